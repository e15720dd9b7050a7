// SPDX-License-Identifier: MIT
#include "raster/resolve.h"

#include <algorithm>

#include "common/picture/tile_pixels.h"
#include "common/prefetch.h"

namespace sidelight::raster {
namespace {

// What surfaces are made of: of a few megabytes all stays near from frame to frame, and to ask for it costs more than it
// brings (README.md).
bool too_large_for_caches(const Scene& scene) {
  const auto bytes = [](const auto& array) { return array.size() * sizeof(array[0]); };
  return bytes(scene.positions) + bytes(scene.normals) + bytes(scene.triangles) > std::size_t{8} << 20;
}

}  // namespace

TileResolve::TileResolve(const Prepared& prepared, const Camera& camera, const RenderOptions& options)
    : prepared_(prepared),
      camera_(camera),
      isa_(options.isa),
      n_(camera.n),
      want_parts_((options.layers & kLocalParts) != 0),
      want_normal_((options.layers & layer_bit(Layer::normal)) != 0),
      want_t_((options.layers & layer_bit(Layer::depth)) != 0 || options.keep_samples),
      prefetch_(too_large_for_caches(prepared.scene)),
      find_(prepared.scene) {
  for (const ObjectKind kind : {ObjectKind::sphere, ObjectKind::plane, ObjectKind::mesh})
    collected_[static_cast<std::size_t>(kind)].batch.kind = kind;
}

void TileResolve::begin(const Rect& pixels) {
  stream_to_ = nullptr;
  streamed_.clear();
  pixels_ = pixels;
  color_.resize(samples());
  if (want_t_) t_.resize(samples());
  if (want_normal_) normal_.resize(samples());
  if (want_parts_)
    for (Colors& part : parts_) part.resize(samples());
}

void TileResolve::shade(const Rect& pixels, const std::uint32_t* primitives, Frame& frame,
                        VisibilityCounts& counts) {
  begin(pixels);
  stream_rows_to(frame);
  primitive_ = primitives;
  shade_samples(false, counts);
}

void TileResolve::shade_wall(const Rect& pixels, std::uint32_t primitive, Frame& frame,
                             VisibilityCounts& counts) {
  begin(pixels);
  stream_rows_to(frame);
  show_one(primitive);
  begin_batches(false);
  Collected& collected = collected_[static_cast<std::size_t>(find_(primitive).kind)];
  SurfaceBatch& batch = collected.batch;
  for (int column = 0; column < columns(); column += SurfaceBatch::kCapacity) {
    const int width = std::min(SurfaceBatch::kCapacity, columns() - column);
    batch.begin_rows(camera_.column_factor(n_ * pixels_.x0 + column), width);
    for (int row = 0; row < rows(); ++row) {
      collected.runs.push_back({column, row, batch.size, width});
      batch.add_row(camera_.row_factor(n_ * pixels_.y0 + row), width, primitive);
      if (batch.room() < width) flush(collected, counts);
    }
    flush(collected, counts);
  }
}

// If each sample is a pixel, and rows of the tile are whole cache lines of the frame's colours.
void TileResolve::stream_rows_to(Frame& frame) {
  constexpr int kPixels = 16;  // are three lines
  const auto odd = [](const glm::vec3& first) { return reinterpret_cast<std::uintptr_t>(&first) % 64; };
  if (n_ != 1 || pixels_.width() % kPixels != 0 || frame.window.width() % kPixels != 0 ||
      frame.color.empty() || odd(frame.color[frame.index(pixels_.x0, pixels_.y0)]) != 0)
    return;
  stream_to_ = &frame;
  streamed_.assign(static_cast<std::size_t>(rows()), false);
}

void TileResolve::shade_background(const Rect& pixels) {
  begin(pixels);
  background_ = std::min(background_, samples());
  if (background_ < samples()) {
    set_background(0, samples());
    background_ = samples();
  }
  show_one(kNone);
}

void TileResolve::show_one(std::uint32_t primitive) {
  if (one_primitive_ != primitive || kept_primitive_.size() < samples())
    kept_primitive_.assign(samples(), primitive);
  one_primitive_ = primitive;
  primitive_ = kept_primitive_.data();
}

void TileResolve::begin_batches(bool known_t) {
  background_ = 0;
  for (Collected& of_kind : collected_) {
    of_kind.batch.has_t = known_t;
    of_kind.batch.want_t = want_t_;
    of_kind.batch.prefetched = true;
  }
}

void TileResolve::shade_samples(bool known_t, VisibilityCounts& counts) {
  begin_batches(known_t);
  find_runs();
  for (int row = 0; row < rows(); ++row) shade_row(row, known_t, counts);
  for (Collected& of_kind : collected_) flush(of_kind, counts);
}

// Where the primitive changes in a row, and where a row starts. (No branch: changes are hard to foresee.)
void TileResolve::find_runs() {
  run_start_.resize(samples() + 1);
  run_of_.resize(samples());
  const auto row = static_cast<std::uint32_t>(columns()), size = static_cast<std::uint32_t>(samples());
  std::size_t runs = 0;
  for (std::uint32_t start = 0; start < size; start += row) {
    run_start_[runs++] = start;
    std::uint32_t unlike = 0;
    for (std::uint32_t i = start; i < start + row; ++i) unlike |= primitive_[i] ^ primitive_[start];
    if (unlike == 0) {
      std::fill_n(&run_of_[start], row, static_cast<std::uint32_t>(runs - 1));
      continue;
    }
    run_of_[start] = static_cast<std::uint32_t>(runs - 1);
    for (std::uint32_t i = start + 1; i < start + row; ++i) {
      run_start_[runs] = i;
      runs += primitive_[i] != primitive_[i - 1];
      run_of_[i] = static_cast<std::uint32_t>(runs - 1);
    }
  }
  run_start_[runs] = size;
  runs_ = runs;
}

// Brings near what the batch that a run will go to reads of its primitive: first the record that says where that is.
void TileResolve::prefetch_run(std::size_t run) {
  constexpr std::size_t kRecord = 64, kSurface = 24;  // runs ahead
  const auto visit = [&](std::size_t ahead, const auto& bring) {
    if (run + ahead >= runs_) return;
    const std::uint32_t primitive = primitive_[run_start_[run + ahead]];
    if (primitive != kNone) bring(find_(primitive));
  };
  visit(kRecord, [&](const PrimitiveRef& ref) {
    if (ref.kind == ObjectKind::mesh) prefetch(&prepared_.scene.triangles[ref.index]);
  });
  visit(kSurface, [&](const PrimitiveRef& ref) { prefetch_surface(prepared_.scene, ref); });
}

// Stretches of background, and of primitives of one kind.
void TileResolve::shade_row(int row, bool known_t, VisibilityCounts& counts) {
  constexpr int kBackground = -1;
  const auto kind_of = [&](std::uint32_t primitive) {
    return primitive == kNone ? kBackground : static_cast<int>(find_(primitive).kind);
  };
  const std::size_t start = index(0, row), end = index(0, row + 1);
  std::size_t run = run_of_[start];
  for (std::size_t first = start, last; first < end; first = last) {
    const int kind = kind_of(primitive_[first]);
    do {
      if (prefetch_) prefetch_run(run);
      last = run_start_[++run];
    } while (last < end && kind_of(primitive_[last]) == kind);
    Run left{static_cast<int>(first - start), row, 0, static_cast<int>(last - first)};
    if (kind == kBackground) {
      set_background(first, last - first);
      continue;
    }
    Collected& collected = collected_[static_cast<std::size_t>(kind)];
    SurfaceBatch& batch = collected.batch;
    while (left.count > 0) {
      const Run now{left.column, row, batch.size, std::min(batch.room(), left.count)};
      const std::size_t i = index(now.column, row);
      if (known_t) std::copy_n(&known_t_[i], now.count, &batch.t[static_cast<std::size_t>(now.entry)]);
      batch.add(camera_.column_factor(n_ * pixels_.x0 + now.column),
                camera_.row_factor(n_ * pixels_.y0 + row), &run_of_[i], now.count,
                [this](std::uint32_t each) { return primitive_[run_start_[each]]; });
      collected.runs.push_back(now);
      left.column += now.count;
      left.count -= now.count;
      if (batch.room() == 0) flush(collected, counts);
    }
  }
}

void TileResolve::set_background(std::size_t first, std::size_t count) {
  const auto set = [&](auto& layer, const auto& value) {
    std::fill_n(layer.begin() + static_cast<std::ptrdiff_t>(first), count, value);
  };
  const glm::vec3 background(prepared_.scene.background);
  set(color_, background);
  if (want_t_) set(t_, 0.0);
  if (want_normal_) set(normal_, glm::vec3(0));
  if (!want_parts_) return;
  set(parts_[0], background);  // booked as ambient light
  set(parts_[1], glm::vec3(0));
  set(parts_[2], glm::vec3(0));
}

void TileResolve::flush(Collected& collected, VisibilityCounts& counts) {
  surfaces_at(isa_, prepared_.scene, camera_, prepared_.tables, collected.batch, shading_, counts);
  sidelight::shade(isa_, prepared_.tables, shading_, want_parts_);
  for (const Run& run : collected.runs) keep(collected.batch, run);
  collected.runs.clear();
  collected.batch.clear();
}

// What has been found of a run.
void TileResolve::keep(const SurfaceBatch& batch, const Run& run) {
  const auto from = static_cast<std::size_t>(run.entry), count = static_cast<std::size_t>(run.count);
  const std::size_t to = index(run.column, run.row);
  const auto put = [&](Colors& layer, const ShadingBatch::Rgb& colors) {
    interleave(colors, from, count, &layer[to]);
  };
  if (stream_to_ && run.count == columns()) {
    const std::size_t pixel = stream_to_->index(pixels_.x0, pixels_.y0 + run.row);
    stream(shading_.unshadowed, from, count, &stream_to_->color[pixel]);
    streamed_[static_cast<std::size_t>(run.row)] = true;
  } else {
    put(color_, shading_.unshadowed);
  }
  if (want_parts_) {
    put(parts_[0], shading_.ambient_layer);
    put(parts_[1], shading_.diffuse_layer);
    put(parts_[2], shading_.specular_layer);
  }
  if (want_t_)
    for (std::size_t i = 0; i < count; ++i) t_[to + i] = batch.t[from + i];
  if (want_normal_)
    for (std::size_t i = 0; i < count; ++i) normal_[to + i] = get(shading_.normal, from + i);
}

void TileResolve::write(Frame& frame) const {
  const TilePixels tile(pixels_, n_);
  tile.write_means(color_, frame, frame.color, streamed_);
  for (std::size_t l = 0; l < parts_.size(); ++l) tile.write_means(parts_[l], frame, frame.rgb[l]);
  tile.write_surfaces([&](std::size_t sample) { return primitive_[sample]; }, t_, normal_, prepared_.scene,
                      camera_.depth_scale(), frame);
  if (frame.cost.empty() || tests_.empty()) return;
  tile.for_each_pixel(frame, [&](std::size_t pixel, std::size_t first) {
    std::uint64_t tests = 0;
    tile.for_each_sample(first, [&](std::size_t sample) { tests += tests_[sample]; });
    frame.cost[pixel] = static_cast<float>(tests);
  });
}

}  // namespace sidelight::raster
