// SPDX-License-Identifier: MIT
// What a sweep measures against what theory says it must: the error of each knob falls as it should, and with no knob
// turned only rounding is left. Scenes whose exact pictures are known.
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/picture/folder.h"
#include "tests/support/approx.h"
#include "tests/tier.h"
#include "viewer/bench/sweep.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

BenchResult sweep(const std::string& scene, const std::vector<std::string>& set) {
  const TemporaryFolder folder;
  write_bytes(folder / "scene.toml", scene);
  SweepPlan plan{
      {folder / "scene.toml"}, {}, product_configs(set), 7, false, PictureCache(""), nullptr, {}, {}};
  return run_sweep(plan);
}

double rms(const BenchPoint& point, ErrorKind kind) {
  const auto& error = point.by_kind[static_cast<std::size_t>(kind)];
  REQUIRE(error.has_value());
  return error->whole.metrics.rms;
}

// A white half-plane before black, whose edge moves by `kSlope` pixels from row to row.
constexpr int kEdgeWidth = 96, kEdgeHeight = 128;
const double kSlope = (std::sqrt(5.0) - 1) / 2;
std::string edge_scene() {
  // One pixel is 1/128 at distance 1. The edge passes 0.3 pixels beside the picture's middle.
  const double at_top = 0.3 / kEdgeHeight + kSlope * 0.6, at_bottom = 0.3 / kEdgeHeight - kSlope * 0.6;
  const auto vertex = [](double x, double y) {
    return "[" + std::to_string(x) + ", " + std::to_string(y) + ", -1]";
  };
  return "picture = { size = [96, 128] }\n"
         "ambient = 1\n"
         "camera = { eye = [0, 0, 0], look_at = [0, 0, -1], view_height = 1 }\n"
         "material.white = { ambient = 1 }\n"
         "mesh = [{ vertices = [[-9, 0.6, -1], [-9, -0.6, -1], " +
         vertex(at_bottom, -0.6) + ", " + vertex(at_top, 0.6) +
         "], faces = [[0, 1, 2, 3]], material = 'white' }]\n";
}

// Variance of what n x n samples get wrong of the edge's area in one row of pixels, phases uniform. Each of the n rows of
// samples rounds the edge to a multiple of 1/n: a sawtooth of phase n phi + k slope, as Fourier series; m of them in a
// row, each worth 1/n of 1/n of the pixel, add up to V(m). With probability `slope` the edge leaves its pixel on the way,
// after m of n rows with any m alike, and two pixels share the error.
double theory(int n) {
  const auto variance = [&](int m) {
    double sum = 0;
    for (int h = 1; h <= 2000; ++h) {
      const double waves =
          std::sin(std::numbers::pi * m * h * kSlope) / std::sin(std::numbers::pi * h * kSlope);
      sum += waves * waves / (2 * std::numbers::pi * std::numbers::pi * h * h);
    }
    return sum / std::pow(n, 4);
  };
  double shared = 0;
  for (int m = 0; m < n; ++m) shared += (variance(m) + variance(n - m)) / n;
  const double in_a_row = (1 - kSlope) * variance(n) + kSlope * shared;
  return std::sqrt(in_a_row / kEdgeWidth);  // a row of the picture has one edge
}

}  // namespace

// The rows' phases are a lattice, not random: over 128 of them a mean is off by some per cent (10 are allowed), and by
// what the reference itself is off.
TEST_CASE("bench: the sampling error of an edge of irrational slope is that of a sawtooth") {
  const BenchResult result = sweep(edge_scene(), {"renderer=raytrace", "samples=1,4,9"});
  const ReferenceImage& reference = result.scenes[0].reference;
  REQUIRE(reference.n >= 8);
  CHECK(reference.remaining <= 2 * theory(reference.n));
  std::vector<double> measured;
  for (std::size_t i = 0; i < 3; ++i) {
    const int n = static_cast<int>(i) + 1;
    CAPTURE(n);
    measured.push_back(rms(result.points[i], ErrorKind::sampling));
    CHECK(std::abs(measured.back() - theory(n)) <= 0.1 * theory(n) + theory(reference.n));
    CHECK(rms(result.points[i], ErrorKind::arithmetic) == 0);  // 0s and 1s: nothing to round
    CHECK(rms(result.points[i], ErrorKind::model) == 0);
  }
  // Between n^-1.5, were the sample rows independent, and n^-2, as well as equal weights can do.
  const double slope = std::log(measured[2] / measured[0]) / std::log(3.0);
  CHECK(slope > -2);
  CHECK(slope < -1.5);
}

