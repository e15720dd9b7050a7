// SPDX-License-Identifier: MIT
#include "viewer/window/progressive.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "common/clock.h"

namespace sidelight {
namespace {

double per_second(std::uint64_t count, double ms) {
  return ms > 0 ? 1e3 * static_cast<double>(count) / ms : 0;
}

// The z-buffer of the first `objects` objects: their primitives are the first ones too.
Scene first_objects(const Scene& scene, std::size_t objects) {
  Scene part = scene;
  part.objects.resize(std::min(objects, part.objects.size()));
  std::size_t primitives = 0;
  if (!part.objects.empty()) {
    const Object& last = part.objects.back();
    primitives = std::size_t{last.first_primitive} + last.count;
  }
  part.primitive_object.resize(primitives);
  return part;
}

RenderOptions options_for(const PictureTask& task, LayerMask layers, std::atomic<bool>* cancel) {
  RenderOptions options = task.options;
  options.layers = layers | (task.cost ? layer_bit(Layer::cost) : 0);
  options.keep_samples = true;  // for the count of mismatches
  options.cancel = cancel;
  options.progress = {};
  return options;
}

std::optional<Comparison> compare_pictures(const Pictures& pictures) {
  if (pictures.task.objects < pictures.task.scene->objects.size()) return {};
  return compare(*pictures.rastered, *pictures.traced, pictures.task.scene->lights.size());
}

}  // namespace

// Lives as long as its scene is drawn: a moved camera builds nothing.
class BuiltScene {
 public:
  explicit BuiltScene(const PictureTask& task) : scene_(task.scene), objects_(task.objects) {
    const double start = wall_ms();
    if (objects_ < scene_->objects.size()) part_ = first_objects(*scene_, objects_);
    rasterizer_ = raster::prepare(part_ ? *part_ : *scene_, task.options.threads);
    raster_ms_ = wall_ms() - start;
  }
  bool serves(const PictureTask& task) const { return scene_ == task.scene && objects_ == task.objects; }

  // After the z-buffer's picture, which need not wait for the tracer's hierarchy.
  const raytrace::Prepared& tracer(int threads) {
    if (!tracer_) {
      const double start = wall_ms();
      tracer_ = raytrace::prepare(*scene_, threads);
      tracer_ms_ = wall_ms() - start;
    }
    return *tracer_;
  }
  // The tracer's hierarchy is the same, however many objects the z-buffer draws.
  void take_tracer(const BuiltScene& other) {
    if (other.scene_ != scene_) return;
    tracer_ = other.tracer_;
    tracer_ms_ = other.tracer_ms_;
  }

  void draw_raster(Pictures& out, std::atomic<bool>* cancel) const {
    const PictureTask& task = out.task;
    const double start = wall_ms();
    out.rastered = std::make_shared<const Frame>(
        raster::render(*rasterizer_, task.made_camera(), options_for(task, kRasterLayers, cancel)));
    const double ms = wall_ms() - start;
    const std::uint64_t samples = out.rastered->pixels() * static_cast<std::uint64_t>(task.n * task.n);
    out.left = {raster_ms_, ms, per_second(samples, ms)};
  }

  // The tracer's picture with one pixel for `block` x `block`; at block 1 with n x n samples, the final one for n = task.n.
  void draw_traced(Pictures& out, int block, int n, std::atomic<bool>* cancel) {
    const PictureTask& task = out.task;
    const raytrace::Prepared& prepared = tracer(task.options.threads);
    const auto coarse = [block](int edge) { return (edge + block - 1) / block; };
    const Camera camera = make_camera(task.camera, coarse(scene_->width), coarse(scene_->height), n);
    const double start = wall_ms();
    out.traced = std::make_shared<const Frame>(
        raytrace::render(prepared, camera, options_for(task, kRaytraceLayers, cancel)));
    const double ms = wall_ms() - start;
    out.right = {tracer_ms_, ms, per_second(out.traced->stats.rays.total(), ms)};
    out.block = block;
    out.finished = block == 1 && n == task.n;
  }

