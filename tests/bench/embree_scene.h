// SPDX-License-Identifier: MIT
// A scene as Embree 3 holds it: all triangles in one geometry, all spheres in another of its own sphere type, single
// precision, default flags (the fastest, not the robust ones) and default build quality. Buffers are shared, not copied.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "common/scene/scene.h"

namespace sidelight::bench {

class EmbreeScene {
 public:
  // `scene` must outlive this. Not built yet.
  EmbreeScene(const Scene& scene, int threads);

  // Builds the hierarchy anew.
  void build();
  RTCScene handle() const { return built_.get(); }

  // What an Embree program keeps beside: as floats, by the numbers of Scene.
  struct FloatMaterial {
    glm::vec3 ambient, diffuse, specular, local, reflect, refract;  // ambient: ka Ia
    float shininess, ior;
  };
  const FloatMaterial& material(const RTCHit& hit) const;
  // The interpolated normal of a triangle, not unit; zero where it is flat, or a sphere.
  glm::vec3 smooth_normal(const RTCHit& hit) const;

 private:
  template <class Handle, void (*release)(Handle)>
  struct Release {
    using pointer = Handle;
    void operator()(Handle handle) const { release(handle); }
  };

  void attach(RTCGeometry geometry, unsigned number);

  const Scene& scene_;
  std::vector<glm::vec3> positions_, normals_;
  std::vector<std::array<unsigned, 3>> corners_;
  std::vector<glm::vec4> spheres_;
  std::vector<FloatMaterial> materials_;
  std::unique_ptr<void, Release<RTCDevice, rtcReleaseDevice>> device_;
  std::unique_ptr<void, Release<RTCScene, rtcReleaseScene>> built_;
};

inline constexpr unsigned kTriangles = 0, kSpheres = 1;  // numbers of the geometries

}  // namespace sidelight::bench
