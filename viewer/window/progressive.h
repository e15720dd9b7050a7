// SPDX-License-Identifier: MIT
// Draws the two pictures on a thread of its own, so that the window never waits: the z-buffer's at once, the tracer's
// from coarse blocks to fine, each picture shown as soon as it is there. On the way only what is looked at is made; all
// layers and samples come with the last pictures, which are those of a headless run, bit for bit. A new task ends the
// one at work. No OpenGL here.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common/picture/compare.h"
#include "common/picture/frame.h"
#include "common/scene/scene.h"
#include "raster/raster.h"
#include "raytrace/raytrace.h"

namespace sidelight {

inline constexpr std::size_t kAllObjects = std::numeric_limits<std::size_t>::max();

struct PictureTask {
  std::shared_ptr<const Scene> scene;  // as drawn: with the spheres of a tessellation
  CameraSettings camera;
  int n = 1;                          // samples per pixel edge
  RenderOptions options;              // threads, isa, crop and faults; the rest is the worker's own
  std::optional<Layer> layer;         // that is looked at: there from the first picture on
  std::size_t objects = kAllObjects;  // the z-buffer draws only so many, the first ones
  double asked_ms = 0;                // when it was submitted, on the clock of wall_ms; tells tasks apart

  Camera made_camera() const { return make_camera(camera, scene->width, scene->height, n); }
};

struct RendererTimes {
  double build_ms = 0, frame_ms = 0;
  double per_second = 0;  // rays of all kinds; the z-buffer's are samples
};

// What the renderers keep of a scene, alive as long as anybody asks them.
struct Renderers {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Scene> part;  // its first objects, where the z-buffer draws only those
  std::shared_ptr<const raster::Prepared> rasterizer;
  std::shared_ptr<const raytrace::Prepared> tracer;
};

struct Pictures {
  PictureTask task;  // what `rastered` shows, and `traced` if block > 0
  std::shared_ptr<const Frame> rastered, traced;
  Renderers renderers;  // that drew `rastered`, and `traced` if block > 0
  int block = 0;          // picture pixels along the edge of one of `traced`; 0: an earlier task's
  bool finished = false;  // both are final
  RendererTimes left, right;
  std::optional<Comparison> comparison;  // once finished, unless only some objects were drawn
  std::string error;                     // why there is no picture, where one could not be drawn
};

// What a task ends with, drawn here and now; task.options.cancel ends it early. Throws what the renderers throw.
Pictures render_pictures(const PictureTask& task);

class BuiltScene;  // what the renderers keep of a scene

class Progressive {
 public:
  // `notify` is called from the worker's thread whenever there is something new to show; it must not call back.
  explicit Progressive(std::function<void()> notify = {});
  ~Progressive();  // ends the task at work
  Progressive(const Progressive&) = delete;
  Progressive& operator=(const Progressive&) = delete;

  // From now on draws this. The task at work ends within a row of pixels; a z-buffer's picture that has begun, and the
  // first coarse blocks, are still finished, or a hand that never rests would never see one.
  void submit(PictureTask task);

  Pictures latest() const;  // what there is to show; empty before the first
  Pictures last_finished() const;
  bool idle() const;
  void wait() const;  // until idle

 private:
  void work();
  void draw(const PictureTask& task);
  void refine(Pictures& pictures);
  void show(const Pictures& pictures);

  const std::function<void()> notify_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::optional<PictureTask> next_;
  bool busy_ = false;
  Pictures latest_, finished_;
  std::atomic<bool> newer_{false};     // a task waits: the one at work may stop
  std::atomic<bool> stop_{false};      // the end: it must
  std::unique_ptr<BuiltScene> built_;  // the worker's
  double pixels_per_ms_ = 0;           // the worker's: traced, lately
  std::thread thread_;                 // last: it uses all of the above
};

}  // namespace sidelight
