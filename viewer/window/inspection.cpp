// SPDX-License-Identifier: MIT
#include "viewer/window/inspection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace sidelight {
namespace {

// Of all samples together, for the inspector puts all of their words into each frame that the window draws.
constexpr std::size_t kMostRecords = 8192;

glm::dvec3 to_light(const Light& light, const glm::dvec3& point) {
  return light.directional ? -light.direction : glm::normalize(light.position - point);
}

SegmentKind kind_of(RayKind kind) {
  if (kind == RayKind::refracted) return SegmentKind::refracted;
  return kind == RayKind::straight ? SegmentKind::straight : SegmentKind::mirrored;
}

void add_segments(const Scene& scene, const RayRecord& ray, double far, std::vector<RaySegment>& out) {
  if (!ray.sent) return;
  const glm::dvec3 end =
      ray.background ? ray.origin + far * glm::normalize(ray.direction) : ray.local.surface.point;
  if (ray.kind != RayKind::eye) out.push_back({ray.origin, end, kind_of(ray.kind)});
  if (ray.background) return;
  for (const LightRecord& record : ray.local.lights) {
    const Light& light = scene.lights[record.light];
    const glm::dvec3 lamp = light.directional ? end - far * light.direction : light.position;
    out.push_back({end, lamp, record.seen ? SegmentKind::light_seen : SegmentKind::light_blocked});
  }
  for (const RayRecord& child : ray.children) add_segments(scene, child, far, out);
}

double angle(const glm::dvec3& a, const glm::dvec3& b) {
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

void tell_rays(const raytrace::Prepared& tracer, Inspection& inspection) {
  raytrace::ExplainBudget budget{kMostRecords};
  const Camera& camera = inspection.camera;
  const glm::ivec2 first = camera.n * inspection.pixel;
  try {
    for (ExplainedSample& sample : inspection.samples)
      sample.raytrace = raytrace::explain(tracer, camera, first.x + sample.i, first.y + sample.j, budget);
  } catch (const raytrace::TooManyRays&) {
    for (ExplainedSample& sample : inspection.samples) sample.raytrace = {};
    inspection.too_many_rays = true;
  }
}

// N, Rl and V need not lie in one plane. Turned about Rl into that of N and Rl, V comes to lie on one side of it or the
// other: on that where it is nearer to its own angle from N, but never under the surface.
bool shown_towards_normal(double normal_to_mirrored, double mirrored_to_viewer, double normal_to_viewer) {
  const double away = normal_to_mirrored + mirrored_to_viewer;
  const double towards = std::abs(normal_to_mirrored - mirrored_to_viewer);
  return away > std::numbers::pi / 2 || away - normal_to_viewer >= normal_to_viewer - towards;
}

}  // namespace

std::vector<RaySegment> ray_segments(const Inspection& inspection) {
  std::vector<RaySegment> out;
  const RayRecord& root = inspection.middle().raytrace;
  const double reach = root.background ? 1 : glm::distance(root.origin, root.local.surface.point);
  add_segments(*inspection.scene, root, 3 * reach, out);
  return out;
}

std::optional<Lobe> specular_lobe(const Inspection& inspection) {
  const RayRecord& root = inspection.middle().raytrace;
  if (root.background || root.local.lights.empty()) return {};
  const auto strength = [](const LightRecord& light) {
    return light.specular.x + light.specular.y + light.specular.z;
  };
  const LightRecord& brightest = *std::max_element(
      root.local.lights.begin(), root.local.lights.end(),
      [&](const LightRecord& a, const LightRecord& b) { return strength(a) < strength(b); });
  const Surface& surface = root.local.surface;
  const glm::dvec3 normal = surface.normal, viewer = -glm::normalize(root.direction);
  const glm::dvec3 light = to_light(inspection.scene->lights[brightest.light], surface.point);
  const glm::dvec3 mirrored = 2 * glm::dot(normal, light) * normal - light;
  const double light_angle = angle(normal, light), view_angle = angle(mirrored, viewer);
  return Lobe{brightest.light,
              inspection.scene->materials[surface.material].shininess,
              light_angle,
              view_angle,
              shown_towards_normal(light_angle, view_angle, angle(normal, viewer)),
              brightest.highlight};
}

std::optional<Inspection> inspect_pixel(const WindowState& state, const Pictures& pictures) {
  const PictureTask& task = pictures.task;
  if (!state.inspected || pictures.block == 0 || task.scene != state.drawn) return {};
  Inspection out;
  out.pixel = *state.inspected;
  out.scene = task.scene;
  out.asked_ms = task.asked_ms;
  out.camera = task.made_camera();
  for (int j = 0; j < task.n; ++j)
    for (int i = 0; i < task.n; ++i) {
      const int X = task.n * out.pixel.x + i, Y = task.n * out.pixel.y + j;
      out.samples.push_back({i, j, raster::explain(*pictures.renderers.rasterizer, out.camera, X, Y), {}});
    }
  tell_rays(*pictures.renderers.tracer, out);
  return out;
}

std::string inspected_words(const Inspection& inspection, Side side) {
  if (side == Side::raytrace && inspection.too_many_rays)
    return "too many rays to explain: fewer at a lower depth, key D";
  const Scene& scene = *inspection.scene;
  std::string out;
  const auto tell = [&](const ExplainedSample& sample, const char* which) {
    if (inspection.samples.size() > 1) out += fmt::format("sample {},{}{}\n", sample.i, sample.j, which);
    out +=
        side == Side::raster ? raster_words(scene, sample.raster, 0) : ray_words(scene, sample.raytrace, 0);
  };
  tell(inspection.middle(), ", whose ids and rays are shown");
  for (const ExplainedSample& sample : inspection.samples)
    if (&sample != &inspection.middle()) tell(sample, "");
  return out;
}

std::string told_of_faults(const Faults& faults) {
  if (!faults.any()) return {};
  if (!faults.tessellate) return "told as without the faults on purpose";
  if (!faults.without(FaultKind::tessellate).any()) return "told of the facets";
  return "told of the facets, but as without the other faults on purpose";
}

}  // namespace sidelight
