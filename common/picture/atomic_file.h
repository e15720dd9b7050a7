// SPDX-License-Identifier: MIT
// Files that appear whole or not at all. The bytes are made in memory first, written to a temporary file
// beside the final name, and renamed over it when every error that writing can report has been ruled out. On
// failure the temporary is removed and an older file of that name is untouched. (Whole for other processes,
// that is; after a power cut the file system decides.)
//
// The program must ignore SIGXFSZ and SIGPIPE, or a file-size limit ends it before any error is seen.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace sidelight {

// A link is followed; a device or pipe (/dev/stdout) is written to directly. Throws OutputError with the path
// and the reason: no such folder, a folder of that name, disk full, ...
void write_file(const std::string& path, std::span<const std::uint8_t> bytes);
// The same for text (JSON, say).
void write_text_file(const std::string& path, const std::string& text);
// Makes the folder, and its parents, if it is not there. Throws OutputError.
void make_folder(const std::string& path);

}  // namespace sidelight
