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

// How much of a picture is made: what is looked at, or all that it will be asked for later.
enum class Extent { glimpse, complete };

RenderOptions options_for(const PictureTask& task, Extent extent, LayerMask all, std::atomic<bool>* cancel) {
  const LayerMask looked_at = task.layer ? layer_bit(*task.layer) : 0;
  RenderOptions options = task.options;
  options.layers = extent == Extent::complete ? all | (looked_at & layer_bit(Layer::cost))
                                              : looked_at & (all | layer_bit(Layer::cost));
  options.keep_samples = extent == Extent::complete;  // for the count of mismatches
  options.cancel = cancel;
  options.progress = {};
  return options;
}

std::optional<Comparison> compare_pictures(const Pictures& pictures) {
  if (pictures.task.objects < pictures.task.scene->objects.size()) return {};
  return compare(*pictures.rastered, *pictures.traced, pictures.task.scene->lights.size());
}

// The coarsest blocks first: so coarse that they are there in `kFirstMs`, by the speed seen lately.
constexpr double kFirstMs = 8;
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

// Lives as long as its scene is drawn: a moved camera builds nothing.
class BuiltScene {
 public:
  explicit BuiltScene(const PictureTask& task) : objects_(task.objects) {
    const double start = wall_ms();
    renderers_.scene = task.scene;
    if (objects_ < task.scene->objects.size())
      renderers_.part = std::make_shared<const Scene>(first_objects(*task.scene, objects_));
    renderers_.rasterizer =
        raster::prepare(renderers_.part ? *renderers_.part : *renderers_.scene, task.options.threads);
    raster_ms_ = wall_ms() - start;
  }
  bool serves(const PictureTask& task) const {
    return renderers_.scene == task.scene && objects_ == task.objects;
  }

  // The tracer's hierarchy is the same, however many objects the z-buffer draws.
  void take_tracer(const BuiltScene& other) {
    if (other.renderers_.scene != renderers_.scene) return;
    renderers_.tracer = other.renderers_.tracer;
    tracer_ms_ = other.tracer_ms_;
  }

  // With n x n samples, which for a glimpse may be fewer than the task's.
  void draw_raster(Pictures& out, Extent extent, int n, std::atomic<bool>* cancel) const {
    const PictureTask& task = out.task;
    const Camera camera = make_camera(task.camera, task.scene->width, task.scene->height, n);
    const double start = wall_ms();
    out.rastered = std::make_shared<const Frame>(
        raster::render(*renderers_.rasterizer, camera, options_for(task, extent, kRasterLayers, cancel)));
    const double ms = wall_ms() - start;
    out.left = {raster_ms_, ms, per_second(out.rastered->pixels() * static_cast<std::uint64_t>(n * n), ms)};
    out.renderers = renderers_;
  }

  // The tracer's picture with one pixel for `block` x `block`. Prepares it first, where it is not: after the z-buffer's
  // picture, which need not wait for the tracer's hierarchy.
  void draw_traced(Pictures& out, Extent extent, int block, int n, std::atomic<bool>* cancel) {
    const PictureTask& task = out.task;
    if (!renderers_.tracer) {
      const double start = wall_ms();
      renderers_.tracer = raytrace::prepare(*task.scene, task.options.threads);
      tracer_ms_ = wall_ms() - start;
    }
    const auto coarse = [block](int edge) { return (edge + block - 1) / block; };
    const Camera camera = make_camera(task.camera, coarse(task.scene->width), coarse(task.scene->height), n);
    const double start = wall_ms();
    out.traced = std::make_shared<const Frame>(
        raytrace::render(*renderers_.tracer, camera, options_for(task, extent, kRaytraceLayers, cancel)));
    const double ms = wall_ms() - start;
    out.right = {tracer_ms_, ms, per_second(out.traced->stats.rays.total(), ms)};
    out.block = block;
    out.renderers = renderers_;
  }

  // Both pictures as a headless run makes them, and what their comparison says.
  void complete(Pictures& out, std::atomic<bool>* cancel) {
    draw_raster(out, Extent::complete, out.task.n, cancel);
    draw_traced(out, Extent::complete, 1, out.task.n, cancel);
    out.comparison = compare_pictures(out);
    out.finished = true;
  }

 private:
  Renderers renderers_;
  std::size_t objects_;
  double raster_ms_ = 0, tracer_ms_ = 0;
};

Pictures render_pictures(const PictureTask& task) {
  Pictures pictures;
  pictures.task = task;
  BuiltScene(task).complete(pictures, task.options.cancel);
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
    next_->asked_ms = wall_ms();
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
    built_->draw_raster(pictures, Extent::glimpse, 1, &stop_);
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
  // The first blocks are finished whatever comes, but those of a crop, of which there is no coarser whole.
  std::atomic<bool>* cancel = task.options.crop.width() > 0 ? &newer_ : &stop_;
  const auto timed = [&](int n, const auto& draw) {
    draw();
    pixels_per_ms_ =
        static_cast<double>(pictures.traced->pixels()) * n * n / std::max(1e-3, pictures.right.frame_ms);
    show(pictures);
    cancel = &newer_;
  };
  const int last = task.n > 1 ? 1 : 2;  // that is not the final picture yet
  for (int block = first_block(task, pixels_per_ms_); block >= last; block /= 2)
    timed(1, [&] { built_->draw_traced(pictures, Extent::glimpse, block, 1, cancel); });
  timed(task.n, [&] { built_->complete(pictures, cancel); });
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
