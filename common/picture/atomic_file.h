// SPDX-License-Identifier: MIT
// Files that appear whole or not at all. The bytes are written to a temporary file beside the final name,
// which is renamed over it when every error that making and writing them can report has been ruled out. On
// failure the temporary is removed and an older file of that name is untouched. (Whole for other processes,
// that is; after a power cut the file system decides.)
//
// The program must ignore SIGXFSZ and SIGPIPE, or a file-size limit ends it before any error is seen.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sidelight {

// A link is followed; a device or pipe (/dev/stdout) is written to directly. Throws OutputError with the path
// and the reason: no such folder, a folder of that name, disk full, ...
void write_file(const std::string& path, std::span<const std::uint8_t> bytes);
// The same for text (JSON, say).
void write_text_file(const std::string& path, const std::string& text);
// The same for a text too long to be made in memory: `produce` is called once, with a function that appends to it. What
// it throws goes through, and no file appears.
using AppendText = std::function<void(std::string_view)>;
void write_text_file(const std::string& path, const std::function<void(const AppendText&)>& produce);
// Makes the folder, and its parents, if it is not there. Throws OutputError.
void make_folder(const std::string& path);

// The same for a run that may be broken off: what it made goes with it where nothing was written there.
class OutputFolder {
 public:
  explicit OutputFolder(const std::string& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::vector<std::string> made_;  // innermost first
};

}  // namespace sidelight
