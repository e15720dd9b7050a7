// SPDX-License-Identifier: MIT
// What of a scene POV-Ray 3.7 renders differently, found without rendering.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>
#include <map>
#include <span>

#include "common/scene/needs.h"
#include "common/scene/pov.h"
#include "common/scene/pov_mesh.h"

namespace sidelight {
namespace {

using glm::dot;
using glm::dvec3;

enum class Relation { apart, inside, unclear };

// Where a solid that comes later in the file lies to one that comes before it, as far as their boxes, which meet, tell.
// POV-Ray and we agree on the medium where the later one is apart from the other, or wholly inside it.
Relation relation(const Scene& scene, const Object& later, const Bounds& box, const Object& before,
                  const Bounds& other) {
  const auto side_of = [&](const Object& plane_object, const Bounds& of) {
    const Plane& plane = scene.planes[plane_object.first];
    // The corners of the box that are farthest along the normal and against it.
    const auto ahead = glm::greaterThan(plane.normal, dvec3(0));
    if (dot(glm::mix(of.high, of.low, ahead) - plane.point, plane.normal) > 0) return Relation::apart;
    return dot(glm::mix(of.low, of.high, ahead) - plane.point, plane.normal) < 0 ? Relation::inside
                                                                                 : Relation::unclear;
  };
  const bool later_plane = later.kind == ObjectKind::plane, before_plane = before.kind == ObjectKind::plane;
  if (later_plane && before_plane) return Relation::unclear;
  if (before_plane) return side_of(before, box);
  if (later_plane) return side_of(later, other) == Relation::apart ? Relation::apart : Relation::unclear;
  if (before.kind != ObjectKind::sphere) return Relation::unclear;
  const Sphere& around = scene.spheres[before.first];
  const double reach =
      later.kind == ObjectKind::sphere
          ? glm::distance(scene.spheres[later.first].center, around.center) +
                scene.spheres[later.first].radius
          : glm::length(glm::max(glm::abs(box.low - around.center), glm::abs(box.high - around.center)));
  return reach < around.radius ? Relation::inside : Relation::unclear;
}

std::string name_of(const Scene& scene, std::uint32_t object) {
  const SourceLocation& where = scene.objects[object].where;
  return fmt::format(
      "object {} (line {}, material {})", object + 1, where.line,
      printable(scene.materials[primitive_material(scene, scene.objects[object].first_primitive)].name));
}

void add_trace_limits(const Scene& scene, std::vector<PovLimit>& out) {
  const TraceSettings& trace = scene.trace;
  const Attenuation& w = trace.secondary_attenuation;
  const bool secondary = trace.reflection || trace.refraction;
  if (secondary && (w.q0 > 1 || w.q1 > 0 || w.q2 > 0))
    out.push_back({"trace.secondary_attenuation: POV-Ray weakens no ray with its length", {}});
  if (secondary && trace.contribution_cut > 0)
    out.push_back({"trace.contribution_cut: written as 0; POV-Ray follows rays of any weight", {}});
  if (trace.depth > kPovMostLevels)
    out.push_back(
        {fmt::format("trace.depth {}: POV-Ray ends a path after {} rays", trace.depth, kPovMostLevels), {}});
}

void add_light_limits(const Scene& scene, std::vector<PovLimit>& out) {
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Attenuation& a = scene.lights[i].attenuation;
    if (a.q1 > 0 && a.q2 > 0)
      out.push_back(
          {fmt::format("light {}: POV-Ray has no attenuation with both q1 and q2; q1 is left out", i + 1),
           {}});
  }
}

// Of some corners of a triangle but not of all: then its own normal stands for those that are missing, while ours leaves
// them out of the sum.
bool lacks_some_normals(const Scene& scene, const Triangle& triangle) {
  const int count =
      has_normal(scene, triangle, 0) + has_normal(scene, triangle, 1) + has_normal(scene, triangle, 2);
  return !triangle.degenerate && count % 3 != 0;
}

void add_normal_limits(const Scene& scene, std::vector<PovLimit>& out) {
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.objects[i].kind != ObjectKind::mesh) continue;
    const auto triangles = std::span(scene.triangles).subspan(scene.objects[i].first, scene.objects[i].count);
    if (std::ranges::any_of(triangles, [&](const Triangle& t) { return lacks_some_normals(scene, t); }))
      out.push_back(
          {name_of(scene, i) + ": where a vertex normal is 0, POV-Ray gets the triangle's own", {}});
  }
}

