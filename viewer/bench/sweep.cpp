// SPDX-License-Identifier: MIT
#include "viewer/bench/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <numeric>

#include "common/clock.h"
#include "common/error.h"
#include "common/parallel.h"
#include "common/scene/toml.h"
#include "viewer/bench/front.h"
#include "viewer/bench/hard_cases.h"
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

// What the process comes to hold more than before while it works, at most. The reset makes the peak what it holds now.
template <class Work>
double memory_of(const Work& work) {
  reset_peak_memory();
  const double before = peak_memory_mb();
  work();
  return peak_memory_mb() - before;
}

// The work on one scene, step by step; what it finds out goes into the result at once, so that none is lost when it is
// interrupted.
class SceneSweep {
 public:
  // `hard_failures`: of each configuration.
  SceneSweep(const SweepPlan& plan, const std::vector<std::string>& hard_failures, BenchResult& result,
             std::size_t index, Scene scene)
      : plan_(plan),
        hard_failures_(hard_failures),
        index_(index),
        scene_(result.scenes[index]),
        points_(result.points.data() + index * plan.configs.size()),
        stage_(std::move(scene), plan.cancel),
        reference_(stage_, plan.cache) {
    for (const Config& config : plan.configs) settings_.push_back(setting_of(config));
  }

  void run() {
    choose();
    make_reference();
    measure_errors();
    if (plan_.timed) measure_times();
  }

 private:
  // Tries out what a frame of each configuration takes, and leaves out the dearest.
  void choose() {
    for (std::size_t c = 0; c < settings_.size(); ++c) {
      steps_.push_back(stage_.trial_steps(settings_[c]));
      chosen_.push_back(c);
    }
    const auto cheaper = [&](std::size_t a, std::size_t b) { return steps_[a] < steps_[b]; };
    double round = std::accumulate(steps_.begin(), steps_.end(), 0.0);
    while (plan_.limited && round > kRoundSteps) {
      std::vector<std::size_t> varied = chosen_;
      std::erase_if(varied, [&](std::size_t c) { return points_[c].varied.empty() || steps_[c] == 0; });
      if (varied.empty()) break;
      const std::size_t dearest = *std::max_element(varied.begin(), varied.end(), cheaper);
      points_[dearest].left_out = fmt::format(
          "too slow for this sweep: a frame takes {:.0f} steps a pixel, of {:.0f} for all configurations",
          steps_[dearest], kRoundSteps);
      std::erase(chosen_, dearest);
      round -= steps_[dearest];
    }
    reference_work_ = std::min(kReferenceSteps, 21 * steps_.front());
    work_ = reference_work_;
    for (const std::size_t c : chosen_) work_ += (2 + (plan_.timed ? plan_.runs : 0)) * work_of(c);
  }

  // For the progress: a frame of the z-buffer, which has no steps, counts as many as the simplest of the ray tracer.
  double work_of(std::size_t c) const {
    constexpr double kLeast = 20;
    return std::max(steps_[c], kLeast * settings_[c].n * settings_[c].n);
  }
  void tell(double work) const {
    const double part = std::min((done_ + work) / work_, 1.0);
    if (plan_.progress)
      plan_.progress((static_cast<double>(index_) + part) / static_cast<double>(plan_.scenes.size()));
  }
  void finish(double work) {
    done_ += work;
    tell(0);
  }

  void make_reference() {
    const double start = wall_ms();
    int finest = 1;
    for (const std::size_t c : chosen_) finest = std::max(finest, settings_[c].n);
    ReferenceImage image =
        reference_.converge(finest, [&](double steps) { tell(std::min(steps, reference_work_)); });
    if (plan_.timed && reference_.made_any()) image.ms = wall_ms() - start;
    image.picture = to_image8(reference_.picture(image.n).color, scene_.width, scene_.height);
    scene_.reference = std::move(image);
    if (reference_.made_any())
      finish(reference_work_);
    else
      work_ -= reference_work_;  // it was there already: no measure of what else takes how long
  }

  void measure_errors() {
    PictureJudge judge(stage_, reference_, scene_.reference.n);
    for (const std::size_t c : chosen_) {
      BenchPoint found = points_[c];
      judge.judge(settings_[c], found);
      if (!hard_failures_[c].empty()) found.failures.push_back(hard_failures_[c]);
      points_[c] = std::move(found);
      points_[c].finished = !plan_.timed;
      finish(2 * work_of(c));  // itself, and once more in double
    }
  }

  void measure_times() {
    std::map<Stage::BuildKey, Build> builds;
    std::vector<Times> frames(settings_.size());
    for (int run = 0; run < plan_.runs; ++run) {
      build_round(builds);
      for (const std::size_t c : chosen_) {
        BenchPoint& point = points_[c];
        const auto frame = [&] { frames[c].add([&] { stage_.render(settings_[c], false); }); };
        if (run == 0)
          point.frame_memory_mb = memory_of(frame);
        else
          frame();
        const Build& build = builds[Stage::build_key(settings_[c])];
        point.build_memory_mb = build.memory_mb;
        point.build_ms = spread_of(build.times.wall);
        point.build_cpu_ms = spread_of(build.times.cpu);
        point.frame_ms = spread_of(frames[c].wall);
        point.cpu_ms = spread_of(frames[c].cpu);
        point.runs = frames[c].wall.size();
        point.finished = true;
        finish(work_of(c));
      }
    }
  }

  struct Build {
    Times times;
    double memory_mb = 0;
  };
  // Each thing to prepare once more. The very first time was while the errors were measured.
  void build_round(std::map<Stage::BuildKey, Build>& builds) {
    const std::size_t round = builds.empty() ? 1 : builds.begin()->second.times.wall.size() + 1;
    for (const std::size_t c : chosen_) {
      Build& build = builds[Stage::build_key(settings_[c])];
      if (build.times.wall.size() == round) continue;
      const auto again = [&] { build.times.add([&] { stage_.build_again(settings_[c]); }); };
      if (round == 1)
        build.memory_mb = memory_of(again);
      else
        again();
    }
  }

  const SweepPlan& plan_;
  const std::vector<std::string>& hard_failures_;
  std::size_t index_;
  BenchScene& scene_;
  BenchPoint* points_;  // of this scene, one a configuration
  Stage stage_;
  Reference reference_;
  std::vector<Setting> settings_;
  std::vector<double> steps_;                        // a pixel of each, tried out
  std::vector<std::size_t> chosen_;                  // indices of those that are not left out
  double work_ = 0, done_ = 0, reference_work_ = 0;  // in steps a pixel
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
    HardCases hard(plan.cancel);
    std::vector<std::string> hard_failures;
    for (const Config& config : plan.configs) hard_failures.push_back(hard.failures(setting_of(config)));
    for (std::size_t index = 0; index < scenes.size(); ++index)
      SceneSweep(plan, hard_failures, result, index, std::move(scenes[index])).run();
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
