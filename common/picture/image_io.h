// SPDX-License-Identifier: MIT
// Pictures to and from files, through OpenImageIO. The only file that knows it.
//
// Files appear whole or not at all: written beside their final name, then renamed. The same frame gives the same
// decoded channels and metadata (DateTime is constant).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/picture/frame.h"

namespace sidelight {

using Metadata = std::vector<std::pair<std::string, std::string>>;   // names get the prefix "sidelight:" in the file

// 8-bit RGB, top row first.
struct Image8 {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;   // 3 * width * height
};

// Linear to sRGB (IEC 61966-2-1), clamped to [0, 1], to 8 bits by rounding half up. The one place where either happens.
std::uint8_t encode_srgb8(float linear);
float decode_srgb8(std::uint8_t encoded);
Image8 to_image8(const std::vector<glm::vec3>& linear, int width, int height);

// PNG, 8-bit sRGB. Throws OutputError.
void write_png(const std::string& path, const Image8& image, const Metadata& metadata = {});
// PNG, linear 16-bit: clamped, rounded half up. Throws OutputError.
void write_png_linear16(const std::string& path, const Frame& frame, const Metadata& metadata = {});

// EXR: FLOAT R G B, then the layers the frame holds under the names of DESIGN section 6 (depth.Z, object.id and
// primitive.id as UINT, normal.X/Y/Z, ambient.R/G/B, ...). The display window is the whole picture, the data window the
// crop. Throws OutputError.
void write_exr(const std::string& path, const Frame& frame, const Metadata& metadata = {});

// A picture file as read: float channels decoded to linear (8- and 16-bit PNG through sRGB unless its metadata says
// linear), uint32 channels natively.
struct ImageFile {
  int width = 0, height = 0;               // of the data window
  int x0 = 0, y0 = 0, full_width = 0, full_height = 0;
  bool eight_bit = false;                  // the file held 8-bit samples
  std::map<std::string, std::vector<float>> channels;            // "R", "G", "B", "depth.Z", ...
  std::map<std::string, std::vector<std::uint32_t>> ids;         // "object.id", "primitive.id"
  std::map<std::string, std::string> metadata;                   // without the prefix
};
// Throws InputError (unreadable, not a picture, no R G B; a grey file gives R = G = B).
ImageFile read_image(const std::string& path);

// Writes text (JSON, say) whole or not at all. Throws OutputError.
void write_text_file(const std::string& path, const std::string& text);
// Makes the folder, and its parents, if it is not there. Throws OutputError.
void make_folder(const std::string& path);

}  // namespace sidelight
