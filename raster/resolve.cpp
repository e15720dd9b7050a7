// SPDX-License-Identifier: MIT
#include "raster/resolve.h"

#include <algorithm>

#include "common/picture/tile_pixels.h"
#include "common/prefetch.h"

namespace sidelight::raster {

TileResolve::TileResolve(const Prepared& prepared, const Camera& camera, const RenderOptions& options)
    : prepared_(prepared),
      camera_(camera),
      isa_(options.isa),
      n_(camera.n),
      want_parts_((options.layers & kLocalParts) != 0),
      want_normal_((options.layers & layer_bit(Layer::normal)) != 0),
      want_t_((options.layers & layer_bit(Layer::depth)) != 0 || options.keep_samples) {
  for (const ObjectKind kind : {ObjectKind::sphere, ObjectKind::plane, ObjectKind::mesh})
    batches_[static_cast<std::size_t>(kind)].kind = kind;
}

void TileResolve::begin(const Rect& pixels) {
  pixels_ = pixels;
  const auto samples = static_cast<std::size_t>(columns()) * static_cast<std::size_t>(n_ * pixels.height());
  color_.resize(samples);
  if (want_t_) t_.resize(samples);
  if (want_normal_) normal_.resize(samples);
  if (want_parts_)
    for (Colors& part : parts_) part.resize(samples);
}

void TileResolve::shade(const Rect& pixels, const std::uint32_t* primitives, SignCounts& counts) {
  begin(pixels);
  primitive_ = primitives;
  shade_samples(false, counts);
}

void TileResolve::shade_samples(bool known_t, SignCounts& counts) {
  for (SurfaceBatch& batch : batches_) {
    batch.has_t = known_t;
    batch.want_t = want_t_;
  }
  find_runs();
  std::size_t run = 0;
  for (int Y = n_ * pixels_.y0; Y < n_ * pixels_.y1; ++Y) run = shade_row(Y, run, known_t, counts);
  for (SurfaceBatch& batch : batches_) flush(batch, counts);
}

// Where the primitive changes in a row, and where a row starts. (No branch: changes are hard to foresee.)
void TileResolve::find_runs() {
  run_start_.resize(color_.size() + 1);
  const auto row = static_cast<std::uint32_t>(columns()), size = static_cast<std::uint32_t>(color_.size());
  std::size_t runs = 0;
  for (std::uint32_t start = 0; start < size; start += row) {
    run_start_[runs++] = start;
    std::uint32_t unlike = 0;
    for (std::uint32_t i = start; i < start + row; ++i) unlike |= primitive_[i] ^ primitive_[start];
    if (unlike == 0) continue;
    for (std::uint32_t i = start + 1; i < start + row; ++i) {
      run_start_[runs] = i;
      runs += primitive_[i] != primitive_[i - 1];
    }
  }
  run_start_[runs] = size;
  runs_ = runs;
}

// Brings the triangle of a run near, so that the batch that it will go to finds it there.
void TileResolve::prefetch_run(std::size_t run) const {
  if (run >= runs_) return;
  const std::uint32_t primitive = primitive_[run_start_[run]];
  if (primitive == kNone) return;
  const PrimitiveRef ref = primitive_ref(prepared_.scene, primitive);
  if (ref.kind == ObjectKind::mesh) prefetch(&prepared_.scene.triangles[ref.index]);
}

// Stretches of background, and of primitives of one kind. From the row's first run to the next one's.
std::size_t TileResolve::shade_row(int Y, std::size_t run, bool known_t, SignCounts& counts) {
  constexpr std::size_t kAhead = 32;
  constexpr int kBackground = -1;
  const Scene& scene = prepared_.scene;
  std::uint32_t last_object = kNone;
  int last_kind = kBackground;
  const auto kind_of = [&](std::uint32_t primitive) {
    if (primitive == kNone) return kBackground;
    const std::uint32_t object = scene.primitive_object[primitive];
    if (object != last_object) last_kind = static_cast<int>(scene.objects[object].kind);
    last_object = object;
    return last_kind;
  };

  const std::size_t start = index(n_ * pixels_.x0, Y), end = start + static_cast<std::size_t>(columns());
  for (std::size_t first = start, last; first < end; first = last) {
    const int kind = kind_of(primitive_[first]);
    do {
      prefetch_run(run + kAhead);
      last = run_start_[++run];
    } while (last < end && kind_of(primitive_[last]) == kind);
    if (kind == kBackground) {
      set_background(first, last);
      continue;
    }
    SurfaceBatch& batch = batches_[static_cast<std::size_t>(kind)];
    for (std::size_t i = first; i < last;) {
      const int count = std::min(batch.room(), static_cast<int>(last - i));
      if (known_t) std::copy_n(&known_t_[i], count, &batch.t[static_cast<std::size_t>(batch.size)]);
      batch.add(camera_.column_factor(n_ * pixels_.x0 + static_cast<int>(i - start)), camera_.row_factor(Y),
                &primitive_[i], static_cast<std::uint32_t>(i), count);
      i += static_cast<std::size_t>(count);
      if (batch.room() == 0) flush(batch, counts);
    }
  }
  return run;
}

void TileResolve::set_background(std::size_t first, std::size_t last) {
  const auto set = [=](auto& array, const auto& value) {
    std::fill(array.begin() + static_cast<std::ptrdiff_t>(first),
              array.begin() + static_cast<std::ptrdiff_t>(last), value);
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

void TileResolve::flush(SurfaceBatch& batch, SignCounts& counts) {
  surfaces_at(isa_, prepared_.scene, camera_, prepared_.tables, batch, shading_, counts);
  sidelight::shade(isa_, prepared_.tables, shading_, want_parts_);
  const auto size = static_cast<std::size_t>(batch.size);
  for (std::size_t i = 0; i < size; ++i) color_[batch.sample[i]] = get(shading_.unshadowed, i);
  if (want_t_)
    for (std::size_t i = 0; i < size; ++i) t_[batch.sample[i]] = batch.t[i];
  if (want_normal_)
    for (std::size_t i = 0; i < size; ++i) normal_[batch.sample[i]] = get(shading_.normal, i);
  if (want_parts_)
    for (std::size_t i = 0; i < size; ++i) {
      parts_[0][batch.sample[i]] = get(shading_.ambient_layer, i);
      parts_[1][batch.sample[i]] = get(shading_.diffuse_layer, i);
      parts_[2][batch.sample[i]] = get(shading_.specular_layer, i);
    }
  batch.size = 0;
}

void TileResolve::write(Frame& frame) const {
  const TilePixels tile(pixels_, n_);
  tile.write_means(color_, frame, frame.color);
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
