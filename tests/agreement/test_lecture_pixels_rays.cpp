// SPDX-License-Identifier: MIT
// Pixels of the lecture scenes 7 to 10 and 12 worked out by hand: what mirrored and refracted rays bring back. Where a
// shadow is not mentioned, nothing that casts one stands near the way to the lamp.
//
// A mirror shows what stands as far behind it as the thing before it: a ray that aims at the mirror image of a point
// meets that point. Numbers with seven digits are rounded; the rest is exact.
#include <cmath>

#include "tests/agreement/lesson.h"

using namespace sidelight;
using namespace sidelight::test;
using glm::dvec3;
using std::sqrt;

TEST_CASE("lecture pixels: 07 mirrors") {
  const Lesson lesson("07-mirrors");
  const dvec3 lamp(0.95, 0.92, 0.85), floor_a(0.26, 0.28, 0.31), floor_d(0.38, 0.40, 0.43),
      clay(0.7, 0.27, 0.16);
  lesson.has_eye({0.8, 2.4, 4.8});
  lesson.has_ambient(grey(0.2));
  lesson.has_lamp(0, {-2, 5, 2}, lamp);
  lesson.has_sphere(0, {-0.8, 0.7, 0}, 0.7);
  lesson.has_material({.name = "floor", .ambient = floor_a, .diffuse = floor_d});
  lesson.has_material({.name = "mirror", .ambient = grey(0.12), .diffuse = grey(0.04), .reflect = grey(0.8)});
  lesson.has_material(
      {.name = "clay", .ambient = clay, .diffuse = clay, .specular = grey(0.4), .shininess = 60});
  const auto mirror = [&](double cosine) { return 0.024 + 0.04 * cosine * lamp; };

  // In the ball's shadow on the floor, (0, 0, -0.6): to the lamp (-2, 5, 2.6), v.v = 35.76; to the ball's centre
  // (-0.8, 0.7, 0.6), m.m = 1.49, m.v = 6.66: the way passes it at sqrt(1.49 - 6.66²/35.76) = 0.50 < 0.7.
  lesson.sees({0, 0, -0.6}, 0.2 * floor_a + 5 / sqrt(35.76) * lamp * floor_d, 0.2 * floor_a);

  // Two mirrors and the floor. The ray falls 0.12 and goes 0.05 to the right for each 1 that it goes along z: from
  // the eye at z = 4.8 to the first mirror after 7.8 at (1.19, 1.464, -3), to the second after 15.8 at (1.59, 0.504, 5),
  // to the floor after 20 at (1.8, 0, 0.8).
  //   first mirror    to the lamp (-3.19, 3.536, 5),  long 6.905027, N.L = 5/6.905027 = 0.7241101
  //   second mirror   to the lamp (-3.59, 4.496, -3), long 6.488614, N.L = 3/6.488614 = 0.4623483
  //   floor           to the lamp (-3.8, 5, 1.2),     long 6.393747, N.L = 5/6.393747 = 0.7820141
  const dvec3 first = mirror(5 / sqrt(47.679396)), second = mirror(3 / sqrt(42.102116));
  const dvec3 below = 0.2 * floor_a + 5 / sqrt(40.88) * lamp * floor_d;
  lesson.sees({1.19, 1.464, -3}, first, first + 0.8 * (second + 0.8 * below));

  // The ball's image, centre (-0.8, 0.7, -6). The ray meets the mirror at 7.8/10.8 of the way, in (-0.3555556,
  // 1.1722222, -3): to the lamp (-1.6444444, 3.8277778, 5), long 6.508155, N.L = 0.7682669. Mirrored, it aims at the
  // ball's centre, along (-1.6, -1.7, 10.8): it sees the side with N = (1.6, 1.7, -10.8)/11.04943, and there the lamp
  // lies behind, N.L < 0: only ambient light, 0.2 ka.
  const dvec3 front = mirror(0.768266901);
  lesson.sees({-0.8, 0.7, -6}, front, front + 0.8 * 0.2 * clay);
}

