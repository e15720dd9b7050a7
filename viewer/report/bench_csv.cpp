// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <type_traits>

#include "viewer/report/bench_table.h"
#include "viewer/report/bench_words.h"

namespace sidelight {
namespace {

// RFC 4180, rules 5 to 7.
std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string out = "\"";
  for (const char c : field) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

// One record under construction, each field with the name of its column.
struct Record {
  std::string names, fields;
  bool known = true;  // false: what follows is left empty

  void add(const std::string& name, const std::string& field) {
    const char* comma = names.empty() ? "" : ",";
    names += comma + quoted(name);
    fields += comma + (known ? quoted(field) : "");
  }
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void add(const std::string& name, Number number) { add(name, fmt::format("{}", number)); }
  void add(const std::string& name, const Spread& spread) {
    add(name + "_min", spread.min);
    add(name + "_median", spread.median);
    add(name + "_max", spread.max);
  }
  void add(const std::string& name, const ErrorMeasure& error) {
    const Metrics& m = error.metrics;
    add(name + "_rmse", m.rms);
    add(name + "_max", m.max.value);
    add(name + "_max_x", m.max.x);
    add(name + "_max_y", m.max.y);
    add(name + "_p999", error.p999);
    add(name + "_mean", m.mean);
    add(name + "_relmse", error.relmse);
    add(name + "_psnr", m.psnr ? fmt::format("{}", *m.psnr) : "");
    add(name + "_depth", error.depth);
    add(name + "_non_finite", m.non_finite);
  }
};

Record record(const BenchResult& result, const BenchPoint& point, const std::vector<KnobValue>& knobs) {
  Record out;
  out.add("scene", result.scenes[point.scene].path);
  for (const KnobValue& each : knobs) out.add(each.knob, knob_value(point, each.knob));
  out.add("left_out", point.left_out);
  out.add("finished", int{point.finished});

  out.known = point.finished;
  out.add("valid", int{point.failures.empty()});
  out.add("failures", failure_words(point));
  out.add("on_front", int{point.on_front});
  out.add("mismatches", point.mismatches);

  out.known = point.finished && result.timed;
  out.add("build_ms", point.build_ms);
  out.add("frame_ms", point.frame_ms);
  out.add("frame_cpu_ms", point.cpu_ms);
  out.add("runs", point.runs);
  out.add("build_memory_mb", point.build_memory_mb);
  out.add("frame_memory_mb", point.frame_memory_mb);

  out.known = point.finished;
  out.add("rays", point.rays);
  out.add("fragments", point.fragments);
  out.add("tests", point.tests);
  out.add("tests_per_ray", point.tests_per_ray);
  out.add("nodes_per_ray", point.nodes_per_ray);
  out.add("whole", point.error.whole);
  out.add("covered", point.error.covered);
  for (std::size_t kind = 0; kind < kErrorKinds; ++kind) {
    const std::optional<PictureError>& error = point.by_kind[kind];
    out.add(std::string(kErrorKindNames[kind]) + "_rmse",
            error ? fmt::format("{}", error->whole.metrics.rms) : "");
  }
  return out;
}

}  // namespace

std::string bench_csv(const BenchResult& result) {
  const std::vector<KnobValue> knobs =
      result.points.empty() ? std::vector<KnobValue>() : result.points.front().config;
  BenchResult one_scene;  // a heading is the same for any point
  one_scene.scenes.emplace_back();
  std::string out = record(one_scene, {}, knobs).names + "\r\n";
  for (const BenchPoint& point : result.points) out += record(result, point, knobs).fields + "\r\n";
  return out;
}

}  // namespace sidelight
