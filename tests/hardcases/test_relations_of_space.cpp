// SPDX-License-Identifier: MIT
// Metamorphic relations of space: scenes that are moved, scaled or seen by more samples, and the pictures that must not
// care (MET-1, 2, 5, 13, 15).
#include "raytrace/prepared.h"
#include "tests/hardcases/relations.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// A highlight's error by the kernel is (24 s + 24) 2^-24 at most (tests/model/test_phong.cpp), once for each picture,
// of each light; s = 120 and two lights at most here, and every weight at most 1.
constexpr double kGlossy = 2 * 2 * (24 * 120 + 24) * 0x1p-24;

// All coordinates multiples of 2^-20.
Scene on_grid(Scene scene) {
  for (Sphere& s : scene.spheres) s.radius = snapped(s.radius);
  return moved(
      std::move(scene), [](const glm::dvec3& p) { return snapped(p); },
      [](const glm::dvec3& d) { return d; });
}

void report(const HardCase& hard, const std::string& what, const Likeness& glossy, const Likeness& dull,
            double bound) {
  hard.none(what + ": pixels with another surface", glossy.surfaces + dull.surfaces,
            glossy.pixels + dull.pixels);
  hard.at_most(what + ": matte colours, difference in units of eps", dull.color / kFloatEps, bound);
  hard.at_most(what + ": colours with highlights, in units of 2 lights (24 s + 24) 2^-24 each",
               glossy.color / kGlossy, 1);
}

}  // namespace

TEST_CASE("MET-1: a rigid motion of everything leaves the picture as it is") {
  const HardCase hard("MET-1");
  const Scene scene = everything(), dull = matte(scene);

  // Quarter turns move no bit of a coordinate, only the order of sums.
  const auto about_y = [](const glm::dvec3& p) { return glm::dvec3(p.z, p.y, -p.x); };
  const auto about_x = [](const glm::dvec3& p) { return glm::dvec3(p.x, -p.z, p.y); };
  const auto upside_down = [](const glm::dvec3& p) { return glm::dvec3(-p.x, -p.y, p.z); };
  Likeness glossy, flat;
  const auto quarter = [&](const auto& turn) {
    const Scene a = turned(scene, turn), b = turned(dull, turn);
    glossy.add(rastered(scene, relation_camera(scene)), rastered(a, relation_camera(a)));
    glossy.add(traced(scene, relation_camera(scene)), traced(a, relation_camera(a)));
    flat.add(rastered(dull, relation_camera(dull)), rastered(b, relation_camera(b)));
    flat.add(traced(dull, relation_camera(dull)), traced(b, relation_camera(b)));
  };
  quarter(about_y);
  quarter(about_x);
  quarter(upside_down);
  report(hard, "quarter turns", glossy, flat, 8);

  // A translation on a grid moves no bit of a difference of coordinates: depths stay, too.
  const Scene grid = on_grid(scene);
  const auto far = [](const glm::dvec3& p) { return p + glm::dvec3(1024, -512, 256); };
  const auto same = [](const glm::dvec3& d) { return d; };
  const Likeness away = likeness(grid, moved(grid, far, same));
  report(hard, "a translation on the grid", away, likeness(matte(grid), moved(matte(grid), far, same)), 8);
  hard.none("a translation on the grid: pixels with another depth", away.depths, away.pixels);

  // Any rotation rounds every coordinate.
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  const double c = std::cos(1.1), s = std::sin(1.1);
  const auto any = [&](const glm::dvec3& p) {
    return c * p + s * glm::cross(axis, p) + (1 - c) * glm::dot(axis, p) * axis;
  };
  const Likeness turned_any = likeness(dull, turned(dull, any));
  hard.none("any rotation: pixels with another surface", turned_any.surfaces, turned_any.pixels);
  hard.at_most("any rotation: matte colours", turned_any.color, 1e-5);
}

