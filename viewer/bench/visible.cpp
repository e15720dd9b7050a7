// SPDX-License-Identifier: MIT
#include "viewer/bench/visible.h"

#include <algorithm>
#include <cmath>

namespace sidelight {

const VisibleJudge::Samples& VisibleJudge::exact(bool raster, int n) {
  const auto [at, added] = exact_.try_emplace({raster, n});
  if (!added) return at->second;
  Setting setting;
  setting.raster = raster;
  setting.n = n;
  setting.depth = 1;
  Frame frame = stage_.render(setting, true);
  at->second = {std::move(frame.sample_primitive), std::move(frame.sample_depth)};
  return at->second;
}

VisibleError VisibleJudge::compare(const Setting& setting, const Frame& frame) {
  const Scene &own = stage_.scene_of(setting), &scene = stage_.scene();
  const bool by_object = setting.faults.tessellate.has_value();
  const auto surface = [&](const Scene& of, std::uint32_t primitive) {
    return by_object && primitive != kNone ? of.primitive_object[primitive] : primitive;
  };
  const Samples& truth = exact(!setting.raster, setting.n);
  VisibleError out;
  out.covered.resize(frame.pixels());
  const auto per_pixel = static_cast<std::size_t>(frame.n) * static_cast<std::size_t>(frame.n);
  for (std::size_t i = 0; i < truth.primitive.size(); ++i) {
    const std::uint32_t seen = frame.sample_primitive[i], there = truth.primitive[i];
    if (seen != kNone || there != kNone) out.covered[i / per_pixel] = 1;
    if (surface(own, seen) != surface(scene, there))
      ++out.mismatches;
    else if (seen != kNone)
      out.depth_error =
          std::max(out.depth_error, std::abs(frame.sample_depth[i] - truth.depth[i]) / truth.depth[i]);
  }
  return out;
}

}  // namespace sidelight
