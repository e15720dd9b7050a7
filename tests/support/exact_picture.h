// SPDX-License-Identifier: MIT
// What a picture of triangles must show: every sample's ray against every triangle that may cover it, in 128-bit
// integers. The oracle of both renderers; it shares with them the scene, the camera's rays and the numbering only.
//
// With a_k = v_k - eye and the ray's direction d, all integers after a scaling by powers of two (the constructor checks
// that they fit), a triangle is met iff E_k = d . (a_i x a_j) has the sign of D = a_0 . (a_1 x a_2), or is 0, for all
// three edges, D and one E_k at least not being 0; strictly inside iff no E_k is 0. Its depth is D / sum E_k, divided
// in 113 bits.
//
// Depths closer than 8 u (|a_0||n| / |a_0.n| + |d||n| / |d.n|), relative, are a tie, which either surface may win:
// a_0.n and d.n, each three products and two sums, are off by 3 u |a_0||n| and 3 u |d||n| for each of two surfaces,
// their quotient by 1 u (n itself is exact here, its products having fewer than 53 bits).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/picture/frame.h"
#include "common/scene/camera.h"
#include "common/scene/scene.h"
#include "tests/support/wide.h"

namespace sidelight::test {

class ExactPicture {
 public:
  struct Sample {
    std::uint32_t nearest = kNone;  // the first of those that are nearest, if any
    std::uint32_t inside = kNone;   // a triangle that has the ray strictly inside, the last of them
    std::uint32_t met = 0;          // how many triangles the ray meets
    std::uint32_t strictly = 0;     // and how many of them strictly inside
    Quad depth = 0;                 // of `nearest`, up to a factor common to the picture
    double tie = 0;                 // its margin
  };

  // Of triangles only.
  ExactPicture(const Scene& scene, const Camera& camera)
      : scene_(scene), camera_(camera), samples_(count(camera.columns()) * count(camera.rows())) {
    choose_scales();
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) draw(i);
  }

  const Sample& at(int X, int Y) const { return samples_[count(Y) * count(camera_.columns()) + count(X)]; }

  // The depth t of the nearest, if any.
  double nearest_depth(int X, int Y) const {
    return static_cast<double>(at(X, Y).depth * static_cast<Quad>(scale_d_) / static_cast<Quad>(scale_a_));
  }

  // Whether a renderer may show `primitive` (kNone: the background) at this sample.
  bool allows(int X, int Y, std::uint32_t primitive) const {
    const Sample& sample = at(X, Y);
    if (primitive == sample.nearest) return true;
    if (primitive == kNone || sample.nearest == kNone) return false;
    const Seen triangle = see(primitive);
    const Meeting meeting = meet(triangle, direction(X, Y));
    if (meeting.zeros < 0) return false;
    const double tie = std::max(sample.tie, meeting.tie);
    return meeting.depth - sample.depth <= static_cast<Quad>(tie) * sample.depth;
  }

  // How many samples of a frame with keep_samples show what they must not.
  std::uint64_t mismatches(const Frame& frame) const {
    std::uint64_t bad = 0;
    for_each_sample(frame, [&](int X, int Y, std::uint32_t shown) { bad += !allows(X, Y, shown); });
    return bad;
  }

  // How many samples of such a frame that show what they may have a depth that is off by more than the bound above.
  std::uint64_t wrong_depths(const Frame& frame) const {
    std::uint64_t bad = 0;
    std::size_t i = 0;
    for_each_sample(frame, [&](int X, int Y, std::uint32_t shown) {
      const double t = frame.sample_depth[i++];
      if (shown == kNone || !allows(X, Y, shown)) return;
      const Meeting meeting = meet(see(shown), direction(X, Y));
      const Quad exact = meeting.depth * static_cast<Quad>(scale_d_) / static_cast<Quad>(scale_a_);
      bad += !(magnitude(static_cast<Quad>(t) - exact) <= static_cast<Quad>(meeting.tie) * exact);
    });
    return bad;
  }

  // Calls visit(X, Y, primitive or kNone) for every sample of a whole frame.
  template <class Visit>
  static void for_each_sample(const Frame& frame, const Visit& visit) {
    std::size_t i = 0;
    for (int y = 0; y < frame.height(); ++y)
      for (int x = 0; x < frame.width(); ++x)
        for (int j = 0; j < frame.n; ++j)
          for (int k = 0; k < frame.n; ++k)
            visit(frame.n * x + k, frame.n * y + j, frame.sample_primitive[i++]);
  }

 private:
  struct Seen {
    std::array<IntVec, 3> a, edge;
    IntVec n;
    Int128 volume;  // D
  };
  struct Meeting {
    int zeros = -1;  // edges through which the ray runs; -1: a miss
    Quad depth = 0;
    double tie = 0;
  };

  static std::size_t count(int n) { return static_cast<std::size_t>(n); }

  // Exponent of the lowest bit that is set; of 0 a high one.
  static int lowest_bit(double x) {
    if (x == 0) return 1000;
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    return exponent - 53 + std::countr_zero(static_cast<std::uint64_t>(mantissa));
  }
  static int highest_bit(double x) { return x == 0 ? -1000 : std::ilogb(x) + 1; }

