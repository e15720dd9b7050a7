// SPDX-License-Identifier: MIT
// What the z-buffer works out at a sample: barycentrics across extreme ratios of depth (RAS-10), in any order of a
// triangle's vertices (RAS-11), in pictures of odd shapes (RAS-12).
#include "common/model/place.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/exact_picture.h"
#include "tests/support/lit.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

// Triangles whose corners are seen well apart on a picture of 1024 x 1024, at depths in a ratio of up to 1e7. The
// attribute 0, 1, 2 at the corners is u = b1 + 2 b2. E_k is off by 6 u P_k, P its permanent (visibility.cpp), so with
// S = sum E the weighted sum is off by at most 6 u (P1 + 2 P2 + u sum P)/S, u <= 2, and 4 u for quotients and sums.
TEST_CASE("RAS-10: barycentrics across depths in a ratio of 1e7") {
  const Camera camera = plain_camera(1024, 1024);
  Random random(10);
  double worst = 0, worst_of_bound = 0;
  std::uint64_t done = 0;
  VisibilityCounts counts;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const double ratio = random.log_uniform(1, 1e7);
    glm::dvec2 pixel[3];
    glm::dvec3 v[3];
    for (int k = 0; k < 3; ++k) {
      pixel[k] = {random.uniform(0, 1023), random.uniform(0, 1023)};
      const double depth = k == 0 ? 1 : k == 1 ? ratio : random.log_uniform(1, 1e7);
      v[k] = depth / 1024 * glm::dvec3(pixel[k].x - 511.5, 511.5 - pixel[k].y, -1024);
    }
    const glm::dvec2 p = pixel[1] - pixel[0], q = pixel[2] - pixel[0];
    if (std::abs(p.x * q.y - p.y * q.x) < 200) continue;  // area below 100 square pixels
    // The pixel whose centre is nearest to a point inside.
    const double a = random.uniform(), b = random.uniform() * (1 - a);
    const glm::dvec2 at = pixel[0] + a * p + b * q;
    const int X = static_cast<int>(std::lround(at.x)), Y = static_cast<int>(std::lround(at.y));
    const Scene scene = scene_of_triangle(v[0], v[1], v[2]);
    const Ray ray{camera.eye, camera.direction(X, Y)};
    const Hit hit = intersect(scene, 0, ray, kRayStart, counts);
    if (!hit.found()) continue;
    const Place place = locate(scene, ray, hit, counts);

    Quad e[3], sum = 0;
    double permanent[3];
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 &i = v[(k + 1) % 3], &j = v[(k + 2) % 3];  // the eye is the origin
      e[k] = determinant(quad(ray.direction), quad(i), quad(j));
      sum = sum + e[k];
      const auto size = [](double x, double y) { return std::abs(x * y); };
      permanent[k] = std::abs(ray.direction.x) * (size(i.y, j.z) + size(i.z, j.y)) +
                     std::abs(ray.direction.y) * (size(i.z, j.x) + size(i.x, j.z)) +
                     std::abs(ray.direction.z) * (size(i.x, j.y) + size(i.y, j.x));
    }
    const Quad u = (e[1] + 2 * e[2]) / sum;
    const double error = std::abs(static_cast<double>(place.barycentric[1] + 2 * place.barycentric[2] - u));
    const double bound =
        6 * 0x1p-53 * (permanent[1] + 2 * permanent[2] + 2 * (permanent[0] + permanent[1] + permanent[2])) /
            std::abs(static_cast<double>(sum)) +
        8 * 0x1p-53;
    worst = std::max(worst, error);
    worst_of_bound = std::max(worst_of_bound, error / bound);
    ++done;
  }
  const HardCase hard("RAS-10");
  hard.at_least("triangles looked at, in parts of those drawn",
                static_cast<double>(done) / static_cast<double>(tier_count("rays_per_case")), 0.5);
  hard.at_most("error of an attribute 0, 1, 2", worst, 1e-6);
  hard.at_most("the same in units of its bound", worst_of_bound, 1);
}

// ---- RAS-11 ----

