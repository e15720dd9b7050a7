// SPDX-License-Identifier: MIT
#include "viewer/commands/explain_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace sidelight {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> kKindNames{"sphere", "plane", "triangle"};

const char* ray_name(RayKind kind) {
  switch (kind) {
    case RayKind::eye: return "eye";
    case RayKind::mirrored: return "mirrored";
    case RayKind::refracted: return "refracted";
    case RayKind::internally_reflected: return "internally reflected";
    case RayKind::straight: return "straight on";
  }
  return "";
}

glm::vec3 mean_color(const std::vector<ExplainedSample>& samples, bool raster) {
  PixelMean mean;
  for (const ExplainedSample& s : samples) mean.add(raster ? s.raster.color : s.raytrace.color);
  return mean.mean(static_cast<int>(samples.size()));
}

template <class V>
std::string triple(const V& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z);
}

template <class V>
Json json_triple(const V& v) {
  return Json::array({v.x, v.y, v.z});
}

// ---- words ----

class Words {
 public:
  explicit Words(const Scene& scene) : scene_(scene) {}

  void line(int depth, const std::string& text) { out_ += std::string(static_cast<std::size_t>(2 * depth), ' ') + text + "\n"; }

  void local(int depth, const LocalRecord& local) {
    line(depth, fmt::format("meets {} at depth t = {:.9g}", primitive_text(scene_, local.hit.primitive), local.hit.t));
    line(depth, fmt::format("point {}, N = {}", triple(local.surface.point), triple(local.surface.normal)));
    line(depth, fmt::format("c1 = {}, times the sum of:", triple(local.local)));
    line(depth + 1, fmt::format("ambient   ka Ia = {}", triple(local.ambient)));
    for (const LightRecord& light : local.lights) {
      line(depth + 1, fmt::format("light {}   N.L = {:.6g}, (Rl.V)^s = {:.6g}, f(d) = {:.6g}: {}", light.light + 1,
                                  light.cosine, light.highlight, light.arriving, seen_text(light)));
      line(depth + 2, fmt::format("diffuse {}, specular {}", triple(light.diffuse), triple(light.specular)));
    }
  }