TEST_CASE("lecture pixels: 08 refraction") {
  const Lesson lesson("08-refraction");
  const dvec3 lamp(0.9, 0.9, 0.86), pool(0.10, 0.26, 0.30), stripe1(0.62, 0.2, 0.13);
  const dvec3 water_a(0.03, 0.06, 0.08), water_d(0.02, 0.04, 0.05), water_c3(0.66, 0.80, 0.82);
  lesson.has_eye({0, 3.2, 9.6});
  lesson.has_ambient(grey(0.25));
  lesson.has_lamp(0, {-3, 6, 6}, lamp);
  lesson.has_sphere(0, {-1.5, 1.2, 0}, 1);
  lesson.has_material({.name = "glass",
                       .ambient = grey(0.1),
                       .diffuse = grey(0.04),
                       .specular = grey(0.6),
                       .shininess = 200,
                       .refract = grey(0.9),
                       .ior = 1.5});
  lesson.has_material({.name = "water",
                       .ambient = water_a,
                       .diffuse = water_d,
                       .reflect = grey(0.1),
                       .refract = water_c3,
                       .ior = 1.33});
  lesson.has_material({.name = "pool", .ambient = pool, .diffuse = pool});
  lesson.has_material({.name = "stripe1", .ambient = stripe1, .diffuse = stripe1});
  lesson.has_material({.name = "white", .ambient = grey(0.65), .diffuse = grey(0.65)});
  const auto white = [&](double cosine) { return 0.65 * (0.25 + cosine * lamp); };

  // The wall's red stripe at (-4, 2, -3): to the lamp (1, 4, 9), N.L = 9/sqrt 98.
  lesson.sees({-4, 2, -3}, stripe1 * (0.25 + 9 / sqrt(98.0) * lamp));

  // Through the ball's centre, where nothing is bent: V = N = (1.5, 2, 9.6)/9.920181 in front and, inside, at the back.
  //   front  (-1.348793, 1.401609, 0.967724): to the lamp (-1.651207, 4.598391, 5.032276), N.L = 0.7908896; its 200th
  //          power is 4e-21, no highlight
  //   back   the lamp shines from within, through the glass, which casts a shadow: ambient only, 0.1 * 0.25
  //   wall   12.6/9.6 of the way to the centre, (-1.96875, 0.575, -3), white: to the lamp (-1.03125, 5.425, 9), long
  //          10.55908, N.L = 0.8523472
  const dvec3 front = 0.025 + 0.04 * 0.790889587 * lamp;
  lesson.sees({-1.5, 1.2, 0}, front, front + 0.9 * (0.025 + 0.9 * white(0.852347248)));

  // The water at (0, 0, 3): to the lamp (-3, 6, 3), N.L = 6/sqrt 54. The ray comes along (0, -3.2, -6.6)/7.334848, so
  // sin i = 0.8998141, sin t = sin i/1.33 = 0.6765520, cos t = 0.7363949; 1.6 below it is 1.6 sin t/cos t = 1.4699764
  // further, at (0, -1.6, 1.5300236) on the pool's floor: to the lamp (-3, 7.6, 4.4699764), N.L = 0.8160225.
  // The mirrored ray meets the wall, 6 further and 6 * 3.2/6.6 higher, at (0, 2.909091, -3), white: to the lamp
  // (-3, 3.090909, 9), N.L = 0.9020150.
  const dvec3 water = 0.25 * water_a + 6 / sqrt(54.0) * lamp * water_d;
  const dvec3 bottom = pool * (0.25 + 0.816022546 * lamp);
  lesson.sees({0, 0, 3}, water, water + 0.1 * white(0.902015011) + water_c3 * bottom);
}

