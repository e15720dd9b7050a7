// SPDX-License-Identifier: MIT
// Wavefront MTL, for obj.cpp: Ka, Kd, Ks, Ns as they are; illum 3, 5, 7: c2 = Ks; illum 6, 7: c3 = Tf; ior =
// Ni; c1 = 1. What a file leaves out has the default of a scene's materials (so no Tf: c3 = 0, which is
// warned of).
#pragma once

#include <string>
#include <vector>

#include "common/error.h"
#include "common/scene/scene.h"

namespace sidelight {

struct MtlFile {
  std::vector<Material> materials;    // in the order of the file; where a name comes again, the first stays
  std::vector<std::string> warnings;  // at most one, naming all that was passed over
};

// Throws InputError: at `named_at` where the file cannot be read, else at the place in it: a malformed or
// non-finite number, one out of the range of the scene's materials, a statement before the first newmtl.
MtlFile read_mtl(const std::string& path, const SourceLocation& named_at);

}  // namespace sidelight
