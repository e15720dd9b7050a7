// SPDX-License-Identifier: MIT
#include "tests/bench/trace_race.h"

#include <algorithm>
#include <glm/common.hpp>
#include <memory>

#include "raytrace/raytrace.h"
#include "tests/bench/embree_tracer.h"
#include "tests/bench/worker.h"

namespace sidelight::bench {
namespace {

struct Question {
  enum class Kind { task, verdict } kind = Kind::task;
  Task task = Task::build;
  int frame = 0;
};
struct Answer {
  Cost single, packets, sidelight;
  TraceVerdict verdict;
};

RayKind ray_kind(Task task) {
  if (task == Task::eye) return RayKind::eye;
  return task == Task::eye_and_shadow ? RayKind::eye_and_shadow : RayKind::whole;
}

// The scene with only those rays.
Scene scene_for(Scene scene, Task task) {
  if (task == Task::eye) scene.trace.shadows = false;
  if (task == Task::eye || task == Task::eye_and_shadow)
    scene.trace.reflection = scene.trace.refraction = false;
  return scene;
}

// One row of pixels, a camera at `from`, whose rays run along the edge from a to b, both ends included.
Camera along_edge(const glm::dvec3& from, const glm::dvec3& a, const glm::dvec3& b) {
  Camera camera;
  camera.eye = from;
  camera.width = 64;
  camera.height = 1;
  camera.forward = (a + b) / 2.0 - from;
  camera.right = (b - a) / static_cast<double>(camera.width - 1);
  // Of one row of pixels no ray has anything of it; but the rays of a camera span space.
  camera.up = glm::length(camera.right) * glm::normalize(glm::cross(camera.right, camera.forward));
  return camera;
}

// Both sides in one process.
class Pair {
 public:
  Pair(const TraceEntry& entry, const Scene& scene, Size size, int threads)
      : entry_(entry), scene_(scene), size_(size), threads_(threads), embree_(scene, threads) {
    embree_.build();
  }

  Answer answer(const Question& question) {
    if (question.kind == Question::Kind::verdict) return verdict();
    if (question.task == Task::build) return timed_build();
    prepare(question.task);
    return timed_frame(question.task, camera(question.frame), question.frame);
  }

 private:
  Camera camera(int frame) const {
    return make_camera(moved_eye(scene_, frame), size_.width, size_.height, 1);
  }

  // The task's scene with its hierarchy; only one is kept.
  void prepare(Task task) {
    if (prepared_ && prepared_for_ == task) return;
    prepared_.reset();
    task_scene_ = scene_for(scene_, task);
    prepared_ = raytrace::prepare(task_scene_, threads_);
    prepared_for_ = task;
  }

  Frame traced(const Camera& camera, LayerMask layers = 0) const {
    RenderOptions options;
    options.threads = threads_;
    options.layers = layers;
    return raytrace::render(*prepared_, camera, options);
  }

  Answer timed_build() {
    Answer answer;
    answer.single = cost_of([&] { embree_.build(); });
    std::shared_ptr<const raytrace::Prepared>
        built;  // outlives its timing: tearing down is no part of building
    answer.sidelight = cost_of([&] { built = raytrace::prepare(scene_, threads_); });
    return answer;
  }

  // Sidelight goes first in every other frame.
  Answer timed_frame(Task task, const Camera& camera, int frame) {
    Answer answer;
    const auto own = [&] { answer.sidelight = cost_of([&] { traced(camera); }); };
    if (frame % 2 == 0) own();
    answer.single = cost_of([&] { embree_.draw(camera, ray_kind(task), false); });
    if (task != Task::whole) answer.packets = cost_of([&] { embree_.draw(camera, ray_kind(task), true); });
    if (frame % 2 != 0) own();
    return answer;
  }

  Answer verdict() {
    Answer answer;
    std::size_t i = 0;
    for (const Task task : {Task::eye, Task::eye_and_shadow, Task::whole}) {
      prepare(task);
      const EmbreePicture theirs = embree_.draw(camera(0), ray_kind(task), false);
      const Frame ours = traced(camera(0));
      answer.verdict.embree_rays[i] = theirs.rays;
      answer.verdict.sidelight_rays[i++] = ours.stats.rays.total();
      if (task == Task::whole) answer.verdict.different = different(theirs, ours);
    }
    if (entry_.inside) answer.verdict.leaks = leaks(*entry_.inside);
    return answer;
  }

