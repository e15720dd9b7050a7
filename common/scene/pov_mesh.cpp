// SPDX-License-Identifier: MIT
#include "common/scene/pov_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

namespace sidelight {
namespace {

// Indices into the scene's positions or normals, numbered anew.
using Numbers = std::map<std::uint32_t, std::size_t>;

using Faces = std::vector<const Triangle*>;

bool is_flat(const Triangle* face) { return face->normal[0] == kNone; }

// Where some faces are smooth, a flat one has three times its own normal, after all others.
void normal_vectors(const PovText& out, const Scene& scene, const Faces& faces, const Numbers& normals) {
  const auto flat = std::count_if(faces.begin(), faces.end(), is_flat);
  out.line("normal_vectors {{ {}", normals.size() + static_cast<std::size_t>(flat));
  for (const auto& [normal, number] : normals) out.line(",{}", pov_vector(scene.normals[normal]));
  for (const Triangle* face : faces) {
    if (!is_flat(face)) continue;
    const glm::dvec3 corner = scene.positions[face->vertex[0]];
    out.line(",{}", pov_vector(glm::normalize(glm::cross(scene.positions[face->vertex[1]] - corner,
                                                         scene.positions[face->vertex[2]] - corner))));
  }
  out.line("}}");
}

void normal_indices(const PovText& out, const Faces& faces, const Numbers& normals) {
  out.line("normal_indices {{ {}", faces.size());
  for (std::size_t next_flat = normals.size(); const Triangle* face : faces) {
    if (is_flat(face))
      out.line(",<{0},{0},{0}>", next_flat++);
    else
      out.line(",<{},{},{}>", normals.at(face->normal[0]), normals.at(face->normal[2]),
               normals.at(face->normal[1]));
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
    for (const std::uint32_t normal : triangle.normal)
      if (normal != kNone) normals.emplace(normal, 0);
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
  if (!normals.empty()) normal_indices(out, faces, normals);
  // Whether the eye is inside is all that POV-Ray asks of it.
  if (object.closed) out.line("inside_vector <0.36,0.48,0.8>");
  out.line("}}");
}

}  // namespace sidelight
