// SPDX-License-Identifier: MIT
#include "raster/faulty_tile.h"

#include <cmath>

#include "common/model/visibility_float.h"

namespace sidelight::raster {

StoredDepth::StoredDepth(const Faults& faults, const Camera& camera)
    : format_(faults.depth_format), scale_(camera.depth_scale()) {
  if (!format_) return;
  near_ = faults.near_plane;
  far_ = faults.far_plane;
}

// 0 on the near plane, 1 on the far one, linear in 1/z; reversed, 1 and 0.
double StoredDepth::key(double t) const {
  if (!format_) return t;
  const double z = t * scale_;
  const double standard = far_ * (z - near_) / (z * (far_ - near_));
  switch (*format_) {
    case DepthFormat::unorm16:
      return std::round(standard * 0xFFFF);
    case DepthFormat::unorm24:
      return std::round(standard * 0xFFFFFF);
    case DepthFormat::float32:
      return double{static_cast<float>(standard)};
    case DepthFormat::reversed:
      break;
  }
  return -double{static_cast<float>(near_ * (far_ - z) / (z * (far_ - near_)))};
}

FaultyTile::FaultyTile(const Camera& camera, const Rect& pixels, const Faults& faults)
    : camera_(camera),
      box_(samples_of(pixels, camera.n)),
      stored_(faults, camera),
      in_float_(faults.float_precision),
      samples_(static_cast<std::size_t>(box_.x1 - box_.x0) * static_cast<std::size_t>(box_.y1 - box_.y0)) {}

// Of what is stored alike the first stays: primitives are drawn in the order of their numbers.
bool FaultyTile::wins(const Hit& hit, const Hit& nearest) const {
  return !nearest.found() || stored_.key(hit.t) < stored_.key(nearest.t);
}

void FaultyTile::draw(const Scene& scene, std::uint32_t primitive, VisibilityCounts& counts) {
  const SampleBox box = intersection(box_of_primitive(scene, camera_, primitive), box_);
  const Hit start{std::nextafter(stored_.nearest(), 0.0), kNone};  // what lies on the near plane counts
  for (int Y = box.y0; Y < box.y1; ++Y)
    for (int X = box.x0; X < box.x1; ++X) {
      const Ray ray{camera_.eye, camera_.direction(X, Y)};
      const Hit hit = in_float_ ? intersect_in_float(scene, primitive, ray, start, counts)
                                : intersect(scene, primitive, ray, start, counts);
      Sample& sample = samples_[index(X, Y)];
      ++sample.tests;
      if (hit.found()) ++counts.fragments;
      if (hit.found() && hit.t <= stored_.farthest() && wins(hit, sample.nearest)) sample.nearest = hit;
    }
}

}  // namespace sidelight::raster
