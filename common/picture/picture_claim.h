// SPDX-License-Identifier: MIT
// What a picture file claims about its size, read from its first bytes before a library allocates for it: a
// header of 100 bytes can ask for terabytes. Not a decoder; read_image calls it first.
//
// Sources: Portable Network Graphics, W3C 2003, section 11.2.2 (IHDR); OpenEXR File Layout, openexr.com
// (header attributes, chlist, box2i, tiledesc).
#pragma once

#include <cstdint>
#include <string>

namespace sidelight {

enum class PictureFormat { png, openexr };

struct PictureClaim {
  PictureFormat format = PictureFormat::png;
  std::int64_t width = 0, height = 0;  // of the stored part
  std::uint64_t pixel_bytes = 0;       // unpacked, all channels
};

// Throws the InputError about the file as a whole.
[[noreturn]] void reject_file(const std::string& path, const std::string& why);

// Reads the claim of the file and checks it. Throws InputError where the file cannot be read, is neither PNG
// nor single-part, flat OpenEXR, its header is broken, a PNG lacks its end, or the claim cannot be true or is
// too much: more than 2^28 pixels, an edge above 65536, or more than 64 MiB unpacked and over 4096 times the
// file's length (zip reaches 1032).
PictureClaim read_claim(const std::string& path);

}  // namespace sidelight
