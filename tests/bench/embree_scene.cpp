// SPDX-License-Identifier: MIT
#include "tests/bench/embree_scene.h"

#include <stdexcept>
#include <string>

namespace sidelight::bench {

EmbreeScene::EmbreeScene(const Scene& scene, int threads)
    : scene_(scene), device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())) {
  if (!device_) throw std::runtime_error("Embree has no device");
  for (const glm::dvec3& p : scene.positions) positions_.emplace_back(p);
  positions_.emplace_back(0);  // Embree reads 16 bytes of each
  for (const glm::dvec3& n : scene.normals) normals_.emplace_back(n);
  for (const Triangle& triangle : scene.triangles) corners_.push_back(triangle.vertex);
  for (const Sphere& sphere : scene.spheres)
    spheres_.emplace_back(glm::vec3(sphere.center), static_cast<float>(sphere.radius));
  for (const Material& m : scene.materials)
    materials_.push_back({m.ambient * scene.ambient, m.diffuse, m.specular, m.local, m.reflect, m.refract,
                          static_cast<float>(m.shininess), static_cast<float>(m.ior)});
}

void EmbreeScene::attach(RTCGeometry geometry, unsigned number) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(built_.get(), geometry, number);
  rtcReleaseGeometry(geometry);
}

void EmbreeScene::build() {
  built_.reset(rtcNewScene(device_.get()));
  if (!corners_.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions_.data(), 0,
                               sizeof(glm::vec3), positions_.size() - 1);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, corners_.data(), 0, 12,
                               corners_.size());
    attach(geometry, kTriangles);
  }
  if (!spheres_.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, spheres_.data(), 0,
                               sizeof(glm::vec4), spheres_.size());
    attach(geometry, kSpheres);
  }
  rtcCommitScene(built_.get());
  if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE)
    throw std::runtime_error("Embree: error " + std::to_string(error));
}

const EmbreeScene::FloatMaterial& EmbreeScene::material(const RTCHit& hit) const {
  return materials_[hit.geomID == kTriangles ? scene_.triangles[hit.primID].material
                                             : scene_.spheres[hit.primID].material];
}

glm::vec3 EmbreeScene::smooth_normal(const RTCHit& hit) const {
  if (hit.geomID != kTriangles) return glm::vec3(0);
  const auto& corner = scene_.triangles[hit.primID].normal;
  if (corner[0] == kNone) return glm::vec3(0);
  return (1 - hit.u - hit.v) * normals_[corner[0]] + hit.u * normals_[corner[1]] +
         hit.v * normals_[corner[2]];
}

}  // namespace sidelight::bench