PovLimit pair_limit(const Scene& scene, Relation lies, std::uint32_t later, std::uint32_t before) {
  if (lies == Relation::inside)
    return {fmt::format("{} in {}: POV-Ray gives total reflection at its outside the weight 1",
                        name_of(scene, later), name_of(scene, before)),
            {later}};
  return {fmt::format("{} and {}: where they touch or overlap, POV-Ray takes the one entered last for "
                      "the medium, and shades surfaces at which it does not change",
                      name_of(scene, before), name_of(scene, later)),
          {before, later}};
}

void add_pair_limits(const Scene& scene, const std::vector<std::uint32_t>& solids,
                     std::vector<PovLimit>& out) {
  constexpr std::size_t kNamed = 20;
  // Pairs that are looked at, in a tenth of a second: all pairs of 1,400 solids.
  constexpr std::size_t kMostPairs = std::size_t{1} << 20;
  std::vector<Bounds> boxes;
  for (const std::uint32_t solid : solids) boxes.push_back(bounds_of(scene, scene.objects[solid]));
  // Of the later one and the one before it: the first in the file.
  std::map<std::array<std::size_t, 2>, Relation> named;
  std::size_t pairs = 0, looked_at = 0;
  const bool all = visit_meeting(boxes, [&](std::size_t i, std::size_t j) {
    if (++looked_at > kMostPairs) return false;
    const std::size_t first = std::min(i, j), second = std::max(i, j);
    const Object &later = scene.objects[solids[second]], &before = scene.objects[solids[first]];
    const Relation lies = relation(scene, later, boxes[second], before, boxes[first]);
    const Material& material = scene.materials[primitive_material(scene, later.first_primitive)];
    // Only then can its outside reflect totally, and with another weight than POV-Ray's.
    const bool told_apart = later.ior < before.ior && material.reflect + material.refract != dvec3(1);
    if (lies == Relation::apart || (lies == Relation::inside && !told_apart)) return true;
    ++pairs;
    named[{second, first}] = lies;
    if (named.size() > kNamed) named.erase(std::prev(named.end()));
    return true;
  });
  for (const auto& [pair, lies] : named)
    out.push_back(pair_limit(scene, lies, solids[pair[0]], solids[pair[1]]));
  const std::size_t more = pairs - named.size();
  if (!all)
    out.push_back(
        {fmt::format("and {} more pairs of solids, or many more: too many are near for a look at each", more),
         {}});
  else if (more > 0)
    out.push_back({fmt::format("and {} more pairs of solids", more), {}});
}

void add_object_limits(const Scene& scene, std::vector<PovLimit>& out) {
  if (!scene.trace.refraction) return;
  std::vector<std::uint32_t> solids;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    bool refracts = false, mixed = false;
    for (std::uint32_t k = 0; k < object.count; ++k) {
      const std::uint32_t material = primitive_material(scene, object.first_primitive + k);
      mixed = mixed || material != primitive_material(scene, object.first_primitive);
      refracts = refracts || scene.materials[material].refract != dvec3(0);
    }
    if (object.solid) solids.push_back(i);
    if (refracts && !object.solid)
      out.push_back({name_of(scene, i) + ": POV-Ray takes it for the surface of a medium of index 1", {i}});
    if (object.solid && mixed)
      out.push_back(
          {name_of(scene, i) + ": its parts of different materials are solids of their own to POV-Ray", {i}});
  }
  add_pair_limits(scene, solids, out);
}

}  // namespace

std::vector<PovLimit> pov_limits(const Scene& scene) {
  std::vector<PovLimit> out;
  add_trace_limits(scene, out);
  add_light_limits(scene, out);
  add_normal_limits(scene, out);
  add_object_limits(scene, out);
  return out;
}

}  // namespace sidelight
