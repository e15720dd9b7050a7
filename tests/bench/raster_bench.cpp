// SPDX-License-Identifier: MIT
// The z-buffer against Mesa's llvmpipe (llvmpipe.h): the same triangles, lamps and eyes, frame by frame in turn, and
// both pictures before the judge of 128-bit integers. A table on standard output; times are of one finished frame.
//
// What differs: llvmpipe writes 8-bit colours, 4 bytes a pixel, and keeps its float depth; sidelight writes float
// colours, 12 bytes, into memory that it allocates anew for each frame. Reading pixels back is not timed.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/picture/atomic_file.h"
#include "tests/bench/program.h"
#include "tests/bench/raster_race.h"
#include "tests/bench/scenes.h"
#include "tests/bench/worker.h"
#include "viewer/commands/result_json.h"
#include "viewer/report/bench_words.h"

using namespace sidelight;
using namespace sidelight::bench;

namespace {

using Json = nlohmann::ordered_json;
using Lines = std::vector<std::vector<std::string>>;

// The bars of speed hold on one core at this size, that of scaling where a frame takes this long.
constexpr Size kBarSize{1280, 720};
constexpr double kScalingBar = 1.7, kScalingFrom_ms = 20;

struct Flags {
  std::string scenes, sizes = "640x480,1280x720,1920x1080", mesh, json;
  std::vector<int> threads{1};
  int frames = 31;
  bool no_judge = false;
};

struct Result {
  Entry entry;
  RasterRace race;
};

double ratio(const RasterRow& row) { return times_faster(row.llvmpipe, row.sidelight, row.threads); }
double bar(const Entry& entry, const RasterRow& row) {
  return row.threads == 1 && row.size == kBarSize ? entry.least : 0;
}

void add_times(Lines& lines, const Result& result) {
  for (const RasterRow& row : result.race.rows)
    lines.push_back({result.entry.name, std::to_string(result.race.triangles), row.size.text(),
                     std::to_string(row.threads), spread_words(row.llvmpipe.cpu),
                     spread_words(row.sidelight.cpu), spread_words(row.llvmpipe.wall),
                     spread_words(row.sidelight.wall), times_words(ratio(row)),
                     verdict_words(ratio(row), bar(result.entry, row)),
                     bar(result.entry, row) > 0 ? fmt::format("{}", result.entry.aim) : "-"});
}

// Of each size, from the row of one core to each with more.
template <class Visit>
void for_each_scaling(const RasterRace& race, const Visit& visit) {
  const RasterRow* one = nullptr;
  for (const RasterRow& row : race.rows) {
    if (row.threads == 1)
      one = &row;
    else if (one && one->size == row.size)
      visit(*one, row);
  }
}
double scaling_bar(const RasterRow& one, const RasterRow& more) {
  return more.threads == 2 && one.sidelight.wall.median >= kScalingFrom_ms ? kScalingBar : 0;
}

void add_scaling(Lines& lines, const Result& result) {
  for_each_scaling(result.race, [&](const RasterRow& one, const RasterRow& more) {
    const double own = one.sidelight.wall.median / more.sidelight.wall.median;
    lines.push_back({result.entry.name, more.size.text(), std::to_string(more.threads),
                     times_words(one.llvmpipe.wall.median / more.llvmpipe.wall.median), times_words(own),
                     times_words(one.sidelight.wall.min / more.sidelight.wall.min),
                     verdict_words(own, scaling_bar(one, more))});
  });
}

void add_verdicts(Lines& lines, const Result& result) {
  for (const RasterVerdict& v : result.race.verdicts)
    lines.push_back({result.entry.name, v.size.text(), std::to_string(v.covered),
                     std::to_string(v.llvmpipe.wrong), std::to_string(v.sidelight.wrong),
                     fmt::format("{:.1e}", v.llvmpipe.depth_rms),
                     fmt::format("{:.1e}", v.sidelight.depth_rms), std::to_string(v.colors_apart)});
}

void print(const std::vector<Result>& results, double load) {
  Lines times{{"scene", "triangles", "size", "cores", "llvmpipe CPU ms", "sidelight CPU ms",
               "llvmpipe wall ms", "sidelight wall ms", "times faster", "reached", "aim"}};
  Lines scaling{{"scene", "size", "cores", "llvmpipe", "sidelight", "least times", "reached"}};
  Lines verdicts{{"scene", "size", "covered", "llvmpipe wrong", "sidelight wrong", "llvmpipe depth rms",
                  "sidelight depth rms", "colours apart"}};
  for (const Result& result : results) {
    add_times(times, result);
    add_scaling(scaling, result);
    add_verdicts(verdicts, result);
  }
  fmt::print("{}, load {:.1f} before and {:.1f} after.\n", machine_name(), load, machine_load());
  fmt::print(
      "\nMilliseconds a frame: median (least-greatest). Times faster: CPU time on one core, else wall "
      "time.\n\n{}",
      table(times));
  if (scaling.size() > 1) fmt::print("\nTimes faster than on one core, by wall time.\n\n{}", table(scaling));
  if (verdicts.size() > 1) fmt::print("\nPixels against exact visibility.\n\n{}", table(verdicts));
}

Json json_of(const Judgement& judgement) {
  return {{"wrong_pixels", judgement.wrong}, {"depth_rms", judgement.depth_rms}};
}

Json json_of(const Result& result) {
  Json json{{"scene", result.entry.name},
            {"triangles", result.race.triangles},
            {"rows", Json::array()},
            {"scaling", Json::array()},
            {"pixels", Json::array()}};
  for (const RasterRow& row : result.race.rows) {
    const auto side = [](const Spread& cpu, const Spread& wall) {
      return Json{{"cpu_ms", spread_json(cpu)}, {"wall_ms", spread_json(wall)}};
    };
    Json entry{{"size", row.size.text()},
               {"threads", row.threads},
               {"llvmpipe", side(row.llvmpipe.cpu, row.llvmpipe.wall)},
               {"sidelight", side(row.sidelight.cpu, row.sidelight.wall)},
               {"times_faster", ratio(row)}};
    const double least = bar(result.entry, row);
    if (least > 0)
      entry.update({{"least", least}, {"aim", result.entry.aim}, {"reached", ratio(row) >= least}});
    json["rows"].push_back(entry);
  }
  for_each_scaling(result.race, [&](const RasterRow& one, const RasterRow& more) {
    json["scaling"].push_back({{"size", more.size.text()},
                               {"threads", more.threads},
                               {"llvmpipe", one.llvmpipe.wall.median / more.llvmpipe.wall.median},
                               {"sidelight", one.sidelight.wall.median / more.sidelight.wall.median}});
  });
  for (const RasterVerdict& v : result.race.verdicts)
    json["pixels"].push_back({{"size", v.size.text()},
                              {"covered", v.covered},
                              {"llvmpipe", json_of(v.llvmpipe)},
                              {"sidelight", json_of(v.sidelight)},
                              {"colors_apart", v.colors_apart}});
  return json;
}

void run(const Flags& flags) {
  RasterPlan plan;
  plan.sizes = parse_sizes(flags.sizes);
  plan.threads = flags.threads;
  plan.frames = flags.frames;
  plan.judged = !flags.no_judge;
  const double load = machine_load();
  std::vector<Result> results;
  const auto entries = raster_entries(flags.mesh.empty() ? std::nullopt : std::optional(flags.mesh));
  for (const Entry& entry : chosen(entries, flags.scenes)) {
    fmt::print(stderr, "{} ...\n", entry.name);
    results.push_back({entry, race(entry.make(), plan)});
  }
  print(results, load);
  if (flags.json.empty()) return;
  Json json{{"machine", machine_name()},
            {"load", {load, machine_load()}},
            {"frames", plan.frames},
            {"scenes", Json::array()}};
  for (const Result& result : results) json["scenes"].push_back(json_of(result));
  write_text_file(flags.json, json.dump(2) + '\n');
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  if (cores() > 1) flags.threads.push_back(cores());
  CLI::App app("Races sidelight's z-buffer against Mesa's llvmpipe on the same frames.", "raster_bench");
  app.add_option("--scenes", flags.scenes, "names separated by commas; all without it");
  app.add_option("--sizes", flags.sizes, "WxH,WxH,...")->capture_default_str();
  app.add_option("--threads", flags.threads,
                 "how many threads, each number its own row, pinned to as many cores")
      ->delimiter(',')
      ->check(CLI::Range(1, cores()))
      ->capture_default_str();
  app.add_option("--frames", flags.frames, "timed frames a row")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--mesh", flags.mesh, "an OBJ file in place of the made meshes");
  app.add_option("--json", flags.json, "write the same numbers to this file");
  app.add_flag("--no-judge", flags.no_judge, "do not look for wrong pixels");
  CLI11_PARSE(app, argc, argv);
  return guarded("raster_bench", [&] { run(flags); });
}
