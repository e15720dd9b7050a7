// SPDX-License-Identifier: MIT
// A layer as a picture to look at, for slides, the report and the window: numbers become colours that an eye
// can order or tell apart. The same frame gives the same bytes.
#pragma once

#include <cstdint>

#include "common/picture/frame.h"
#include "common/picture/srgb.h"

namespace sidelight {

// The frame holds the layer. Background, which has no depth, id or normal, is black there.
//   ambient ... refraction  the linear values as sRGB, clamped
//   depth                   grey by 1/z: white at this frame's nearest depth, dark grey at its farthest. On
//                           a flat surface 1/z changes evenly, and a horizon leaves contrast to what is near
//   object, primitive       id_color()
//   normal                  a code of 255 (N + 1)/2 a channel, the usual colours of a normal map
//   cost                    amount_color() of the share in the greatest cost of this frame
Image8 layer_picture(const Frame& frame, Layer layer);

// sRGB codes.
struct Color8 {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Color8&) const = default;
};

// The colour of an id as a frame stores it: black for 0, else one that depends on the id alone and is far
// from those of the ids before and after it.
Color8 id_color(std::uint32_t id);

// From dark blue for 0 to bright yellow for 1, clamped; NaN gives 0. Equal steps look equal, lightness alone
// tells the order, and the hues keep to the axis, blue to yellow, that red-green-blind viewers see.
Color8 amount_color(double amount);

}  // namespace sidelight
