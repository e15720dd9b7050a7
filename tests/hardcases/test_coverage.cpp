// SPDX-License-Identifier: MIT
// Which samples a triangle covers: partitions of the screen (RAS-1), slivers and triangles far below a pixel (RAS-3) and
// huge ones (RAS-6), each judged in 128-bit integers.
//
// Edges are closed and there is no fill rule, so a partition asks: at each sample at least one candidate; exactly one
// where its ray lies strictly inside one triangle; the winner is the oracle's. That no second one claims a sample shows
// when the triangles are drawn in two halves: one half has a surface there, the other must have none.
#include "common/scene/build.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/exact_picture.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// A dyadic point that is seen at (x, y), in pixels from the first sample, at the distance `depth`.
glm::dvec3 seen_at(const Camera& camera, double x, double y, double depth) {
  const double pixel = camera.up.y * depth / camera.height;
  return snapped(
      glm::dvec3((x - 0.5 * (camera.width - 1)) * pixel, (0.5 * (camera.height - 1) - y) * pixel, -depth));
}

struct Tally {
  std::uint64_t samples = 0, gaps = 0, phantoms = 0, unlike = 0, alone = 0;
};

// The triangles cover the whole picture without overlap, up to edges.
void judge_partition(const PolygonMesh& mesh, const Camera& camera, Random& random, Tally& tally) {
  RenderOptions options = keeping(0);
  options.tile = 1 << random.below(8);
  options.threads = 1 + static_cast<int>(random.below(3));
  const Scene scene = scene_of(mesh);
  const ExactPicture exact(scene, camera);
  tally.unlike += exact.mismatches(rastered(scene, camera, options));

  std::vector<bool> in_first(mesh.faces.size());
  PolygonMesh half[2]{mesh, mesh};
  half[0].faces.clear();
  half[1].faces.clear();
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    in_first[i] = random.bits() & 1;
    half[in_first[i] ? 0 : 1].faces.push_back(mesh.faces[i]);
  }
  const Scene scenes[2]{scene_of(half[0]), scene_of(half[1])};
  const Frame frames[2]{rastered(scenes[0], camera, options), rastered(scenes[1], camera, options)};
  ExactPicture::for_each_sample(frames[0], [&](int X, int Y, std::uint32_t first) {
    const ExactPicture::Sample& sample = exact.at(X, Y);
    const bool shown[2]{first != kNone, frames[1].sample_primitive[frames[1].index(X, Y)] != kNone};
    ++tally.samples;
    tally.gaps += !shown[0] && !shown[1];
    if (sample.met != 1 || sample.strictly != 1) return;
    ++tally.alone;
    tally.phantoms += shown[0] != in_first[sample.inside] || shown[1] == in_first[sample.inside];
  });
}

void report(const std::string& id, const std::string& what, const Tally& tally) {
  const HardCase hard(id);
  hard.none(what + ": samples that no triangle covers", tally.gaps, tally.samples);
  hard.none(what + ": samples strictly inside one triangle that another one claims too", tally.phantoms,
            tally.alone);
  hard.none(what + ": samples with another winner than in 128-bit integers", tally.unlike, tally.samples);
}

// A grid that reaches 8 pixels beyond the screen, its inner vertices moved by up to 0.35 of a cell and to any depth,
// cut along either diagonal, triangles wound and rotated at random.
PolygonMesh jittered_grid(const Camera& camera, std::uint32_t cells, Random& random) {
  std::vector<glm::dvec3> positions;
  const double cell_x = (camera.width + 16.0) / cells, cell_y = (camera.height + 16.0) / cells;
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const double x = -8.5 + cell_x * (i + random.uniform(-0.35, 0.35));
      const double y = -8.5 + cell_y * (j + random.uniform(-0.35, 0.35));
      positions.push_back(seen_at(camera, x, y, random.uniform(1, 3)));
    }
  std::vector<Face> faces;
  const auto add = [&](Face face) {
    std::rotate(face.begin(), face.begin() + random.below(3), face.end());
    if (random.bits() & 1) std::swap(face[1], face[2]);
    faces.push_back(face);
  };
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * (cells + 1) + i, b = a + 1, c = b + cells + 1, d = a + cells + 1;
      if (random.bits() & 1) {
        add({a, b, c});
        add({a, c, d});
      } else {
        add({a, b, d});
        add({b, c, d});
      }
    }
  return mesh_of(positions, faces);
}

// Frames of a partition that take about as many samples as the tier has rays.
std::uint64_t frames_of(const Camera& camera, std::uint64_t share) {
  return 1 + tier_count("rays_per_gate") / (share * static_cast<std::uint64_t>(camera.width * camera.height));
}

}  // namespace

