// SPDX-License-Identifier: MIT
// A finished picture with what was asked for beside the colour, and the options that make one. Both renderers
// return a Frame; image_io writes it, compare reads two of them.
//
// Pixels are stored row by row, top row first. Where a picture is cropped the arrays hold the crop only.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "common/kept_memory.h"
#include "common/math/isa.h"
#include "common/model/faults.h"

namespace sidelight {

// What a renderer can deliver beside the colour. The first six are RGB layers of the ledger (compare.h).
enum class Layer {
  ambient,
  diffuse,
  specular,
  shadow,
  reflection,
  refraction,
  depth,
  object,
  primitive,
  normal,
  cost
};
inline constexpr int kRgbLayers = 6;
inline constexpr int kLayers = 11;
inline constexpr std::array<std::string_view, kLayers> kLayerNames{
    "ambient", "diffuse", "specular",  "shadow", "reflection", "refraction",
    "depth",   "object",  "primitive", "normal", "cost"};

using LayerMask = unsigned;
constexpr LayerMask layer_bit(Layer layer) { return 1u << static_cast<unsigned>(layer); }
inline constexpr LayerMask kVisibilityLayers = layer_bit(Layer::depth) | layer_bit(Layer::object) |
                                               layer_bit(Layer::primitive) | layer_bit(Layer::normal);
inline constexpr LayerMask kLocalParts =
    layer_bit(Layer::ambient) | layer_bit(Layer::diffuse) | layer_bit(Layer::specular);
// What render() and render_reference() of a renderer make alike; only render() makes `cost`.
inline constexpr LayerMask kRasterLayers = kVisibilityLayers | kLocalParts;
inline constexpr LayerMask kLedgerLayers =
    layer_bit(Layer::shadow) | layer_bit(Layer::reflection) | layer_bit(Layer::refraction);
inline constexpr LayerMask kRaytraceLayers = kRasterLayers | kLedgerLayers;
inline constexpr LayerMask kAllLayers = kRaytraceLayers | layer_bit(Layer::cost);

// Half-open pixel rectangle, y down.
struct Rect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool operator==(const Rect&) const = default;
};

// A part of a picture cut into square tiles of pixels, row by row; those at the right and lower border may be smaller.
struct TileGrid {
  Rect window;
  int edge = 32;
  int columns() const { return (window.width() + edge - 1) / edge; }
  int rows() const { return (window.height() + edge - 1) / edge; }
  int count() const { return columns() * rows(); }
  Rect tile(int index) const;
};

struct Frame;

struct RenderOptions {
  int threads = 0;  // 0: all cores
  Isa isa = best_isa();
  int tile = 64;              // edge of a tile in pixels, at most; changes no bit of the picture
  LayerMask layers = 0;       // which layers to fill
  bool keep_samples = false;  // fill Frame::sample_primitive and sample_depth
  Rect crop;                  // empty: the whole picture
  Faults faults;              // off; the references know none
  // What each sample shows: another renderer's frame of the same camera and crop, with its samples kept, from which the
  // ray tracer's waves take surfaces and depths in place of eye rays. Null: its own rays find them.
  const Frame* primary = nullptr;
  std::atomic<bool>* cancel = nullptr;  // raised from outside: the renderer throws Interrupted soon after
  std::function<void(double done)> progress;  // called now and then, from any thread, with done in [0, 1]
};

// body(part, thread) for each of `parts` parts of a picture (parallel_for), until options.cancel is raised: then throws
// Interrupted. Tells options.progress of each that is done.
void for_each_part(const RenderOptions& options, int parts,
                   const std::function<void(int part, int thread)>& body);

struct RayCounts {
  std::uint64_t primary = 0, shadow = 0, reflection = 0, refraction = 0;
  std::uint64_t total() const { return primary + shadow + reflection + refraction; }
};

