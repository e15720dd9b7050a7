// SPDX-License-Identifier: MIT
// A fault on purpose: triangles as a renderer in float meets them, with neither an error bound nor an exact routine
// behind it. Positions, origin and direction are rounded to float as a graphics card's buffers hold them; the edge
// functions, the side and the depth are the sentences of visibility.h, in float. Far from the origin of the world
// vertices then jump in steps of 2^-24 of their distance from it. Spheres and planes are left exact.
#pragma once

#include "common/model/visibility.h"

namespace sidelight {

// As intersect(). A triangle's hit that the exact functions cannot place (the ray lies in its plane but for rounding)
// is dropped, so that no picture holds a NaN.
Hit intersect_in_float(const Scene& scene, std::uint32_t primitive, const Ray& ray, const Hit& after,
                       VisibilityCounts& counts);

}  // namespace sidelight