TEST_CASE("MET-2: scaling everything by a power of two changes no bit") {
  const Scene scene = everything();
  std::uint64_t unlike = 0, depths = 0, pixels = 0, pictures = 0;
  const Camera camera = relation_camera(scene);
  const Frame flat = rastered(scene, camera), deep = traced(scene, camera);
  const int step = tier() == "sanitized" ? 8 : 1;
  for (int k = -20; k <= 20; k += step) {
    const double by = std::exp2(k);
    const auto scaled = [&](const glm::dvec3& p) { return by * p; };
    Scene other = moved(scene, scaled, [](const glm::dvec3& d) { return d; });
    for (Sphere& s : other.spheres) s.radius *= by;
    const auto rescale = [&](Attenuation& q) {
      q.q1 /= by;
      q.q2 /= by * by;
    };
    for (Light& l : other.lights) rescale(l.attenuation);
    rescale(other.trace.secondary_attenuation);
    const Camera far = relation_camera(other);
    for (auto& [before, after] :
         {std::pair(&flat, rastered(other, far)), std::pair(&deep, traced(other, far))}) {
      Frame expected = *before;
      for (double& t : expected.sample_depth) t *= by;
      for (float& t : expected.depth) t *= static_cast<float>(by);
      const std::string what = differences(after, expected);
      CAPTURE(k);
      CAPTURE(what);
      CHECK(what == "");
      ++pictures;
      unlike += !what.empty();
      for (std::size_t i = 0; i < after.pixels(); ++i) {
        ++pixels;
        depths += after.sample_depth[i] != expected.sample_depth[i];
      }
    }
  }
  const HardCase hard("MET-2");
  hard.none("pictures with any other bit, 2^-20 to 2^20", unlike, pictures);
  hard.none("depths that do not scale exactly", depths, pixels);
}

// ---- MET-5 ----

TEST_CASE("MET-5: the centre samples of a picture of odd multiples are the picture") {
  const HardCase hard("MET-5");
  const Scene scene = everything();
  const int width = 67, height = 49;
  const Camera camera = make_camera(scene.camera, width, height, 1);
  const Frame frames[2]{rastered(scene, camera), traced(scene, camera)};
  std::uint64_t unlike = 0, pixels = 0, nowhere = 0, looked_up = 0;
  for (const int times : {3, 5}) {
    const Camera larger = make_camera(scene.camera, times * width, times * height, 1);
    const Frame large[2]{rastered(scene, larger), traced(scene, larger)};
    for (int which = 0; which < 2; ++which)
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const std::size_t i = large[which].index(times * x + times / 2, times * y + times / 2);
          ++pixels;
          unlike += large[which].primitive_id[i] != frames[which].primitive_id[frames[which].index(x, y)];
        }
  }
  hard.none("pixels whose surface is not that of the centre sample, 3 and 5 times as large", unlike, pixels);

  // Twice and four times as large, centres do not coincide: the surface is seen in the block or the eight around it.
  for (const int times : {2, 4}) {
    const Camera larger = make_camera(scene.camera, times * width, times * height, 1);
    const Frame large = rastered(scene, larger);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        bool found = false;
        const std::uint32_t id = frames[0].object_id[frames[0].index(x, y)];
        for (int Y = std::max(0, times * (y - 1)); Y < std::min(times * height, times * (y + 2)); ++Y)
          for (int X = std::max(0, times * (x - 1)); X < std::min(times * width, times * (x + 2)); ++X)
            found = found || large.object_id[large.index(X, Y)] == id;
        ++looked_up;
        nowhere += !found;
      }
  }
  hard.at_most("share of pixels whose object is not seen around them, 2 and 4 times as large",
               static_cast<double>(nowhere) / static_cast<double>(looked_up), 1e-4);
}

