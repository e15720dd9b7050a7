// SPDX-License-Identifier: MIT
// Objects into the scene: what renderers rely on is established here and nowhere else. Readers and shape
// generators call it in file order; it draws and reads nothing.
#include "common/scene/build.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <span>
#include <utility>

#include "common/model/exact.h"
#include "common/scene/closed_mesh.h"
#include "common/scene/limits.h"
#include "common/scene/number_text.h"
#include "common/scene/triangulate.h"
#include "common/scene/unit_vector.h"

namespace sidelight {
namespace {

using glm::dmat3;
using glm::dvec3;

void warn(Scene& scene, const SourceLocation& where, const std::string& message) {
  scene.warnings.push_back(InputError(where, message).what());
}

// --- Numbers in range ---

// The value, or 0 where it is as good as that. Throws where it is too large or not a number; `what` names it.
double in_range(double value, const SourceLocation& where, const std::string& what) {
  if (!(std::abs(value) <= kLargest))
    throw InputError(where, what + " is " + number_text(value) + ", expected at most 1e15 in magnitude");
  return std::abs(value) < kSmallestLength ? 0.0 : value;
}

dvec3 in_range(const dvec3& p, const SourceLocation& where, const std::string& what) {
  return {in_range(p.x, where, what), in_range(p.y, where, what), in_range(p.z, where, what)};
}

void check_capacity(const Scene& scene, std::uint64_t more, const SourceLocation& where) {
  check_capacity(scene.primitive_object.size() + more, where);
}

void check_size(const Scene& scene, const PolygonMesh& mesh, const SourceLocation& where) {
  std::uint64_t triangles = 0;
  for (const PolygonMesh::Face& face : mesh.faces) {
    assert(face.count >= 3 && std::uint64_t{face.first} + face.count <= mesh.corners.size());
    triangles += face.count - 2;
  }
  check_capacity(scene, triangles, where);
  if (const double clipping = clipping_effort(mesh); clipping > kMaxClipping)
    throw InputError(where, "the squares of the faces' corner counts add up to " + number_text(clipping) +
                                ", expected at most " + number_text(kMaxClipping));
  assert(scene.positions.size() + mesh.positions.size() < kNone);
  assert(scene.normals.size() + mesh.normals.size() < kNone);
}

// --- Objects and media ---

bool refracts(const Material& m) { return m.refract.x > 0 || m.refract.y > 0 || m.refract.z > 0; }

void push_object(Scene& scene, Object object, const SourceLocation& where) {
  object.first_primitive = static_cast<std::uint32_t>(scene.primitive_object.size());
  object.where = where;
  const auto number = static_cast<std::uint32_t>(scene.objects.size());
  scene.primitive_object.insert(scene.primitive_object.end(), object.count, number);
  scene.objects.push_back(std::move(object));
}

// A sphere or a plane: always closed.
Object simple_object(const Scene& scene, ObjectKind kind, std::size_t first, std::uint32_t material) {
  assert(material < scene.materials.size());
  Object object;
  object.kind = kind;
  object.first = static_cast<std::uint32_t>(first);
  object.solid = refracts(scene.materials[material]);
  if (object.solid) object.ior = scene.materials[material].ior;
  return object;
}

// Whether the mesh bounds a medium, and of which index: its first refracting face's.
void find_medium(Scene& scene, Object& object, std::span<const Triangle> triangles,
                 const SourceLocation& where) {
  const Material* medium = nullptr;
  bool several = false;
  for (const Triangle& triangle : triangles) {
    const Material& material = scene.materials[triangle.material];
    if (!refracts(material)) continue;
    if (!medium) medium = &material;
    several = several || material.ior != medium->ior;
  }
  if (!medium) return;
  if (object.closed) {
    object.solid = true;
    object.ior = medium->ior;
    if (several)
      warn(scene, where,
           "the mesh's materials have several indices of refraction; the first face's, " +
               number_text(medium->ior) + ", is used throughout");
  } else {
    warn(scene, where,
         "the mesh refracts but is not closed, so it has no inside: light goes through it straight on "
         "(T = D)");
  }
}

// --- Meshes ---

void append_positions(Scene& scene, const PolygonMesh& mesh, const Transform& transform,
                      const SourceLocation& where) {
  scene.positions.reserve(scene.positions.size() + mesh.positions.size());
  std::string name;
  for (const dvec3& local : mesh.positions) {
    const dvec3 p = transform.linear * local + transform.translate;
    const bool fine = glm::all(glm::lessThanEqual(glm::abs(p), dvec3(kLargest)));
    if (!fine)
      name = "vertex " + std::to_string(&local - mesh.positions.data() + 1) + " (of the mesh, from 1)";
    scene.positions.push_back(in_range(p, where, name));
  }
}

// The sign of the determinant, -1, 0 or 1; lengths of the columns do not matter.
int handedness(const dmat3& m) {
  return exact::determinant_sign(binary_scaled(m[0]), binary_scaled(m[1]), binary_scaled(m[2]));
}

// All entries times one power of two, the largest then in [0.5, 1).
dmat3 scaled_entries(dmat3 m) {
  double largest = 0;
  for (glm::length_t k = 0; k < 9; ++k) largest = std::max(largest, std::abs(m[k / 3][k % 3]));
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (glm::length_t k = 0; k < 9; ++k) m[k / 3][k % 3] = std::ldexp(m[k / 3][k % 3], -exponent);
  return m;
}

// What takes normals to where `linear` takes their surface: the transpose of the inverse up to a positive
// factor, that is the cofactor matrix by the determinant's sign. Made of products alone, so singular maps are
// welcome.
dmat3 normal_map(const dmat3& linear) {
  const dmat3 m = scaled_entries(linear);
  const dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return handedness(linear) < 0 ? -cofactors : cofactors;
}

void append_normals(Scene& scene, const PolygonMesh& mesh, const Transform& transform) {
  const dmat3 map = normal_map(transform.linear);
  scene.normals.reserve(scene.normals.size() + mesh.normals.size());
  for (const dvec3& n : mesh.normals) scene.normals.push_back(unit_or_zero(map * binary_scaled(n)));
}

// Numbers of a mesh's first position and normal in the scene.
struct Base {
  std::uint32_t position, normal;
};

void append_triangles(Scene& scene, const PolygonMesh& mesh, Base base) {
  std::vector<dvec3> polygon;
  for (const PolygonMesh::Face& face : mesh.faces) {
    assert(face.material < scene.materials.size());
    const auto corners = std::span(mesh.corners).subspan(face.first, face.count);
    polygon.clear();
    for (const PolygonMesh::Corner& corner : corners) {
      assert(corner.position < mesh.positions.size());
      assert(corner.normal == kNone || corner.normal < mesh.normals.size());
      polygon.push_back(scene.positions[base.position + corner.position]);
    }
    for (const auto& [a, b, c] : triangulate(polygon)) {
      Triangle triangle;
      triangle.material = face.material;
      triangle.degenerate = exact::collinear(polygon[a], polygon[b], polygon[c]);
      for (std::size_t k = 0; const std::uint32_t at : {a, b, c}) {
        triangle.vertex[k] = base.position + corners[at].position;
        if (corners[at].normal != kNone) triangle.normal[k] = base.normal + corners[at].normal;
        ++k;
      }
      scene.triangles.push_back(triangle);
    }
  }
}

void reverse(std::span<Triangle> triangles) {
  for (Triangle& t : triangles) {
    std::swap(t.vertex[1], t.vertex[2]);
    std::swap(t.normal[1], t.normal[2]);
  }
}

}  // namespace

void check_capacity(std::uint64_t primitives, const SourceLocation& where) {
  if (primitives > kMaxPrimitives)
    throw InputError(where, "the scene reaches " + std::to_string(primitives) +
                                " primitives, expected at most " + std::to_string(kMaxPrimitives));
}

double clipping_effort(const PolygonMesh& mesh) {
  double effort = 0;
  for (const PolygonMesh::Face& face : mesh.faces)
    if (face.count > 4) effort += static_cast<double>(face.count) * face.count;
  return effort;
}

std::uint32_t add_material(Scene& scene, Material material) {
  scene.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void add_sphere(Scene& scene, const Sphere& sphere, const SourceLocation& where) {
  check_capacity(scene, 1, where);
  Sphere added = sphere;
  added.center = in_range(sphere.center, where, "the centre");
  added.radius = in_range(sphere.radius, where, "the radius");
  if (!(added.radius > 0))
    throw InputError(where, "the radius is " + number_text(sphere.radius) + ", expected at least 1e-30");
  const Object object = simple_object(scene, ObjectKind::sphere, scene.spheres.size(), sphere.material);
  scene.spheres.push_back(added);
  push_object(scene, object, where);
}

void add_plane(Scene& scene, Plane plane, const SourceLocation& where) {
  check_capacity(scene, 1, where);
  plane.point = in_range(plane.point, where, "the point");
  plane.normal = unit_or_zero(plane.normal);
  if (plane.normal == dvec3(0)) throw InputError(where, "the plane's normal must be finite and not zero");
  const Object object = simple_object(scene, ObjectKind::plane, scene.planes.size(), plane.material);
  scene.planes.push_back(plane);
  push_object(scene, object, where);
}

void add_mesh(Scene& scene, const PolygonMesh& mesh, const Transform& transform,
              const SourceLocation& where) {
  check_size(scene, mesh, where);
  const Base base{static_cast<std::uint32_t>(scene.positions.size()),
                  static_cast<std::uint32_t>(scene.normals.size())};
  append_positions(scene, mesh, transform, where);
  append_normals(scene, mesh, transform);

  Object object;
  object.kind = ObjectKind::mesh;
  object.first = static_cast<std::uint32_t>(scene.triangles.size());
  append_triangles(scene, mesh, base);
  const std::span<Triangle> triangles = std::span(scene.triangles).subspan(object.first);
  object.count = static_cast<std::uint32_t>(triangles.size());
  if (triangles.empty()) warn(scene, where, "the mesh has no faces");

  // Winding: a mirror image keeps its outside, and a closed mesh gets it right whatever the file says.
  if (handedness(transform.linear) < 0) reverse(triangles);
  const auto positions = std::span(scene.positions).subspan(base.position);
  object.closed = is_closed(triangles, positions, base.position);
  if (object.closed && is_inside_out(triangles, positions, base.position)) reverse(triangles);

  find_medium(scene, object, triangles, where);
  push_object(scene, object, where);
}

}  // namespace sidelight
