// SPDX-License-Identifier: MIT
// From samples to a pixel of a Frame, for who makes them one by one. Equal samples give equal pixels whoever made them:
// TilePixels (tile_pixels.h) does the same for those that stand in arrays.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "common/picture/frame.h"

namespace sidelight {

// One sample as a renderer knows it. Layers that a frame does not hold are ignored.
struct Sample {
  glm::vec3 color{0};
  std::array<glm::vec3, kRgbLayers> layer{};  // indexed by Layer
  std::uint32_t object = 0, primitive = 0;    // as stored in a frame: 0 background, else 1 + number
  double t = 0;                               // depth along the sample's ray; 0 on background
  glm::vec3 normal{0};
  std::uint64_t tests = 0;  // what it cost (VisibilityCounts)

  glm::vec3& operator[](Layer l) { return layer[static_cast<std::size_t>(l)]; }
};

// Collects the n*n samples of one pixel, in row order, and writes it.
class PixelWriter {
 public:
  // depth_scale turns t into the distance along the viewing direction (Camera::depth_scale).
  PixelWriter(Frame& frame, double depth_scale) : frame_(frame), depth_scale_(depth_scale) {}

  void add(const Sample& sample);
  // Writes the pixel at picture coordinates (x, y). Needs n*n samples.
  void write(int x, int y);

 private:
  Frame& frame_;
  double depth_scale_;
  int count_ = 0;
  PixelMean color_;
  std::array<PixelMean, kRgbLayers> layer_;
  Sample center_;
  std::uint64_t tests_ = 0;
  std::vector<std::uint32_t> kept_primitive_;
  std::vector<double> kept_t_;
};

// The pixels of row y, picture coordinates: sample_at(X, Y) of the lattice for each of their samples.
template <class SampleAt>
void write_row(Frame& frame, double depth_scale, int y, const SampleAt& sample_at) {
  const int n = frame.n;
  for (int x = frame.window.x0; x < frame.window.x1; ++x) {
    PixelWriter pixel(frame, depth_scale);
    for (int Y = n * y; Y < n * (y + 1); ++Y)
      for (int X = n * x; X < n * (x + 1); ++X) pixel.add(sample_at(X, Y));
    pixel.write(x, y);
  }
}

}  // namespace sidelight
