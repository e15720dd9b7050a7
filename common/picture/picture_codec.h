// SPDX-License-Identifier: MIT
// What OpenImageIO does for image_io.h: pictures to and from the bytes of a file. image_write.cpp and image_read.cpp, the
// only files that know OpenImageIO, are a library of their own, which the first picture loads: Debian's OpenImageIO brings
// 250 libraries with it, and to load them takes ten times as long as all else of a start (`time sidelight --version`).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/picture/image_io.h"
#include "common/picture/picture_claim.h"

namespace sidelight {

// The bytes of a file, as image_io.h describes it. `name` is the picture's in messages. Throws OutputError.
//
// Into memory: OpenEXR may swallow what goes wrong while a file closes, and the bytes then go through write_file, where
// nothing is lost and no half-written file appears.
std::vector<std::uint8_t> png_bytes(const std::string& name, const Image8& image, const Metadata& metadata);
std::vector<std::uint8_t> png_linear16_bytes(const std::string& name, const Frame& frame,
                                             const Metadata& metadata);
std::vector<std::uint8_t> exr_bytes(const std::string& name, const Frame& frame, const Metadata& metadata);

// read_image of a file whose claim has been checked before OpenImageIO sees it. Throws InputError and std::bad_alloc.
ImageFile read_claimed(const std::string& path, const PictureClaim& claim);

// The functions above, as the library hands them out.
struct PictureCodec {
  decltype(&png_bytes) png;
  decltype(&png_linear16_bytes) png_linear16;
  decltype(&exr_bytes) exr;
  decltype(&read_claimed) read;
};

}  // namespace sidelight

extern "C" const sidelight::PictureCodec* sidelight_picture_codec();
