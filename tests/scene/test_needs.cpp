// SPDX-License-Identifier: MIT
// What a scene needs, and that nothing else is needed: a claim beyond it changes no bit.
#include "common/scene/needs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "tests/support/random.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// A glass ball of radius 1.
void add_glass(Scene& scene, const glm::dvec3& center) {
  Material glass;
  glass.refract = glm::dvec3(0.9);
  glass.ior = 1.5;
  Sphere ball;
  ball.center = center;
  ball.material = add_material(scene, glass);
  add_sphere(scene, ball, {});
}

std::vector<std::string_view> names(const Scene& scene) {
  const Needs needs = needs_of(scene);
  std::vector<std::string_view> out;
  for (std::size_t i = 0; i < kNeeds; ++i)
    if (needs.has[i]) out.push_back(kNeedNames[i]);
  return out;
}

using Names = std::vector<std::string_view>;

}  // namespace

TEST_CASE("needs: an empty scene needs nothing") { CHECK(names(Scene{}) == Names{}); }

TEST_CASE("needs: a mirror counts where it is used and where reflection is on") {
  Scene scene = empty_scene();
  Material mirror;
  mirror.reflect = {0, 0, 0.1};
  Sphere ball;
  ball.material = add_material(scene, mirror);
  CHECK(names(scene) == Names{});
  add_sphere(scene, ball, {});
  CHECK(names(scene) == Names{"mirrors", "spheres"});
  scene.trace.secondary_attenuation = {1, 0, 0.5};
  CHECK(names(scene) == Names{"mirrors", "secondary attenuation", "spheres"});
  scene.trace.reflection = false;
  CHECK(names(scene) == Names{"spheres"});
}

TEST_CASE("needs: lights count where they are not black, their fall where it is one") {
  Scene scene = empty_scene();
  Light light;
  light.attenuation = {0, 0, 1};
  scene.lights = {light};
  CHECK(names(scene) == Names{});
  scene.lights[0].intensity.y = 1;
  CHECK(names(scene) == Names{"light attenuation", "live lights"});
  scene.lights[0].directional = true;  // no distance to fall with
  CHECK(names(scene) == Names{"live lights"});
  scene.lights[0].directional = false;
  scene.lights[0].attenuation = {};
  CHECK(names(scene) == Names{"live lights"});
}

TEST_CASE("needs: solids overlap where their bounds meet, touching included") {
  for (const auto& [second, meet] :
       std::vector<std::pair<double, bool>>{{1.5, true}, {2, true}, {2.001, false}}) {
    Scene scene = empty_scene();
    add_glass(scene, {0, 0, 0});
    add_glass(scene, {second, 0, 0});
    CHECK_MESSAGE(needs_of(scene)[Need::overlapping_solids] == meet, second);
    // A third between the two, in the file's order or not
    Scene three = empty_scene();
    add_glass(three, {second, 0, 0});
    add_glass(three, {-10, 0, 0});
    add_glass(three, {0, 0, 0});
    CHECK_MESSAGE(needs_of(three)[Need::overlapping_solids] == meet, second);
  }
}

TEST_CASE("needs: bounds meet where they touch") {
  const Bounds first{glm::dvec3(0), glm::dvec3(1)}, second{glm::dvec3(1, 0, 0), glm::dvec3(2)};
  CHECK(first.meets(second));
  CHECK(second.meets(first));
}

TEST_CASE("needs: pairs of bounds that meet are those that two loops find, each once") {
  Random random(31);
  std::vector<Bounds> bounds;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 low = random.on_grid(20), size = glm::abs(random.on_grid(4));
    bounds.push_back({low, low + size});
  }
  const double all = std::numeric_limits<double>::infinity();
  bounds[100] = {glm::dvec3(-all), {all, 0, all}};
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  Pairs expected, found;
  for (std::size_t i = 0; i < bounds.size(); ++i)
    for (std::size_t j = i + 1; j < bounds.size(); ++j)
      if (bounds[i].meets(bounds[j])) expected.emplace_back(i, j);
  const auto visit = [&](std::size_t i, std::size_t j) {
    found.emplace_back(std::min(i, j), std::max(i, j));
    return true;
  };
  CHECK(visit_meeting(bounds, visit));
  std::ranges::sort(found);
  CHECK(found.size() > 200);
  CHECK(found == expected);

  int visits = 0;
  CHECK_FALSE(visit_meeting(bounds, [&](std::size_t, std::size_t) { return ++visits < 3; }));
  CHECK(visits == 3);
}

TEST_CASE("needs: of more rods beside each other than can be looked at in pairs, some may meet") {
  // They begin along x, farthest apart, and are as long as that; beside each other along y.
  const auto rods = [](int count) {
    std::vector<Bounds> out;
    for (int i = 0; i < count; ++i) out.push_back({{4.0 * i, i, 0}, {4.0 * (i + count), i + 0.5, 1}});
    return out;
  };
  int visits = 0;
  const auto visit = [&](std::size_t, std::size_t) { return ++visits > 0; };
  CHECK(visit_meeting(rods(1000), visit));
  CHECK_FALSE(visit_meeting(rods(100'000), visit));  // 5e9 pairs
  CHECK(visits == 0);
}

TEST_CASE("needs: a long row of balls along any axis, which do not meet but for the last") {
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    Scene scene = empty_scene();
    glm::dvec3 center(0);
    for (int i = 0; i < 20'000; ++i, center[axis] += 3) add_glass(scene, center);
    CHECK_FALSE(needs_of(scene)[Need::overlapping_solids]);
    center[axis] -= 4;
    add_glass(scene, center);
    CHECK(needs_of(scene)[Need::overlapping_solids]);
  }
}

TEST_CASE("needs: water is a half-space, bounded above where its surface is level") {
  for (const auto& [height, meet] : std::vector<std::pair<double, bool>>{{-1, true}, {-1.001, false}}) {
    Scene scene = empty_scene();
    add_glass(scene, {0, 0, 0});
    Plane water;
    water.point = {5, height, 7};
    water.material = scene.spheres[0].material;
    add_plane(scene, water, {});
    CHECK_MESSAGE(needs_of(scene)[Need::overlapping_solids] == meet, height);
    scene.planes[0].normal = glm::normalize(glm::dvec3(1, 8, 0));
    CHECK(needs_of(scene)[Need::overlapping_solids]);
  }
}
