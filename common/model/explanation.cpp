// SPDX-License-Identifier: MIT
#include "common/model/explanation.h"

#include "common/model/shading.h"

namespace sidelight {
namespace {

void add_leaves(const RayRecord& ray, const glm::dvec3& weight, std::vector<glm::dvec3>& out) {
  if (!ray.sent) return;
  if (ray.background) {
    out.push_back(weight * glm::dvec3(ray.color));
    return;
  }
  const glm::dvec3 local = weight * glm::dvec3(ray.local.local);
  out.push_back(local * glm::dvec3(ray.local.ambient));
  for (const LightRecord& light : ray.local.lights)
    if (light.seen) {
      out.push_back(local * glm::dvec3(light.diffuse));
      out.push_back(local * glm::dvec3(light.specular));
    }
  for (const RayRecord& child : ray.children)
    add_leaves(child, weight * glm::dvec3(child.coefficient) * static_cast<double>(child.falloff), out);
}

}  // namespace

LightRecord record_light(std::size_t light, const LightTerm<float>& term) {
  LightRecord record;
  record.light = light;
  record.cosine = term.cosine;
  record.highlight = term.highlight;
  record.arriving = term.arriving;
  record.diffuse = {term.diffuse.x, term.diffuse.y, term.diffuse.z};
  record.specular = {term.specular.x, term.specular.y, term.specular.z};
  return record;
}

LocalRecord record_local(const Scene& scene, const ShadingTables& tables, const Ray& ray, const Hit& hit,
                         VisibilityCounts& counts) {
  LocalRecord record;
  record.hit = hit;
  record.surface = surface_at(scene, ray, hit, counts);
  const ShadingPoint<float> point = shading_point(tables, record.surface, ray);
  const Vec3<float>& c1 = tables.materials[record.surface.material].local;
  const Vec3<float> ambient = ambient_term<float>(point, tables.ambient_light);
  record.local = {c1.x, c1.y, c1.z};
  record.ambient = {ambient.x, ambient.y, ambient.z};
  for (std::size_t i = 0; i < tables.lights.size(); ++i) {
    const LightTerm<float> term = light_term<float>(point, tables.lights[i]);
    if (term.lit) record.lights.push_back(record_light(i, term));
  }
  return record;
}

std::vector<glm::dvec3> leaves(const RayRecord& root) {
  std::vector<glm::dvec3> out;
  add_leaves(root, glm::dvec3(1), out);
  return out;
}

}  // namespace sidelight
