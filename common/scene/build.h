// SPDX-License-Identifier: MIT
// The one way objects enter a scene: numbers them, and establishes what renderers rely on (unit normals, outward
// winding of closed meshes, exact degeneracy flags, which objects are solids). Callers add objects in file order.
#pragma once

#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace sidelight {

// A polygon mesh as readers and shape generators produce it, in its own space.
struct PolygonMesh {
  struct Corner {
    std::uint32_t position = 0;
    std::uint32_t normal = kNone;  // into normals; all corners of a face have one, or none has
  };
  struct Face {
    std::uint32_t first = 0, count = 0;  // range in corners; count >= 3
    std::uint32_t material = 0;          // into Scene::materials
    int line = 0, column = 0;            // where the file has it, 0 for generated faces
  };
  std::vector<glm::dvec3> positions, normals;  // normals of any non-zero length; zero means "use the face's"
  std::vector<Corner> corners;
  std::vector<Face> faces;
};

// Throws InputError where a scene that reaches so many primitives has more than it may (limits.h).
void check_capacity(std::uint64_t primitives, const SourceLocation& where);

// What ear clipping of its faces costs at worst: the squares of their corner counts, summed. The limit is about a minute.
double clipping_effort(const PolygonMesh& mesh);
inline constexpr double kMaxClipping = 1e10;

// x -> linear x + translate.
struct Transform {
  glm::dmat3 linear{1};
  glm::dvec3 translate{0};
};

std::uint32_t add_material(Scene& scene, Material material);
void add_sphere(Scene& scene, const Sphere& sphere, const SourceLocation& where);
// The normal may have any finite non-zero length.
void add_plane(Scene& scene, Plane plane, const SourceLocation& where);
// Transforms, triangulates (triangulate.h), numbers and checks the mesh. Positions go through `transform`, normals
// through its cofactor matrix (the inverse transpose up to a positive factor, which also serves singular maps; the
// determinant's sign is put back, so that normals keep to their side). A negative determinant reverses the winding;
// a closed mesh of negative volume is turned outward. Positions below 1e-30 in magnitude become 0, beyond 1e15 they
// are an InputError at `where`. Warns once where a refracting mesh is not closed.
void add_mesh(Scene& scene, const PolygonMesh& mesh, const Transform& transform, const SourceLocation& where);

}  // namespace sidelight
