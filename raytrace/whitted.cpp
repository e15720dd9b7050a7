// SPDX-License-Identifier: MIT
#include "raytrace/whitted.h"

namespace sidelight::raytrace {
namespace {

template <class Real>
glm::vec<3, Real> rgb(const Vec3<Real>& v) {
  return {v.x, v.y, v.z};
}
}  // namespace

// color = c1 local + c2 w(r) trace(reflected) + c3 w(r) trace(refracted)
template <class Real, class Recorder>
Traced<Real> Whitted<Real, Recorder>::trace(const Path& arriving) {
  Path path = arriving;
  Traced<Real> out;
  Surface surface;
  recorder_.begin(path);
  // A surface inside a medium that goes on behind it is passed without colour; what the eye itself meets is shaded.
  for (Hit hit = nearest(prepared_, path.ray, path.start, stats_.visibility, precision_, isa_);;
       hit = nearest(prepared_, path.ray, hit, stats_.visibility, precision_, isa_)) {
    out.hit = hit;
    if (!hit.found()) {
      out.color = out.ambient = Rgb(scene_.background);
      recorder_.end(out.color);
      return out;
    }
    surface = surface_at(scene_, path.ray, hit, stats_.visibility);
    if (path.depth == 1 || prepared_.solids.empty() || !scene_.objects[surface.object].solid) break;
    const Media behind = media_behind(prepared_, path.ray, hit, surface, path.media, stats_.visibility);
    if (behind.current() != path.media.current()) break;
    path.media = behind;
    recorder_.passed(hit);
  }
  out.object = surface.object;

  const bool secondary = prepared_.needs.secondary_rays();
  glm::dvec3 from{0};  // where rays start that leave
  if (secondary || scene_.trace.shadows)
    from = leaving_point(prepared_, path.ray, out.hit, surface, stats_.visibility, isa_);
  add_local(surface, path.ray, from, out);
  if (secondary) add_secondary(path, surface, from, out);
  out.color = (out.color + out.mirrored) + out.refracted;
  recorder_.end(out.color);
  return out;
}

// color = c1 (ka Ia + sum b_i T_i), shadow = c1 sum (1 - b_i) T_i, and the unshadowed parts.
template <class Real, class Recorder>
void Whitted<Real, Recorder>::add_local(const Surface& surface, const Ray& ray, const glm::dvec3& from,
                                        Traced<Real>& out) {
  const Vec3<Real>& c1 = tables_.materials[surface.material].local;
  const ShadingPoint<Real> point = shading_point(tables_, surface, ray);
  out.normal = {point.normal.x, point.normal.y, point.normal.z};
  const Vec3<Real> ambient = ambient_term<Real>(point, tables_.ambient_light);
  recorder_.surface(out.hit, surface, c1, ambient);
  Vec3<Real> light = ambient, shadow{}, diffuse{}, specular{};
  for (std::size_t i = 0; i < tables_.lights.size(); ++i) {
    const LightTerm<Real> term = light_term<Real>(point, tables_.lights[i]);
    diffuse = diffuse + term.diffuse;
    specular = specular + term.specular;
    const Vec3<Real> total = term.total();
    if (total.x == 0 && total.y == 0 && total.z == 0) continue;  // nothing to miss, so no shadow ray

    bool b = true;
    Hit blocker;
    if (scene_.trace.shadows) {
      if (term.self_shadowed)
        ++stats_.self_shadowed;
      else
        blocker = shadow_blocker(surface, from, scene_.lights[i]);
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
template <class Real, class Recorder>
Hit Whitted<Real, Recorder>::shadow_blocker(const Surface& surface, const glm::dvec3& from,
                                            const Light& light) {
  ++stats_.rays.shadow;
  const glm::dvec3 origin = shadow_offset_ ? surface.point : from;
  const Ray ray = ray_to_light(origin, light);
  const Hit start{shadow_offset_ ? *shadow_offset_ / glm::length(ray.direction) : kRayStart.t, kNone};
  return blocker(prepared_, ray, light.directional ? nullptr : &light.position, stats_.visibility, start,
                 precision_, isa_);
}

template <class Real, class Recorder>
void Whitted<Real, Recorder>::add_secondary(const Path& path, const Surface& surface, const glm::dvec3& from,
                                            Traced<Real>& out) {
  Departures leaving = departures(prepared_, path, out.hit, surface, from, stats_.visibility);
  out.mirrored = follow(std::move(leaving.mirrored), out.cut_weight);
  out.refracted = follow(std::move(leaving.refracted), out.cut_weight);
}

// c w(r) trace(path), or black where the path is too deep or weighs too little.
template <class Real, class Recorder>
glm::vec<3, Real> Whitted<Real, Recorder>::follow(Departure leaving, double& cut_weight) {
  auto& [path, c] = leaving;
  if (largest(c) == 0) return Rgb(0);
  if (!send(scene_, c, path)) {
    cut_weight += path.weight;
    recorder_.not_sent(path, c);
    return Rgb(0);
  }
  ++(is_mirrored(path.kind) ? stats_.rays.reflection : stats_.rays.refraction);
  const Traced<Real> traced = trace(path);
  cut_weight += traced.cut_weight;
  const Real w = prepared_.needs[Need::secondary_attenuation]
                     ? static_cast<Real>(distance_weight(scene_.trace.secondary_attenuation, path.ray,
                                                         path.start, traced.hit))
                     : Real(1);
  recorder_.counted(c, w);
  return Rgb(c) * (w * traced.color);
}

template class Whitted<float, NoRecorder<float>>;
template class Whitted<double, NoRecorder<double>>;
template class Whitted<float, TreeRecorder>;

}  // namespace sidelight::raytrace