// The work of visibility: edge and side signs by the level of exactness that decided them, and tests of a ray
// against a primitive. A z-buffer's test is a primitive tried at a sample that its box covers; it gives a fragment where
// the primitive covers the sample, unless a whole block of samples was known to hide it. The float filter decides the
// three edge signs of all tests of a triangle but those that it finds doubtful. A node is one of the hierarchy that a ray
// entered, or a packet of rays. A packet's tests are those of whole groups of 16 rays, so their number depends on how rays
// are packed; a picture with the layer `cost` is traced ray by ray.
struct VisibilityCounts {
  std::uint64_t filtered = 0, in_double = 0, exact = 0;
  std::uint64_t tests = 0;
  std::uint64_t fragments = 0;  // z-buffer only
  std::uint64_t nodes = 0;      // ray tracer only
};

// Wall time spent in one stage of a renderer, of all its threads together.
struct StageTime {
  std::string_view name;
  double ms = 0;
};

struct RenderStats {
  RayCounts rays;
  VisibilityCounts visibility;
  std::uint64_t self_shadowed = 0;  // light terms dropped because the surface stands in its own light
  double cut_weight = 0;            // mean over samples of the weights of all rays not sent
  std::vector<StageTime> stages;    // in their order; empty where a renderer does not time them

  // Adds the counts; stages are left alone, cut_weight to the caller, who must add in a fixed order.
  void add_counts(const RenderStats& other);
};

struct Frame {
  int full_width = 0, full_height = 0;  // the whole picture
  Rect window;                          // the part that is stored
  int n = 1;                            // samples per pixel edge: n x n samples

  KeptArray<glm::vec3> color;
  std::array<KeptArray<glm::vec3>, kRgbLayers> rgb;  // empty unless asked for; indexed by Layer
  // Of sample (n/2, n/2) of each pixel; empty unless asked for.
  KeptArray<float> depth;                 // distance along the viewing direction; 0 on background
  KeptArray<std::uint32_t> object_id;     // 0: background, else 1 + the object's number
  KeptArray<std::uint32_t> primitive_id;  // likewise
  KeptArray<glm::vec3> normal;            // N, unit, world space; 0 on background
  // VisibilityCounts::tests made for the pixel, all its samples together; empty unless asked for. Whole numbers,
  // rounded to a float above 2^24.
  KeptArray<float> cost;
  // Of every sample (keep_samples), n*n a pixel, row by row within the pixel: primitive or kNone, and its depth t.
  KeptArray<std::uint32_t> sample_primitive;
  KeptArray<double> sample_depth;

  RenderStats stats;

  int width() const { return window.width(); }
  int height() const { return window.height(); }
  std::size_t pixels() const {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
  std::size_t index(int x, int y) const {  // picture coordinates, inside the window
    return static_cast<std::size_t>(y - window.y0) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>(x - window.x0);
  }
  const KeptArray<glm::vec3>& layer(Layer l) const { return rgb[static_cast<std::size_t>(l)]; }
  KeptArray<glm::vec3>& layer(Layer l) { return rgb[static_cast<std::size_t>(l)]; }
};

// A frame with its arrays allocated for `options` (all zero). Sizes and n are positive; the crop, if there is
// one, lies inside the picture.
Frame make_frame(int width, int height, int n, const RenderOptions& options);
// The same for one that writes colour, samples and the layers `written` of every pixel: these are not set, which at 1440p
// takes a twentieth of a frame.
Frame make_frame_to_write(int width, int height, int n, const RenderOptions& options, LayerMask written);

// The mean of a pixel's samples: summed in double in the order given, divided, rounded once. The one definition,
// so that equal samples give equal pixels in both renderers.
class PixelMean {
 public:
  void add(const glm::vec3& sample) { sum_ += glm::dvec3(sample); }
  glm::vec3 mean(int samples) const { return glm::vec3(sum_ / static_cast<double>(samples)); }

 private:
  glm::dvec3 sum_{0};
};

// Bytes of two frames made with these arguments (both pictures; or one and its file, which is encoded in
// memory): what is checked against the machine's memory before anything is allocated. Right at any size; what
// would not fit 64 bits gives the greatest number.
std::uint64_t frame_bytes(int width, int height, int n, const RenderOptions& options);

// The first pixel (row by row, picture coordinates) with a NaN or infinity in colour, any layer or the depth of
// a sample that hit, as text: "colour at pixel (12, 40)". Empty if there is none.
std::string first_non_finite(const Frame& frame);

}  // namespace sidelight