 private:
  std::shared_ptr<const Scene> scene_;
  std::size_t objects_;
  std::optional<Scene> part_;
  std::shared_ptr<const raster::Prepared> rasterizer_;
  double raster_ms_ = 0, tracer_ms_ = 0;
  std::shared_ptr<const raytrace::Prepared> tracer_;
};

namespace {

// The coarsest blocks first: so coarse that they are there in `kFirstMs`, by the speed seen lately.
constexpr double kFirstMs = 25;
constexpr int kCoarsest = 16;

int first_block(const PictureTask& task, double pixels_per_ms) {
  if (task.options.crop.width() > 0) return 1;  // a part of the picture: no coarser whole to show
  const double pixels = static_cast<double>(task.scene->width) * task.scene->height;
  const double affordable = std::max(1.0, kFirstMs * pixels_per_ms);
  int block = 1;
  while (block < kCoarsest && pixels / (block * block) > affordable) block *= 2;
  return block;
}

}  // namespace

Pictures render_pictures(const PictureTask& task) {
  Pictures pictures;
  pictures.task = task;
  BuiltScene built(task);
  built.draw_raster(pictures, task.options.cancel);
  built.draw_traced(pictures, 1, task.n, task.options.cancel);
  pictures.comparison = compare_pictures(pictures);
  return pictures;
}

Progressive::Progressive(std::function<void()> notify)
    : notify_(std::move(notify)), thread_([this] { work(); }) {}

Progressive::~Progressive() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = newer_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Progressive::submit(PictureTask task) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(task);
    newer_ = true;
  }
  changed_.notify_all();
}

Pictures Progressive::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

Pictures Progressive::last_finished() const {
  const std::lock_guard lock(mutex_);
  return finished_;
}

bool Progressive::idle() const {
  const std::lock_guard lock(mutex_);
  return !busy_ && !next_;
}

void Progressive::wait() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !busy_ && !next_; });
}

void Progressive::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return stop_ || next_; });
    if (stop_) return;
    const PictureTask task = *std::exchange(next_, std::nullopt);
    newer_ = false;
    busy_ = true;
    lock.unlock();
    draw(task);
    lock.lock();
    busy_ = false;
    changed_.notify_all();
  }
}

void Progressive::draw(const PictureTask& task) {
  Pictures pictures = latest();
  pictures.task = task;
  pictures.block = 0;
  pictures.finished = false;
  pictures.comparison.reset();
  pictures.error.clear();
  try {
    if (!built_ || !built_->serves(task)) {
      auto built = std::make_unique<BuiltScene>(task);
      if (built_) built->take_tracer(*built_);
      built_ = std::move(built);
    }
    built_->draw_raster(pictures, &stop_);
    show(pictures);
    refine(pictures);
  } catch (const Interrupted&) {
    // The next task, or the end, is what there is to see.
  } catch (const std::exception& failure) {
    pictures.error = failure.what();
    show(pictures);
  }
}

void Progressive::refine(Pictures& pictures) {
  const PictureTask& task = pictures.task;
  const int first = first_block(task, pixels_per_ms_);
  // The first blocks are finished whatever comes; a crop has none.
  std::atomic<bool>* cancel = task.options.crop.width() > 0 ? &newer_ : &stop_;
  const auto draw_level = [&](int block, int n) {
    built_->draw_traced(pictures, block, n, cancel);
    pixels_per_ms_ =
        static_cast<double>(pictures.traced->pixels()) * n * n / std::max(1e-3, pictures.right.frame_ms);
    if (pictures.finished) pictures.comparison = compare_pictures(pictures);
    show(pictures);
    cancel = &newer_;
  };
  for (int block = first; block > 1; block /= 2) draw_level(block, 1);
  if (task.n > 1) draw_level(1, 1);
  draw_level(1, task.n);
}

void Progressive::show(const Pictures& pictures) {
  {
    const std::lock_guard lock(mutex_);
    latest_ = pictures;
    if (pictures.finished) finished_ = pictures;
  }
  if (notify_) notify_();
}

}  // namespace sidelight