// The eye is in the water. The lamp is above, so the surface has only ambient light on this side: 0.3 ka.
TEST_CASE("lecture pixels: 09 total internal reflection") {
  const Lesson lesson("09-total-internal-reflection");
  const dvec3 lamp(0.75, 0.75, 0.72), sky(0.40, 0.52, 0.62), water(0.10, 0.16, 0.18), dark(0.10, 0.30, 0.36);
  const dvec3 clay(0.75, 0.28, 0.16);
  lesson.has_eye({0, -3, 4});
  lesson.has_background(sky);
  lesson.has_ambient(grey(0.3));
  lesson.has_lamp(0, {-3, 8, 2}, lamp);
  lesson.has_sphere(0, {1.6, -2.2, -1}, 0.8);
  lesson.has_material(
      {.name = "water", .ambient = water, .reflect = grey(0.05), .refract = grey(0.9), .ior = 1.33});
  lesson.has_material({.name = "dark_tile", .ambient = dark, .diffuse = dark});
  lesson.has_material(
      {.name = "clay", .ambient = clay, .diffuse = clay, .specular = grey(0.3), .shininess = 40});

  // Nearly straight up, to (0, 0, 4.3): sin i = 0.3/sqrt 9.09 = 0.0995, sin t = 1.33 sin i = 0.1323: out into the sky.
  // Mirrored down to (0, -4, 4.7), a dark tile: to the lamp (-3, 12, -2.7), v.v = 160.29.
  const dvec3 tile = dark * (0.3 + 12 / sqrt(160.29) * lamp);
  lesson.sees({0, 0, 4.3}, 0.3 * water, 0.3 * water + 0.05 * tile + 0.9 * sky);

  // To (0, 0, -4): sin i = 8/sqrt 73 = 0.936, sin t would be 1.245: all goes to the mirror ray, with weight 0.95. It
  // meets the end wall, 4 further and 1.5 lower, in the dark tile at (0, -1.5, -8): to the lamp (-3, 9.5, 10).
  const dvec3 wall = dark * (0.3 + 10 / sqrt(199.25) * lamp);
  lesson.sees({0, 0, -4}, 0.3 * water, 0.3 * water + 0.95 * wall);

  // The ball in the water: V = N = (-1.6, -0.8, 5)/sqrt 28.2, P = centre + 0.8 N = (1.358962, -2.320519, -0.246756), to
  // the lamp (-4.358962, 10.320519, 2.246756), N.L = 0.1640081. The water casts no shadow, the highlight is 1e-32.
  lesson.sees({1.6, -2.2, -1}, clay * (0.3 + 0.164008101 * lamp));
}

// With two rays along a path: what the second meets is shaded, and what it would send is black.
TEST_CASE("lecture pixels: 10 nested glass with depth 2") {
  Lesson lesson("10-nested-glass");
  const dvec3 lamp(0.85, 0.85, 0.82), water(0.03, 0.05, 0.06), blue(0.10, 0.22, 0.40),
      night(0.02, 0.026, 0.04);
  lesson.has_eye({0, 3.6, 9.6});
  lesson.has_background(night);
  lesson.has_ambient(grey(0.3));
  lesson.has_lamp(0, {-4, 7, 6}, lamp);
  lesson.has_sphere(0, {-0.95, 0.85, 0}, 0.85);
  lesson.has_sphere(1, {-0.95, 0.85, 0}, 0.65);
  lesson.has_material({.name = "glass",
                       .ambient = grey(0.06),
                       .diffuse = grey(0.03),
                       .specular = grey(0.5),
                       .shininess = 300,
                       .reflect = grey(0.06),
                       .refract = grey(0.9),
                       .ior = 1.5});
  lesson.has_material(
      {.name = "water", .ambient = water, .reflect = grey(0.04), .refract = {0.86, 0.92, 0.94}, .ior = 1.33});
  lesson.has_material({.name = "floor", .ambient = grey(0.32), .diffuse = grey(0.4)});
  lesson.has_material({.name = "blue", .ambient = blue, .diffuse = blue});
  lesson.set_depth(2);
  const auto glass = [&](double cosine) {
    return 0.018 + 0.03 * cosine * lamp;
  };  // all highlights below are 0

  // The blue band at (0, 1.5, -3), between the balls: to the lamp (-4, 5.5, 9), v.v = 127.25.
  lesson.sees({0, 1.5, -3}, blue * (0.3 + 9 / sqrt(127.25) * lamp));

  // Through the centre of the ball with water: N = V = (0.95, 2.75, 9.6)/10.03120, P = (-0.869501, 1.083023, 0.813462),
  // to the lamp (-3.130499, 5.916977, 5.186538), N.L = 0.7426852. Behind the glass comes the water, which has no diffuse
  // part: 0.3 ka. The mirrored ray goes back the way it came, over the eye and away.
  const dvec3 shell = glass(0.742685203);
  lesson.sees({-0.95, 0.85, 0}, shell, shell + 0.06 * night + 0.9 * 0.3 * water);

  // The left one of the two blocks that touch at x = 2.7, at (2.6, 0.75, 0.5) on its front: to the lamp (-6.6, 6.25,
  // 5.5), N.L = 5.5/sqrt 112.8725. D = (2.6, -2.85, -9.1)/9.883952; T = (Dx/1.5, Dy/1.5, ...) = (0.1753685, -0.1922308,
  // -0.9655533). It meets both blocks' faces at (2.7, 0.6403846, -0.0505855), crosses them together and shades the first
  // of them, N = (-1, 0, 0): to the lamp (-6.7, 6.359615, 6.050586), N.L = 0.6067280.
  // The mirrored ray meets the floor 0.75/2.85 of (2.6, -2.85, 9.1) further, at (3.2842105, 0, 2.8947368): to the lamp
  // (-7.284211, 7, 3.105263), N.L = 0.6623184.
  const dvec3 face = glass(5.5 / sqrt(112.8725)), seam = glass(0.606728035);
  const dvec3 ground = 0.096 + 0.4 * 0.662318403 * lamp;
  lesson.sees({2.6, 0.75, 0.5}, face, face + 0.06 * ground + 0.9 * seam);
}

