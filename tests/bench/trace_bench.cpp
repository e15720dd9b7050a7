// SPDX-License-Identifier: MIT
// The tracer against Embree 3 (embree_tracer.h) and, on request, POV-Ray: the same scenes, lamps and eyes, in turn. A
// table on standard output; times are of one build or one finished frame.
//
// What differs: Embree decides and shades in single precision, and its eye rays and shadow rays are shaded by an angle
// alone; sidelight finds exact hits, and shades every task with its full model.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/picture/atomic_file.h"
#include "tests/bench/povray_time.h"
#include "tests/bench/program.h"
#include "tests/bench/trace_race.h"
#include "tests/bench/worker.h"
#include "viewer/commands/result_json.h"
#include "viewer/report/bench_words.h"

using namespace sidelight;
using namespace sidelight::bench;

namespace {

using Json = nlohmann::ordered_json;
using Lines = std::vector<std::vector<std::string>>;

// Times as fast as Embree on one core: building, eye rays with shadow rays, the mean of whole frames; as POV-Ray; and
// on two cores as on one, where a frame takes this long.
constexpr double kBuildBar = 1 / 0.75, kShadowBar = 1, kMeanBar = 2, kMeanAim = 2.5, kPovrayBar = 5;
constexpr double kScalingBar = 1.85, kScalingFrom_ms = 150;

struct Flags {
  std::string scenes, size = "800x600", mesh, json;
  std::vector<int> threads{1};
  int frames = 31, builds = 9;
  bool povray = false;
};

struct Result {
  TraceEntry entry;
  TraceRace race;
  std::optional<double> povray_s;
};

const CostSpread& peer(const TraceRow& row) { return row.has_packets() ? row.packets : row.single; }
double ratio(const TraceRow& row) { return times_faster(peer(row), row.sidelight, row.threads); }

double bar(const TraceEntry& entry, const TraceRow& row) {
  if (row.threads != 1) return 0;
  switch (row.task) {
    case Task::build:
      return kBuildBar;
    case Task::eye:
      return entry.eye_least;
    case Task::eye_and_shadow:
      return kShadowBar;
    case Task::whole:
      return entry.least;
  }
  return 0;
}

std::string task_name(const TraceRow& row) {
  return std::string(kTaskNames[static_cast<std::size_t>(row.task)]);
}

// By processor time on one core, else by the clock, as the ratio is.
std::string time_of(const CostSpread& cost, int threads) {
  return spread_words(threads == 1 ? cost.cpu : cost.wall);
}

// Million queries a second of the task, from the median.
std::string rate_of(const std::array<std::uint64_t, 3>& rays, const CostSpread& cost, const TraceRow& row) {
  if (row.task == Task::build) return "-";
  const double ms = row.threads == 1 ? cost.cpu.median : cost.wall.median;
  return fmt::format("{:.1f}", static_cast<double>(rays[static_cast<std::size_t>(row.task) - 1]) / ms / 1000);
}

void add_times(Lines& lines, const Result& result) {
  const TraceVerdict& verdict = result.race.verdict;
  for (const TraceRow& row : result.race.rows)
    lines.push_back(
        {result.entry.name, task_name(row), std::to_string(row.threads), time_of(row.single, row.threads),
         row.has_packets() ? time_of(row.packets, row.threads) : "-", time_of(row.sidelight, row.threads),
         rate_of(verdict.embree_rays, peer(row), row), rate_of(verdict.sidelight_rays, row.sidelight, row),
         times_words(ratio(row)), verdict_words(ratio(row), bar(result.entry, row))});
}

// From a task on one core to the same on each number of more.
template <class Visit>
void for_each_scaling(const TraceRace& race, const Visit& visit) {
  for (const TraceRow& one : race.rows)
    for (const TraceRow& more : race.rows)
      if (one.threads == 1 && more.threads > 1 && more.task == one.task)
        visit(more, one.single.wall.median / more.single.wall.median,
              one.sidelight.wall.median / more.sidelight.wall.median,
              more.threads == 2 && one.task != Task::build && one.sidelight.wall.median >= kScalingFrom_ms
                  ? kScalingBar
                  : 0);
}

void add_scaling(Lines& lines, const Result& result) {
  for_each_scaling(result.race, [&](const TraceRow& row, double theirs, double ours, double least) {
    lines.push_back({result.entry.name, task_name(row), std::to_string(row.threads), times_words(theirs),
                     times_words(ours), verdict_words(ours, least)});
  });
}

const TraceRow* whole_on_one_core(const TraceRace& race) {
  for (const TraceRow& row : race.rows)
    if (row.task == Task::whole && row.threads == 1) return &row;
  return nullptr;
}

// POV-Ray's time over ours; empty without either.
std::optional<double> povray_ratio(const Result& result) {
  const TraceRow* whole = whole_on_one_core(result.race);
  if (!result.povray_s || !whole) return {};
  return 1000 * *result.povray_s / whole->sidelight.cpu.median;
}

// Of whole frames on one core over the scenes that count; empty where none was run.
std::optional<double> mean_ratio(const std::vector<Result>& results) {
  double sum = 0;
  int count = 0;
  for (const Result& result : results)
    if (const TraceRow* whole = whole_on_one_core(result.race); whole && result.entry.in_mean) {
      sum += std::log(ratio(*whole));
      ++count;
    }
  if (count == 0) return {};
  return std::exp(sum / count);
}

void add_verdict(Lines& lines, const Result& result) {
  const TraceVerdict& v = result.race.verdict;
  const auto leaked = [&](std::uint64_t count) { return v.leaks.rays == 0 ? "-" : std::to_string(count); };
  const std::optional<double> povray = povray_ratio(result);
  lines.push_back({result.entry.name, std::to_string(result.race.triangles),
                   std::to_string(result.race.spheres), std::to_string(v.embree_rays[2]),
                   std::to_string(v.sidelight_rays[2]), std::to_string(v.different), leaked(v.leaks.rays),
                   leaked(v.leaks.single), leaked(v.leaks.packets), leaked(v.leaks.sidelight),
                   result.povray_s ? fmt::format("{:.2f}", *result.povray_s) : "-",
                   povray ? times_words(*povray) + " " + verdict_words(*povray, kPovrayBar) : "-"});
}

void print(const std::vector<Result>& results, double load) {
  Lines times{{"scene", "task", "cores", "Embree ms", "in packets", "sidelight ms", "Embree Mrays/s",
               "sidelight Mrays/s", "times faster", "reached"}};
  Lines scaling{{"scene", "task", "cores", "Embree", "sidelight", "reached"}};
  Lines verdicts{{"scene", "triangles", "spheres", "Embree rays", "sidelight rays", "pixels apart",
                  "edge rays", "Embree leaks", "in packets", "sidelight leaks", "POV-Ray s", "times faster"}};
  for (const Result& result : results) {
    add_times(times, result);
    add_scaling(scaling, result);
    add_verdict(verdicts, result);
  }
  fmt::print("{}, load {:.1f} before and {:.1f} after.\n", machine_name(), load, machine_load());
  fmt::print(
      "\nMilliseconds: median (least-greatest), CPU time on one core, else wall time. Times faster than "
      "Embree's\n"
      "packets where it has them.\n\n{}",
      table(times));
  if (const auto mean = mean_ratio(results))
    fmt::print("\nWhole frames on one core, geometric mean: {} times faster, reached {}, aim {}.\n",
               times_words(*mean), verdict_words(*mean, kMeanBar), kMeanAim);
  if (scaling.size() > 1) fmt::print("\nTimes faster than on one core, by wall time.\n\n{}", table(scaling));
  fmt::print("\nThe whole frame: queries, pixels apart, and rays along edges that leave a closed mesh.\n\n{}",
             table(verdicts));
}

Json json_of(const CostSpread& cost) {
  return {{"cpu_ms", spread_json(cost.cpu)}, {"wall_ms", spread_json(cost.wall)}};
}

Json json_of(const TraceEntry& entry, const TraceRow& row) {
  Json json{{"task", task_name(row)}, {"threads", row.threads}, {"embree", json_of(row.single)}};
  if (row.has_packets()) json["embree_packets"] = json_of(row.packets);
  json.update({{"sidelight", json_of(row.sidelight)}, {"times_faster", ratio(row)}});
  if (const double least = bar(entry, row); least > 0)
    json.update({{"least", least}, {"reached", ratio(row) >= least}});
  return json;
}

Json json_of(const Result& result) {
  const TraceVerdict& v = result.race.verdict;
  Json json{{"scene", result.entry.name},         {"triangles", result.race.triangles},
            {"spheres", result.race.spheres},     {"rows", Json::array()},
            {"scaling", Json::array()},           {"embree_rays", v.embree_rays},
            {"sidelight_rays", v.sidelight_rays}, {"pixels_apart", v.different}};
  for (const TraceRow& row : result.race.rows) json["rows"].push_back(json_of(result.entry, row));
  for_each_scaling(result.race, [&](const TraceRow& row, double theirs, double ours, double least) {
    Json entry{{"task", task_name(row)}, {"threads", row.threads}, {"embree", theirs}, {"sidelight", ours}};
    if (least > 0) entry.update({{"least", least}, {"reached", ours >= least}});
    json["scaling"].push_back(entry);
  });
  json["leaks"] = v.leaks.rays == 0 ? Json(nullptr)
                                    : Json{{"rays", v.leaks.rays},
                                           {"embree", v.leaks.single},
                                           {"embree_packets", v.leaks.packets},
                                           {"sidelight", v.leaks.sidelight}};
  json["povray_s"] = result.povray_s ? Json(*result.povray_s) : Json(nullptr);
  return json;
}

void run(const Flags& flags) {
  TracePlan plan;
  const std::vector<Size> sizes = parse_sizes(flags.size);
  if (sizes.size() != 1) throw UsageError("--size wants one WxH");
  plan.size = sizes[0];
  plan.threads = flags.threads;
  plan.frames = flags.frames;
  plan.builds = flags.builds;
  const double load = machine_load();
  std::vector<Result> results;
  const auto entries = trace_entries(flags.mesh.empty() ? std::nullopt : std::optional(flags.mesh));
  for (const TraceEntry& entry : chosen(entries, flags.scenes)) {
    fmt::print(stderr, "{} ...\n", entry.name);
    Scene scene = entry.make();
    scene.width = plan.size.width;
    scene.height = plan.size.height;
    results.push_back({entry, race(entry, scene, plan), flags.povray ? povray_seconds(scene) : std::nullopt});
  }
  print(results, load);
  if (flags.json.empty()) return;
  const auto mean = mean_ratio(results);
  Json json{{"machine", machine_name()},
            {"load", {load, machine_load()}},
            {"size", plan.size.text()},
            {"frames", plan.frames},
            {"mean_times_faster", mean ? Json(*mean) : Json(nullptr)},
            {"scenes", Json::array()}};
  for (const Result& result : results) json["scenes"].push_back(json_of(result));
  write_text_file(flags.json, json.dump(2) + '\n');
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  if (cores() > 1) flags.threads.push_back(cores());
  CLI::App app("Races sidelight's ray tracer against Embree on the same rays.", "trace_bench");
  app.add_option("--scenes", flags.scenes, "names separated by commas; all without it");
  app.add_option("--size", flags.size, "WxH")->capture_default_str();
  app.add_option("--threads", flags.threads,
                 "how many threads, each number its own row, pinned to as many cores")
      ->delimiter(',')
      ->check(CLI::Range(1, cores()))
      ->capture_default_str();
  app.add_option("--frames", flags.frames, "timed frames a row")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--builds", flags.builds, "timed builds a row")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--mesh", flags.mesh, "an OBJ file in place of the made meshes");
  app.add_option("--json", flags.json, "write the same numbers to this file");
  app.add_flag("--povray", flags.povray, "time POV-Ray too, where it is installed");
  CLI11_PARSE(app, argc, argv);
  return guarded("trace_bench", [&] { run(flags); });
}
