// SPDX-License-Identifier: MIT
// Packets of 16 rays through Embree, with as little shading as there can be (embree_tracer.h). Loops over the 16 lanes
// are for the compiler to vectorise.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "common/scene/camera.h"
#include "tests/bench/embree_scene.h"

namespace sidelight::bench {

inline constexpr float kOffset = 1e-4f;  // by which rays leave a surface, in scene units

class PacketShader {
 public:
  PacketShader(const Scene& scene, const EmbreeScene& hierarchy) : scene_(scene), hierarchy_(hierarchy) {
    rtcInitIntersectContext(&context_);
    context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }

  std::uint64_t rays = 0;

  // The 4x4 pixels from (x, y) on, as far as they are in the picture.
  void draw(const Camera& camera, int x, int y, bool shadows, std::vector<glm::vec3>& picture) {
    load(camera, [&](int i) { return glm::ivec2(x + i % 4, y + i / 4); });
    rtcIntersect16(valid_, hierarchy_.handle(), &context_, &packet_);
    shade(shadows);
    for (int i = 0; i < 16; ++i) {
      if (valid_[i] == 0) continue;
      glm::vec3& color =
          picture[static_cast<std::size_t>(y + i / 4) * static_cast<std::size_t>(camera.width) +
                  static_cast<std::size_t>(x + i % 4)];
      const bool met = packet_.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      color = met ? glm::vec3(red_[i], green_[i], blue_[i]) : glm::vec3(scene_.background);
    }
  }

  // The 16 pixels from (x, 0) on: visit(geometry, primitive) of each.
  template <class Visit>
  void meet_row(const Camera& camera, int x, const Visit& visit) {
    load(camera, [&](int i) { return glm::ivec2(x + i, 0); });
    rtcIntersect16(valid_, hierarchy_.handle(), &context_, &packet_);
    for (int i = 0; i < 16; ++i)
      if (valid_[i] != 0) visit(packet_.hit.geomID[i], packet_.hit.primID[i]);
  }

 private:
  template <class PixelOf>
  void load(const Camera& camera, const PixelOf& pixel_of) {
    const glm::vec3 eye(camera.eye);
    for (int i = 0; i < 16; ++i) {
      const glm::ivec2 pixel = pixel_of(i);
      const glm::vec3 d(camera.direction(pixel.x, pixel.y));
      const bool inside = pixel.x < camera.width && pixel.y < camera.height;
      valid_[i] = inside ? -1 : 0;
      rays += inside;
      RTCRay16& ray = packet_.ray;
      ray.org_x[i] = eye.x, ray.org_y[i] = eye.y, ray.org_z[i] = eye.z;
      ray.dir_x[i] = d.x, ray.dir_y[i] = d.y, ray.dir_z[i] = d.z;
      ray.tnear[i] = 0, ray.tfar[i] = INFINITY, ray.time[i] = 0;
      ray.mask[i] = ~0u, ray.id[i] = 0, ray.flags[i] = 0;
      packet_.hit.geomID[i] = packet_.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
  }

  // By the angle of the surface alone: to the eye, or to the lights that it sees.
  void shade(bool shadows) {
    const RTCRay16& ray = packet_.ray;
    RTCHit16& hit = packet_.hit;
    for (int i = 0; i < 16; ++i) {
      const float along =
          hit.Ng_x[i] * ray.dir_x[i] + hit.Ng_y[i] * ray.dir_y[i] + hit.Ng_z[i] * ray.dir_z[i];
      const float n2 = hit.Ng_x[i] * hit.Ng_x[i] + hit.Ng_y[i] * hit.Ng_y[i] + hit.Ng_z[i] * hit.Ng_z[i];
      const float d2 =
          ray.dir_x[i] * ray.dir_x[i] + ray.dir_y[i] * ray.dir_y[i] + ray.dir_z[i] * ray.dir_z[i];
      const float unit = (along < 0 ? 1.0f : -1.0f) / std::sqrt(n2);
      hit.Ng_x[i] *= unit, hit.Ng_y[i] *= unit, hit.Ng_z[i] *= unit;
      const float cosine = shadows ? 0.0f : -unit * along / std::sqrt(d2);
      red_[i] = green_[i] = blue_[i] = cosine;
    }
    if (!shadows) return;
    for (const Light& light : scene_.lights) add_light(glm::vec3(light.position), glm::vec3(light.intensity));
  }

  void add_light(const glm::vec3& position, const glm::vec3& intensity) {
    const RTCRay16& ray = packet_.ray;
    const RTCHit16& hit = packet_.hit;
    alignas(64) RTCRay16 shadow;
    alignas(64) int lit[16];
    alignas(64) float cosine[16];
    for (int i = 0; i < 16; ++i) {
      shadow.org_x[i] = ray.org_x[i] + ray.tfar[i] * ray.dir_x[i] + kOffset * hit.Ng_x[i];
      shadow.org_y[i] = ray.org_y[i] + ray.tfar[i] * ray.dir_y[i] + kOffset * hit.Ng_y[i];
      shadow.org_z[i] = ray.org_z[i] + ray.tfar[i] * ray.dir_z[i] + kOffset * hit.Ng_z[i];
      const float x = shadow.dir_x[i] = position.x - shadow.org_x[i];
      const float y = shadow.dir_y[i] = position.y - shadow.org_y[i];
      const float z = shadow.dir_z[i] = position.z - shadow.org_z[i];
      cosine[i] = (hit.Ng_x[i] * x + hit.Ng_y[i] * y + hit.Ng_z[i] * z) / std::sqrt(x * x + y * y + z * z);
      shadow.tnear[i] = 0, shadow.tfar[i] = 1, shadow.time[i] = 0;
      shadow.mask[i] = ~0u, shadow.id[i] = 0, shadow.flags[i] = 0;
      lit[i] = valid_[i] & -static_cast<int>(hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) &
               -static_cast<int>(cosine[i] > 0);
    }
    int count = 0;
    for (int i = 0; i < 16; ++i) count -= lit[i];
    if (count == 0) return;
    rays += static_cast<unsigned>(count);
    rtcOccluded16(lit, hierarchy_.handle(), &context_, &shadow);
    for (int i = 0; i < 16; ++i) {
      const float share = lit[i] != 0 && shadow.tfar[i] >= 0 ? cosine[i] : 0.0f;
      red_[i] += share * intensity.x, green_[i] += share * intensity.y, blue_[i] += share * intensity.z;
    }
  }

  const Scene& scene_;
  const EmbreeScene& hierarchy_;
  RTCIntersectContext context_;
  alignas(64) RTCRayHit16 packet_;
  alignas(64) int valid_[16];
  alignas(64) float red_[16], green_[16], blue_[16];
};

}  // namespace sidelight::bench