namespace {

// A bumpy dyadic ball with smooth normals; `turn` gives each face its rotation (0 to 2) and whether it is reversed.
template <class Turn>
Scene smooth_ball(const Turn& turn) {
  PolygonMesh mesh = star_sphere(20, 28, 0.3, 11);
  for (glm::dvec3& p : mesh.positions) p = snapped(p);
  mesh.normals = mesh.positions;
  for (PolygonMesh::Corner& corner : mesh.corners) corner.normal = corner.position;
  mesh.faces.pop_back();  // an open mesh keeps the winding of its file
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto begin = mesh.corners.begin() + mesh.faces[i].first;
    const auto [rotation, reversed] = turn(i);
    std::rotate(begin, begin + rotation, begin + 3);
    if (reversed) std::reverse(begin, begin + 3);
  }
  Material material;
  material.diffuse = {0.5, 0.25, 0.75};
  return test::lit(mesh, material, {0.25, 0.5, 3.5});
}

}  // namespace

// Depth begins with the first vertex and the winding, so its last bit may change; which surface is seen may not, but for
// a tie of exact arithmetic, and colour hardly.
TEST_CASE("RAS-11: any order of vertices gives the same surfaces and colours") {
  const auto as_it_is = [](std::size_t) { return std::pair(0, false); };
  const Scene plain = local_only(smooth_ball(as_it_is));
  const Camera camera = make_camera(plain.camera, 128, 96, 1);
  const ExactPicture exact(plain, camera);
  const Frame before = rastered(plain, camera);
  Random random(111);
  std::uint64_t uncovered = 0, other = 0, samples = 0;
  double worst = 0;
  for (std::uint64_t left = 2 + tier_count("rays_per_case") / 50'000; left > 0; --left) {
    const Scene turned = local_only(smooth_ball([&](std::size_t) {
      const int rotation = static_cast<int>(random.below(3));
      return std::pair(rotation, (random.bits() & 1) != 0);
    }));
    const Frame after = rastered(turned, camera);
    REQUIRE(differences(traced(turned, camera), after) == "");
    for (std::size_t i = 0; i < before.pixels(); ++i) {
      ++samples;
      uncovered += (before.object_id[i] != 0) != (after.object_id[i] != 0);
      if (before.primitive_id[i] != after.primitive_id[i]) continue;  // judged below: only an exact tie may
      for (int c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(double{before.color[i][c]} - double{after.color[i][c]}));
    }
    other += exact.mismatches(after);
  }
  const HardCase hard("RAS-11");
  hard.none("samples covered in one order of vertices only", uncovered, samples);
  hard.none("samples with another surface, exact ties excepted", other, samples);
  hard.at_most("difference of colours of at most 1, in units of eps", worst / 0x1p-23, 4);
}

// ---- RAS-12 ----

TEST_CASE("RAS-12: pictures one pixel wide, 65535 pixels long, or of odd sizes") {
  const Scene scene = local_only(smooth_ball([](std::size_t) { return std::pair(0, false); }));
  std::uint64_t disagreeing = 0, crops = 0, unlike = 0, sizes = 0;
  for (const auto& [width, height] :
       {std::pair{1, 1}, {1, 4096}, {4096, 1}, {3, 5}, {65535, 1}, {1, 65535}, {257, 129}}) {
    const Camera camera = make_camera(scene.camera, width, height, 1);
    const Frame whole = rastered(scene, camera);
    ++sizes;
    disagreeing += !differences(whole, traced(scene, camera)).empty();
    for (const Rect& crop :
         {Rect{0, 0, width, height}, Rect{width / 3, height / 3, width / 3 + 1, height / 3 + 1},
          Rect{width / 2, height / 4, width, 1 + height / 2}}) {
      RenderOptions options = keeping(kRasterLayers);
      options.crop = crop;
      ++crops;
      unlike += !differences(rastered(scene, camera, options), whole).empty();
    }
  }
  std::uint64_t accepted = 0, asked = 0;
  const Workplace here;
  for (const auto& [size, code] :
       {std::pair{"0x0", 2}, {"0x5", 2}, {"65536x1", 2}, {"4294967297x1", 2}, {"65535x65535", 3}}) {
    ++asked;
    const Outcome outcome =
        here.run({"render", "good.toml", "-o", "a.png", "-q", "--spp", "4096", "-r", size});
    accepted += outcome.code != code || !here.made().empty();
  }
  const HardCase hard("RAS-12");
  hard.none("sizes of nothing or beyond memory that are not refused", accepted, asked);
  hard.none("shapes on which z-buffer and tracer differ in any bit", disagreeing, sizes);
  hard.none("crops that are not that part of the picture", unlike, crops);
}
