// SPDX-License-Identifier: MIT
// What the tracer keeps of a scene between frames, and the questions it asks of it (prepared.cpp).
#pragma once

#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

#include "common/math/norms.h"
#include "common/model/place.h"
#include "common/model/shading.h"
#include "common/model/visibility.h"
#include "raytrace/leaves.h"
#include "raytrace/raytrace.h"

namespace sidelight::raytrace {

class Prepared {
 public:
  explicit Prepared(const Scene& all, int threads = 1) : Prepared(all, needs_of(all), threads) {}
  Prepared(const Scene& scene, const Needs& needs, int threads = 1);

  const Scene& scene;
  Needs needs;
  ShadingTablesOf<float> tables;
  ShadingTablesOf<double> tables_in_double;  // for reference images
  TriangleLeaves triangles;
  SphereLeaves spheres;
  bool all_cast_shadows = true;        // as far as materials say
  std::vector<std::uint32_t> planes;   // primitive numbers: infinite, so met one by one
  std::vector<std::uint32_t> solids;   // objects that bound a medium; empty where refraction is off
  std::vector<Bounds> bounds;          // of each solid
  std::vector<std::uint8_t> shuts_in;  // of each solid: whether no ray escapes it (enclosed.h)
  std::vector<std::uint8_t> secluded;  // of each sphere: whether it is a solid and is_secluded()
  double reach = 0;  // greatest coordinate of all that can be met; of planes, of their points

  // The same, and of `origin`.
  double reach_from(const glm::dvec3& origin) const { return std::max(reach, max_norm(origin)); }

  // Where in `solids` an object stands that is one of them.
  std::size_t place_of(std::uint32_t solid) const {
    return static_cast<std::size_t>(std::lower_bound(solids.begin(), solids.end(), solid) - solids.begin());
  }

  template <class Real>
  const ShadingTablesOf<Real>& tables_in() const {
    if constexpr (std::is_same_v<Real, float>)
      return tables;
    else
      return tables_in_double;
  }
};

bool casts_shadow(const Scene& scene, std::uint32_t primitive);

// Where a light is on its shadow rays (blocker() below); nullptr: a directional one.
[[gnu::always_inline]] inline double light_depth(const glm::dvec3* light) {
  return light ? 1 : std::numeric_limits<double>::infinity();
}

// What find_hit() finds of the primitive, where that casts a shadow and stands before the light.
template <class FindHit>
[[gnu::always_inline]] inline Hit blocking_hit(const Prepared& prepared, std::uint32_t primitive,
                                               const Ray& ray, const glm::dvec3* light,
                                               VisibilityCounts& counts, const FindHit& find_hit) {
  if (!prepared.all_cast_shadows && !casts_shadow(prepared.scene, primitive)) return {};
  const Hit hit = find_hit();
  return hit.found() && (!light || before_light(prepared.scene, hit, ray, *light, counts)) ? hit : Hit{};
}

// How triangles are decided: exactly, or as a fault on purpose (visibility_float.h).
enum class Precision { exact, in_float };

// The nearest hit after `after`; not found() if there is none. The same as nearest_of_all, found faster.
Hit nearest(const Prepared& prepared, const Ray& ray, const Hit& after, VisibilityCounts& counts,
            Precision precision = Precision::exact, Isa isa = best_isa());

// The same where of one primitive, `known`, it is known that its hit, if it has one, is `own`: it is not asked.
Hit nearest_beside(const Prepared& prepared, const Ray& ray, const Hit& after, std::uint32_t known,
                   const Hit& own, VisibilityCounts& counts, Isa isa);

// The same for many rays, neighbours of which should have much the same way: `best` of each question, its own hit at
// first, becomes the nearest.
struct RayQuestion;
void nearest_beside(const Prepared& prepared, std::span<RayQuestion> questions, VisibilityCounts& counts,
                    Isa isa);

// Something that casts shadows and stands between the ray's origin and the light; not found() if nothing does. For a
// point light the ray's direction is light - origin and the light is at t = 1; for a directional one (light ==
// nullptr) it is infinitely far. Of several blockers any one is returned, the same one each time.
// Only what is met after `start` counts.
Hit blocker(const Prepared& prepared, const Ray& ray, const glm::dvec3* light, VisibilityCounts& counts,
            const Hit& start = kRayStart, Precision precision = Precision::exact, Isa isa = best_isa());

// Whether there is a blocker of each of many rays to one light, neighbours of which should have much the same way.
struct ShadowQuestion;
void find_blocked(const Prepared& prepared, std::span<ShadowQuestion> questions, const glm::dvec3* light,
                  VisibilityCounts& counts, Isa isa);

// Where rays start that leave `place`, at which `ray` met `hit`: leaving_point of all that stands near.
glm::dvec3 leaving_point(const Prepared& prepared, const Ray& ray, const Hit& hit, const Place& place,
                         VisibilityCounts& counts, Isa isa = best_isa());

// All hits h with h.t in [from.t, last_t] that do not come before `from`, in order.
std::vector<Hit> hits_between(const Prepared& prepared, const Ray& ray, const Hit& from, double last_t,
                              VisibilityCounts& counts, Isa isa = best_isa());

}  // namespace sidelight::raytrace
