// SPDX-License-Identifier: MIT
#include "common/picture/picture_codec.h"

extern "C" __attribute__((visibility("default"))) const sidelight::PictureCodec* sidelight_picture_codec() {
  static constexpr sidelight::PictureCodec kCodec{sidelight::png_bytes, sidelight::png_linear16_bytes,
                                                  sidelight::exr_bytes, sidelight::read_claimed};
  return &kCodec;
}