TEST_CASE("lecture pixels: 12 secondary attenuation") {
  const Lesson lesson("12-secondary-attenuation");
  const dvec3 lamp(0.9, 0.88, 0.82), ivory(0.75, 0.70, 0.58), teal(0.12, 0.40, 0.42);
  lesson.has_eye({0, 3.6, 9.6});
  lesson.has_ambient(grey(0.25));
  lesson.has_lamp(0, {-4, 6, 6}, lamp);
  lesson.has_sphere(1, {2.3, 1.5, 0}, 0.4);
  lesson.has_material({.name = "floor", .ambient = grey(0.05), .diffuse = grey(0.06), .reflect = grey(0.8)});
  lesson.has_material({.name = "ivory", .ambient = ivory, .diffuse = ivory});
  lesson.has_material(
      {.name = "teal", .ambient = teal, .diffuse = teal, .specular = grey(0.3), .shininess = 40});
  lesson.has_secondary_attenuation({0.5, 0.5, 0});
  const auto ground = [&](double cosine) { return 0.0125 + 0.06 * cosine * lamp; };

  // The floor at (0, 0, 5): to the lamp (-4, 6, 1). The mirrored ray passes over the pillars, 3.913 high at z = 0, and
  // meets nothing: r is infinite and w = 0, so not even the background comes back.
  lesson.sees({0, 0, 5}, ground(6 / sqrt(53.0)));

  // The image of (-1.3, 1.5, 0), on the middle pillar's front, is (-1.3, -1.5, 0): the ray to it is (-1.3, -5.1, -9.6),
  // 10.948059 long, and meets the floor after 3.6/5.1 of it, at (-0.9176471, 0, 2.8235294): to the lamp (-3.0823529, 6,
  // 3.1764706), N.L = 0.8047288. What is left is r = 10.948059 * 1.5/5.1 = 3.220017, so w = 1/(0.5 + 0.5 r) = 0.4739317.
  // On the pillar: to the lamp (-2.7, 4.5, 6), N.L = 6/sqrt 63.54.
  const double r = sqrt(119.86) * 1.5 / 5.1, w = 1 / (0.5 + 0.5 * r);
  const dvec3 pillar = ivory * (0.25 + 6 / sqrt(63.54) * lamp);
  lesson.sees({-1.3, -1.5, 0}, ground(0.804728781), ground(0.804728781) + 0.8 * w * pillar);

  // The teal ball itself: N = V = (-2.3, 2.1, 9.6)/10.09257, P = centre + 0.4 N = (2.208844, 1.583230, 0.380478), to the
  // lamp (-6.208844, 4.416770, 5.619522), c = N.L = 0.8110988, c^40 = 0.000230648.
  const double c = 0.811098786;
  lesson.sees({2.3, 1.5, 0}, teal * (0.25 + c * lamp) + 0.3 * std::pow(c, 40) * lamp);
}
