// SPDX-License-Identifier: MIT
// Recursive ray tracing as the lecture has it, by brute force, in double, never optimised: the text to read first,
// and the oracle of render(). It shares with the fast code the scene, the camera, visibility, where hits are and rays leave
// them (place.h), and how samples become a pixel (pixel.h); the local model, reflection, refraction, attenuation, media
// and the recursion are written out here once more, on purpose.
//
//   trace(ray) = c1 local + c2 w(r) trace(reflected) + c3 w(r) trace(refracted)
//
// The lecture solves "a quadratic in t" for a plane; a plane is linear in t, only the sphere is quadratic. Its vectors
// point now to and now from the surface; here D is the way the ray travels, and N, L, V, Rl point away from the surface.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "common/model/place.h"
#include "common/model/solid.h"
#include "common/picture/pixel.h"
#include "raytrace/raytrace.h"

namespace sidelight::raytrace {
namespace {

using glm::dot;
using glm::dvec3;
using glm::normalize;

using Solids = std::set<std::uint32_t>;  // the objects a ray is inside of

// color = ambient + diffuse + specular - shadow + mirrored + refracted
struct Traced {
  dvec3 color{0};                             // what the ray brings back
  dvec3 ambient{0}, diffuse{0}, specular{0};  // of which, local and unshadowed
  dvec3 shadow{0}, mirrored{0}, refracted{0};
  Hit hit;
  dvec3 normal{0};
};

class Tracer {
 public:
  Tracer(const Scene& scene, RenderStats& stats) : scene_(scene), stats_(stats) {}

  Traced trace(const Ray& ray, Hit start, Solids inside, int depth, double weight);
  Solids solids_around(const dvec3& eye) const;

 private:
  dvec3 normal_at(const Hit& hit, const Place& place) const;
  dvec3 leaving_from(const Ray& ray, const Hit& hit, const Place& place);
  bool sees_light(const dvec3& from, const Light& light);
  void add_local(const Place& place, const dvec3& from, const Material& material, const dvec3& N,
                 const dvec3& V, Traced& out);
  void add_secondary(const Ray& ray, const Place& place, const dvec3& from, const Material& material,
                     const dvec3& N, const Solids& inside, int depth, double weight, Traced& out);
  dvec3 follow(const Ray& ray, const Hit& start, const Solids& inside, const dvec3& c, int depth,
               double weight, std::uint64_t& counter);
  Solids behind(const Ray& ray, const Hit& hit, const Place& place, const Solids& inside);
  double ior(const Solids& inside) const { return inside.empty() ? 1 : scene_.objects[*inside.rbegin()].ior; }
  const Object& object_of(const Hit& hit) const {
    return scene_.objects[scene_.primitive_object[hit.primitive]];
  }

