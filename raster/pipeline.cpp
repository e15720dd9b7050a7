// SPDX-License-Identifier: MIT
// The z-buffer renderer, stage by stage: bin the primitives, then for each tile draw them into its z-buffer, and shade
// what is visible once. Object order: the z-buffer never asks what else a ray might meet.
#include <vector>

#include "common/model/shading.h"
#include "common/parallel.h"
#include "common/picture/pixel.h"
#include "raster/bins.h"
#include "raster/prepared.h"
#include "raster/tile.h"

namespace sidelight::raster {
namespace {

glm::vec3 rgb(const ShadingBatch::Rgb& from, std::size_t i) { return {from[0][i], from[1][i], from[2][i]}; }

// Shades a tile's samples, a batch at a time; samples_ keeps the lattice's row order.
class TileShader {
 public:
  TileShader(const Prepared& prepared, const Camera& camera, const RenderOptions& options, const Rect& pixels)
      : prepared_(prepared), camera_(camera), isa_(options.isa), pixels_(pixels),
        samples_(static_cast<std::size_t>(camera.n * pixels.width()) *
                 static_cast<std::size_t>(camera.n * pixels.height())) {}

  void shade_all(const DepthTile& tile, SignCounts& counts) {
    const int n = camera_.n;
    for (int Y = n * pixels_.y0; Y < n * pixels_.y1; ++Y)
      for (int X = n * pixels_.x0; X < n * pixels_.x1; ++X) shade_sample(X, Y, tile.at(X, Y), counts);
    flush();
  }

  void write(Frame& frame) const {
    const int n = camera_.n;
    PixelWriter writer(frame, camera_.depth_scale());
    for (int y = pixels_.y0; y < pixels_.y1; ++y)
      for (int x = pixels_.x0; x < pixels_.x1; ++x) {
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i) writer.add(samples_[index(n * x + i, n * y + j)]);
        writer.write(x, y);
      }
  }

 private:
  std::size_t index(int X, int Y) const {
    const int n = camera_.n;
    return static_cast<std::size_t>(Y - n * pixels_.y0) * static_cast<std::size_t>(n * pixels_.width()) +
           static_cast<std::size_t>(X - n * pixels_.x0);
  }

  void shade_sample(int X, int Y, const Hit& hit, SignCounts& counts) {
    const Scene& scene = prepared_.scene;
    Sample& sample = samples_[index(X, Y)];
    if (!hit.found()) {
      sample.color = sample[Layer::ambient] = glm::vec3(scene.background);
      return;
    }
    const Ray ray{camera_.eye, camera_.direction(X, Y)};
    const Surface surface = surface_at(scene, ray, hit, counts);
    sample.object = 1 + surface.object;
    sample.primitive = 1 + hit.primitive;
    sample.t = hit.t;
    sample.normal = glm::vec3(surface.normal);
    pending_[static_cast<std::size_t>(batch_.size)] = &sample;
    batch_.add(shading_point(prepared_.tables, surface, ray), prepared_.tables.materials[surface.material]);
    if (batch_.full()) flush();
  }

  void flush() {
    shade(isa_, prepared_.tables, batch_);
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch_.size); ++i) {
      Sample& sample = *pending_[i];
      sample.color = rgb(batch_.unshadowed, i);
      sample[Layer::ambient] = rgb(batch_.ambient_layer, i);
      sample[Layer::diffuse] = rgb(batch_.diffuse_layer, i);
      sample[Layer::specular] = rgb(batch_.specular_layer, i);
    }
    batch_.size = 0;
  }

  const Prepared& prepared_;
  const Camera& camera_;
  Isa isa_;
  Rect pixels_;
  std::vector<Sample> samples_;
  ShadingBatch batch_;
  std::array<Sample*, ShadingBatch::kCapacity> pending_{};
};

}  // namespace

std::shared_ptr<const Prepared> prepare(const Scene& scene, int) { return std::make_shared<const Prepared>(scene); }

Frame render(const Prepared& prepared, const Camera& camera, const RenderOptions& options) {
  Frame frame = make_frame(camera.width, camera.height, camera.n, options);
  const TileGrid grid{frame.window, options.tile};
  const int threads = thread_count(options.threads);
  std::vector<RenderStats> stats(static_cast<std::size_t>(threads));
  std::atomic<int> done{0};

  const Bins bins = bin_primitives(prepared.scene, camera, grid, threads);
  parallel_for(grid.count(), threads, [&](int tile, int thread) {
    if (options.cancel && *options.cancel) throw Interrupted();
    SignCounts& counts = stats[static_cast<std::size_t>(thread)].signs;
    DepthTile depth(camera, grid.tile(tile));
    bins.for_each(tile, [&](std::uint32_t primitive) { depth.draw(prepared.scene, primitive, counts); });
    TileShader shader(prepared, camera, options, grid.tile(tile));
    shader.shade_all(depth, counts);
    shader.write(frame);
    if (options.progress) options.progress(static_cast<double>(++done) / grid.count());
  });

  for (const RenderStats& s : stats) frame.stats.add_counts(s);
  return frame;
}

}  // namespace sidelight::raster
