// SPDX-License-Identifier: MIT
#include "viewer/commands/faulty.h"

#include <algorithm>

#include "viewer/commands/renderers.h"

namespace sidelight {
namespace {

// Both pictures of a scene with some faults.
struct BothPictures {
  const Scene& scene;
  const Faults& faults;
  const Frame &rastered, &traced;
};

// The same with frames of its own. `faults` must outlive it.
struct Rendered {
  BothPictures pictures() const { return {scene, faults, rastered, traced}; }
  const Scene& scene;
  const Faults& faults;
  Frame rastered, traced;
};

Rendered render_with(const Job& job, const Faults& faults) {
  Job other = job;
  other.options.faults = faults;
  other.flags.quiet = true;  // the job's own pictures had the progress bar
  const Scene& scene = job.untessellated && !faults.tessellate ? *job.untessellated : job.scene;
  if (&scene != &job.scene) other.scene = scene;
  return {scene, faults, render_all_layers(other, *find_renderer("raster")).frame,
          render_all_layers(other, *find_renderer("raytrace")).frame};
}

enum Change : char { kSame, kValue, kSurface };

// What is compared of two frames; the scenes tell objects by primitive.
struct Differs {
  const Scene &with_scene, &without_scene;
  bool by_object, depth;

  static std::uint32_t object(const Scene& scene, std::uint32_t primitive) {
    return primitive == kNone ? kNone : scene.primitive_object[primitive];
  }
  Change sample(const Frame& with, const Frame& without, std::size_t s) const {
    const std::uint32_t a = with.sample_primitive[s], b = without.sample_primitive[s];
    if (by_object ? object(with_scene, a) != object(without_scene, b) : a != b) return kSurface;
    return depth && a != kNone && with.sample_depth[s] != without.sample_depth[s] ? kValue : kSame;
  }
  Change samples(const Frame& with, const Frame& without, std::size_t i) const {
    Change change = kSame;
    const auto per_pixel = static_cast<std::size_t>(with.n) * static_cast<std::size_t>(with.n);
    for (std::size_t s = i * per_pixel; s < (i + 1) * per_pixel; ++s)
      change = std::max(change, sample(with, without, s));
    return change;
  }
  Change pixel(const Frame& with, const Frame& without, std::size_t i) const {
    return std::max(with.color[i] != without.color[i] ? kValue : kSame, samples(with, without, i));
  }
};

// What the faults that only `with` has change.
std::vector<char> changed_pixels(const BothPictures& with, const BothPictures& without) {
  const Differs differs{with.scene, without.scene, with.faults.tessellate != without.faults.tessellate,
                        with.faults.float_precision == without.faults.float_precision};
  // Facets of one sphere in one colour are no change of either picture; that the two name different ones, is.
  const auto apart = [](const BothPictures& of, std::size_t i) {
    return Differs{of.scene, of.scene, false, true}.samples(of.rastered, of.traced, i);
  };
  std::vector<char> mask(with.rastered.pixels());
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const Change newly_apart = apart(without, i) == kSame ? apart(with, i) : kSame;
    mask[i] = std::max({differs.pixel(with.rastered, without.rastered, i),
                        differs.pixel(with.traced, without.traced, i), newly_apart});
  }
  return mask;
}

// Takes in what another comparison finds changed.
void add(std::vector<char>& mask, const std::vector<char>& other) {
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = std::max(mask[i], other[i]);
}

}  // namespace

Spoiled find_spoiled(const Job& job, const Frame& rastered, const Frame& traced) {
  Spoiled spoiled;
  const Faults& faults = job.options.faults;
  if (!faults.any()) return spoiled;
  const Faults none{};
  const BothPictures all{job.scene, faults, rastered, traced};
  const Rendered exact = render_with(job, none);
  spoiled.mask = changed_pixels(all, exact.pictures());
  for (int i = 0; i < kFaults; ++i) {
    const auto fault = static_cast<FaultKind>(i);
    if (!faults.has(fault)) continue;
    std::vector<char> mask = spoiled.mask;
    if (const Faults alone = faults.only(fault), others = faults.without(fault); alone != faults) {
      mask = changed_pixels(render_with(job, alone).pictures(), exact.pictures());
      add(mask, changed_pixels(all, render_with(job, others).pictures()));
    }
    const auto count = [&](Change change) { return std::count(mask.begin(), mask.end(), change); };
    const auto surfaces = static_cast<std::uint64_t>(count(kSurface));
    spoiled.by_fault.push_back({fault, surfaces + static_cast<std::uint64_t>(count(kValue)), surfaces});
  }
  return spoiled;
}

}  // namespace sidelight
