// SPDX-License-Identifier: MIT
#include "raytrace/whitted.h"

#include <algorithm>

#include "common/model/optics.h"

namespace sidelight::raytrace {
namespace {

glm::vec3 rgb(const Vec3<float>& v) { return {v.x, v.y, v.z}; }
double largest(const glm::dvec3& c) { return std::max({c.x, c.y, c.z}); }

// w(r) = 1 / max(1, q0 + q1 r + q2 r²); a ray that meets nothing has r -> infinity.
float distance_weight(const Attenuation& q, const Path& path, const Hit& hit) {
  if (!hit.found()) return q.q1 > 0 || q.q2 > 0 ? 0.0f : static_cast<float>(1 / std::max(1.0, q.q0));
  const double r = (hit.t - path.start.t) * glm::length(path.ray.direction);
  return static_cast<float>(1 / std::max(1.0, q.q0 + q.q1 * r + q.q2 * r * r));
}

}  // namespace

// color = c1 local + c2 w(r) trace(reflected) + c3 w(r) trace(refracted)
template <class Recorder>
Traced Whitted<Recorder>::trace(const Path& arriving) {
  Path path = arriving;
  Traced out;
  Surface surface;
  recorder_.begin(path);
  // A surface inside a medium that goes on behind it is passed without colour; what the eye itself meets is shaded.
  for (Hit hit = nearest(prepared_, path.ray, path.start, stats_.signs, precision_);;
       hit = nearest(prepared_, path.ray, hit, stats_.signs, precision_)) {
    out.hit = hit;
    if (!hit.found()) {
      out.color = out.ambient = glm::vec3(scene_.background);
      recorder_.end(out.color);
      return out;
    }
    surface = surface_at(scene_, path.ray, hit, stats_.signs);
    if (path.depth == 1 || prepared_.solids.empty() || !scene_.objects[surface.object].solid) break;
    const Media behind = media_behind(prepared_, path.ray, hit, surface, path.media, stats_.signs);
    if (behind.current() != path.media.current()) break;
    path.media = behind;
    recorder_.passed(hit);
  }
  out.object = surface.object;
  out.normal = glm::vec3(surface.normal);

  add_local(surface, path.ray, out);
  if (prepared_.needs[Need::mirrors] || prepared_.needs[Need::refraction]) add_secondary(path, surface, out);
  out.color = (out.color + out.mirrored) + out.refracted;
  recorder_.end(out.color);
  return out;
}

// color = c1 (ka Ia + sum b_i T_i), shadow = c1 sum (1 - b_i) T_i, and the unshadowed parts.
template <class Recorder>
void Whitted<Recorder>::add_local(const Surface& surface, const Ray& ray, Traced& out) {
  const Vec3<float>& c1 = prepared_.tables.materials[surface.material].local;
  const ShadingPoint<float> point = shading_point(prepared_.tables, surface, ray);
  const Vec3<float> ambient = ambient_term<float>(point, prepared_.tables.ambient_light);
  recorder_.surface(out.hit, surface, c1, ambient);
  Vec3<float> light = ambient, shadow{}, diffuse{}, specular{};
  for (std::size_t i = 0; i < prepared_.tables.lights.size(); ++i) {
    const LightTerm<float> term = light_term<float>(point, prepared_.tables.lights[i]);
    diffuse = diffuse + term.diffuse;
    specular = specular + term.specular;
    const Vec3<float> total = term.total();
    if (total.x == 0 && total.y == 0 && total.z == 0) continue;   // nothing to miss, so no shadow ray

    bool b = true;
    Hit blocker;
    if (scene_.trace.shadows) {
      if (term.self_shadowed)
        ++stats_.self_shadowed;
      else
        blocker = shadow_blocker(surface, scene_.lights[i]);
      b = !term.self_shadowed && !blocker.found();
    }
    if (b)
      light = light + total;
    else
      shadow = shadow + total;
    recorder_.light(i, term, b, blocker);
  }
  out.color = rgb(c1 * light);
  out.shadow = rgb(c1 * shadow);
  out.ambient = rgb(c1 * ambient);
  out.diffuse = rgb(c1 * diffuse);
  out.specular = rgb(c1 * specular);
}

// b_i = 0 where this finds something.
template <class Recorder>
Hit Whitted<Recorder>::shadow_blocker(const Surface& surface, const Light& light) {
  ++stats_.rays.shadow;
  glm::dvec3 from = surface.point;
  if (!shadow_offset_) from += surface.clearance * surface.facing;
  const Ray ray = make_ray(from, light.directional ? -light.direction : light.position - from);
  const Hit start{shadow_offset_ ? *shadow_offset_ / glm::length(ray.direction) : kRayStart.t, kNone};
  return blocker(prepared_, ray, light.directional ? nullptr : &light.position, stats_.signs, start, precision_);
}

template <class Recorder>
void Whitted<Recorder>::add_secondary(const Path& path, const Surface& surface, Traced& out) {
  const Material& material = scene_.materials[surface.material];
  const glm::dvec3 c2 = scene_.trace.reflection ? material.reflect : glm::dvec3(0);
  const glm::dvec3 c3 = scene_.trace.refraction ? material.refract : glm::dvec3(0);
  if (largest(c2) == 0 && largest(c3) == 0) return;

  const glm::dvec3 d = glm::normalize(path.ray.direction);
  // Both rays start on the near side. A refracted one meets its own surface again and passes it, since by then it
  // is in the medium behind; and no other surface that touches this one is jumped over.
  const glm::dvec3 from = surface.point + surface.clearance * surface.facing;
  Path mirrored = path;
  mirrored.kind = RayKind::mirrored;
  mirrored.ray = make_ray(from, reflect_direction(d, surface.normal, surface.facing));
  mirrored.start = kRayStart;

  if (largest(c3) == 0) {
    out.mirrored = follow(std::move(mirrored), c2);
    return;
  }
  Path refracted = path;
  if (!scene_.objects[surface.object].solid) {
    // A sheet without an inside: straight on, along the same ray.
    refracted.kind = RayKind::straight;
    refracted.start = out.hit;
  } else {
    refracted.kind = RayKind::refracted;
    refracted.media = media_behind(prepared_, path.ray, out.hit, surface, path.media, stats_.signs);
    const double eta = path.media.ior(scene_) / refracted.media.ior(scene_);
    const std::optional<glm::dvec3> t = refract_direction(d, surface.normal, surface.facing, eta);
    if (!t) {   // total internal reflection: one ray carries both weights
      mirrored.kind = RayKind::internally_reflected;
      out.mirrored = follow(std::move(mirrored), c2 + c3);
      return;
    }
    refracted.ray = make_ray(from, *t);
    refracted.start = kRayStart;
  }
  out.mirrored = follow(std::move(mirrored), c2);
  out.refracted = follow(std::move(refracted), c3);
}

// c w(r) trace(path), or black where the path is too deep or weighs too little.
template <class Recorder>
glm::vec3 Whitted<Recorder>::follow(Path path, const glm::dvec3& c) {
  if (largest(c) == 0) return glm::vec3(0);
  path.weight *= largest(c);
  if (path.depth >= scene_.trace.depth || path.weight < scene_.trace.contribution_cut) {
    stats_.cut_weight += path.weight;
    recorder_.not_sent(path, c);
    return glm::vec3(0);
  }
  ++path.depth;
  const bool mirror = path.kind == RayKind::mirrored || path.kind == RayKind::internally_reflected;
  ++(mirror ? stats_.rays.reflection : stats_.rays.refraction);
  const Traced traced = trace(path);
  const float w = prepared_.needs[Need::secondary_attenuation]
                      ? distance_weight(scene_.trace.secondary_attenuation, path, traced.hit)
                      : 1.0f;
  recorder_.counted(c, w);
  return glm::vec3(c) * (w * traced.color);
}

template class Whitted<NoRecorder>;
template class Whitted<TreeRecorder>;

}  // namespace sidelight::raytrace
