// SPDX-License-Identifier: MIT
#include "common/picture/frame.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "common/error.h"
#include "common/parallel.h"
#include "common/scene/scene.h"

namespace sidelight {
namespace {

bool asked_for(const RenderOptions& options, Layer layer) { return (options.layers & layer_bit(layer)) != 0; }

// The part of the picture that is stored.
Rect stored_window(int width, int height, const RenderOptions& options) {
  const bool cropped = options.crop.width() > 0 && options.crop.height() > 0;
  return cropped ? options.crop : Rect{0, 0, width, height};
}

template <class T>
void set_zero(KeptArray<T>& array) {
  std::fill(array.begin(), array.end(), T{});
}

// visit(layer, its array) for every layer.
template <class Visit>
void for_each_layer(Frame& frame, const Visit& visit) {
  for (std::size_t i = 0; i < frame.rgb.size(); ++i) visit(static_cast<Layer>(i), frame.rgb[i]);
  visit(Layer::depth, frame.depth);
  visit(Layer::object, frame.object_id);
  visit(Layer::primitive, frame.primitive_id);
  visit(Layer::normal, frame.normal);
  visit(Layer::cost, frame.cost);
}

// Where the search for the first value that is not finite stands.
struct Fault {
  std::size_t pixel;
  std::string_view name;
};

bool is_finite(double value) { return std::isfinite(value); }
bool is_finite(const glm::vec3& value) {
  return std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
}

// Moves `fault` to the first faulty pixel of one array if that stands before the one already found.
template <class T>
void look_for_fault(const KeptArray<T>& values, std::string_view name, Fault& fault) {
  for (std::size_t i = 0; i < values.size() && i < fault.pixel; ++i) {
    if (!is_finite(values[i])) fault = {i, name};
  }
}

// The same for the depths of all samples; a sample without a hit has none.
void look_for_sample_fault(const Frame& frame, Fault& fault) {
  const std::size_t samples = static_cast<std::size_t>(frame.n) * static_cast<std::size_t>(frame.n);
  for (std::size_t i = 0; i < frame.sample_depth.size() && i / samples < fault.pixel; ++i) {
    const bool hit = frame.sample_primitive[i] != kNone;
    if (hit && !std::isfinite(frame.sample_depth[i])) fault = {i / samples, "sample depth"};
  }
}

}  // namespace

Rect TileGrid::tile(int index) const {
  const int x0 = window.x0 + index % columns() * edge, y0 = window.y0 + index / columns() * edge;
  return {x0, y0, std::min(x0 + edge, window.x1), std::min(y0 + edge, window.y1)};
}

void for_each_part(const RenderOptions& options, int parts,
                   const std::function<void(int part, int thread)>& body) {
  std::atomic<int> done{0};
  parallel_for(parts, options.threads, [&](int part, int thread) {
    if (options.cancel && *options.cancel) throw Interrupted();
    body(part, thread);
    if (options.progress) options.progress(static_cast<double>(++done) / parts);
  });
}

void RenderStats::add_counts(const RenderStats& other) {
  rays.primary += other.rays.primary;
  rays.shadow += other.rays.shadow;
  rays.reflection += other.rays.reflection;
  rays.refraction += other.rays.refraction;
  visibility.filtered += other.visibility.filtered;
  visibility.in_double += other.visibility.in_double;
  visibility.exact += other.visibility.exact;
  visibility.tests += other.visibility.tests;
  visibility.fragments += other.visibility.fragments;
  visibility.nodes += other.visibility.nodes;
  self_shadowed += other.self_shadowed;
}

Frame make_frame(int width, int height, int n, const RenderOptions& options) {
  Frame frame = make_frame_to_write(width, height, n, options, 0);
  set_zero(frame.color);
  set_zero(frame.sample_primitive);
  set_zero(frame.sample_depth);
  return frame;
}

Frame make_frame_to_write(int width, int height, int n, const RenderOptions& options, LayerMask written) {
  assert(width > 0 && height > 0 && n > 0);
  Frame frame;
  frame.full_width = width;
  frame.full_height = height;
  frame.window = stored_window(width, height, options);
  frame.n = n;
  assert(frame.window.x0 >= 0 && frame.window.x0 < frame.window.x1 && frame.window.x1 <= width);
  assert(frame.window.y0 >= 0 && frame.window.y0 < frame.window.y1 && frame.window.y1 <= height);

  const std::size_t pixels = frame.pixels();
  frame.color.resize(pixels);
  for_each_layer(frame, [&](Layer layer, auto& array) {
    if (!asked_for(options, layer)) return;
    array.resize(pixels);
    if ((written & layer_bit(layer)) == 0) set_zero(array);
  });
  if (options.keep_samples) {
    const std::size_t samples = pixels * static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
    frame.sample_primitive.resize(samples);
    frame.sample_depth.resize(samples);
  }
  return frame;
}

std::uint64_t frame_bytes(int width, int height, int n, const RenderOptions& options) {
  std::size_t layer_bytes = 0;
  for (int i = 0; i < kLayers; ++i) {
    const auto layer = static_cast<Layer>(i);
    const bool three = i < kRgbLayers || layer == Layer::normal;
    if (asked_for(options, layer)) layer_bytes += three ? sizeof(glm::vec3) : sizeof(float);
  }
  const std::size_t sample_bytes = options.keep_samples ? sizeof(std::uint32_t) + sizeof(double) : 0;

  // In floating point, where products of any four ints fit; only the result may not.
  const auto count = [](int value) { return static_cast<long double>(std::max(value, 0)); };
  const Rect window = stored_window(width, height, options);
  const long double pixel_bytes = static_cast<long double>(sizeof(glm::vec3) + layer_bytes) +
                                  count(n) * count(n) * static_cast<long double>(sample_bytes);
  const long double bytes = 2 * count(window.width()) * count(window.height()) * pixel_bytes;
  return bytes < 0x1p64L ? static_cast<std::uint64_t>(bytes) : std::numeric_limits<std::uint64_t>::max();
}

std::string first_non_finite(const Frame& frame) {
  Fault fault{frame.pixels(), {}};
  look_for_fault(frame.color, "colour", fault);
  for (std::size_t i = 0; i < frame.rgb.size(); ++i) look_for_fault(frame.rgb[i], kLayerNames[i], fault);
  look_for_fault(frame.depth, "depth", fault);
  look_for_fault(frame.normal, "normal", fault);
  look_for_fault(frame.cost, "cost", fault);
  look_for_sample_fault(frame, fault);
  if (fault.name.empty()) return {};

  const auto width = static_cast<std::size_t>(frame.width());
  const auto x = static_cast<std::size_t>(frame.window.x0) + fault.pixel % width;
  const auto y = static_cast<std::size_t>(frame.window.y0) + fault.pixel / width;
  return std::string(fault.name) + " at pixel (" + std::to_string(x) + ", " + std::to_string(y) + ")";
}

}  // namespace sidelight
