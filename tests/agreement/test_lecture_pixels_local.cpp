// SPDX-License-Identifier: MIT
// Pixels of the lecture scenes 1 to 6 and 11 worked out by hand: local light, who is in front, and who stands in the
// light. Read each comment beside the scene file; all that is needed is a pocket calculator.
//
// Two tricks. A ray that aims at a sphere's centre meets it where N = V, so that Rl.V = 2 (N.L)(N.V) - L.V = N.L. And a
// point on the floor y = 0, N = (0, 1, 0), below a lamp of height y at distance d has N.L = y / d.
#include <cmath>

#include "tests/agreement/lesson.h"

using namespace sidelight;
using namespace sidelight::test;
using glm::dvec3;
using std::sqrt;

// The picture is 6 high at the balls' plane z = 0, so 15 rows of pixels are 0.4 apart, and in a picture of 21 columns
// pixel (4, 4) looks at (-2.4, 1.2, 0), pixel (10, 4) at (0, 1.2, 0), pixel (16, 4) at (2.4, 1.2, 0): the balls' centres.
TEST_CASE("lecture pixels: 01 ambient") {
  const Lesson lesson("01-ambient");
  const dvec3 clay(0.8, 0.34, 0.2);
  lesson.has_eye({0, 0, 20});
  lesson.has_view_height(0.3);
  lesson.has_background({0.010, 0.012, 0.020});
  lesson.has_ambient(grey(0.3));
  lesson.has_sun(0, dvec3(-6, 3, 2) / 7.0, grey(0.9));
  lesson.has_material({.name = "ambient_only", .ambient = clay});
  lesson.has_material({.name = "diffuse_only", .diffuse = clay});
  lesson.has_material({.name = "both", .ambient = clay, .diffuse = clay});

  const PictureSize size{21, 15};
  lesson.shows(size, 0, 0, {0.010, 0.012, 0.020});
  // ka Ia
  lesson.shows(size, 4, 4, {0.24, 0.102, 0.06});
  // V = (0, -1.2, 20)/sqrt(401.44), N.L = (3 (-1.2) + 2 * 20)/(7 * 20.03597) = 36.4/140.2518 = 0.259533
  const double middle = 36.4 / (7 * sqrt(401.44));
  lesson.shows(size, 10, 4, 0.9 * middle * clay);
  // V = (-2.4, -1.2, 20)/sqrt(407.2), N.L = (14.4 - 3.6 + 40)/(7 * 20.17920) = 50.8/141.2544 = 0.359635
  const double right = 50.8 / (7 * sqrt(407.2));
  lesson.shows(size, 16, 4, 0.3 * clay + 0.9 * right * clay);
}

// A slope of tilt a has N = (-sin a, cos a, 0), and N.L = cos a for L = (0, 1, 0). The points are the middles of the
// first, third and fifth slope; nothing hangs above them.
TEST_CASE("lecture pixels: 02 diffuse") {
  const Lesson lesson("02-diffuse");
  const dvec3 paper(0.85, 0.75, 0.6), air(0.1, 0.1, 0.12);
  lesson.has_eye({-0.5, 5.08, 10.56});
  lesson.has_ambient(air);
  lesson.has_sun(0, {0, 1, 0}, grey(1));
  lesson.has_material({.name = "paper", .ambient = paper, .diffuse = paper});

  lesson.sees({-3.5, 0, 0}, paper * (air + 1.0));          // 0.935, 0.825, 0.672
  lesson.sees({-0.5, 0.375, 0}, paper * (air + 4.0 / 5));  // 0.765, 0.675, 0.552
  lesson.sees({2.5, 1.2, 0}, paper * (air + 5.0 / 13));
}

