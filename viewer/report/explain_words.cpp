// SPDX-License-Identifier: MIT
#include "viewer/report/explain_words.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "common/error.h"
#include "common/picture/frame.h"

namespace sidelight {
namespace {

constexpr std::array<const char*, 3> kKindNames{"sphere", "plane", "triangle"};

template <class V>
std::string triple(const V& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z);
}

class Words {
 public:
  explicit Words(const Scene& scene) : scene_(scene) {}

  void line(int depth, const std::string& text) {
    out_ += std::string(static_cast<std::size_t>(2 * depth), ' ') + text + "\n";
  }

  void local(int depth, const LocalRecord& local) {
    line(depth, fmt::format("meets {} at depth t = {:.9g}", primitive_text(scene_, local.hit.primitive),
                            local.hit.t));
    line(depth, fmt::format("point {}, N = {}", triple(local.surface.point), triple(local.surface.normal)));
    line(depth, fmt::format("c1 = {}, times the sum of:", triple(local.local)));
    line(depth + 1, fmt::format("ambient   ka Ia = {}", triple(local.ambient)));
    for (const LightRecord& light : local.lights) {
      line(depth + 1,
           fmt::format("light {}   N.L = {:.6g}, (Rl.V)^s = {:.6g}, f(d) = {:.6g}: {}", light.light + 1,
                       light.cosine, light.highlight, light.arriving, seen_text(light)));
      line(depth + 2, fmt::format("diffuse {}, specular {}", triple(light.diffuse), triple(light.specular)));
    }
  }

  void ray(int depth, const RayRecord& ray) {
    const std::string counted = ray.kind == RayKind::eye ? std::string()
                                                         : fmt::format(", counted c = {}, w(r) = {:.6g}",
                                                                       triple(ray.coefficient), ray.falloff);
    if (!ray.sent) {
      line(depth, fmt::format("{} ray, c = {}: not sent (too deep or too light), black", ray_name(ray.kind),
                              triple(ray.coefficient)));
      return;
    }
    line(depth, fmt::format("{} ray{}: brings back {}", ray_name(ray.kind), counted, triple(ray.color)));
    for (const Hit& hit : ray.passed)
      line(depth + 1,
           fmt::format("passes {}: the medium goes on behind it", primitive_text(scene_, hit.primitive)));
    if (ray.background)
      line(depth + 1, "meets nothing: background");
    else
      local(depth + 1, ray.local);
    for (const RayRecord& child : ray.children) this->ray(depth + 1, child);
  }

  void raster(int depth, const RasterRecord& record) {
    line(depth, fmt::format("{} fragment(s) competed:", record.fragments.size()));
    for (const FragmentRecord& fragment : record.fragments) {
      const bool won = !record.background && fragment.hit == record.local.hit;
      line(depth + 1,
           fmt::format("t = {:.9g}  {}{}", fragment.hit.t, primitive_text(scene_, fragment.hit.primitive),
                       won             ? "  <- nearest, kept"
                       : fragment.kept ? "  (kept for a while)"
                                       : ""));
    }
    if (record.background)
      line(depth, "background");
    else
      local(depth, record.local);
  }

  std::string take() { return std::move(out_); }

 private:
  std::string seen_text(const LightRecord& light) const {
    if (light.seen) return "b = 1, seen";
    if (light.self_shadowed) return "b = 0, the surface stands in its own light";
    return "b = 0, blocked by " + primitive_text(scene_, light.blocker);
  }

  const Scene& scene_;
  std::string out_;
};

}  // namespace

const char* ray_name(RayKind kind) {
  constexpr std::array<const char*, 5> kNames{"eye", "mirrored", "refracted", "internally reflected",
                                              "straight on"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string primitive_text(const Scene& scene, std::uint32_t primitive) {
  const Object& object = scene.objects[scene.primitive_object[primitive]];
  const Material& material = scene.materials[primitive_material(scene, primitive)];
  return fmt::format("primitive {}, {} of line {}, material {}", primitive,
                     kKindNames[static_cast<std::size_t>(object.kind)], object.where.line,
                     printable(material.name, 60));
}

glm::vec3 mean_color(const std::vector<ExplainedSample>& samples, Side side) {
  PixelMean mean;
  for (const ExplainedSample& s : samples) mean.add(side == Side::raster ? s.raster.color : s.raytrace.color);
  return mean.mean(static_cast<int>(samples.size()));
}

std::string raster_words(const Scene& scene, const RasterRecord& record, int depth) {
  Words words(scene);
  words.raster(depth, record);
  return words.take();
}

std::string ray_words(const Scene& scene, const RayRecord& ray, int depth) {
  Words words(scene);
  words.ray(depth, ray);
  return words.take();
}

std::string color_text(const glm::vec3& color) { return triple(color); }

}  // namespace sidelight
