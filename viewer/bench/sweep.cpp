// SPDX-License-Identifier: MIT
#include "viewer/bench/sweep.h"

#include <fmt/format.h>

#include <fstream>
#include <map>

#include "common/clock.h"
#include "common/error.h"
#include "common/parallel.h"
#include "common/scene/toml.h"
#include "viewer/bench/front.h"
#include "viewer/bench/judge_picture.h"

namespace sidelight {
namespace {

// How often a scene is loaded for its time: that is the disk's and the reader's, and more of it teaches nothing.
constexpr int kLoads = 7;

// Wall and processor time of some runs of one thing.
struct Times {
  std::vector<double> wall, cpu;

  template <class Work>
  void add(const Work& work) {
    const double wall_start = wall_ms(), cpu_start = cpu_ms();
    work();
    wall.push_back(wall_ms() - wall_start);
    cpu.push_back(cpu_ms() - cpu_start);
  }
};

// The work on one scene, step by step; what it finds out goes into the result at once, so that none is lost when it is
// interrupted.
class SceneSweep {
 public:
  SceneSweep(const SweepPlan& plan, BenchResult& result, std::size_t index, Scene scene)
      : plan_(plan),
        scene_(result.scenes[index]),
        points_(result.points.data() + index * plan.configs.size()),
        stage_(std::move(scene), plan.cancel),
        reference_(stage_, plan.cache) {
    for (const Config& config : plan.configs) settings_.push_back(setting_of(config));
  }

  void run() {
    make_reference();
    measure_errors();
    if (plan_.timed) measure_times();
  }

 private:
  void tell(const std::string& what, std::size_t done, std::size_t all) const {
    if (plan_.progress)
      plan_.progress(fmt::format("{}: {}", printable(scene_.title, 40), what),
                     static_cast<double>(done) / static_cast<double>(all));
  }

  void make_reference() {
    const double start = wall_ms();
    ReferenceImage image =
        reference_.converge([&](int n) { tell(fmt::format("reference, {}x{} samples", n, n), 0, 1); });
    if (plan_.timed && reference_.made_any()) image.ms = wall_ms() - start;
    image.picture = to_image8(reference_.picture(image.n).color, scene_.width, scene_.height);
    scene_.reference = std::move(image);
  }

  void measure_errors() {
    PictureJudge judge(stage_, reference_, scene_.reference.n);
    for (std::size_t c = 0; c < settings_.size(); ++c) {
      tell("errors", c, settings_.size());
      BenchPoint found = points_[c];
      judge.judge(settings_[c], found);
      points_[c] = std::move(found);
      points_[c].finished = !plan_.timed;
    }
  }

  void measure_times() {
    std::map<Stage::BuildKey, Times> builds;
    std::vector<Times> frames(settings_.size());
    const std::size_t all = static_cast<std::size_t>(plan_.runs) * settings_.size();
    for (int run = 0; run < plan_.runs; ++run) {
      build_round(builds);
      for (std::size_t c = 0; c < settings_.size(); ++c) {
        tell("times", static_cast<std::size_t>(run) * settings_.size() + c, all);
        if (run == 0) reset_peak_memory();
        frames[c].add([&] { stage_.render(settings_[c], false); });
        BenchPoint& point = points_[c];
        if (run == 0) point.peak_memory_mb = peak_memory_mb();
        const Times& build = builds[Stage::build_key(settings_[c])];
        point.build_ms = spread_of(build.wall);
        point.build_cpu_ms = spread_of(build.cpu);
        point.frame_ms = spread_of(frames[c].wall);
        point.cpu_ms = spread_of(frames[c].cpu);
        point.runs = frames[c].wall.size();
        point.finished = true;
      }
    }
  }

  // Each thing to prepare once more. The very first time was while the errors were measured.
  void build_round(std::map<Stage::BuildKey, Times>& builds) {
    const std::size_t round = builds.empty() ? 1 : builds.begin()->second.wall.size() + 1;
    for (const Setting& setting : settings_) {
      Times& times = builds[Stage::build_key(setting)];
      if (times.wall.size() < round) times.add([&] { stage_.build_again(setting); });
    }
  }

  const SweepPlan& plan_;
  BenchScene& scene_;
  BenchPoint* points_;  // of this scene, one a configuration
  Stage stage_;
  Reference reference_;
  std::vector<Setting> settings_;
};

Scene load(const SweepPlan& plan, const std::string& path, BenchScene& out) {
  Scene scene = load_scene(path);  // the warm-up
  Times times;
  for (int run = 0; run < kLoads && plan.timed; ++run) times.add([&] { scene = load_scene(path); });
  if (plan.size) {
    scene.width = plan.size->x;
    scene.height = plan.size->y;
  }
  if (plan.loaded) plan.loaded(scene);
  out.path = path;
  out.title = scene.title.empty() ? path : scene.title;
  out.hash = scene.hash;
  out.width = scene.width;
  out.height = scene.height;
  out.triangles = scene.triangles.size();
  out.spheres = scene.spheres.size();
  out.planes = scene.planes.size();
  out.load_ms = spread_of(times.wall);
  out.load_cpu_ms = spread_of(times.cpu);
  return scene;
}

}  // namespace

BenchResult run_sweep(const SweepPlan& plan) {
  BenchResult result;
  result.version = SIDELIGHT_VERSION;
  result.machine = machine_name();
  result.timed = plan.timed;
  result.configs = plan.configs.size();
  std::vector<Scene> scenes;
  for (std::size_t index = 0; index < plan.scenes.size(); ++index) {
    scenes.push_back(load(plan, plan.scenes[index], result.scenes.emplace_back()));
    for (const Config& config : plan.configs) {
      BenchPoint& point = result.points.emplace_back();
      point.scene = index;
      point.config = config;
      point.varied = varied_knobs(config);
    }
  }
  try {
    for (std::size_t index = 0; index < scenes.size(); ++index)
      SceneSweep(plan, result, index, std::move(scenes[index])).run();
  } catch (const Interrupted&) {
    result.interrupted = true;
  }
  return result;
}

std::string machine_name() {
  std::string processor = "unknown processor";
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) {
      processor = line.substr(std::min(line.find(':') + 2, line.size()));
      break;
    }
  return fmt::format("{}, {} cores, {}", printable(processor), thread_count(0), isa_name(best_isa()));
}

}  // namespace sidelight
