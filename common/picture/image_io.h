// SPDX-License-Identifier: MIT
// Pictures to and from files, through OpenImageIO (picture_codec.h).
//
// Files appear whole or not at all (atomic_file.h). The same frame and metadata give the same bytes: DateTime
// is constant.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/picture/atomic_file.h"
#include "common/picture/frame.h"
#include "common/picture/srgb.h"

namespace sidelight {

// Names (at most 60 characters) get the prefix "sidelight:" in the file. Values are UTF-8, of any number of
// lines; an empty one is not written.
using Metadata = std::vector<std::pair<std::string, std::string>>;

// PNG, 8-bit sRGB. Throws OutputError.
void write_png(const std::string& path, const Image8& image, const Metadata& metadata = {});
// The same as bytes in memory, without metadata.
std::vector<std::uint8_t> encode_png(const Image8& image);
// PNG, linear 16-bit: clamped, rounded half up (NaN gives 0), and marked by the metadata "encoding" =
// "linear". Throws OutputError.
void write_png_linear16(const std::string& path, const Frame& frame, const Metadata& metadata = {});

// EXR: FLOAT R G B, then the layers the frame holds under these names (depth.Z, object.id
// and primitive.id as UINT, normal.X/Y/Z, cost.tests, ambient.R/G/B, ...), in every bit. The display window is
// the whole picture, the data window the crop. Throws OutputError.
void write_exr(const std::string& path, const Frame& frame, const Metadata& metadata = {});

// A picture file as read: float channels decoded to linear (8- and 16-bit PNG through sRGB unless its
// metadata says linear), uint32 channels natively. Alpha ("A") stays beside the colours, which are not
// multiplied by it.
struct ImageFile {
  int width = 0, height = 0;  // of the data window
  int x0 = 0, y0 = 0;         // its place in the display window
  int full_width = 0, full_height = 0;
  bool png = false;                                       // integers, so clamped to [0, 1]; else OpenEXR
  std::map<std::string, std::vector<float>> channels;     // "R", "G", "B", "depth.Z", ...
  std::map<std::string, std::vector<std::uint32_t>> ids;  // "object.id", "primitive.id"
  std::map<std::string, std::string> metadata;            // those of sidelight, without the prefix
};
// Throws InputError: unreadable, neither PNG nor single-part OpenEXR, truncated, no R G B (a grey file gives
// R = G = B; one of luminance and chroma is none), or claiming more pixels than 2^28 or than its length can hold
// (picture_claim.h).
ImageFile read_image(const std::string& path);
// R, G and B, pixel by pixel.
std::vector<glm::vec3> colors(const ImageFile& image);

}  // namespace sidelight