  const Scene& scene_;
  RenderStats& stats_;
};

bool same_medium(const Solids& a, const Solids& b) {
  return a.empty() || b.empty() ? a.empty() == b.empty() : *a.rbegin() == *b.rbegin();
}

Traced Tracer::trace(const Ray& ray, Hit start, Solids inside, int depth, double weight) {
  Traced out;
  Place place;
  for (;; start = out.hit) {
    // For each object: the nearest it is.
    out.hit = nearest_of_all(scene_, ray, start, stats_.visibility);
    if (!out.hit.found()) {
      out.color = out.ambient = scene_.background;
      return out;
    }
    place = locate(scene_, ray, out.hit, stats_.visibility);
    // Where the medium goes on behind the surface, a secondary ray does not notice it.
    if (depth == 1 || !scene_.trace.refraction || !object_of(out.hit).solid) break;
    const Solids after = behind(ray, out.hit, place, inside);
    if (!same_medium(after, inside)) break;
    inside = after;
  }
  const Material& material = scene_.materials[primitive_material(scene_, out.hit.primitive)];
  const dvec3 Nv = place.facing;
  dvec3 N = normal_at(out.hit, place);
  if (dot(N, Nv) < 0) N = -N;
  if (dot(N, Nv) == 0) N = Nv;
  out.normal = N;
  const dvec3 from = leaving_from(ray, out.hit, place);
  add_local(place, from, material, N, -normalize(ray.direction), out);
  add_secondary(ray, place, from, material, N, inside, depth, weight, out);
  return out;
}

dvec3 Tracer::normal_at(const Hit& hit, const Place& place) const {
  const PrimitiveRef ref = primitive_ref(scene_, hit.primitive);
  if (ref.kind != ObjectKind::mesh || scene_.triangles[ref.index].normal[0] == kNone) return place.outward;
  const auto& corner = scene_.triangles[ref.index].normal;
  const auto& weight = place.barycentric;
  const dvec3 sum = weight[0] * scene_.normals[corner[0]] + weight[1] * scene_.normals[corner[1]] +
                    weight[2] * scene_.normals[corner[2]];
  return sum == dvec3(0) ? sum : normalize(sum);
}

// Where rays start that leave: off the surface, and off every other one that stands near.
dvec3 Tracer::leaving_from(const Ray& ray, const Hit& hit, const Place& place) {
  std::vector<std::uint32_t> near;
  for (std::uint32_t primitive = 0; primitive < scene_.primitive_object.size(); ++primitive)
    if (stands_near(scene_, primitive, ray, hit, place, stats_.visibility)) near.push_back(primitive);
  return leaving_point(scene_, ray, hit, place, near, stats_.visibility);
}

// c1 [ ka Ia + sum_i b_i f_i(d) I_i (kd (N.L) + ks (Rl.V)^s) ], b_i = 0 where something stands before light i
void Tracer::add_local(const Place& place, const dvec3& from, const Material& material, const dvec3& N,
                       const dvec3& V, Traced& out) {
  const dvec3 c1 = material.local;
  out.ambient = c1 * material.ambient * scene_.ambient;
  for (const Light& light : scene_.lights) {
    dvec3 L = -light.direction;
    double f = 1;
    if (!light.directional) {
      const double d = glm::length(light.position - place.point);
      if (d == 0) continue;
      L = (light.position - place.point) / d;
      f = 1 / (light.attenuation.q0 + light.attenuation.q1 * d + light.attenuation.q2 * d * d);
    }
    if (dot(N, L) <= 0) continue;
    const dvec3 Rl = 2 * dot(N, L) * N - L;
    const double highlight = dot(Rl, V) > 0 ? std::pow(dot(Rl, V), material.shininess) : 0;
    const dvec3 diffuse = c1 * f * light.intensity * material.diffuse * dot(N, L);
    const dvec3 specular = c1 * f * light.intensity * material.specular * highlight;
    out.diffuse += diffuse;
    out.specular += specular;
    if (!scene_.trace.shadows || diffuse + specular == dvec3(0)) continue;
    // Facing away from the light, the surface stands in its own: no ray is needed.
    const bool self_shadowed = dot(place.facing, L) <= 0;
    if (self_shadowed) ++stats_.self_shadowed;
    const bool b = !self_shadowed && sees_light(from, light);
    if (!b) out.shadow += diffuse + specular;
  }
  out.color = out.ambient + out.diffuse + out.specular - out.shadow;
}

bool Tracer::sees_light(const dvec3& from, const Light& light) {
  ++stats_.rays.shadow;
  const Ray ray = make_ray(from, light.directional ? -light.direction : light.position - from);
  for (std::uint32_t primitive = 0; primitive < scene_.primitive_object.size(); ++primitive) {
    if (!scene_.materials[primitive_material(scene_, primitive)].casts_shadow) continue;
    const Hit hit = intersect(scene_, primitive, ray, kRayStart, stats_.visibility);
    if (hit.found() &&
        (light.directional || before_light(scene_, hit, ray, light.position, stats_.visibility)))
      return false;
  }
  return true;
}

void Tracer::add_secondary(const Ray& ray, const Place& place, const dvec3& from, const Material& material,
                           const dvec3& N, const Solids& inside, int depth, double weight, Traced& out) {
  const dvec3 c2 = scene_.trace.reflection ? material.reflect : dvec3(0);
  const dvec3 c3 = scene_.trace.refraction ? material.refract : dvec3(0);
  const dvec3 D = normalize(ray.direction), Nv = place.facing;

  // Mirror: R = D - 2 (D.N) N, kept above the surface.
  dvec3 R = D - 2 * dot(D, N) * N;
  if (dot(R, Nv) < 0) R -= 2 * dot(R, Nv) * Nv;
  const Ray mirrored = make_ray(from, normalize(R));

  if (c3 == dvec3(0)) {
    out.mirrored = follow(mirrored, kRayStart, inside, c2, depth, weight, stats_.rays.reflection);
  } else if (!object_of(out.hit).solid) {  // a sheet without an inside: straight on
    out.mirrored = follow(mirrored, kRayStart, inside, c2, depth, weight, stats_.rays.reflection);
    out.refracted = follow(ray, out.hit, inside, c3, depth, weight, stats_.rays.refraction);
  } else {
    // Snell: T = eta D + (eta cos i - sqrt(1 - eta² (1 - cos² i))) N, or total internal reflection.
    const Solids after = behind(ray, out.hit, place, inside);
    const double eta = ior(inside) / ior(after);
    const dvec3 n = dot(D, N) < 0 ? N : Nv;
    const double cos_i = -dot(D, n);
    const double radicand = 1 - eta * eta * (1 - cos_i * cos_i);
    if (eta != 1 && radicand < 0) {
      out.mirrored = follow(mirrored, kRayStart, inside, c2 + c3, depth, weight, stats_.rays.reflection);
    } else {
      dvec3 T = eta == 1 ? D : eta * D + (eta * cos_i - std::sqrt(radicand)) * n;
      if (dot(T, Nv) > 0) T -= 2 * dot(T, Nv) * Nv;
      out.mirrored = follow(mirrored, kRayStart, inside, c2, depth, weight, stats_.rays.reflection);
      // It starts before the surface, which it then passes unnoticed: it is already in the medium behind.
      const Ray refracted = make_ray(from, normalize(T));
      out.refracted = follow(refracted, kRayStart, after, c3, depth, weight, stats_.rays.refraction);
    }
  }
  out.color += out.mirrored + out.refracted;
}

// c w(r) trace(ray)
dvec3 Tracer::follow(const Ray& ray, const Hit& start, const Solids& inside, const dvec3& c, int depth,
                     double weight, std::uint64_t& counter) {
  weight *= std::max({c.x, c.y, c.z});
  if (c == dvec3(0)) return dvec3(0);
  if (depth == scene_.trace.depth || weight < scene_.trace.contribution_cut) {
    stats_.cut_weight += weight;
    return dvec3(0);
  }
  ++counter;
  const Traced seen = trace(ray, start, inside, depth + 1, weight);
  const Attenuation& q = scene_.trace.secondary_attenuation;
  const double r = seen.hit.found() ? (seen.hit.t - start.t) * glm::length(ray.direction) : INFINITY;
  const double falloff = q.q0 + (q.q1 > 0 ? q.q1 * r : 0) + (q.q2 > 0 ? q.q2 * r * r : 0);
  return c / std::max(1.0, falloff) * seen.color;
}

// The solids a ray is in after a hit, and after all surfaces that lie together with it.
Solids Tracer::behind(const Ray& ray, const Hit& hit, const Place& place, const Solids& inside) {
  Solids after = inside;
  for (Hit each = hit; each.found() && each.t <= place.together;
       each = nearest_of_all(scene_, ray, each, stats_.visibility)) {
    const std::uint32_t object = scene_.primitive_object[each.primitive];
    if (!scene_.objects[object].solid) continue;
    if (locate(scene_, ray, each, stats_.visibility).entering)
      after.insert(object);
    else
      after.erase(object);
  }
  return after;
}

Solids Tracer::solids_around(const dvec3& eye) const {
  Solids inside;
  for (std::uint32_t i = 0; i < scene_.objects.size(); ++i)
    if (scene_.trace.refraction && scene_.objects[i].solid && contains(scene_, scene_.objects[i], eye))
      inside.insert(i);
  return inside;
}

Sample to_sample(const Scene& scene, const Traced& light) {
  Sample sample;
  sample.color = light.color;
  sample[Layer::ambient] = light.ambient;
  sample[Layer::diffuse] = light.diffuse;
  sample[Layer::specular] = light.specular;
  sample[Layer::shadow] = light.shadow;
  sample[Layer::reflection] = light.mirrored;
  sample[Layer::refraction] = light.refracted;
  if (!light.hit.found()) return sample;
  sample.object = 1 + scene.primitive_object[light.hit.primitive];
  sample.primitive = 1 + light.hit.primitive;
  sample.t = light.hit.t;
  sample.normal = light.normal;
  return sample;
}

}  // namespace

Frame render_reference(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  Frame frame = make_frame(camera.width, camera.height, camera.n, options);
  std::vector<RenderStats> stats(static_cast<std::size_t>(frame.height()));
  const Solids around = Tracer(scene, stats[0]).solids_around(camera.eye);
  for_each_part(options, frame.height(), [&](int row, int) {
    RenderStats& mine = stats[static_cast<std::size_t>(row)];
    Tracer tracer(scene, mine);
    write_row(frame, camera.depth_scale(), frame.window.y0 + row, [&](int X, int Y) {
      ++mine.rays.primary;
      const Ray ray{camera.eye, camera.direction(X, Y)};
      return to_sample(scene, tracer.trace(ray, kRayStart, around, 1, 1.0));
    });
  });
  for (const RenderStats& s : stats) {
    frame.stats.add_counts(s);
    frame.stats.cut_weight += s.cut_weight;
  }
  frame.stats.cut_weight /= static_cast<double>(frame.pixels()) * camera.n * camera.n;
  return frame;
}

}  // namespace sidelight::raytrace