// Inside a mirrored ball that glows, every ray brings a (1 + k + ... + k^(depth - 1)) of a / (1 - k): what a depth limit
// leaves out is a k^depth / (1 - k). Beside it rounding, u = 2^-24 of the value once for each of at most `depth` sums and
// three times for products and the picture; and what the reference itself leaves out.
TEST_CASE("bench: the error of a depth limit falls by the mirror's weight a level") {
  constexpr double a = 0.25, k = 0.125;
  const BenchResult result = sweep(
      "picture = { size = [16, 12] }\n"
      "ambient = 1\n"
      "camera = { eye = [0.1, 0.2, 0.3], look_at = [1, 0, 0], view_height = 1 }\n"
      "material.mirror = { ambient = 0.25, reflect = 0.125 }\n"
      "sphere = [{ center = [0, 0, 0], radius = 1, material = 'mirror' }]\n",
      {"renderer=raytrace", "depth=1,2,3,4,6"});
  const ReferenceImage& reference = result.scenes[0].reference;
  CHECK(reference.cut_weight < 0x1p-24);
  CHECK(reference.cut_weight == std::pow(k, reference.depth));
  REQUIRE(result.points.size() == 6);
  for (const BenchPoint& point : result.points) {
    if (point.varied.empty()) continue;
    const double depth = setting_of(point.config).depth.value();
    CAPTURE(depth);
    const double left_out = a * std::pow(k, depth) / (1 - k);
    const double slack = 0x1p-24 * (depth + 3) * a / (1 - k) + a * reference.cut_weight / (1 - k);
    CHECK(std::abs(rms(point, ErrorKind::model) - left_out) <= slack);
    CHECK(std::abs(point.error.whole.metrics.rms - left_out) <= slack);
    CHECK(point.failures.empty());
  }
}

// A ball that fills the picture, so that no silhouette is seen. With N segments its normals and points are off by
// multiples of (pi/N)²; the next term of the series is (2 pi/N)²/12 of that, under 1.3 % from N = 16 on. What remains of
// the margin is for which facets the picture happens to hold.
TEST_CASE("bench: the error of facets falls fourfold when their segments double") {
  const BenchResult result = sweep(
      "picture = { size = [40, 30] }\n"
      "camera = { eye = [0.3, 0.4, 2], look_at = [0, 0, 0], view_height = 0.5 }\n"
      "light = [{ direction = [-0.4, -0.3, -1], intensity = 1 }]\n"
      "material.grey = { diffuse = 0.8 }\n"
      "sphere = [{ center = [0, 0, 0], radius = 1, material = 'grey' }]\n",
      {"tessellation=16,32,64"});
  double last = 0;
  for (const BenchPoint& point : result.points) {
    if (point.varied.empty()) {
      last = 0;
      continue;
    }
    const double now = rms(point, ErrorKind::model);
    CAPTURE(point.config[0].value);
    CHECK(now > 0);
    if (setting_of(point.config).faults.tessellate != 16) {
      CHECK(std::log2(last / now) > 1.8);
      CHECK(std::log2(last / now) < 2.2);
    }
    CHECK(point.mismatches == 0);  // of objects
    CHECK(point.error.whole.depth > 0);
    last = now;
  }
}

