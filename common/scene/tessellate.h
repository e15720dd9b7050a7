// SPDX-License-Identifier: MIT
// A fault on purpose: spheres as facets, which is what a z-buffer in hardware draws. The facets' error against their
// number is a thing to teach: with chords, it falls four times when their number of segments doubles.
#pragma once

#include "common/scene/scene.h"

namespace sidelight {

// The scene with a mesh of `segments` (shapes.h: make_sphere_mesh) in place of each sphere. Objects and materials keep
// their numbers; primitives are numbered anew. Throws InputError, at the object that is too many, where that is more
// primitives than a scene may have (limits.h), before any is made.
Scene tessellated(const Scene& scene, int segments);

}  // namespace sidelight
