// SPDX-License-Identifier: MIT
// The z-buffer as the lecture has it: for each object, for each pixel it covers, keep the nearest; then light what
// is visible by the local model. In double, one sample at a time, never optimised: the text to read first, and the
// oracle of render(). It shares with the fast code the scene, the camera, visibility, where a hit is (place.h), and how
// samples become a pixel (pixel.h); the local model is written out here once more, on purpose.
//
// The lecture says "greater z is nearer" and scans polygons line by line. Here the depth t is the distance along the
// sample's ray, so the smaller is the nearer; and a sample asks whether its ray meets the polygon, which needs no
// clipping and no division by z.
#include <cmath>
#include <vector>

#include "common/model/place.h"
#include "common/parallel.h"
#include "common/picture/pixel.h"
#include "raster/raster.h"

namespace sidelight::raster {
namespace {

using glm::dot;
using glm::dvec3;
using glm::normalize;

struct LocalLight {
  dvec3 ambient{0}, diffuse{0}, specular{0};
};

// N: the vertex normals, interpolated and made unit again; the surface's own normal where there are none. It faces
// the viewer: Ng is turned against the ray, and N follows Ng.
dvec3 normal_facing_viewer(const Scene& scene, const Hit& hit, const Place& place) {
  const dvec3 facing = place.entering ? place.outward : -place.outward;
  const PrimitiveRef ref = primitive_ref(scene, hit.primitive);
  if (ref.kind != ObjectKind::mesh || scene.triangles[ref.index].normal[0] == kNone) return facing;
  dvec3 sum(0);
  for (std::size_t k = 0; k < 3; ++k)
    sum += place.barycentric[k] * scene.normals[scene.triangles[ref.index].normal[k]];
  if (dot(sum, facing) == 0) return facing;
  return normalize(dot(sum, facing) < 0 ? -sum : sum);
}

// I = ka Ia + sum_i f_i(d) I_i [ kd (N.L) + ks (Rl.V)^s ]
LocalLight local_light(const Scene& scene, const Material& material, const dvec3& point, const dvec3& N,
                       const dvec3& V) {
  LocalLight sum;
  sum.ambient = material.ambient * scene.ambient;
  for (const Light& light : scene.lights) {
    dvec3 L = -light.direction;
    double f = 1;
    if (!light.directional) {
      const dvec3 to_light = light.position - point;
      const double d = glm::length(to_light);
      if (d == 0) continue;  // a light at the point itself adds nothing
      L = to_light / d;
      f = 1 / (light.attenuation.q0 + light.attenuation.q1 * d + light.attenuation.q2 * d * d);
    }
    if (dot(N, L) <= 0) continue;  // behind the surface
    const dvec3 Rl = 2 * dot(N, L) * N - L;
    const double highlight = dot(Rl, V) > 0 ? std::pow(dot(Rl, V), material.shininess) : 0;
    sum.diffuse += f * light.intensity * material.diffuse * dot(N, L);
    sum.specular += f * light.intensity * material.specular * highlight;
  }
  return sum;
}

Sample shade(const Scene& scene, const Ray& ray, const Hit& hit, VisibilityCounts& counts) {
  Sample sample;
  if (!hit.found()) {
    sample.color = sample[Layer::ambient] = scene.background;
    return sample;
  }
  const Place place = locate(scene, ray, hit, counts);
  const Material& material = scene.materials[primitive_material(scene, hit.primitive)];
  const dvec3 N = normal_facing_viewer(scene, hit, place);
  const dvec3 V = -normalize(ray.direction);
  const LocalLight light = local_light(scene, material, place.point, N, V);
  const dvec3 c1 = material.local;

  sample.color = c1 * (light.ambient + light.diffuse + light.specular);
  sample[Layer::ambient] = c1 * light.ambient;
  sample[Layer::diffuse] = c1 * light.diffuse;
  sample[Layer::specular] = c1 * light.specular;
  sample.object = 1 + scene.primitive_object[hit.primitive];
  sample.primitive = 1 + hit.primitive;
  sample.t = hit.t;
  sample.normal = N;
  return sample;
}

// One row of pixels. (Rows are cut apart only so that all cores can help.)
void render_row(const Scene& scene, const Camera& camera, int y, Frame& frame, VisibilityCounts& counts) {
  const int n = camera.n, x0 = n * frame.window.x0, x1 = n * frame.window.x1;
  const auto columns = static_cast<std::size_t>(x1 - x0);
  std::vector<Hit> z_buffer(columns * static_cast<std::size_t>(n));
  const auto sample = [&](int X, int Y) {
    return static_cast<std::size_t>(Y - n * y) * columns + static_cast<std::size_t>(X - x0);
  };

  // For each object, for each sample it covers: keep the nearest.
  for (std::uint32_t primitive = 0; primitive < scene.primitive_object.size(); ++primitive)
    for (int Y = n * y; Y < n * (y + 1); ++Y)
      for (int X = x0; X < x1; ++X) {
        const Ray ray{camera.eye, camera.direction(X, Y)};
        const Hit hit = intersect(scene, primitive, ray, kRayStart, counts);
        if (hit.found() && before(hit, z_buffer[sample(X, Y)])) z_buffer[sample(X, Y)] = hit;
      }

  // Then light what is visible.
  write_row(frame, camera.depth_scale(), y, [&](int X, int Y) {
    return shade(scene, {camera.eye, camera.direction(X, Y)}, z_buffer[sample(X, Y)], counts);
  });
}

}  // namespace

Frame render_reference(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  Frame frame = make_frame(camera.width, camera.height, camera.n, options);
  std::vector<RenderStats> stats(static_cast<std::size_t>(thread_count(options.threads)));
  for_each_part(options, frame.height(), [&](int row, int thread) {
    render_row(scene, camera, frame.window.y0 + row, frame,
               stats[static_cast<std::size_t>(thread)].visibility);
  });
  for (const RenderStats& s : stats) frame.stats.add_counts(s);
  return frame;
}

}  // namespace sidelight::raster
