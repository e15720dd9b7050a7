// SPDX-License-Identifier: MIT
#include "raster/resolve.h"

namespace sidelight::raster {
namespace {

glm::vec3 rgb(const ShadingBatch::Rgb& from, std::size_t i) { return {from[0][i], from[1][i], from[2][i]}; }

}  // namespace

TileResolve::TileResolve(const Prepared& prepared, const Camera& camera, Isa isa, const Rect& pixels)
    : prepared_(prepared),
      camera_(camera),
      isa_(isa),
      pixels_(pixels),
      samples_(static_cast<std::size_t>(camera.n * pixels.width()) *
               static_cast<std::size_t>(camera.n * pixels.height())) {}

void TileResolve::shade_sample(int X, int Y, const Hit& hit, SignCounts& counts) {
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

void TileResolve::flush() {
  sidelight::shade(isa_, prepared_.tables, batch_);
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch_.size); ++i) {
    Sample& sample = *pending_[i];
    sample.color = rgb(batch_.unshadowed, i);
    sample[Layer::ambient] = rgb(batch_.ambient_layer, i);
    sample[Layer::diffuse] = rgb(batch_.diffuse_layer, i);
    sample[Layer::specular] = rgb(batch_.specular_layer, i);
  }
  batch_.size = 0;
}

void TileResolve::write(Frame& frame) const {
  const int n = camera_.n;
  PixelWriter writer(frame, camera_.depth_scale());
  for (int y = pixels_.y0; y < pixels_.y1; ++y)
    for (int x = pixels_.x0; x < pixels_.x1; ++x) {
      for (int Y = n * y; Y < n * (y + 1); ++Y)
        for (int X = n * x; X < n * (x + 1); ++X) writer.add(sample(X, Y));
      writer.write(x, y);
    }
}

}  // namespace sidelight::raster
