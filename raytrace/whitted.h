// SPDX-License-Identifier: MIT
// The recursion: what light comes back along a ray. Reads like the lecture's pseudo-code; all geometry is asked of
// prepared.h, all light of common/model.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/picture/frame.h"
#include "raytrace/path.h"
#include "raytrace/prepared.h"
#include "raytrace/recorder.h"

namespace sidelight::raytrace {

// What a ray brings back: color = c1 local + mirrored + refracted. For an eye ray the parts are the terms of the
// ledger: ambient + diffuse + specular is local light with every light seen, and shadow what is missing from it.
struct Traced {
  glm::vec3 color{0};
  glm::vec3 ambient{0}, diffuse{0}, specular{0};
  glm::vec3 shadow{0}, mirrored{0}, refracted{0};
  Hit hit;
  std::uint32_t object = kNone;
  glm::vec3 normal{0};
};

// Recorder: NoRecorder or TreeRecorder (recorder.h).
template <class Recorder>
class Whitted {
 public:
  Whitted(const Prepared& prepared, RenderStats& stats, Recorder& recorder, const Faults& faults = {})
      : prepared_(prepared),
        scene_(prepared.scene),
        stats_(stats),
        recorder_(recorder),
        shadow_offset_(faults.shadow_offset),
        precision_(faults.float_precision ? Precision::in_float : Precision::exact) {}

  Traced trace(const Path& path);

 private:
  void add_local(const Surface& surface, const Ray& ray, Traced& out);
  Hit shadow_blocker(const Surface& surface, const Light& light);
  void add_secondary(const Path& path, const Surface& surface, Traced& out);
  glm::vec3 follow(Path path, const glm::dvec3& c);

  const Prepared& prepared_;
  const Scene& scene_;
  RenderStats& stats_;
  Recorder& recorder_;
  std::optional<double> shadow_offset_;   // faults on purpose (faults.h)
  Precision precision_;
};

extern template class Whitted<NoRecorder>;
extern template class Whitted<TreeRecorder>;

}  // namespace sidelight::raytrace
