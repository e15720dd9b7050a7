// SPDX-License-Identifier: MIT
#include "common/model/shading.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/math/four.h"
#include "common/math/norms.h"
#include "common/model/kernels.h"

namespace sidelight {
namespace {

template <class T>
Vec3<T> rounded(const glm::dvec3& v) {
  return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}

// The greatest coordinate anything in the scene has, near enough; 0 for an empty one.
double extent(const Scene& scene) {
  double most = max_norm(scene.camera.eye);
  for (const glm::dvec3& p : scene.positions) most = std::max(most, max_norm(p));
  for (const Sphere& s : scene.spheres) most = std::max(most, max_norm(s.center) + s.radius);
  for (const Plane& p : scene.planes) most = std::max(most, max_norm(p.point));
  for (const Light& l : scene.lights) most = std::max(most, max_norm(l.position));
  return most;
}

// v = high + low: to 48 bits in float, with nothing low in double.
template <class T>
struct Split {
  Vec3<T> high, low;
};

template <class T>
Split<T> split(const glm::dvec3& v) {
  const Vec3<T> high = rounded<T>(v);
  return {high, rounded<T>(v - glm::dvec3(high.x, high.y, high.z))};
}

// Of unit length, in T.
template <class T>
Vec3<T> unit_rounded(const glm::dvec3& v) {
  const auto plain = [](const T& length2) { return length2 >= T(kLeastPlain) && length2 <= T(kMostPlain); };
  Vec3<T> direction = rounded<T>(v);
  if (!plain(dot(direction, direction))) direction = rounded<T>(glm::normalize(v / max_norm(v)));
  return (T(1) / std::sqrt(dot(direction, direction))) * direction;
}

template <class T>
ShadingLight<T> shading_light(const Light& light, double scale, bool attenuated) {
  ShadingLight<T> out;
  out.attenuated = attenuated && !light.directional;
  out.intensity = rounded<T>(light.intensity);
  out.directional = light.directional;
  if (light.directional) {
    out.high = rounded<T>(-light.direction);
    return out;
  }
  const Split<T> position = split<T>(scale * light.position);
  out.high = position.high;
  out.low = position.low;
  // f(d) of the scaled distance: a power of two, so nothing is rounded
  out.q0 = static_cast<T>(light.attenuation.q0);
  out.q1 = static_cast<T>(light.attenuation.q1 / scale);
  out.q2 = static_cast<T>(light.attenuation.q2 / scale / scale);
  return out;
}

}  // namespace

template <class T>
ShadingTablesOf<T> make_shading_tables(const Scene& scene, const Needs& needs) {
  ShadingTablesOf<T> tables;
  const double most = extent(scene);
  tables.length_scale = most > 0 ? std::exp2(-std::ilogb(most)) : 1;
  tables.ambient_light = rounded<T>(scene.ambient);
  for (const Material& m : scene.materials)
    tables.materials.push_back({rounded<T>(m.ambient), rounded<T>(m.diffuse), rounded<T>(m.specular),
                                rounded<T>(m.local), rounded<T>(m.reflect), rounded<T>(m.refract),
                                static_cast<T>(m.shininess)});
  if (!needs[Need::live_lights]) return tables;
  for (const Light& light : scene.lights)
    tables.lights.push_back(shading_light<T>(light, tables.length_scale, needs[Need::light_attenuation]));
  return tables;
}

template <class T>
ShadingPoint<T> shading_point(const ShadingTablesOf<T>& tables, const Surface& surface, const Ray& ray) {
  const ShadingMaterialOf<T>& material = tables.materials[surface.material];
  const Split<T> position = split<T>(tables.length_scale * surface.point);
  return {position.high,
          position.low,
          unit_rounded<T>(surface.smooth),
          rounded<T>(surface.facing),
          unit_rounded<T>(-ray.direction),
          material.ambient,
          material.diffuse,
          material.specular,
          material.shininess};
}

template ShadingTablesOf<float> make_shading_tables(const Scene&, const Needs&);
template ShadingTablesOf<double> make_shading_tables(const Scene&, const Needs&);
template ShadingPoint<float> shading_point(const ShadingTablesOf<float>&, const Surface&, const Ray&);
template ShadingPoint<double> shading_point(const ShadingTablesOf<double>&, const Surface&, const Ray&);

void ShadingBatch::set(std::size_t i, const ShadingPoint<float>& point, std::uint32_t material_number) {
  store_rows<float>(point.high, high, i);
  store_rows<float>(point.low, low, i);
  store_rows<float>(point.normal, normal, i);
  store_rows<float>(point.facing, facing, i);
  store_rows<float>(point.to_viewer, to_viewer, i);
  material[i] = material_number;
}

namespace {
// Of four entries, three times four floats.
std::array<FourFloats, 3> four_pixels(const ShadingBatch::Rgb& from, std::size_t first) {
  const auto four = [&](std::size_t c) { return load_four<FourFloats>(&from[c][first]); };
  return interleaved(four(0), four(1), four(2));
}
}  // namespace

void interleave(const ShadingBatch::Rgb& from, std::size_t first, std::size_t count, glm::vec3* to) {
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    const auto parts = four_pixels(from, first + i);
    std::memcpy(&to[i].x, parts.data(), sizeof parts);
  }
  for (; i < count; ++i) to[i] = get(from, first + i);
}

void stream(const ShadingBatch::Rgb& from, std::size_t first, std::size_t count, glm::vec3* to) {
  float* channel = &to->x;
  for (std::size_t i = 0; i < count; i += 4)
    for (const FourFloats& part : four_pixels(from, first + i)) {
      stream_four(FourFloats{} + part, channel);
      channel += 4;
    }
}

void shade(Isa isa, const ShadingTables& tables, ShadingBatch& batch, bool with_parts) {
  if (batch.size == 0) return;  // there may be no material to read
  model_kernels(isa).shade(tables, batch, with_parts);
}

void light_terms(Isa isa, const ShadingTables& tables, const ShadingBatch& batch, bool with_parts,
                 LitBatch& out) {
  out.light.resize(tables.lights.size());
  if (batch.size == 0) return;
  model_kernels(isa).light_terms(tables, batch, with_parts, out);
}

}  // namespace sidelight
