// SPDX-License-Identifier: MIT
#include "common/scene/tessellate.h"

#include "common/scene/build.h"
#include "common/scene/shapes.h"

namespace sidelight {
namespace {

// The object's triangles and their vertices, unchanged: they are in order already, and winding and normals are settled.
void copy_mesh(const Scene& from, const Object& object, Scene& to) {
  Object copy = object;
  copy.first = static_cast<std::uint32_t>(to.triangles.size());
  copy.first_primitive = static_cast<std::uint32_t>(to.primitive_object.size());
  const auto first = from.triangles.begin() + object.first;
  to.triangles.insert(to.triangles.end(), first, first + object.count);
  to.primitive_object.insert(to.primitive_object.end(), object.count,
                             static_cast<std::uint32_t>(to.objects.size()));
  to.objects.push_back(copy);
}

}  // namespace

Scene tessellated(const Scene& scene, int segments) {
  PolygonMesh ball = make_sphere_mesh(segments);
  std::uint64_t of_ball = 0, total = 0;
  for (const PolygonMesh::Face& face : ball.faces) of_ball += face.count - 2;
  for (const Object& object : scene.objects)
    check_capacity(total += object.kind == ObjectKind::sphere ? of_ball : object.count, object.where);
  Scene out = scene;  // positions and normals keep their numbers, so copied triangles stay right
  out.spheres.clear();
  out.planes.clear();
  out.triangles.clear();
  out.objects.clear();
  out.primitive_object.clear();
  for (const Object& object : scene.objects) {
    if (object.kind == ObjectKind::mesh) {
      copy_mesh(scene, object, out);
    } else if (object.kind == ObjectKind::plane) {
      add_plane(out, scene.planes[object.first], object.where);
    } else {
      const Sphere& sphere = scene.spheres[object.first];
      for (PolygonMesh::Face& face : ball.faces) face.material = sphere.material;
      add_mesh(out, ball, {glm::dmat3(sphere.radius), sphere.center}, object.where);
    }
  }
  return out;
}

}  // namespace sidelight
