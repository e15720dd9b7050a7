// SPDX-License-Identifier: MIT
#include "viewer/report/bench_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "common/error.h"
#include "common/utf8.h"
#include "viewer/report/bench_words.h"

namespace sidelight {
namespace {

// ---- For a terminal ----

constexpr std::size_t kLongestName = 40;
constexpr std::size_t kTextWidth = 100;  // of a paragraph

using Row = std::vector<std::string>;

// Columns as wide as their widest cell, two blanks between: those named in `text` flush left, numbers flush right.
std::string aligned(const std::vector<Row>& rows, const std::vector<std::size_t>& text) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], utf8_count(row[c]));
  std::string out;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string blanks(widths[c] - utf8_count(row[c]), ' ');
      const bool left = std::find(text.begin(), text.end(), c) != text.end();
      line += "  " + (left ? row[c] + blanks : blanks + row[c]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

// Broken between words, every line behind two blanks.
std::string paragraph(const std::string& text) {
  std::string out, line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (!line.empty() && line.size() + 1 + word.size() > kTextWidth) {
      out += "  " + line + "\n";
      line.clear();
    }
    if (!word.empty()) line += (line.empty() ? "" : " ") + word;
    at = end + 1;
  }
  return line.empty() ? out : out + "  " + line + "\n";
}

std::string state(const BenchPoint& point) {
  if (!point.failures.empty()) return "fails: " + printable(failure_words(point));
  return point.on_front ? "front" : "";
}

std::string points_table(const BenchResult& result, std::size_t scene) {
  const std::vector<std::size_t> order = finished_points(result, scene);
  if (order.empty()) return "  No configuration was finished.\n";
  const std::vector<std::string> timed_columns{"frame ms (min-max)", "as fast as"};
  Row head{"#", "configuration"};
  if (result.timed) head.insert(head.end(), timed_columns.begin(), timed_columns.end());
  for (const char* column : {"RMSE", "max", "mismatches", ""}) head.emplace_back(column);
  std::vector<Row> rows{head};
  for (std::size_t k = 0; k < order.size(); ++k) {
    const BenchPoint& point = result.points[order[k]];
    Row row{std::to_string(k + 1), printable(config_name(point), kLongestName)};
    if (result.timed) {
      row.push_back(spread_words(point.frame_ms));
      row.push_back(same_time_as(result, order, k));
    }
    const Metrics& metrics = point.error.whole.metrics;
    row.insert(row.end(), {error_words(metrics.rms), error_words(metrics.max.value),
                           std::to_string(point.mismatches), state(point)});
    rows.push_back(row);
  }
  return aligned(rows, {1, head.size() - 1});
}

std::string facts(const std::vector<Fact>& all) {
  if (all.empty()) return {};
  std::vector<Row> rows;
  for (const Fact& fact : all) rows.push_back({fact.name, printable(fact.value)});
  return "\n" + aligned(rows, {0, 1});
}

std::string scene_text(const BenchResult& result, std::size_t index) {
  const BenchScene& scene = result.scenes[index];
  std::string out = fmt::format("{} ({}x{})\n", printable(scene_name(scene)), scene.width, scene.height);
  out += "\n" + points_table(result, index);
  for (const std::size_t i : unfinished_points(result, index)) {
    const BenchPoint& point = result.points[i];
    const std::string name = printable(config_name(point), kLongestName);
    out += point.left_out.empty() ? fmt::format("  unfinished: {}\n", name)
                                  : fmt::format("  left out: {}, {}\n", name, printable(point.left_out));
  }
  if (result.timed)
    out +=
        "\n" + paragraph(
                   "as fast as: the numbers of the configurations whose range of times overlaps this one's; "
                   "they do not differ in time.");
  out += "\n" + paragraph("Reference image: " + reference_words(scene.reference));
  return out + facts(summary_facts(result, index));
}

// ---- For other programs ----

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

std::string bench_table(const BenchResult& result) {
  std::string out;
  for (const std::size_t scene : scenes_worst_first(result))
    out += (out.empty() ? "" : "\n") + scene_text(result, scene);
  if (const std::vector<Fact> all = facts_over_scenes(result); !all.empty())
    out += "\nOver " + std::to_string(result.scenes.size()) + " scenes, geometric means of ratios\n" +
           facts(all);
  if (result.scenes.empty()) out += "No scene was measured.\n";
  if (result.interrupted) out += "\nInterrupted: only what is shown was finished.\n";
  return out;
}

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
