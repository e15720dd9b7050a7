// SPDX-License-Identifier: MIT
// An explanation is the picture's own story: on random pixels of every scene its root is the picture's colour in every
// bit, the fragment that won is the picture's, and its terms add up to the root.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "common/model/explanation.h"
#include "common/scene/toml.h"
#include "raster/raster.h"
#include "raytrace/raytrace.h"
#include "tests/agreement/pictures.h"
#include "tests/support/random.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

int deepest(const RayRecord& ray) {
  int depth = ray.depth;
  for (const RayRecord& child : ray.children) depth = std::max(depth, deepest(child));
  return depth;
}

// Rays, lights and surfaces that were passed.
std::size_t record_count(const RayRecord& ray) {
  std::size_t count = 1 + ray.passed.size() + ray.local.lights.size();
  for (const RayRecord& child : ray.children) count += record_count(child);
  return count;
}

// |sum of leaves - root| <= (leaves + 4 depth) 2^-24 sum |leaf|: each leaf is added once, and on its way to the root is
// multiplied by c, w and c1 and added to its siblings, each time with one rounding.
void check_leaves(const RayRecord& root) {
  glm::dvec3 sum(0), size(0);
  const std::vector<glm::dvec3> terms = leaves(root);
  for (const glm::dvec3& term : terms) {
    sum += term;
    size += glm::abs(term);
  }
  const double bound = (static_cast<double>(terms.size()) + 4.0 * deepest(root)) * 0x1p-24;
  for (int c = 0; c < 3; ++c) CHECK(std::abs(sum[c] - static_cast<double>(root.color[c])) <= bound * size[c]);
}

// Of each ray its place in the tree; of a light that is missing why: something stands in between, or else the surface
// stands in its own light.
void check_rays(const RayRecord& ray) {
  for (const LightRecord& light : ray.local.lights) {
    CHECK((!light.seen || light.blocker == kNone));
    CHECK(light.self_shadowed == (!light.seen && light.blocker == kNone));
  }
  for (const RayRecord& child : ray.children) {
    const glm::vec3& c = child.coefficient;
    const double weight = ray.path_weight * static_cast<double>(std::max({c.x, c.y, c.z}));
    CHECK(child.path_weight == doctest::Approx(weight).epsilon(1e-6));
    CHECK(child.depth == ray.depth + 1);
    check_rays(child);
  }
}

void check_scene(const std::string& file, std::uint64_t seed) {
  CAPTURE(file);
  const Scene scene = load_scene(file);
  const Camera camera = make_camera(scene.camera, 160, 121, 1);
  RenderOptions options;
  options.keep_samples = true;
  const auto rasterizer = raster::prepare(scene);
  const auto tracer = raytrace::prepare(scene);
  const Frame flat = raster::render(*rasterizer, camera, options),
              deep = raytrace::render(*tracer, camera, options);

  test::Random random(seed);
  for (std::uint64_t i = 0; i < test::tier_count("explained_pixels"); ++i) {
    const int x = static_cast<int>(random.uniform() * camera.width),
              y = static_cast<int>(random.uniform() * camera.height);
    CAPTURE(x);
    CAPTURE(y);
    const std::size_t at = flat.index(x, y);

    const RasterRecord why_flat = raster::explain(*rasterizer, camera, x, y);
    CHECK(why_flat.color == flat.color[at]);
    CHECK(why_flat.background == (flat.sample_primitive[at] == kNone));
    if (!why_flat.background) {
      CHECK(why_flat.local.hit.primitive == flat.sample_primitive[at]);
      CHECK(why_flat.local.hit.t == flat.sample_depth[at]);
      for (const FragmentRecord& fragment : why_flat.fragments)
        CHECK_FALSE(before(fragment.hit, why_flat.local.hit));
    }
    const RayRecord why_deep = raytrace::explain(*tracer, camera, x, y);
    CHECK(why_deep.color == deep.color[at]);
    check_leaves(why_deep);
    check_rays(why_deep);
  }
}

// With n x n samples a pixel's colour is the mean of its samples' roots, in every bit, in a crop as in the whole.
void check_means(const std::string& file, int n, std::uint64_t seed) {
  CAPTURE(file);
  const Scene scene = load_scene(file);
  const Camera camera = make_camera(scene.camera, 61, 47, n);
  const auto rasterizer = raster::prepare(scene);
  const auto tracer = raytrace::prepare(scene);
  const Frame flat = raster::render(*rasterizer, camera, {}), deep = raytrace::render(*tracer, camera, {});
  test::Random random(seed);
  for (int left = tier() == "sanitized" ? 3 : 12; left > 0; --left) {
    const int x = static_cast<int>(random.below(61)), y = static_cast<int>(random.below(47));
    CAPTURE(x);
    CAPTURE(y);
    PixelMean flat_mean, deep_mean;
    for (int sample = 0; sample < n * n; ++sample) {
      const int X = n * x + sample % n, Y = n * y + sample / n;
      flat_mean.add(raster::explain(*rasterizer, camera, X, Y).color);
      const RayRecord root = raytrace::explain(*tracer, camera, X, Y);
      check_leaves(root);
      deep_mean.add(root.color);
    }
    CHECK(flat_mean.mean(n * n) == flat.color[flat.index(x, y)]);
    CHECK(deep_mean.mean(n * n) == deep.color[deep.index(x, y)]);

    RenderOptions cropped;
    cropped.crop = {x, y, x + 1, y + 1};
    CHECK(raster::render(*rasterizer, camera, cropped).color[0] == flat.color[flat.index(x, y)]);
    CHECK(raytrace::render(*tracer, camera, cropped).color[0] == deep.color[deep.index(x, y)]);
  }
}

}  // namespace

TEST_CASE("explain: the mean of the samples' roots is the pixel on every scene, cropped or not") {
  std::uint64_t seed = 1;
  for (const std::string& file : shipped_scenes()) check_means(file, 3, seed++);
  check_means(kEverything, 2, seed);
}

TEST_CASE("explain: the root is the picture's colour and the leaves add up to it on every scene") {
  std::uint64_t seed = 1;
  for (const std::string& file : shipped_scenes()) check_scene(file, seed++);
}

TEST_CASE("explain: a budget of records suffices to the last one, and ends with its cancel") {
  const Scene scene = load_scene(SIDELIGHT_SOURCE_DIR "/scenes/13-everything.toml");
  const Camera camera = make_camera(scene.camera, 64, 48, 1);
  const auto tracer = raytrace::prepare(scene);
  constexpr std::size_t kPlenty = 1'000'000;
  std::size_t most = 0;
  for (int X = 2; X < 64; X += 6) {
    raytrace::ExplainBudget budget{kPlenty};
    const RayRecord told = raytrace::explain(*tracer, camera, X, 24, budget);
    const std::size_t taken = kPlenty - budget.records;
    CHECK(taken == record_count(told));
    most = std::max(most, taken);
    raytrace::ExplainBudget exact{taken};
    CHECK(raytrace::explain(*tracer, camera, X, 24, exact).color == told.color);
    CHECK(exact.records == 0);
    raytrace::ExplainBudget short_of_one{taken - 1};
    CHECK_THROWS_AS(raytrace::explain(*tracer, camera, X, 24, short_of_one), raytrace::TooManyRays);
  }
  CHECK(most > 10);
  const std::atomic<bool> cancel{true};
  raytrace::ExplainBudget cancelled{kPlenty, &cancel};
  CHECK_THROWS_AS(raytrace::explain(*tracer, camera, 32, 24, cancelled), Interrupted);
}