  void ray(int depth, const RayRecord& ray) {
    const std::string counted = ray.kind == RayKind::eye
                                    ? std::string()
                                    : fmt::format(", counted c = {}, w(r) = {:.6g}", triple(ray.coefficient), ray.falloff);
    if (!ray.sent) {
      line(depth, fmt::format("{} ray, c = {}: not sent (too deep or too light), black", ray_name(ray.kind), triple(ray.coefficient)));
      return;
    }
    line(depth, fmt::format("{} ray{}: brings back {}", ray_name(ray.kind), counted, triple(ray.color)));
    for (const Hit& hit : ray.passed)
      line(depth + 1, fmt::format("passes {}: the medium goes on behind it", primitive_text(scene_, hit.primitive)));
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
      line(depth + 1, fmt::format("t = {:.9g}  {}{}", fragment.hit.t, primitive_text(scene_, fragment.hit.primitive),
                                  won ? "  <- nearest, kept" : fragment.kept ? "  (kept for a while)" : ""));
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

// ---- JSON ----

Json local_json(const Scene& scene, const LocalRecord& local) {
  const std::uint32_t primitive = local.hit.primitive;
  Json lights = Json::array();
  for (const LightRecord& light : local.lights) {
    Json one{{"light", light.light},
             {"cosine", light.cosine},
             {"highlight", light.highlight},
             {"attenuation", light.arriving},
             {"diffuse", json_triple(light.diffuse)},
             {"specular", json_triple(light.specular)},
             {"seen", light.seen},
             {"self_shadowed", light.self_shadowed}};
    one["blocker"] = light.blocker == kNone ? Json(nullptr) : Json(light.blocker);
    lights.push_back(one);
  }
  return {{"primitive", primitive},
          {"object", scene.primitive_object[primitive]},
          {"line", scene.objects[scene.primitive_object[primitive]].where.line},
          {"material", printable(scene.materials[local.surface.material].name, 1000)},
          {"depth", local.hit.t},
          {"point", json_triple(local.surface.point)},
          {"normal", json_triple(local.surface.normal)},
          {"c1", json_triple(local.local)},
          {"ambient", json_triple(local.ambient)},
          {"lights", lights}};
}

Json ray_json(const Scene& scene, const RayRecord& ray) {
  Json json{{"kind", ray_name(ray.kind)},
            {"sent", ray.sent},
            {"coefficient", json_triple(ray.coefficient)},
            {"falloff", ray.falloff},
            {"depth", ray.depth},
            {"path_weight", ray.path_weight},
            {"origin", json_triple(ray.origin)},
            {"direction", json_triple(ray.direction)},
            {"color", json_triple(ray.color)}};
  json["passed"] = Json::array();
  for (const Hit& hit : ray.passed) json["passed"].push_back({{"primitive", hit.primitive}, {"depth", hit.t}});
  if (ray.sent) json["background"] = ray.background;
  if (ray.sent && !ray.background) json["local"] = local_json(scene, ray.local);
  json["children"] = Json::array();
  for (const RayRecord& child : ray.children) json["children"].push_back(ray_json(scene, child));
  return json;
}

Json raster_json(const Scene& scene, const RasterRecord& record) {
  Json json{{"color", json_triple(record.color)}, {"fragments", Json::array()}};
  for (const FragmentRecord& f : record.fragments)
    json["fragments"].push_back({{"primitive", f.hit.primitive}, {"depth", f.hit.t}, {"kept", f.kept}});
  json["background"] = record.background;
  if (!record.background) json["local"] = local_json(scene, record.local);
  return json;
}

}  // namespace

std::string primitive_text(const Scene& scene, std::uint32_t primitive) {
  const Object& object = scene.objects[scene.primitive_object[primitive]];
  const Material& material = scene.materials[primitive_material(scene, primitive)];
  return fmt::format("primitive {}, {} of line {}, material {}", primitive,
                     kKindNames[static_cast<std::size_t>(object.kind)], object.where.line, printable(material.name, 60));
}

std::string explanation_text(const Job& job, glm::ivec2 pixel, const std::vector<ExplainedSample>& samples) {
  Words words(job.scene);
  words.line(0, fmt::format("pixel {},{} of {} at {}x{}", pixel.x, pixel.y, printable(job.flags.scene, 1000),
                            job.scene.width, job.scene.height));
  words.line(0, "z-buffer    " + triple(mean_color(samples, true)));
  words.line(0, "ray tracer  " + triple(mean_color(samples, false)));
  for (const ExplainedSample& sample : samples) {
    if (samples.size() > 1) words.line(0, fmt::format("sample {},{}", sample.i, sample.j));
    words.line(0, "");
    words.line(0, "z-buffer: " + triple(sample.raster.color));
    words.raster(1, sample.raster);
    words.line(0, "");
    words.line(0, "ray tracer: " + triple(sample.raytrace.color));
    words.ray(1, sample.raytrace);
  }
  return words.take();
}

Json explanation_json(const Job& job, glm::ivec2 pixel, const std::vector<ExplainedSample>& samples) {
  Json json{{"scene", printable(job.flags.scene, 1000)},
            {"scene_hash", job.scene.hash},
            {"pixel", {pixel.x, pixel.y}},
            {"color",
             {{"raster", json_triple(mean_color(samples, true))}, {"raytrace", json_triple(mean_color(samples, false))}}}};
  json["samples"] = Json::array();
  for (const ExplainedSample& s : samples)
    json["samples"].push_back({{"sample", {s.i, s.j}},
                               {"raster", raster_json(job.scene, s.raster)},
                               {"raytrace", ray_json(job.scene, s.raytrace)}});
  return json;
}

}  // namespace sidelight
