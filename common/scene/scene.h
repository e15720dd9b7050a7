// SPDX-License-Identifier: MIT
// The scene: plain structs that both renderers, the references and the readers share. Everything is in world
// space and in double; handles are indices; member initialisers are the documented defaults of the file format.
// Invariants are established once, by add_sphere, add_plane and add_mesh (build.h); readers call only those, and
// renderers rely on them.
//
// Numbering: objects in file order, whatever their kind; primitives through the scene in that order, a sphere and
// a plane one each, a mesh its triangles. Triangles of all meshes stand in one array in that same order.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"

namespace sidelight {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// 1 / (q0 + q1 d + q2 d²); coefficients >= 0 with a sum of at least 1e-30.
struct Attenuation {
  double q0 = 1, q1 = 0, q2 = 0;
};

struct Light {
  bool directional = false;
  glm::dvec3 position{0};   // point light only
  glm::dvec3 direction{0};  // directional light only: unit, the way the light travels
  glm::dvec3 intensity{0};  // >= 0, linear RGB
  Attenuation attenuation;  // point light only
};

struct Material {
  std::string name;
  glm::dvec3 ambient{0}, diffuse{0}, specular{0};  // ka, kd, ks: >= 0
  double shininess = 1;                            // s in [0, 1e6]
  glm::dvec3 local{1}, reflect{0}, refract{0};     // c1, c2, c3: >= 0
  double ior = 1;                                  // in [0.25, 4]
  bool casts_shadow = true;
  bool of_mesh_file = false;  // from its MTL: the scene file has no key for it
};

struct Sphere {
  glm::dvec3 center{0};
  double radius = 1;  // > 0
  std::uint32_t material = 0;
};

struct Plane {
  glm::dvec3 point{0};
  glm::dvec3 normal{0, 1, 0};  // unit; as a solid, the plane is the half-space behind it
  std::uint32_t material = 0;
};

struct Triangle {
  std::array<std::uint32_t, 3> vertex{};                     // into Scene::positions
  std::array<std::uint32_t, 3> normal{kNone, kNone, kNone};  // into Scene::normals, or kNone: flat
  std::uint32_t material = 0;
  bool degenerate = false;  // zero area, exactly: never hit, but keeps its number
};

enum class ObjectKind : std::uint8_t { sphere, plane, mesh };

struct Object {
  ObjectKind kind = ObjectKind::sphere;
  std::uint32_t first = 0;            // into spheres, planes or triangles
  std::uint32_t count = 1;            // triangles of a mesh, else 1
  std::uint32_t first_primitive = 0;  // number of its first primitive
  bool closed = true;                 // a mesh: each directed edge exactly once, with its reverse
  bool solid = false;                 // bounds a medium: closed (or sphere, or plane), and refracts
  double ior = 1;                     // of that medium
  SourceLocation where;               // where the file begins it
};

struct CameraSettings {
  glm::dvec3 eye{0}, look_at{0, 0, -1}, up{0, 1, 0};
  double view_height = 1;  // height of the picture at distance 1 = 2 tan(vertical_fov / 2)
};

struct TraceSettings {
  int depth = 6;                      // rays along a path, the eye ray included; >= 1
  double contribution_cut = 0;        // in [0, 1]
  Attenuation secondary_attenuation;  // w(r) = 1 / max(1, q0 + q1 r + q2 r²)
  bool shadows = true, reflection = true, refraction = true;
};

// One step of a lesson: what to show when the teacher presses the key.
struct Step {
  std::string text;
  std::string mode;  // a view mode, or empty: unchanged
  std::optional<glm::dvec3> eye;
  std::vector<std::pair<std::string, std::string>> set;  // key path and value, as written in TOML
};

struct Scene {
  std::string file;  // as the user named it; empty for scenes made in memory
  std::string hash;  // 16 hex digits over the scene file and all it reads
  std::string title, lesson;
  glm::dvec3 background{0}, ambient{0};
  int width = 640, height = 480;
  CameraSettings camera;
  TraceSettings trace;

  std::vector<Light> lights;
  std::vector<Material> materials;
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  // unit, or 0: left out where normals are interpolated
  std::vector<Triangle> triangles;
  std::vector<Object> objects;
  std::vector<std::uint32_t> primitive_object;  // object of each primitive; its size is the primitive count

  std::vector<Step> steps;
  std::vector<std::string> warnings;  // one line each, for stderr
};

// What a primitive number stands for: its kind and its index into spheres, planes or triangles.
struct PrimitiveRef {
  ObjectKind kind;
  std::uint32_t index;
};

inline PrimitiveRef primitive_ref(const Scene& scene, std::uint32_t primitive) {
  const Object& object = scene.objects[scene.primitive_object[primitive]];
  return {object.kind, object.first + (primitive - object.first_primitive)};
}

inline std::uint32_t primitive_material(const Scene& scene, std::uint32_t primitive) {
  const PrimitiveRef ref = primitive_ref(scene, primitive);
  if (ref.kind == ObjectKind::sphere) return scene.spheres[ref.index].material;
  if (ref.kind == ObjectKind::plane) return scene.planes[ref.index].material;
  return scene.triangles[ref.index].material;
}

}  // namespace sidelight