  void choose_scales() {
    int low_a = 1000, high_a = -1000, low_d = 1000, high_d = -1000;
    const auto widen = [](const glm::dvec3& v, int& low, int& high) {
      for (int i = 0; i < 3; ++i) {
        low = std::min(low, lowest_bit(v[i]));
        high = std::max(high, highest_bit(v[i]));
      }
    };
    widen(camera_.eye, low_a, high_a);
    for (const glm::dvec3& p : scene_.positions) widen(p, low_a, high_a);
    for (int Y = 0; Y < camera_.rows(); ++Y)
      for (int X = 0; X < camera_.columns(); ++X) widen(camera_.direction(X, Y), low_d, high_d);
    // A difference has one bit more than its terms; a determinant three bits more than a product of three.
    const int bits_a = high_a - low_a + 1, bits_d = high_d - low_d;
    if (std::max(3 * bits_a, 2 * bits_a + bits_d) + 3 > 127)
      throw std::runtime_error("the scene needs more than 128 bits: " + std::to_string(bits_a) +
                               " a coordinate, " + std::to_string(bits_d) + " a direction");
    scale_a_ = std::exp2(-low_a);
    scale_d_ = std::exp2(-low_d);
  }

  IntVec direction(int X, int Y) const { return integers(scale_d_ * camera_.direction(X, Y)); }

  Seen see(std::uint32_t i) const {
    Seen seen;
    const IntVec eye = integers(scale_a_ * camera_.eye);
    for (std::size_t k = 0; k < 3; ++k)
      seen.a[k] = integers(scale_a_ * scene_.positions[scene_.triangles[i].vertex[k]]) - eye;
    for (std::size_t k = 0; k < 3; ++k) seen.edge[k] = cross(seen.a[(k + 1) % 3], seen.a[(k + 2) % 3]);
    seen.n = seen.edge[0] + seen.edge[1] + seen.edge[2];
    seen.volume = dot(seen.a[0], seen.edge[0]);
    return seen;
  }

  static double norm(const IntVec& v) {
    return std::hypot(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
  }

  static Meeting meet(const Seen& seen, const IntVec& d) {
    const int side = sign_of(seen.volume);
    if (side == 0) return {};
    Int128 sum = 0;
    Meeting meeting;
    int zeros = 0;
    for (const IntVec& edge : seen.edge) {
      const Int128 e = dot(d, edge);
      if (sign_of(e) * side < 0) return {};
      zeros += e == 0;
      sum += e;
    }
    if (zeros == 3) return {};
    meeting.zeros = zeros;
    meeting.depth = static_cast<Quad>(seen.volume) / static_cast<Quad>(sum);
    const double n = norm(seen.n);
    meeting.tie = 8 * 0x1p-53 *
                  (norm(seen.a[0]) * n / std::abs(static_cast<double>(seen.volume)) +
                   norm(d) * n / std::abs(static_cast<double>(sum)));
    return meeting;
  }

  // The samples that a triangle in front of the eye may cover, in plain double with a margin of 1/16; all of them for
  // one that reaches to the eye's plane, none for one behind it.
  std::array<int, 4> loose_box(std::uint32_t i) const {
    const auto right = camera_.right, up = camera_.up, ahead = camera_.forward;
    double box[4]{INFINITY, INFINITY, -INFINITY, -INFINITY};
    int in_front = 0, behind = 0;
    for (const std::uint32_t v : scene_.triangles[i].vertex) {
      const glm::dvec3 a = scene_.positions[v] - camera_.eye;
      const auto along = [&](const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
      const double size = std::sqrt(along(a)), depth = along(ahead);
      behind += depth < -1e-9 * size;
      if (!(depth > 1e-6 * size)) continue;
      ++in_front;
      const double height = up.x * up.x + up.y * up.y + up.z * up.z,
                   scale = 2 * camera_.rows() / height / depth;
      const double x = (scale * along(right) + camera_.columns() - 1) / 2;
      const double y = (camera_.rows() - 1 - scale * along(up)) / 2;
      box[0] = std::min(box[0], x);
      box[1] = std::min(box[1], y);
      box[2] = std::max(box[2], x);
      box[3] = std::max(box[3], y);
    }
    if (behind == 3) return {0, 0, 0, 0};
    if (in_front < 3) return {0, 0, camera_.columns(), camera_.rows()};
    const auto within = [](double x, int most) { return static_cast<int>(std::clamp<double>(x, 0, most)); };
    return {within(std::ceil(box[0] - 0.0625), camera_.columns()),
            within(std::ceil(box[1] - 0.0625), camera_.rows()),
            within(std::floor(box[2] + 1.0625), camera_.columns()),
            within(std::floor(box[3] + 1.0625), camera_.rows())};
  }

  void draw(std::uint32_t i) {
    const Seen seen = see(i);
    const auto [x0, y0, x1, y1] = loose_box(i);
    for (int Y = y0; Y < y1; ++Y)
      for (int X = x0; X < x1; ++X) {
        const Meeting meeting = meet(seen, direction(X, Y));
        if (meeting.zeros < 0) continue;
        Sample& sample = samples_[count(Y) * count(camera_.columns()) + count(X)];
        ++sample.met;
        if (meeting.zeros == 0) {
          ++sample.strictly;
          sample.inside = i;
        }
        if (sample.nearest != kNone && !(meeting.depth < sample.depth)) continue;
        sample.nearest = i;
        sample.depth = meeting.depth;
        sample.tie = meeting.tie;
      }
  }

  const Scene& scene_;
  const Camera& camera_;
  std::vector<Sample> samples_;
  double scale_a_ = 1, scale_d_ = 1;
};

}  // namespace sidelight::test
