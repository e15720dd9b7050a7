// SPDX-License-Identifier: MIT
#include "tests/bench/raster_race.h"

#include <glm/common.hpp>
#include <memory>

#include "raster/raster.h"
#include "tests/bench/llvmpipe.h"
#include "tests/bench/scenes.h"
#include "tests/bench/worker.h"
#include "tests/support/exact_picture.h"

namespace sidelight::bench {
namespace {

using test::ExactPicture;

struct Question {
  enum class Kind { frame, judgement } kind = Kind::frame;
  Size size;
  int frame = 0;
};
struct Answer {
  Cost llvmpipe, sidelight;
  RasterVerdict verdict;
};

Judgement judge(const ExactPicture& exact, const Camera& camera, const Frame& frame) {
  Judgement judgement;
  double squares = 0;
  std::uint64_t right = 0;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const std::size_t i = frame.index(x, y);
      const std::uint32_t shown = frame.primitive_id[i] == 0 ? kNone : frame.primitive_id[i] - 1;
      judgement.wrong += !exact.allows(x, y, shown);
      if (shown == kNone || shown != exact.at(x, y).nearest) continue;
      const double error = double{frame.depth[i]} / (camera.depth_scale() * exact.nearest_depth(x, y)) - 1;
      squares += error * error;
      ++right;
    }
  judgement.depth_rms = right == 0 ? 0 : std::sqrt(squares / static_cast<double>(right));
  return judgement;
}

// Both sides in one process.
class Pair {
 public:
  Pair(const Scene& scene, int threads)
      : scene_(scene),
        threads_(threads),
        llvmpipe_(scene, threads),
        prepared_(raster::prepare(scene, threads)) {}

  Answer answer(const Question& question) {
    if (question.size != size_) llvmpipe_.resize(question.size.width, question.size.height);
    size_ = question.size;
    const Camera camera = make_camera(moved_eye(scene_, question.frame), size_.width, size_.height, 1);
    return question.kind == Question::Kind::frame ? timed(camera, question.frame) : judged(camera);
  }

 private:
  Frame rastered(const Camera& camera, LayerMask layers) const {
    RenderOptions options;
    options.threads = threads_;
    options.layers = layers;
    return raster::render(*prepared_, camera, options);
  }

  // Each goes first in every other frame.
  Answer timed(const Camera& camera, int frame) {
    Answer answer;
    const auto own = [&] { answer.sidelight = cost_of([&] { rastered(camera, 0); }); };
    if (frame % 2 == 0) own();
    answer.llvmpipe = cost_of([&] { llvmpipe_.draw(camera); });
    if (frame % 2 != 0) own();
    return answer;
  }

  Answer judged(const Camera& camera) {
    const ExactPicture exact(scene_, camera);
    const Frame theirs = llvmpipe_.look(camera);
    const Frame ours = rastered(camera, layer_bit(Layer::primitive) | layer_bit(Layer::depth));
    Answer answer;
    RasterVerdict& verdict = answer.verdict;
    verdict.size = size_;
    verdict.llvmpipe = judge(exact, camera, theirs);
    verdict.sidelight = judge(exact, camera, ours);
    for (int y = 0; y < size_.height; ++y)
      for (int x = 0; x < size_.width; ++x) {
        const std::size_t i = ours.index(x, y);
        verdict.covered += exact.at(x, y).met > 0;
        if (ours.primitive_id[i] != theirs.primitive_id[i]) continue;
        const glm::vec3 apart = abs(clamp(ours.color[i], 0.0f, 1.0f) - theirs.color[i]);
        verdict.colors_apart += std::max({apart.x, apart.y, apart.z}) > 2.0f / 255;
      }
    return answer;
  }

  const Scene& scene_;
  int threads_;
  Llvmpipe llvmpipe_;
  std::shared_ptr<const raster::Prepared> prepared_;
  Size size_;
};

using PairWorker = Worker<Question, Answer>;

// The rows of one size: every worker draws a frame before any draws the next.
std::vector<RasterRow> race_at(Size size, const RasterPlan& plan,
                               const std::vector<std::unique_ptr<PairWorker>>& workers) {
  std::vector<std::vector<Answer>> answers(workers.size());
  for (int frame = -plan.warm_up; frame < plan.frames; ++frame)
    for (std::size_t w = 0; w < workers.size(); ++w) {
      const Answer answer = workers[w]->ask({Question::Kind::frame, size, frame});
      if (frame >= 0) answers[w].push_back(answer);
    }
  std::vector<RasterRow> rows;
  for (std::size_t w = 0; w < workers.size(); ++w) {
    std::vector<Cost> theirs, ours;
    for (const Answer& answer : answers[w]) {
      theirs.push_back(answer.llvmpipe);
      ours.push_back(answer.sidelight);
    }
    rows.push_back({size, plan.threads[w], spread_of_costs(theirs), spread_of_costs(ours)});
  }
  return rows;
}

}  // namespace

RasterRace race(const Scene& scene, const RasterPlan& plan) {
  std::vector<std::unique_ptr<PairWorker>> workers;
  for (const int threads : plan.threads)
    workers.push_back(std::make_unique<PairWorker>([&scene, threads] {
      keep_cores(threads);
      const auto pair = std::make_shared<Pair>(scene, threads);
      return [pair](const Question& question) { return pair->answer(question); };
    }));
  RasterRace result;
  result.triangles = scene.triangles.size();
  for (const Size& size : plan.sizes) {
    for (const RasterRow& row : race_at(size, plan, workers)) result.rows.push_back(row);
    if (plan.judged) result.verdicts.push_back(workers[0]->ask({Question::Kind::judgement, size, 0}).verdict);
  }
  return result;
}

}  // namespace sidelight::bench