// The balls stand as in the first scene, three below. L = (2, 3, 6)/7; N = V gives ka Ia + kd c + ks c^s, c = N.L.
TEST_CASE("lecture pixels: 03 specular") {
  const Lesson lesson("03-specular");
  const dvec3 ka(0.10, 0.30, 0.36), kd(0.06, 0.20, 0.25);
  lesson.has_eye({0, 0, 20});
  lesson.has_view_height(0.3);
  lesson.has_ambient(grey(0.15));
  lesson.has_sun(0, dvec3(2, 3, 6) / 7.0, grey(1));
  for (const int s : {1, 5, 20, 80})
    lesson.has_material({.name = "s" + std::to_string(s),
                         .ambient = ka,
                         .diffuse = kd,
                         .specular = grey(0.7),
                         .shininess = static_cast<double>(s)});

  const PictureSize size{21, 15};
  const auto shown = [&](double c, int s) { return 0.15 * ka + c * kd + 0.7 * std::pow(c, s); };
  // V = (2.4, -1.2, 20)/20.17920: c = (4.8 - 3.6 + 120)/141.2544 = 0.858027
  lesson.shows(size, 4, 4, shown(121.2 / (7 * sqrt(407.2)), 1));
  // V = (0, -1.2, 20)/20.03597: c = (-3.6 + 120)/140.2518 = 0.829936, c^5 = 0.393746
  lesson.shows(size, 10, 4, shown(116.4 / (7 * sqrt(401.44)), 5));
  // V = (-2.4, -1.2, 20)/20.17920: c = (-4.8 - 3.6 + 120)/141.2544 = 0.790064, c^20 = 0.008980
  lesson.shows(size, 16, 4, shown(111.6 / (7 * sqrt(407.2)), 20));
  // V = (2.4, 1.2, 20)/20.17920: c = (4.8 + 3.6 + 120)/141.2544 = 0.909998, c^80 = 0.000528
  lesson.shows(size, 4, 10, shown(128.4 / (7 * sqrt(407.2)), 80));
}

TEST_CASE("lecture pixels: 04 many lights") {
  const Lesson lesson("04-many-lights");
  const dvec3 red(0.7, 0.1, 0.1), green(0.1, 0.7, 0.1), blue(0.1, 0.1, 0.7);
  lesson.has_eye({0, 3.6, 9.6});
  lesson.has_ambient(grey(0.1));
  lesson.has_lamp(0, {-5, 4, 3}, red);
  lesson.has_lamp(1, {0, 7, 1}, green);
  lesson.has_lamp(2, {5, 4, 3}, blue);
  lesson.has_sphere(0, {0, 1, 0}, 1);
  lesson.has_material({.name = "paper", .ambient = grey(0.3), .diffuse = grey(0.75)});
  lesson.has_material(
      {.name = "white", .ambient = grey(0.3), .diffuse = grey(0.75), .specular = grey(0.5), .shininess = 60});

  // The floor at (0, 0, 2): to the lamps (-5, 4, 1), (0, 7, -1), (5, 4, 1), so N.L = 4/sqrt 42, 7/sqrt 50, 4/sqrt 42.
  lesson.sees({0, 0, 2}, 0.03 + 0.75 * (4 / sqrt(42.0) * (red + blue) + 7 / sqrt(50.0) * green));
  // At (2, 0, 3): (-7, 4, 0), (-2, 7, -2) and, with sides 3-4-5, (3, 4, 0): N.L = 4/sqrt 65, 7/sqrt 57, 4/5.
  lesson.sees({2, 0, 3}, 0.03 + 0.75 * (4 / sqrt(65.0) * red + 7 / sqrt(57.0) * green + 0.8 * blue));
  // The ball: N = V = (0, 2.6, 9.6)/9.945853, P = (0, 1, 0) + N = (0, 1.261415, 0.965226).
  // Red (and blue, mirrored): to it (-5, 2.738585, 2.034774), long 6.053111, N.L = 2.679926/6.053111 = 0.442735.
  // Green: (0, 5.738585, 0.034774), long 5.738690, N.L = 1.533719/5.738690 = 0.267259.
  // Here c^60 is below 1e-21: no highlight where the eye aims at the middle.
  const double side = 0.442735262, above = 0.267259472;
  lesson.sees({0, 1, 0}, 0.03 + 0.75 * (side * (red + blue) + above * green));
}

// The lamp is in the eye: L = V.
TEST_CASE("lecture pixels: 05 visibility") {
  const Lesson lesson("05-visibility");
  const dvec3 clay(0.6, 0.22, 0.14), brass(0.5, 0.36, 0.12);
  lesson.has_eye({0, 3.6, 9.6});
  lesson.has_ambient(grey(0.2));
  lesson.has_lamp(0, {0, 3.6, 9.6}, grey(0.9));
  lesson.has_sphere(0, {0, 1, 0}, 1.25);
  lesson.has_sphere(2, {-2.4, 0.9, 1.0}, 0.5);
  lesson.has_material({.name = "floor", .ambient = grey(0.35), .diffuse = grey(0.35)});
  lesson.has_material(
      {.name = "clay", .ambient = clay, .diffuse = clay, .specular = grey(0.25), .shininess = 40});
  lesson.has_material(
      {.name = "brass", .ambient = brass, .diffuse = brass, .specular = grey(0.4), .shininess = 60});

  // The floor at (0, 0, 3): V = (0, 3.6, 6.6)/sqrt(56.52), N.L = N.V = 3.6/7.517979 = 0.478852.
  lesson.sees({0, 0, 3}, grey(0.35 * (0.2 + 0.9 * 3.6 / sqrt(56.52))));
  // Towards the centre of ball and box. To the eye it is (0, 2.6, 9.6)/9.9459 = (0, 0.2614, 0.9652), which, turned back
  // by the box's 30 degrees, is (-0.4826, 0.2614, 0.8359): it leaves the box at 1/0.8359 = 1.196, before the ball's
  // 1.25. So the ball is in front, with N = V = L: ka Ia + 0.9 (kd + ks) = (0.885, 0.467, 0.379).
  lesson.sees({0, 1, 0}, 0.2 * clay + 0.9 * (clay + 0.25));
  // Likewise the ball of brass, which stands before the one of sage: (0.91, 0.756, 0.492).
  lesson.sees({-2.4, 0.9, 1.0}, 0.2 * brass + 0.9 * (brass + 0.4));
}

