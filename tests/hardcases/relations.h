// SPDX-License-Identifier: MIT
// What the metamorphic relations (MET) share: scenes that are moved or changed in memory, and how alike two pictures of
// them are.
#pragma once

#include <algorithm>
#include <cmath>

#include "common/scene/build.h"
#include "common/scene/toml.h"
#include "tests/agreement/pictures.h"

namespace sidelight::test {

// How far the second of two frames is from the first.
struct Likeness {
  std::uint64_t pixels = 0;
  std::uint64_t surfaces = 0;  // pixels with another primitive
  std::uint64_t depths = 0;    // pixels with another depth, in any bit
  double color = 0;            // greatest difference of a channel, relative where it is above 1

  void add(const Frame& a, const Frame& b) {
    REQUIRE(a.color.size() == b.color.size());
    for (std::size_t i = 0; i < a.pixels(); ++i) {
      ++pixels;
      surfaces += a.sample_primitive[i] != b.sample_primitive[i];
      depths += std::memcmp(&a.sample_depth[i], &b.sample_depth[i], sizeof(double)) != 0;
      for (int c = 0; c < 3; ++c) {
        const double apart = std::abs(double{a.color[i][c]} - double{b.color[i][c]});
        color = std::max(color, std::isnan(apart) ? INFINITY : apart / std::max(1.0, double{a.color[i][c]}));
      }
    }
  }
};

inline Camera relation_camera(const Scene& scene) { return make_camera(scene.camera, 67, 49, 1); }

// By both renderers, with shadows and secondary rays in the tracer's.
inline Likeness likeness(const Scene& a, const Scene& b) {
  Likeness out;
  out.add(rastered(a, relation_camera(a)), rastered(b, relation_camera(b)));
  out.add(traced(a, relation_camera(a)), traced(b, relation_camera(b)));
  return out;
}
inline bool same_bytes(const Scene& a, const Scene& b) {
  return differences(rastered(a, relation_camera(a)), rastered(b, relation_camera(b))).empty() &&
         differences(traced(a, relation_camera(a)), traced(b, relation_camera(b))).empty();
}

inline Scene everything() { return load_scene(kEverything); }

// Without highlights, whose error grows with the exponent.
inline Scene matte(Scene scene) {
  for (Material& material : scene.materials) material.specular = glm::dvec3(0);
  return scene;
}

// Points through `point`, directions through `direction`.
template <class Point, class Direction>
Scene moved(Scene scene, const Point& point, const Direction& direction) {
  for (glm::dvec3& p : scene.positions) p = point(p);
  for (glm::dvec3& n : scene.normals) n = direction(n);
  for (Sphere& s : scene.spheres) s.center = point(s.center);
  for (Plane& p : scene.planes) {
    p.point = point(p.point);
    p.normal = direction(p.normal);
  }
  for (Light& l : scene.lights) {
    l.position = point(l.position);
    l.direction = direction(l.direction);
  }
  scene.camera.eye = point(scene.camera.eye);
  scene.camera.look_at = point(scene.camera.look_at);
  scene.camera.up = direction(scene.camera.up);
  return scene;
}
template <class Turn>
Scene turned(const Scene& scene, const Turn& turn) {
  return moved(scene, turn, turn);
}

// An object of `from` as a mesh of its own, with its triangles as `change` leaves them.
template <class Change>
PolygonMesh mesh_of_object(const Scene& from, const Object& object, const Change& change) {
  PolygonMesh mesh;
  mesh.positions = from.positions;
  mesh.normals = from.normals;
  std::vector<Triangle> triangles(from.triangles.begin() + object.first,
                                  from.triangles.begin() + object.first + object.count);
  change(triangles, mesh.positions);
  for (const Triangle& triangle : triangles) {
    PolygonMesh::Face face;
    face.first = static_cast<std::uint32_t>(mesh.corners.size());
    face.count = 3;
    face.material = triangle.material;
    mesh.faces.push_back(face);
    for (std::size_t k = 0; k < 3; ++k) mesh.corners.push_back({triangle.vertex[k], triangle.normal[k]});
  }
  return mesh;
}

// The scene with its objects in the order `order`, all else as it is; `change(triangles, positions)` may edit the
// triangles of a mesh.
template <class Change>
Scene rebuilt(const Scene& scene, const std::vector<std::size_t>& order, const Change& change) {
  Scene out = scene;
  out.spheres.clear();
  out.planes.clear();
  out.positions.clear();
  out.normals.clear();
  out.triangles.clear();
  out.objects.clear();
  out.primitive_object.clear();
  for (const std::size_t i : order) {
    const Object& object = scene.objects[i];
    switch (object.kind) {
      case ObjectKind::sphere:
        add_sphere(out, scene.spheres[object.first], object.where);
        break;
      case ObjectKind::plane:
        add_plane(out, scene.planes[object.first], object.where);
        break;
      case ObjectKind::mesh:
        add_mesh(out, mesh_of_object(scene, object, change), {}, object.where);
        break;
    }
  }
  return out;
}
inline void unchanged(std::vector<Triangle>&, std::vector<glm::dvec3>&) {}

}  // namespace sidelight::test
