// SPDX-License-Identifier: MIT
#include "tests/bench/embree_tracer.h"

#include <pmmintrin.h>
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/parallel.h"
#include "tests/bench/embree_packets.h"

namespace sidelight::bench {
namespace {

using glm::dot;
using glm::vec3;

constexpr int kTile = 32;

RTCRayHit ray_from(const vec3& from, const vec3& direction, float last) {
  RTCRayHit ray{};
  ray.ray = {from.x, from.y, from.z, 0, direction.x, direction.y, direction.z, 0, last, ~0u, 0, 0};
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

// Traces the rays of one tile, one by one.
class Shader {
 public:
  Shader(const Scene& scene, const EmbreeScene& hierarchy) : scene_(scene), hierarchy_(hierarchy) {
    rtcInitIntersectContext(&any_);
    rtcInitIntersectContext(&coherent_);
    coherent_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (const Light& light : scene.lights) lights_.push_back({light.position, light.intensity});
  }

  std::uint64_t rays = 0;

  RTCRayHit met_by_eye(const vec3& from, const vec3& direction) {
    RTCRayHit ray = ray_from(from, direction, INFINITY);
    rtcIntersect1(hierarchy_.handle(), &coherent_, &ray);
    ++rays;
    return ray;
  }

  // By the angle of the surface alone: to the eye, or to the lights that it sees.
  vec3 simple(const vec3& from, const vec3& direction, bool shadows) {
    const RTCRayHit ray = met_by_eye(from, direction);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return scene_.background;
    const vec3 normal = facing(ray.hit, direction);
    if (!shadows) return vec3(-dot(normal, direction) / glm::length(direction));
    const vec3 point = from + ray.ray.tfar * direction + kOffset * normal;
    vec3 sum(0);
    for (const FloatLight& light : lights_) {
      const vec3 to_light = light.position - point;
      const float cosine = dot(normal, to_light);
      if (cosine > 0 && sees(point, to_light, coherent_))
        sum += cosine / glm::length(to_light) * light.intensity;
    }
    return sum;
  }

  // trace(ray) = c1 local + c2 trace(reflected) + c3 trace(refracted)
  vec3 trace(const vec3& from, const vec3& direction, int depth) {
    RTCRayHit ray = ray_from(from, direction, INFINITY);
    rtcIntersect1(hierarchy_.handle(), depth == 1 ? &coherent_ : &any_, &ray);
    ++rays;
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return scene_.background;
    const EmbreeScene::FloatMaterial& material = hierarchy_.material(ray.hit);
    const vec3 facing_normal = facing(ray.hit, direction);
    vec3 normal = hierarchy_.smooth_normal(ray.hit);
    normal = normal == vec3(0) ? facing_normal : glm::normalize(normal);
    if (dot(normal, facing_normal) < 0) normal = -normal;
    const vec3 point = from + ray.ray.tfar * direction;
    const vec3 above = point + kOffset * facing_normal;
    vec3 color = local(above, normal, facing_normal, direction, material);
    if (depth < scene_.trace.depth && (material.reflect != vec3(0) || material.refract != vec3(0)))
      color += secondary(ray.hit, point, above, normal, facing_normal, direction, material, depth);
    return color;
  }

 private:
  struct FloatLight {
    vec3 position, intensity;
  };

  // Embree's normal, made unit, on the side that the ray comes from.
  static vec3 facing(const RTCHit& hit, const vec3& direction) {
    const vec3 normal = glm::normalize(vec3(hit.Ng_x, hit.Ng_y, hit.Ng_z));
    return dot(normal, direction) < 0 ? normal : -normal;
  }

  bool sees(const vec3& from, const vec3& to_light, RTCIntersectContext& context) {
    RTCRay ray = ray_from(from, to_light, 1).ray;
    rtcOccluded1(hierarchy_.handle(), &context, &ray);
    ++rays;
    return ray.tfar >= 0;
  }

  // c1 [ ka Ia + sum_i b_i I_i (kd (N.L) + ks (Rl.V)^s) ]
  vec3 local(const vec3& point, const vec3& normal, const vec3& facing_normal, const vec3& direction,
             const EmbreeScene::FloatMaterial& material) {
    vec3 sum = material.ambient;
    for (const FloatLight& light : lights_) {
      const vec3 offset = light.position - point;
      const vec3 to_light = glm::normalize(offset);
      const float cosine = dot(normal, to_light);
      if (cosine <= 0 || dot(facing_normal, to_light) <= 0 || !sees(point, offset, any_)) continue;
      const float highlight = -dot(2 * cosine * normal - to_light, direction);
      vec3 term = cosine * material.diffuse;
      if (highlight > 0) term += std::pow(highlight, material.shininess) * material.specular;
      sum += light.intensity * term;
    }
    return material.local * sum;
  }

  vec3 secondary(const RTCHit& hit, const vec3& point, const vec3& above, const vec3& normal,
                 const vec3& facing_normal, const vec3& direction, const EmbreeScene::FloatMaterial& material,
                 int depth) {
    vec3 reflect = material.reflect, color(0);
    if (material.refract != vec3(0)) {
      const bool entering = dot(vec3(hit.Ng_x, hit.Ng_y, hit.Ng_z), direction) < 0;
      const float eta = entering ? 1 / material.ior : material.ior;
      const float cosine = -dot(direction, normal), radicand = 1 - eta * eta * (1 - cosine * cosine);
      if (radicand < 0) {
        reflect += material.refract;
      } else {
        const vec3 refracted = eta * direction + (eta * cosine - std::sqrt(radicand)) * normal;
        color =
            material.refract * trace(point - kOffset * facing_normal, glm::normalize(refracted), depth + 1);
      }
    }
    if (reflect == vec3(0)) return color;
    vec3 mirrored = direction - 2 * dot(direction, normal) * normal;
    if (const float below = dot(mirrored, facing_normal); below < 0) mirrored -= 2 * below * facing_normal;
    return color + reflect * trace(above, glm::normalize(mirrored), depth + 1);
  }

  const Scene& scene_;
  const EmbreeScene& hierarchy_;
  std::vector<FloatLight> lights_;
  RTCIntersectContext any_, coherent_;
};

// Calls work(x0, y0, x1, y1) for every tile, as Embree wants its threads: with denormals as zero.
template <class Work>
void for_each_tile(const Camera& camera, int threads, const Work& work) {
  const int columns = (camera.width + kTile - 1) / kTile, rows = (camera.height + kTile - 1) / kTile;
  parallel_for(columns * rows, threads, [&](int tile, int) {
    const unsigned state = _mm_getcsr();
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    const int x = tile % columns * kTile, y = tile / columns * kTile;
    work(x, y, std::min(x + kTile, camera.width), std::min(y + kTile, camera.height));
    _mm_setcsr(state);
  });
}

}  // namespace

EmbreeTracer::EmbreeTracer(const Scene& scene, int threads)
    : scene_(scene), threads_(threads), hierarchy_(scene, threads) {}

EmbreePicture EmbreeTracer::draw(const Camera& camera, RayKind kind, bool packets) const {
  EmbreePicture picture;
  picture.color.resize(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  const vec3 eye(camera.eye);
  std::atomic<std::uint64_t> rays{0};
  for_each_tile(camera, threads_, [&](int x0, int y0, int x1, int y1) {
    if (packets) {
      PacketShader shader(scene_, hierarchy_);
      for (int y = y0; y < y1; y += 4)
        for (int x = x0; x < x1; x += 4)
          shader.draw(camera, x, y, kind == RayKind::eye_and_shadow, picture.color);
      rays += shader.rays;
      return;
    }
    Shader shader(scene_, hierarchy_);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        const vec3 direction(camera.direction(x, y));
        vec3& color = picture.color[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) +
                                    static_cast<std::size_t>(x)];
        color = kind == RayKind::whole ? shader.trace(eye, glm::normalize(direction), 1)
                                       : shader.simple(eye, direction, kind == RayKind::eye_and_shadow);
      }
    rays += shader.rays;
  });
  picture.rays = rays;
  return picture;
}

std::uint64_t EmbreeTracer::misses(const Camera& camera, std::uint32_t triangles, bool packets) const {
  std::uint64_t missed = 0;
  const auto count = [&](unsigned geometry, unsigned primitive) {
    missed += geometry != kTriangles || primitive >= triangles;
  };
  if (packets) {
    PacketShader shader(scene_, hierarchy_);
    for (int x = 0; x < camera.width; x += 16) shader.meet_row(camera, x, count);
    return missed;
  }
  Shader shader(scene_, hierarchy_);
  for (int x = 0; x < camera.width; ++x) {
    const RTCRayHit ray = shader.met_by_eye(vec3(camera.eye), vec3(camera.direction(x, 0)));
    count(ray.hit.geomID, ray.hit.primID);
  }
  return missed;
}

}  // namespace sidelight::bench
