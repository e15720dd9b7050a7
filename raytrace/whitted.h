// SPDX-License-Identifier: MIT
// The recursion: what light comes back along a ray. Reads like the lecture's pseudo-code; all geometry is asked of
// prepared.h, all light of common/model. Geometry is in double; light is in Real: float in every picture, and double in
// a reference image, which the same rays make.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/picture/frame.h"
#include "raytrace/recorder.h"
#include "raytrace/secondary.h"

namespace sidelight::raytrace {

// What a ray brings back: color = c1 local + mirrored + refracted. For an eye ray the parts are the terms of the
// ledger: ambient + diffuse + specular is local light with every light seen, and shadow what is missing from it.
template <class Real>
struct Traced {
  using Rgb = glm::vec<3, Real>;
  Rgb color{0};
  Rgb ambient{0}, diffuse{0}, specular{0};
  Rgb shadow{0}, mirrored{0}, refracted{0};
  Hit hit;
  std::uint32_t object = kNone;
  glm::vec3 normal{0};
  double cut_weight = 0;  // path weights of the rays below that were not sent
};

// Recorder: NoRecorder or TreeRecorder (recorder.h).
template <class Real, class Recorder>
class Whitted {
 public:
  using Rgb = glm::vec<3, Real>;

  Whitted(const Prepared& prepared, RenderStats& stats, Recorder& recorder, const Faults& faults = {},
          Isa isa = best_isa())
      : prepared_(prepared),
        scene_(prepared.scene),
        tables_(prepared.tables_in<Real>()),
        stats_(stats),
        recorder_(recorder),
        shadow_offset_(faults.shadow_offset),
        precision_(faults.float_precision ? Precision::in_float : Precision::exact),
        isa_(isa) {}

  Traced<Real> trace(const Path& path);

 private:
  void add_local(const Surface& surface, const Ray& ray, const glm::dvec3& from, Traced<Real>& out);
  Hit shadow_blocker(const Surface& surface, const glm::dvec3& from, const Light& light);
  void add_secondary(const Path& path, const Surface& surface, const glm::dvec3& from, Traced<Real>& out);
  Rgb follow(Departure leaving, double& cut_weight);

  const Prepared& prepared_;
  const Scene& scene_;
  const ShadingTablesOf<Real>& tables_;
  RenderStats& stats_;
  Recorder& recorder_;
  std::optional<double> shadow_offset_;  // faults on purpose (faults.h)
  Precision precision_;
  Isa isa_;
};

extern template class Whitted<float, NoRecorder<float>>;
extern template class Whitted<double, NoRecorder<double>>;
extern template class Whitted<float, TreeRecorder>;

}  // namespace sidelight::raytrace
