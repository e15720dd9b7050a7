// SPDX-License-Identifier: MIT
// What Whitted tells about its work. NoRecorder hears nothing and vanishes in the compiler; TreeRecorder keeps the
// whole tree of rays of one sample, for `explain` and the inspector, as far as its budget goes.
#pragma once

#include <utility>

#include "raytrace/raytrace.h"
#include "raytrace/secondary.h"

namespace sidelight::raytrace {

template <class Real>
struct NoRecorder {
  void begin(const Path&) {}
  void passed(const Hit&) {}
  void surface(const Hit&, const Surface&, const Vec3<Real>&, const Vec3<Real>&) {}
  void light(std::size_t, const LightTerm<Real>&, bool, const Hit&) {}
  void end(const glm::vec<3, Real>&) {}
  void counted(const glm::dvec3&, Real) {}
  void not_sent(const Path&, const glm::dvec3&) {}
};

class TreeRecorder {
 public:
  // `budget` must outlive this.
  explicit TreeRecorder(ExplainBudget& budget) : budget_(budget) {}

  void begin(const Path& path) {
    count_record();
    open_.push_back(record(path));
  }
  void passed(const Hit& hit) {
    count_record();
    open_.back().passed.push_back(hit);
  }
  void surface(const Hit& hit, const Surface& surface, const Vec3<float>& c1, const Vec3<float>& ambient) {
    open_.back().background = false;
    open_.back().local = {hit, surface, {c1.x, c1.y, c1.z}, {ambient.x, ambient.y, ambient.z}, {}};
  }
  // A light whose term is not zero; `blocker` is what stands in between, where a shadow ray met something.
  void light(std::size_t index, const LightTerm<float>& term, bool seen, const Hit& blocker) {
    count_record();
    LightRecord record = record_light(index, term);
    record.seen = seen;
    record.self_shadowed = !seen && !blocker.found();
    record.blocker = blocker.primitive;
    open_.back().local.lights.push_back(record);
  }
  void end(const glm::vec3& color) {
    RayRecord done = std::move(open_.back());
    open_.pop_back();
    done.color = color;
    if (open_.empty())
      root_ = std::move(done);
    else
      open_.back().children.push_back(std::move(done));
  }
  // How the ray that ended last is counted.
  void counted(const glm::dvec3& c, float falloff) {
    open_.back().children.back().coefficient = glm::vec3(c);
    open_.back().children.back().falloff = falloff;
  }
  void not_sent(const Path& path, const glm::dvec3& c) {
    count_record();
    RayRecord unsent = record(path);
    unsent.sent = false;
    unsent.depth = open_.back().depth + 1;  // it would have been
    unsent.coefficient = glm::vec3(c);
    open_.back().children.push_back(std::move(unsent));
  }

  const RayRecord& root() const { return root_; }

 private:
  void count_record() {
    if (budget_.cancel && *budget_.cancel) throw Interrupted();
    if (budget_.records == 0) throw TooManyRays();
    --budget_.records;
  }
  static RayRecord record(const Path& path) {
    RayRecord out;
    out.kind = path.kind;
    out.origin = path.ray.origin;
    out.direction = path.ray.direction;
    out.depth = path.depth;
    out.path_weight = path.weight;
    return out;
  }

  ExplainBudget& budget_;
  std::vector<RayRecord> open_;  // the rays from the root to the one being traced
  RayRecord root_;
};

}  // namespace sidelight::raytrace