TEST_CASE("RAS-1: every sample of a jittered partition is covered once") {
  const Camera camera = plain_camera(256, 256);
  Random random(77);
  Tally tally;
  const bool small = tier() == "sanitized";
  for (std::uint64_t left = frames_of(camera, 5); left > 0; --left)
    for (const std::uint32_t cells : {16u, 48u, 128u, small ? 130u : 512u})
      judge_partition(jittered_grid(camera, cells, random), camera, random, tally);
  report("RAS-1", "grids of 16 to 512 cells", tally);
}

// Two triangles on both sides of an edge whose ends, like the apexes, are R pixels away. Those of R = 100 reach over a
// small picture only: the sides of the square that they make are 71 pixels from its middle, a corner of the picture 53.
TEST_CASE("RAS-1: an edge whose ends are up to 1e7 pixels away neither leaks nor overlaps") {
  const Camera large = plain_camera(256, 256), small = plain_camera(48, 48);
  Random random(78);
  Tally tally;
  for (std::uint64_t left = frames_of(large, 5); left > 0; --left)
    for (const double reach : {1e2, 1e3, 1e4, 1e5, 1e6, 1e7}) {
      const Camera& camera = reach < 1e3 ? small : large;
      const double turn = random.uniform(0, 7), middle = 0.5 * camera.width,
                   aside = middle - 60 / 256.0 * camera.width;
      const double x = middle + random.uniform(-aside, aside), y = middle + random.uniform(-aside, aside);
      const double depth = random.uniform(1, 2);
      const auto corner = [&](double angle) {
        return seen_at(camera, x + reach * std::cos(angle), y + reach * std::sin(angle), depth);
      };
      const double quarter = std::numbers::pi / 2;
      judge_partition(mesh_of({corner(turn), corner(turn + quarter), corner(turn + 2 * quarter),
                               corner(turn + 3 * quarter)},
                              {{0, 2, 1}, {2, 0, 3}}),
                      camera, random, tally);
    }
  report("RAS-1", "edges with ends 100 to 1e7 pixels away", tally);
}

// ---- RAS-3 ----

// Slivers about 1e-3 pixels wide at most, from an apex far to the left, that cover the picture.
TEST_CASE("RAS-3: a fan of slivers of a thousandth of a pixel covers every sample once") {
  const std::uint64_t most = std::min<std::uint64_t>(tier_count("rays_per_case") / 4, 100'000);
  const auto slivers = static_cast<std::uint32_t>(most);
  const int height = std::max(2, static_cast<int>(slivers / 1000));
  const Camera camera = plain_camera(48, height);
  std::vector<glm::dvec3> positions{seen_at(camera, -1e4, 0.5 * height, 1)};
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i <= slivers; ++i) {
    positions.push_back(seen_at(camera, 60, -2 + (height + 4.0) * i / slivers, 1));
    if (i > 0) faces.push_back({0, i, i + 1});
  }
  Random random(31);
  Tally tally;
  judge_partition(mesh_of(positions, faces), camera, random, tally);
  report("RAS-3", "slivers of 1e-3 pixels", tally);
}

// A grid of triangles that lies within one pixel, around its centre, so finely cut that some snap to no area.
TEST_CASE("RAS-3: of the triangles inside one pixel the one at its centre is seen") {
  const Camera camera = plain_camera(16, 16);
  const auto cells = static_cast<std::uint32_t>(
      std::sqrt(static_cast<double>(std::min<std::uint64_t>(tier_count("rays_per_case"), 1'000'000)) / 2));
  Random random(32);
  std::vector<glm::dvec3> positions;
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i)
      positions.push_back(seen_at(camera, 7 + 0.02 * i / cells - 0.01, 5 + 0.02 * j / cells - 0.01, 1));
  std::vector<Face> faces;
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * (cells + 1) + i, b = a + 1, c = b + cells + 1, d = a + cells + 1;
      faces.push_back({a, b, c});
      faces.push_back({a, c, d});
    }
  const Scene scene = scene_of(mesh_of(positions, faces));
  const ExactPicture exact(scene, camera);
  const Frame frame = rastered(scene, camera);
  const std::uint32_t shown_there = frame.sample_primitive[frame.index(7, 5)];
  REQUIRE(shown_there != kNone);
  std::uint64_t elsewhere = 0, degenerate = 0;
  for (const Triangle& t : scene.triangles) degenerate += t.degenerate;
  for (const std::uint32_t shown : frame.sample_primitive) elsewhere += shown != kNone;
  const HardCase hard("RAS-3");
  hard.none("inside one pixel: samples with another winner than in 128-bit integers", exact.mismatches(frame),
            frame.sample_primitive.size());
  hard.holds("inside one pixel: it alone is covered", elsewhere == 1 && exact.at(7, 5).met > 0);
  hard.none("inside one pixel: triangles without area that are shown",
            scene.triangles[shown_there].degenerate, 1 + degenerate);
}