// With u = 2^-24 and every float operation and rounded input off by u at most, to first order:
//   L         3 u for the offset, 9 u for its square, so 5.5 u for d, 1 u for 1/d, and products: 10.5 u
//   N.L       10.5 u, 1 u for N, 3 u for products and sums: 14.5 u
//   diffuse   14.5 u, and 5 u for I, kd and three products: 20 u of I kd
//   Rl - V    2 (14.5 + 1) u for 2 (N.L) N and its roundings, 10.5 u for L, 5 u for V and the differences: 48 u
//   x         = |Rl - V|²/2: 48 u sqrt(2 x) + 4 u x
//   (1-x)^s   s (1-x)^(s-1) dx, whose first part is at most 48 u sqrt(s) e^-1/2 s/(s-1) (at x = 1/2s), the second
//             4 u/e; log1p to 8 u and a product: 9 u/e; exp: 4 u; together (30 sqrt(s) + 9) u for s >= 64
//   specular  that, and 5 u for I, ks and three products
//   sums      8 u of the value: terms, c1, the mirrored part, the pictures' own roundings
// And light by way of a mirror is as much again, times c2, and so on: 1 / (1 - c2).
TEST_CASE("bench: exact settings show every surface right and are off by rounding alone") {
  constexpr double kd = 0.6, ks = 0.5, s = 64, c2 = 0.25, u = 0x1p-24;
  const BenchResult result = sweep(
      "picture = { size = [80, 60] }\n"
      "ambient = 0.2\n"
      "camera = { eye = [0, 2, 6], look_at = [0, 0.5, 0], view_height = 0.6 }\n"
      "light = [{ position = [3, 5, 4], intensity = 0.5 }, { direction = [1, -2, -1], intensity = 0.5 }]\n"
      "material.shiny = { ambient = 1, diffuse = 0.6, specular = 0.5, shininess = 64, reflect = 0.25 }\n"
      "sphere = [{ center = [0, 0.7, 0], radius = 1, material = 'shiny' }]\n"
      "plane = [{ point = [0, -0.3, 0], normal = [0, 1, 0], material = 'shiny' }]\n",
      {"samples=1,4", "isa=scalar,best"});
  const double greatest = (0.2 + kd + ks) / (1 - c2);
  const double bound = u * (20 * kd + (30 * std::sqrt(s) + 14) * ks + 8 * greatest) / (1 - c2);
  REQUIRE(result.points.size() == 6);  // the z-buffer's isa knob doubles its two
  for (const BenchPoint& point : result.points) {
    CAPTURE(point.config[0].value);
    CAPTURE(point.varied);
    CHECK(point.mismatches == 0);
    CHECK(point.failures.empty());
    CHECK(point.error.whole.depth == 0);
    const PictureError& arithmetic = point.by_kind[static_cast<std::size_t>(ErrorKind::arithmetic)].value();
    CHECK(arithmetic.whole.metrics.max.value > 0);
    CHECK(arithmetic.whole.metrics.max.value <= bound);
    // The kinds add up to the whole, as sides of a polygon do.
    const double sum =
        rms(point, ErrorKind::arithmetic) + rms(point, ErrorKind::model) + rms(point, ErrorKind::sampling);
    CHECK(point.error.whole.metrics.rms <= sum * (1 + 1e-12));
  }
  const ReferenceImage& reference = result.scenes[0].reference;
  REQUIRE(reference.against_brute_force.has_value());
  CHECK(*reference.against_brute_force <= 4 * u * greatest);  // both in double: rounded to float twice each
}

// Float decides edges wrongly where snapped vertices or a coarse depth do: each shows in its own count.
TEST_CASE("bench: a fault fails the gate, by the samples it spoils") {
  const std::string path = SIDELIGHT_SOURCE_DIR "/scenes/hard/depth-format.toml";
  SweepPlan plan{{path},
                 glm::ivec2(64, 48),
                 product_configs({"renderer=raster", "depth-format=unorm16"}),
                 7,
                 false,
                 PictureCache(""),
                 nullptr,
                 {},
                 {}};
  const BenchResult result = run_sweep(plan);
  CHECK(result.points[0].failures.empty());
  CHECK(result.points[1].mismatches > 0);
  REQUIRE(result.points[1].failures.size() == 2);
  CHECK(result.points[1].failures[0].find("another surface") != std::string::npos);
  CHECK(result.points[1].failures[1].find("hard cases: ") == 0);
}

// In little, so that only which surface is seen and what rounding does are judged here; not the fronts, which need times.
TEST_CASE("bench: on shipped scenes the exact settings show every surface right, with rounding errors only") {
  std::vector<std::string> names = test::tier_list("walk_pictures");
  if (names == std::vector<std::string>{"all"}) {
    names.clear();
    for (const auto& entry : std::filesystem::directory_iterator(SIDELIGHT_SOURCE_DIR "/scenes"))
      if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  }
  for (const std::string& name : names) {
    CAPTURE(name);
    SweepPlan plan{{SIDELIGHT_SOURCE_DIR "/scenes/" + name + ".toml"},
                   glm::ivec2(16, 12),
                   sweep_configs("default"),
                   7,
                   false,
                   PictureCache(""),
                   nullptr,
                   {},
                   {}};
    const BenchResult result = run_sweep(plan);
    for (const BenchPoint& point : result.points) {
      CAPTURE(point.varied);
      CHECK(point.finished);
      CHECK(point.error.whole.metrics.non_finite == 0);
      if (setting_of(point.config).faults.any()) continue;
      CHECK(point.failures.empty());
      // As the tests of the references allow between float and double; the shipped scenes' values are around 1.
      CHECK(point.by_kind[0]->whole.metrics.max.value <= 1e-5);
    }
  }
}
