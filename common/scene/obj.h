// SPDX-License-Identifier: MIT
// Wavefront OBJ and MTL: v, vn, vt (read and dropped), f (polygons, negative indices), usemtl, mtllib; o, g, s are
// accepted. Numbers by std::from_chars, so a double in the file is that double. Every mistake is an InputError with
// file, line and column: a malformed or non-finite number, an index out of range or zero, a face of fewer than three
// corners, an unknown material, a missing MTL file, statements none of which are of an OBJ file.
#pragma once

#include <string>
#include <vector>

#include "common/scene/build.h"
#include "common/scene/scene.h"

namespace sidelight {

struct ObjFile {
  PolygonMesh mesh;                   // Face::material indexes `materials`, or kNone before any usemtl
  std::vector<Material> materials;    // in the order of first use
  std::vector<std::string> warnings;  // statements that were skipped, one line a kind
  std::vector<std::string> files;     // every file that was read, this one first (for the scene's hash)
};

// `with_materials`: read MTL files and usemtl (an error where they fail); else both are skipped and every
// Face::material is kNone. Throws InputError.
ObjFile read_obj(const std::string& path, bool with_materials);

struct MtlFile {
  std::vector<Material> materials;    // in the order of the file; where a name comes again, the first stays
  std::vector<std::string> warnings;  // at most one, naming all that was passed over
};

// Ka, Kd, Ks, Ns as they are; illum 3, 5, 7: c2 = Ks; illum 6, 7: c3 = Tf; ior = Ni; c1 = 1. What a file leaves out has the
// default of a scene's materials (so no Tf: c3 = 0, which is warned of). Throws InputError: at `named_at` where the file
// cannot be read, else at the place in it: a malformed or non-finite number, one out of the range of the scene's
// materials, a statement before the first newmtl.
MtlFile read_mtl(const std::string& path, const SourceLocation& named_at);

}  // namespace sidelight
