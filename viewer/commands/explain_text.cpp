// SPDX-License-Identifier: MIT
#include "viewer/commands/explain_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace sidelight {
namespace {

using Json = nlohmann::ordered_json;

template <class V>
Json json_triple(const V& v) {
  return Json::array({v.x, v.y, v.z});
}

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

std::string explanation_text(const Job& job, glm::ivec2 pixel, const std::vector<ExplainedSample>& samples) {
  std::string out = fmt::format("pixel {},{} of {} at {}x{}\n", pixel.x, pixel.y, printable(job.flags.scene, 1000),
                                job.scene.width, job.scene.height);
  out += fmt::format("z-buffer    {}\n", color_text(mean_color(samples, Side::raster)));
  out += fmt::format("ray tracer  {}\n", color_text(mean_color(samples, Side::raytrace)));
  for (const ExplainedSample& sample : samples) {
    if (samples.size() > 1) out += fmt::format("sample {},{}\n", sample.i, sample.j);
    out += fmt::format("\nz-buffer: {}\n", color_text(sample.raster.color));
    out += raster_words(job.scene, sample.raster, 1);
    out += fmt::format("\nray tracer: {}\n", color_text(sample.raytrace.color));
    out += ray_words(job.scene, sample.raytrace, 1);
  }
  return out;
}

Json explanation_json(const Job& job, glm::ivec2 pixel, const std::vector<ExplainedSample>& samples) {
  Json json{{"scene", printable(job.flags.scene, 1000)},
            {"scene_hash", job.scene.hash},
            {"pixel", {pixel.x, pixel.y}},
            {"color",
             {{"raster", json_triple(mean_color(samples, Side::raster))}, {"raytrace", json_triple(mean_color(samples, Side::raytrace))}}}};
  json["samples"] = Json::array();
  for (const ExplainedSample& s : samples)
    json["samples"].push_back({{"sample", {s.i, s.j}},
                               {"raster", raster_json(job.scene, s.raster)},
                               {"raytrace", ray_json(job.scene, s.raytrace)}});
  return json;
}

}  // namespace sidelight
