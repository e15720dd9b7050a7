// SPDX-License-Identifier: MIT
#include "viewer/commands/faulty.h"

#include <algorithm>

#include "viewer/commands/renderers.h"

namespace sidelight {
namespace {

struct Pictures {
  Frame rastered, traced;
};

Pictures render_with(const Job& job, const Faults& faults) {
  Job other = job;
  other.options.faults = faults;
  other.flags.quiet = true;  // the job's own pictures had the progress bar
  if (job.untessellated && !faults.tessellate) other.scene = *job.untessellated;
  return {render_all_layers(other, *find_renderer("raster")).frame,
          render_all_layers(other, *find_renderer("raytrace")).frame};
}

enum Change : char { kSame, kValue, kSurface };

// What is compared of two frames; the scenes tell objects by primitive.
struct Differs {
  const Scene &faulty_scene, &exact_scene;
  bool by_object, depth;

  static std::uint32_t object(const Scene& scene, std::uint32_t primitive) {
    return primitive == kNone ? kNone : scene.primitive_object[primitive];
  }
  Change sample(const Frame& faulty, const Frame& exact, std::size_t s) const {
    const std::uint32_t a = faulty.sample_primitive[s], b = exact.sample_primitive[s];
    if (by_object ? object(faulty_scene, a) != object(exact_scene, b) : a != b) return kSurface;
    return depth && a != kNone && faulty.sample_depth[s] != exact.sample_depth[s] ? kValue : kSame;
  }
  Change samples(const Frame& faulty, const Frame& exact, std::size_t i) const {
    Change change = kSame;
    const auto per_pixel = static_cast<std::size_t>(exact.n) * static_cast<std::size_t>(exact.n);
    for (std::size_t s = i * per_pixel; s < (i + 1) * per_pixel; ++s)
      change = std::max(change, sample(faulty, exact, s));
    return change;
  }
  Change pixel(const Frame& faulty, const Frame& exact, std::size_t i) const {
    return std::max(faulty.color[i] != exact.color[i] ? kValue : kSame, samples(faulty, exact, i));
  }
};

std::vector<char> changed_pixels(const Job& job, const Faults& faults, const Frame& rastered,
                                 const Frame& traced, const Pictures& exact) {
  const Scene& exact_scene = job.untessellated ? *job.untessellated : job.scene;
  const Differs differs{faults.tessellate ? job.scene : exact_scene, exact_scene,
                        faults.tessellate.has_value(), !faults.float_precision};
  // Facets of one sphere in one colour are no change of either picture; that the two name different ones, is.
  const Differs apart{job.scene, job.scene, false, true};
  std::vector<char> mask(rastered.pixels());
  for (std::size_t i = 0; i < mask.size(); ++i)
    mask[i] = std::max({differs.pixel(rastered, exact.rastered, i), differs.pixel(traced, exact.traced, i),
                        apart.samples(rastered, traced, i)});
  return mask;
}

}  // namespace

Spoiled find_spoiled(const Job& job, const Frame& rastered, const Frame& traced) {
  Spoiled spoiled;
  const Faults& faults = job.options.faults;
  if (!faults.any()) return spoiled;
  const Pictures exact = render_with(job, {});
  spoiled.mask = changed_pixels(job, faults, rastered, traced, exact);
  for (int i = 0; i < kFaults; ++i) {
    const auto fault = static_cast<FaultKind>(i);
    if (!faults.has(fault)) continue;
    std::vector<char> mask = spoiled.mask;
    if (const Faults alone = faults.only(fault); alone != faults) {
      const Pictures pictures = render_with(job, alone);
      mask = changed_pixels(job, alone, pictures.rastered, pictures.traced, exact);
    }
    const auto count = [&](Change change) { return std::count(mask.begin(), mask.end(), change); };
    const auto surfaces = static_cast<std::uint64_t>(count(kSurface));
    spoiled.by_fault.push_back({fault, surfaces + static_cast<std::uint64_t>(count(kValue)), surfaces});
  }
  return spoiled;
}

}  // namespace sidelight
