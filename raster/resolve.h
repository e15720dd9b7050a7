// SPDX-License-Identifier: MIT
// Resolve: a tile's visible samples, shaded once each by the local model, and written as pixels. It asks the z-buffer for
// the primitives that are seen and works out the rest; samples are collected by kind of primitive into batches, so that
// lanes are full. Only what the picture holds is computed.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/model/surface_batch.h"
#include "common/scene/primitive_finder.h"
#include "raster/prepared.h"

namespace sidelight::raster {

// One for each thread, for tile after tile of one picture.
class TileResolve {
 public:
  // Of the options, isa, layers and keep_samples.
  TileResolve(const Prepared& prepared, const Camera& camera, const RenderOptions& options);

  // The samples of these pixels, of which the z-buffer keeps these primitives (row by row on the lattice; kNone:
  // background). They must stay until the tile is written. Rows of colours may be so at once, past the caches.
  void shade(const Rect& pixels, const std::uint32_t* primitives, Frame& frame, VisibilityCounts& counts);
  // The same of pixels that all show one primitive.
  void shade_wall(const Rect& pixels, std::uint32_t primitive, Frame& frame, VisibilityCounts& counts);
  // The same of pixels that show nothing.
  void shade_background(const Rect& pixels);
  // The same of what a tile of hits holds: a DepthTile, or one with faults, whose depths need not be those of visibility.h.
  template <class Tile>
  void shade_hits(const Rect& pixels, const Tile& tile, VisibilityCounts& counts) {
    begin(pixels);
    kept_primitive_.resize(samples());
    known_t_.resize(samples());
    tests_.resize(samples());
    std::size_t i = 0;
    for (int Y = n_ * pixels.y0; Y < n_ * pixels.y1; ++Y)
      for (int X = n_ * pixels.x0; X < n_ * pixels.x1; ++X, ++i) {
        kept_primitive_[i] = tile.at(X, Y).primitive;
        known_t_[i] = tile.at(X, Y).t;
        tests_[i] = tile.tests(X, Y);
      }
    primitive_ = kept_primitive_.data();
    one_primitive_.reset();
    shade_samples(true, counts);
  }

  // After shade(): the colour of the sample at (X, Y) of the tile, and what the frame's pixels are made of.
  glm::vec3 color(int X, int Y) const {
    return glm::vec3(0) + color_[index(X - n_ * pixels_.x0, Y - n_ * pixels_.y0)];
  }
  void write(Frame& frame) const;

 private:
  using Colors = std::vector<glm::vec3>;

  // Neighbours in a row, from (column, row) of the tile, and where they begin in their batch.
  struct Run {
    int column = 0, row = 0, entry = 0, count = 0;
  };
  struct Collected {
    SurfaceBatch batch;
    std::vector<Run> runs;
  };

  int columns() const { return n_ * pixels_.width(); }
  int rows() const { return n_ * pixels_.height(); }
  std::size_t samples() const {
    return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows());
  }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns()) +
           static_cast<std::size_t>(column);
  }
  void begin(const Rect& pixels);
  void stream_rows_to(Frame& frame);
  void show_one(std::uint32_t primitive);
  void begin_batches(bool known_t);
  void shade_samples(bool known_t, VisibilityCounts& counts);
  void find_runs();
  void prefetch_run(std::size_t run);
  void shade_row(int row, bool known_t, VisibilityCounts& counts);
  void set_background(std::size_t first, std::size_t count);
  void flush(Collected& collected, VisibilityCounts& counts);
  void keep(const SurfaceBatch& batch, const Run& run);

  const Prepared& prepared_;
  const Camera& camera_;
  Isa isa_;
  int n_;
  bool want_parts_, want_normal_, want_t_;
  bool prefetch_;
  Rect pixels_;
  // Where the colours of a row go if they are found all at once, and not to color_; of each row, whether they were.
  Frame* stream_to_ = nullptr;
  std::vector<bool> streamed_;
  // Of each sample, row by row on the lattice. What is not wanted is empty, or holds what came before.
  const std::uint32_t* primitive_ = nullptr;
  std::vector<std::uint32_t> kept_primitive_, tests_;
  std::optional<std::uint32_t> one_primitive_;  // all of kept_primitive_, where it is
  // Of runs_ runs of one primitive in a row, where they start, and the end of the last; of each sample its run.
  std::vector<std::uint32_t> run_start_, run_of_;
  std::size_t runs_ = 0;
  std::size_t background_ = 0;  // so many samples, from the first, are known to be set to background
  std::vector<double> known_t_, t_;
  Colors normal_, color_;
  std::array<Colors, 3> parts_;         // ambient, diffuse, specular
  std::array<Collected, 3> collected_;  // by ObjectKind
  PrimitiveFinder find_;
  ShadingBatch shading_;
};

}  // namespace sidelight::raster