// The ball of radius 1 around C = (0, 1, 0) hides a lamp from P where the line from P passes C at less than 1; with
// v the way to the lamp and m = C - P that distance is sqrt(m.m - (m.v)²/(v.v)).
TEST_CASE("lecture pixels: 06 shadows") {
  const Lesson lesson("06-shadows");
  const dvec3 warm(0.62, 0.50, 0.36), cool(0.30, 0.40, 0.54), air(0.16, 0.16, 0.18);
  lesson.has_eye({0, 5.6, 12});
  lesson.has_ambient(air);
  lesson.has_lamp(0, {-3, 6, 2}, warm);
  lesson.has_lamp(1, {3, 6, -1}, cool);
  lesson.has_sphere(0, {0, 1, 0}, 1);
  lesson.has_material({.name = "floor", .ambient = grey(0.5), .diffuse = grey(0.6)});

  // (0, 0, 4), in no shadow: to the warm lamp (-3, 6, -2), long 7, to the cool one (3, 6, -5), long sqrt 70.
  lesson.sees({0, 0, 4}, 0.5 * air + 0.6 * (6.0 / 7 * warm + 6 / sqrt(70.0) * cool));
  // (-0.9, 0, 0.3): cool (3.9, 6, -1.3), v.v = 52.9, m.v = 9.9, m.m = 1.9: passes C at 0.22, hidden;
  // warm (-2.1, 6, 1.7), v.v = 43.3, m.v = 3.6: at 1.27, seen.
  lesson.sees({-0.9, 0, 0.3}, 0.5 * air + 0.6 * (6 / sqrt(43.3) * warm + 6 / sqrt(52.9) * cool),
              0.5 * air + 0.6 * 6 / sqrt(43.3) * warm);
  // (0.9, 0, -0.6): warm (-3.9, 6, 2.6), v.v = 57.97, m.v = 11.07, m.m = 2.17: at 0.24, hidden;
  // cool (2.1, 6, -0.4), v.v = 40.57, m.v = 3.87: at 1.34, seen.
  lesson.sees({0.9, 0, -0.6}, 0.5 * air + 0.6 * (6 / sqrt(57.97) * warm + 6 / sqrt(40.57) * cool),
              0.5 * air + 0.6 * 6 / sqrt(40.57) * cool);
}

// Each lamp stands 1 before its panel; 0.75 above its foot d = 1.25 and N.L = 0.8. Other lamps are behind the panel.
TEST_CASE("lecture pixels: 11 light attenuation") {
  const Lesson lesson("11-light-attenuation");
  const dvec3 lamp(0.95, 0.90, 0.80);
  lesson.has_eye({0, 1, 12});
  lesson.has_ambient(grey(0.05));
  lesson.has_lamp(0, {-3.6, 0, -0.2}, lamp);
  lesson.has_lamp(1, {0, 0, 1}, lamp);
  lesson.has_lamp(2, {3.6, 0, -0.2}, lamp);
  lesson.has_material({.name = "paper", .ambient = grey(0.9), .diffuse = grey(0.9)});

  const auto shown = [&](double f, double cosine) { return 0.9 * 0.05 + 0.9 * f * cosine * lamp; };
  lesson.sees({-3, 0.75, -1}, shown(1, 0.8));                 // q = (1, 0, 0)
  lesson.sees({0, 0.75, 0}, shown(1 / 1.25, 0.8));            // q = (0, 1, 0)
  lesson.sees({3, 0.75, -1}, shown(1 / (1.25 * 1.25), 0.8));  // q = (0, 0, 1)
  lesson.sees({0, 4.0 / 3, 0}, shown(0.6, 0.6));              // d = 5/3
}