// Light that varies smoothly: over a pixel of width h, f'' h² / 32 lies between the centre and the mean of its 2 x 2
// parts, 5 f'' h² / 128 of its 4 x 4, for each of two axes; and of its three samples in a row along an axis, h apart, two
// differ by f'' h² / 2 at least. So centre and mean are at most 10 / 64 of the greatest difference among the pixel and its
// eight neighbours apart; a quarter leaves room for what is not square in f. Only where all of them show one surface.
TEST_CASE("MET-5: away from edges the mean of a picture twice or four times as large is the picture") {
  const Scene scene = local_only(matte(everything()));
  const int width = 67, height = 49;
  const Camera camera = make_camera(scene.camera, width, height, 1);
  std::uint64_t pixels = 0;
  double worst = 0;
  const Frame frames[2]{rastered(scene, camera), traced(scene, camera)};
  for (const int times : {2, 4}) {
    const Camera larger = make_camera(scene.camera, times * width, times * height, 1);
    const Frame large[2]{rastered(scene, larger), traced(scene, larger)};
    for (int which = 0; which < 2; ++which)
      for (int y = 1; y < height - 1; ++y)
        for (int x = 1; x < width - 1; ++x) {
          const Frame& frame = frames[which];
          const std::size_t i = frame.index(x, y);
          bool one_surface = true;
          double low = INFINITY, high = -INFINITY, mean = 0;
          for (int Y = y - 1; Y <= y + 1; ++Y)
            for (int X = x - 1; X <= x + 1; ++X) {
              const std::size_t j = frame.index(X, Y);
              one_surface = one_surface && frame.primitive_id[j] == frame.primitive_id[i];
              low = std::min(low, double{frame.color[j].y});
              high = std::max(high, double{frame.color[j].y});
            }
          for (int Y = times * y; Y < times * (y + 1); ++Y)
            for (int X = times * x; X < times * (x + 1); ++X) {
              const std::size_t j = large[which].index(X, Y);
              one_surface = one_surface && large[which].primitive_id[j] == frame.primitive_id[i];
              mean += double{large[which].color[j].y} / (times * times);
            }
          if (!one_surface || low == 0) continue;  // where light begins, it bends
          ++pixels;
          worst = std::max(
              worst, std::abs(mean - double{frame.color[i].y}) / ((high - low) / 4 + 8 * kFloatEps * high));
        }
  }
  const HardCase hard("MET-5");
  hard.at_least("pixels away from edges", static_cast<double>(pixels), 4 * 1500);
  hard.at_most("mean of a pixel's parts off its centre, in quarters of the differences around it", worst, 1);
}

// ---- MET-13 ----

TEST_CASE("MET-13: a shadow ray from A to B is blocked iff that from B to A is") {
  Scene scene = empty_scene();
  Transform aside;
  aside.translate = {1.5, 0.25, 0};
  add_mesh(scene, star_sphere(12, 16, 0.4, 17), aside, {});
  add_sphere(scene, {{-1.25, 0.5, 0.3}, 0.7, 0}, {});
  add_plane(scene, {{0, -1, 0}, {0.1, 1, 0.05}, 0}, {});
  const raytrace::Prepared prepared(scene);
  Random random(13);
  VisibilityCounts counts;
  std::uint64_t disagreeing = 0, pairs = 0, blocked = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const glm::dvec3 a = random.in_box(3), b = random.in_box(3);
    const bool there = raytrace::blocker(prepared, make_ray(a, b - a), &b, counts).found();
    const bool back = raytrace::blocker(prepared, make_ray(b, a - b), &a, counts).found();
    ++pairs;
    blocked += there;
    disagreeing += there != back;
  }
  const HardCase hard("MET-13");
  hard.none("pairs of points that see each other one way only", disagreeing, pairs);
  hard.at_least("share of pairs that something separates",
                static_cast<double>(blocked) / static_cast<double>(pairs), 0.2);
}

// ---- MET-15 ----

TEST_CASE("MET-15: permuting the axes changes no surface") {
  const auto yzx = [](const glm::dvec3& p) { return glm::dvec3(p.y, p.z, p.x); };
  const auto zxy = [](const glm::dvec3& p) { return glm::dvec3(p.z, p.x, p.y); };
  Likeness glossy, dull;
  for (const Scene& scene : {everything(), matte(everything())}) {
    Likeness& to = scene.materials[0].specular.x > 0 ? glossy : dull;
    for (const Scene& other : {turned(scene, yzx), turned(scene, zxy)}) {
      to.add(rastered(scene, relation_camera(scene)), rastered(other, relation_camera(other)));
      to.add(traced(scene, relation_camera(scene)), traced(other, relation_camera(other)));
    }
  }
  report(HardCase("MET-15"), "axes permuted", glossy, dull, 8);
}
