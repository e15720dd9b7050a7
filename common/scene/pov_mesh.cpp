// SPDX-License-Identifier: MIT
#include "common/scene/pov_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

#include "common/scene/unit_vector.h"

namespace sidelight {
namespace {

// Indices into the scene's positions or normals, numbered anew.
using Numbers = std::map<std::uint32_t, std::size_t>;

using Faces = std::vector<const Triangle*>;

bool lacks_normals(const Scene& scene, const Triangle& face) {
  return !has_normal(scene, face, 0) || !has_normal(scene, face, 1) || !has_normal(scene, face, 2);
}

// Where some faces are smooth, corners without a normal have their face's own, which stands after all others.
void normal_vectors(const PovText& out, const Scene& scene, const Faces& faces, const Numbers& normals) {
  const auto lacking =
      std::ranges::count_if(faces, [&](const Triangle* face) { return lacks_normals(scene, *face); });
  out.line("normal_vectors {{ {}", normals.size() + static_cast<std::size_t>(lacking));
  for (const auto& [normal, number] : normals) out.line(",{}", pov_vector(scene.normals[normal]));
  for (const Triangle* face : faces) {
    if (!lacks_normals(scene, *face)) continue;
    const glm::dvec3 corner = scene.positions[face->vertex[0]];
    out.line(",{}", pov_vector(unit_or_zero(glm::cross(scene.positions[face->vertex[1]] - corner,
                                                       scene.positions[face->vertex[2]] - corner))));
  }
  out.line("}}");
}

void normal_indices(const PovText& out, const Scene& scene, const Faces& faces, const Numbers& normals) {
  out.line("normal_indices {{ {}", faces.size());
  for (std::size_t next_own = normals.size(); const Triangle* face : faces) {
    const std::size_t own = lacks_normals(scene, *face) ? next_own++ : 0;
    const auto number = [&](std::size_t k) {
      return has_normal(scene, *face, k) ? normals.at(face->normal[k]) : own;
    };
    out.line(",<{},{},{}>", number(0), number(2), number(1));
  }
  out.line("}}");
}

}  // namespace

void write_pov_mesh(const PovText& out, const Scene& scene, const Object& object, std::uint32_t material) {
  Numbers vertices, normals;
  Faces faces;
  for (std::uint32_t i = object.first; i < object.first + object.count; ++i) {
    const Triangle& triangle = scene.triangles[i];
    if (triangle.degenerate || triangle.material != material) continue;
    faces.push_back(&triangle);
    for (const std::uint32_t vertex : triangle.vertex) vertices.emplace(vertex, 0);
    for (std::size_t k = 0; k < 3; ++k)
      if (has_normal(scene, triangle, k)) normals.emplace(triangle.normal[k], 0);
  }
  for (std::size_t next = 0; auto& [vertex, number] : vertices) number = next++;
  for (std::size_t next = 0; auto& [normal, number] : normals) number = next++;

  out.line("mesh2 {{");
  out.line("vertex_vectors {{ {}", vertices.size());
  for (const auto& [vertex, number] : vertices) out.line(",{}", out.place(scene.positions[vertex]));
  out.line("}}");
  if (!normals.empty()) normal_vectors(out, scene, faces, normals);
  out.line("face_indices {{ {}", faces.size());
  for (const Triangle* face : faces)
    out.line(",<{},{},{}>", vertices[face->vertex[0]], vertices[face->vertex[2]], vertices[face->vertex[1]]);
  out.line("}}");
  if (!normals.empty()) normal_indices(out, scene, faces, normals);
  // Whether the eye is inside is all that POV-Ray asks of it.
  if (object.closed) out.line("inside_vector <0.36,0.48,0.8>");
  out.line("}}");
}

}  // namespace sidelight
