// SPDX-License-Identifier: MIT
// From the samples of a tile to the pixels of a frame: what PixelWriter (pixel.h) does sample by sample, for a renderer
// that has a tile's samples in arrays. Arrays go row by row on the lattice, n times the tile's width in a row.
#pragma once

#include <span>
#include <vector>

#include "common/picture/frame.h"
#include "common/scene/scene.h"

namespace sidelight {

class TilePixels {
 public:
  using Colors = std::span<const glm::vec3>;

  // These pixels, in picture coordinates, of n x n samples each.
  TilePixels(const Rect& pixels, int n) : pixels_(pixels), n_(static_cast<std::size_t>(n)) {}

  // visit(the pixel's index in the frame, the number of its first sample)
  template <class Visit>
  void for_each_pixel(const Frame& frame, const Visit& visit) const {
    for (int y = pixels_.y0; y < pixels_.y1; ++y) {
      const std::size_t pixel = frame.index(pixels_.x0, y), sample = n_ * row(y) * columns();
      for (std::size_t x = 0; x < width(); ++x) visit(pixel + x, sample + n_ * x);
    }
  }
  // visit(sample) for all samples of the pixel whose first sample this is, in the order in which they are summed.
  template <class Visit>
  void for_each_sample(std::size_t first, const Visit& visit) const {
    for (std::size_t j = 0; j < n_; ++j, first += columns())
      for (std::size_t i = 0; i < n_; ++i) visit(first + i);
  }

  // Their means; nothing where the frame has no such pixels. Of one sample a pixel, without the rows that `streamed` says
  // have been written, past the caches; empty: none.
  void write_means(Colors samples, const Frame& frame, KeptArray<glm::vec3>& pixels,
                   const std::vector<bool>& streamed = {}) const;

  // What is kept of the sample in the middle, (n/2, n/2), and where the frame asks for it of all: surfaces and depths.
  // primitive_of(sample) is kNone on background, where t is 0. t and normal may be empty where nothing asks for them.
  template <class PrimitiveOf>
  void write_surfaces(const PrimitiveOf& primitive_of, const std::vector<double>& t, Colors normal,
                      const Scene& scene, double depth_scale, Frame& frame) const {
    const std::size_t middle = n_ / 2 * columns() + n_ / 2;
    const auto for_each_middle = [&](const auto& array, const auto& write) {
      if (!array.empty())
        for_each_pixel(frame, [&](std::size_t pixel, std::size_t first) { write(pixel, first + middle); });
    };
    for_each_middle(frame.depth, [&](std::size_t pixel, std::size_t sample) {
      frame.depth[pixel] = static_cast<float>(t[sample] * depth_scale);
    });
    for_each_middle(frame.object_id, [&](std::size_t pixel, std::size_t sample) {
      const std::uint32_t primitive = primitive_of(sample);
      frame.object_id[pixel] = primitive == kNone ? 0 : 1 + scene.primitive_object[primitive];
    });
    for_each_middle(frame.primitive_id, [&](std::size_t pixel, std::size_t sample) {
      const std::uint32_t primitive = primitive_of(sample);
      frame.primitive_id[pixel] = primitive == kNone ? 0 : 1 + primitive;
    });
    for_each_middle(frame.normal,
                    [&](std::size_t pixel, std::size_t sample) { frame.normal[pixel] = normal[sample]; });
    if (frame.sample_primitive.empty()) return;
    for_each_pixel(frame, [&](std::size_t pixel, std::size_t first) {
      std::size_t to = pixel * n_ * n_;
      for_each_sample(first, [&](std::size_t sample) {
        frame.sample_primitive[to] = primitive_of(sample);
        frame.sample_depth[to++] = t[sample];
      });
    });
  }

 private:
  std::size_t width() const { return static_cast<std::size_t>(pixels_.width()); }
  std::size_t columns() const { return n_ * width(); }
  std::size_t row(int y) const { return static_cast<std::size_t>(y - pixels_.y0); }

  Rect pixels_;
  std::size_t n_;
};

}  // namespace sidelight
