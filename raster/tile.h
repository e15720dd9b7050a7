// SPDX-License-Identifier: MIT
// One tile's z-buffer: depth and primitive of the nearest surface at each of its samples and, if asked for,
// how many primitives were tried there.
#pragma once

#include <cstdint>
#include <vector>

#include "common/model/explanation.h"
#include "common/model/visibility.h"
#include "common/scene/camera.h"
#include "raster/setup.h"

namespace sidelight::raster {

// Hears of every fragment that competes for a sample: nothing, in a picture; one sample's, for an explanation.
struct NoFragments {
  void fragment(int, int, const Hit&, bool) {}
};
struct FragmentsOfSample {
  int X = 0, Y = 0;
  std::vector<FragmentRecord> fragments{};

  void fragment(int x, int y, const Hit& hit, bool kept) {
    if (x == X && y == Y) fragments.push_back({hit, kept});
  }
};

template <class Recorder>
class DepthTile {
 public:
  // An empty z-buffer for the samples of `pixels`.
  DepthTile(const Camera& camera, const Rect& pixels, Recorder& recorder, bool count_tests = false);

  // Keeps the primitive wherever it is nearer than what the samples hold.
  void draw(const Scene& scene, std::uint32_t primitive, VisibilityCounts& counts);

  // The nearest hit at lattice sample (X, Y) of the tile; not found() on background.
  const Hit& at(int X, int Y) const { return nearest_[index(X, Y)]; }
  // The primitives tried there so far; 0 unless they are counted.
  std::uint32_t tests(int X, int Y) const { return tests_.empty() ? 0 : tests_[index(X, Y)]; }

 private:
  std::size_t index(int X, int Y) const {
    return static_cast<std::size_t>(Y - samples_.y0) * columns_.size() +
           static_cast<std::size_t>(X - samples_.x0);
  }
  glm::dvec3 direction(int X, int Y) const {
    return (columns_[static_cast<std::size_t>(X - samples_.x0)] +
            rows_[static_cast<std::size_t>(Y - samples_.y0)]) +
           axis_;
  }
  void keep(int X, int Y, const Hit& hit, VisibilityCounts& counts) {
    ++counts.fragments;
    Hit& nearest = nearest_[index(X, Y)];
    const bool kept = before(hit, nearest);
    if (kept) nearest = hit;
    recorder_.fragment(X, Y, hit, kept);
  }
  void add_tests(const SampleBox& box);
  void draw_triangle(const Scene& scene, std::uint32_t primitive, const Triangle& triangle,
                     const SampleBox& box, VisibilityCounts& counts);

  const Camera& camera_;
  SampleBox samples_;
  std::vector<glm::dvec3> columns_, rows_;  // the summands of Camera::direction
  glm::dvec3 axis_;
  std::vector<Hit> nearest_;
  std::vector<std::uint32_t> tests_;  // empty unless they are counted
  Recorder& recorder_;
};

extern template class DepthTile<NoFragments>;
extern template class DepthTile<FragmentsOfSample>;

}  // namespace sidelight::raster