// ---- RAS-6 ----

namespace {

// A fan around a point of the screen whose rim is `reach` pixels away; a copy of `random` gives the same one again.
PolygonMesh fan(const Camera& camera, double reach, Random random) {
  constexpr std::uint32_t kCorners = 7;
  const double middle = 0.5 * camera.width, aside = 56 / 512.0 * camera.width;
  const double x = middle + random.uniform(-aside, aside), y = middle + random.uniform(-aside, aside);
  const double turn = random.uniform(0, 7);
  std::vector<glm::dvec3> positions{seen_at(camera, x, y, 1)};
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < kCorners; ++i) {
    const double angle = turn + 2 * std::numbers::pi * (i + random.uniform(-0.2, 0.2)) / kCorners;
    positions.push_back(seen_at(camera, x + reach * std::cos(angle), y + reach * std::sin(angle), 1));
    faces.push_back({0, 1 + i, 1 + (i + 1) % kCorners});
  }
  return mesh_of(positions, faces);
}

std::uint64_t signs(const Frame& frame) {
  return frame.stats.visibility.filtered + frame.stats.visibility.in_double + frame.stats.visibility.exact;
}

}  // namespace

// Those of 300 pixels reach over a small picture only: the sides of the rim are 300 cos(0.63) = 242 from its middle at
// least, a corner of the picture 166.
TEST_CASE("RAS-6: fans whose rim is up to 1e7 pixels away") {
  const Camera large = plain_camera(512, 512), small = plain_camera(192, 192);
  Random random(61);
  Tally tally;
  double most_work = 0;
  const auto work_of_pair = [&](const Camera& camera) {
    const double end = camera.width + 8;
    const std::vector<glm::dvec3> screen{seen_at(camera, -9, -9, 1), seen_at(camera, end, -9, 1),
                                         seen_at(camera, end, end, 1), seen_at(camera, -9, end, 1)};
    return static_cast<double>(signs(rastered(scene_of(mesh_of(screen, {{0, 1, 2}, {0, 2, 3}})), camera)));
  };
  const double large_pair = work_of_pair(large), small_pair = work_of_pair(small);
  for (std::uint64_t left = frames_of(large, 3); left > 0; --left) {
    for (const double reach : {3e2, 1e3, 1e4, 1e5, 1e6, 1e7}) {
      const Camera& camera = reach < 1e3 ? small : large;
      const PolygonMesh huge = fan(camera, reach, random);
      const double pair = reach < 1e3 ? small_pair : large_pair;
      most_work = std::max(most_work, static_cast<double>(signs(rastered(scene_of(huge), camera))) / pair);
      Random halves(left);
      judge_partition(huge, camera, halves, tally);
    }
    random.bits();
  }
  report("RAS-6", "fans with a rim 300 to 1e7 pixels away", tally);
  // A triangle's box is at most the screen. So seven of them cost at most seven halves of a pair that fills it, wherever
  // their corners are; that a frame of any fan costs at most two such pairs is more than boxes can promise.
  HardCase("RAS-6").at_most(
      "edge signs of a fan of 7, each against one of two triangles that fill the screen", most_work / 3.5, 1);
}

// The triangle (0, -L, -e), (0, L, -e), (L, 0, -e) is seen by every ray with d.x > 0: half of an even picture. With
// L = 2^49, e = 2^-40 and 256 samples a unit its corners are 2^96 = 8e28 pixels away, with e = 2^-46 5e30.
TEST_CASE("RAS-6: a triangle of 1e30 pixels covers its half of the picture") {
  const Camera camera = plain_camera(512, 512);
  std::uint64_t wrong = 0, samples = 0;
  for (const double e : {0x1p-40, 0x1p-46}) {
    const double L = 0x1p49;
    const Scene scene = local_only(scene_of_triangle({0, -L, -e}, {0, L, -e}, {L, 0, -e}));
    for (const Frame& frame : {rastered(scene, camera), traced(scene, camera)})
      ExactPicture::for_each_sample(frame, [&](int X, int, std::uint32_t shown) {
        ++samples;
        wrong += (shown != kNone) != (X >= 256);
      });
  }
  HardCase("RAS-6").none("corners 5e30 pixels away: samples not as the half-plane says", wrong, samples);
}
