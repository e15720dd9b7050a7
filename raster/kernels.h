// SPDX-License-Identifier: MIT
// The rasterizer's kernels, each written once over lanes (project_lanes, setup_kernel.h, visible_*.h) and
// instantiated for each instruction set. Every set gives the same bits and counts.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "raster/screen.h"
#include "raster/visible_tile.h"

namespace sidelight::raster {

// Triangles on their way through set-up together: a structure of arrays, corner by corner.
struct TriangleChunk {
  static constexpr int kSize = 256;
  // What becomes of a triangle: nothing more; drawn by the tiles, front faces before back faces; as that, if it has a side,
  // which the filter cannot tell; set up in double.
  enum Kind : std::int32_t { kNothing, kFront, kBack, kDoubtful, kLarge };

  template <class T>
  using PerTriangle = std::array<T, kSize>;

  int size = 0;
  alignas(64) std::array<PerTriangle<std::int32_t>, 3> x, y;
  alignas(64) std::array<PerTriangle<float>, 3> w;
  alignas(64) std::array<PerTriangle<std::int32_t>, 3> state;

  // What set_up() finds.
  alignas(64) PerTriangle<std::int32_t> x0, y0, x1, y1;  // box, cut to the window
  alignas(64) PerTriangle<std::int32_t> kind;
};

// Tiny triangles are rasterized by set_up(): the samples that they cover, and those that must be asked.
struct TinyFragments {
  static constexpr int kBox = 2;  // samples along the edge of a tiny triangle's box, at most
  static constexpr int kMost = TriangleChunk::kSize * kBox * kBox;
  std::size_t covered = 0, doubtful = 0;
  std::array<ScreenFragment, kMost> fragment;  // .primitive: place in the chunk
  std::array<ScreenFragment, kMost> doubt;
  std::uint64_t triangles = 0, tests = 0;  // how many they are, and the samples of their boxes
};

struct Kernels {
  void (*project)(const ScreenSpace& space, const glm::dvec3* from, ScreenVertex* to, int count);
  void (*set_up)(const ScreenSpace& space, const SampleBox& window, TriangleChunk& chunk,
                 TinyFragments& tiny);
  void (*draw_small)(const TileView& tile, const ScreenSpace& space, const ScreenVertex* vertices,
                     const Corners3* corners, const SmallTriangle* triangles, std::size_t count);
  // Brings TileView::farthest up to date, and returns its least.
  float (*find_farthest)(const TileView& tile);
  // The surface that fills a box before all others, if one surely does (visible_large.h).
  const LargeSurface* (*find_wall)(const SampleBox& box, std::span<const LargeSurface* const> surfaces,
                                   float nearest);
  void (*draw_large)(const TileView& tile, const LargeSurface& surface);
};

const Kernels& kernels_scalar();
const Kernels& kernels_avx2();
const Kernels& kernels_avx512();

inline const Kernels& kernels_for(Isa isa) {
  return by_isa(isa, kernels_scalar, kernels_avx2, kernels_avx512)();
}

}  // namespace sidelight::raster