  static std::uint64_t different(const EmbreePicture& theirs, const Frame& ours) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < ours.pixels(); ++i) {
      const glm::vec3 apart = abs(clamp(ours.color[i], 0.0f, 1.0f) - clamp(theirs.color[i], 0.0f, 1.0f));
      count += std::max({apart.x, apart.y, apart.z}) > 2.0f / 255;
    }
    return count;
  }

  // Along edges all over the first object.
  Leaks leaks(const glm::dvec3& inside) const {
    constexpr std::uint32_t kEdges = 2000;
    Leaks found;
    const std::uint32_t triangles = scene_.objects[0].count;
    for (std::uint32_t i = 0; i < std::min(kEdges, triangles); ++i) {
      const auto& corner =
          scene_.triangles[std::uint64_t{i} * triangles / std::min(kEdges, triangles)].vertex;
      const Camera camera =
          along_edge(inside, scene_.positions[corner[i % 3]], scene_.positions[corner[(i + 1) % 3]]);
      found.rays += static_cast<std::uint64_t>(camera.width);
      found.single += embree_.misses(camera, triangles, false);
      found.packets += embree_.misses(camera, triangles, true);
      const Frame frame = traced(camera, layer_bit(Layer::object));
      found.sidelight += static_cast<std::uint64_t>(std::count_if(
          frame.object_id.begin(), frame.object_id.end(), [](std::uint32_t id) { return id != 1; }));
    }
    return found;
  }

  const TraceEntry& entry_;
  const Scene& scene_;
  Size size_;
  int threads_;
  EmbreeTracer embree_;
  Scene task_scene_;
  std::shared_ptr<const raytrace::Prepared> prepared_;
  Task prepared_for_ = Task::build;
};

using PairWorker = Worker<Question, Answer>;

// The rows of one task: every worker takes its turn before any takes the next.
std::vector<TraceRow> race_in(Task task, const TracePlan& plan,
                              const std::vector<std::unique_ptr<PairWorker>>& workers) {
  std::vector<std::array<std::vector<Cost>, 3>> costs(workers.size());
  const int frames = task == Task::build ? plan.builds : plan.frames;
  for (int frame = -plan.warm_up; frame < frames; ++frame)
    for (std::size_t w = 0; w < workers.size(); ++w) {
      const Answer answer = workers[w]->ask({Question::Kind::task, task, frame});
      if (frame < 0) continue;
      costs[w][0].push_back(answer.single);
      costs[w][1].push_back(answer.packets);
      costs[w][2].push_back(answer.sidelight);
    }
  std::vector<TraceRow> rows;
  for (std::size_t w = 0; w < workers.size(); ++w)
    rows.push_back({task, plan.threads[w], spread_of_costs(costs[w][0]), spread_of_costs(costs[w][1]),
                    spread_of_costs(costs[w][2])});
  return rows;
}

}  // namespace

TraceRace race(const TraceEntry& entry, const Scene& scene, const TracePlan& plan) {
  std::vector<std::unique_ptr<PairWorker>> workers;
  for (const int threads : plan.threads)
    workers.push_back(std::make_unique<PairWorker>([&entry, &scene, &plan, threads] {
      keep_cores(threads);
      const auto pair = std::make_shared<Pair>(entry, scene, plan.size, threads);
      return [pair](const Question& question) { return pair->answer(question); };
    }));
  TraceRace result;
  result.triangles = scene.triangles.size();
  result.spheres = scene.spheres.size();
  for (const Task task : {Task::build, Task::eye, Task::eye_and_shadow, Task::whole})
    for (const TraceRow& row : race_in(task, plan, workers)) result.rows.push_back(row);
  result.verdict = workers[0]->ask({Question::Kind::verdict, Task::whole, 0}).verdict;
  return result;
}

}  // namespace sidelight::bench
