// SPDX-License-Identifier: MIT
// Our picture beside POV-Ray's, pixel by pixel. One in which the two disagree must belong to a class of which we know
// the cause:
//
//   edge       POV-Ray shows what we show beside it. The line through the pixel's centre runs along an edge of an
//              object, a face, a shadow or a mirrored picture of one, and falls to the other side: POV-Ray keeps a
//              mesh's vertices in float, takes an edge as open where we take it as closed, and starts and ends its rays
//              by tolerances.
//   smooth     An interpolated normal N is at odds with the triangle it stands on, as happens along a smooth mesh's
//              outline: it looks away from the viewer (N.V < 0), or its mirror ray goes below the triangle. We ask the
//              triangle and keep to its side; POV-Ray knows N only, turns it round and lets the ray go inside.
//   later      The same at a later hit of the pixel's tree of rays.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <string>

#include "tests/agreement/pictures.h"
#include "tests/judges/povray.h"

namespace sidelight::test {

inline constexpr int kClose = 16, kVisible = 257;  // of 65535; 257 is 1/255

struct Verdict {
  std::size_t pixels = 0, close = 0, visible = 0, edge = 0, smooth = 0, later = 0;
  int worst = 0;
  std::string unexplained;  // the first pixel that belongs to no class

  double percent(std::size_t n) const { return 100.0 * static_cast<double>(n) / static_cast<double>(pixels); }
};

inline void check_verdict(const Verdict& verdict) {
  CHECK(verdict.percent(verdict.close) >= 99.9);
  CHECK(verdict.percent(verdict.visible) <= 0.05);
  CHECK(verdict.unexplained == "");
}

// As write_png_linear16 does.
inline int in_65535(float value) {
  return static_cast<int>(std::floor(std::clamp(value, 0.0f, 1.0f) * 65535.0 + 0.5));
}

class Judge {
 public:
  Judge(const Scene& scene, PovQuality quality)
      : scene_(scene),
        quality_(quality),
        camera_(make_camera(scene.camera, scene.width, scene.height, 1)),
        frame_(quality == PovQuality::local ? rastered(scene, camera_) : traced(scene, camera_)),
        picture_(render_pov(scene, quality)),
        prepared_(raytrace::prepare(scene)) {}

  Verdict verdict() const {
    Verdict out;
    out.pixels = frame_.pixels();
    for (int y = 0; y < frame_.height(); ++y)
      for (int x = 0; x < frame_.width(); ++x) {
        const int difference = difference_at(x, y);
        out.worst = std::max(out.worst, difference);
        out.visible += difference > kVisible;
        if (difference <= kClose)
          ++out.close;
        else
          classify(x, y, out);
      }
    return out;
  }

  const Frame& frame() const { return frame_; }
  const PovPicture& picture() const { return picture_; }

 private:
  int difference_at(int x, int y) const {
    const std::size_t i = frame_.index(x, y);
    int most = 0;
    for (int c = 0; c < 3; ++c)
      most = std::max(most, std::abs(in_65535(frame_.color[i][c]) -
                                     int{picture_.pixels[i][static_cast<std::size_t>(c)]}));
    return most;
  }

  // Whether POV-Ray's pixel lies among ours around it.
  bool among_neighbours(int x, int y) const {
    for (int c = 0; c < 3; ++c) {
      int low = 65535, high = 0;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, frame_.height() - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, frame_.width() - 1); ++u) {
          low = std::min(low, in_65535(frame_.color[frame_.index(u, v)][c]));
          high = std::max(high, in_65535(frame_.color[frame_.index(u, v)][c]));
        }
      const int theirs = picture_.pixels[frame_.index(x, y)][static_cast<std::size_t>(c)];
      if (theirs < low - kClose || theirs > high + kClose) return false;
    }
    return true;
  }

  static bool at_odds(const RayRecord& ray) {
    if (ray.background || !ray.sent) return false;
    const glm::dvec3 D = glm::normalize(ray.direction), N = ray.local.surface.normal;
    const glm::dvec3 mirrored = D - 2 * glm::dot(D, N) * N;
    return glm::dot(N, D) > 0 || glm::dot(mirrored, ray.local.surface.facing) < 0;
  }
  static bool at_odds_later(const RayRecord& ray) {
    return std::any_of(ray.children.begin(), ray.children.end(),
                       [](const RayRecord& child) { return at_odds(child) || at_odds_later(child); });
  }

  void classify(int x, int y, Verdict& out) const {
    const RayRecord ray = raytrace::explain(*prepared_, camera_, x, y);
    if (at_odds(ray))
      ++out.smooth;
    else if (quality_ == PovQuality::full && at_odds_later(ray))
      ++out.later;
    else if (among_neighbours(x, y))
      ++out.edge;
    else if (out.unexplained.empty()) {
      const auto& theirs = picture_.pixels[frame_.index(x, y)];
      out.unexplained = fmt::format("pixel {},{}: ours {}, POV-Ray's ({:.9g}, {:.9g}, {:.9g})", x, y,
                                    text(frame_.color[frame_.index(x, y)]), theirs[0] / 65535.0,
                                    theirs[1] / 65535.0, theirs[2] / 65535.0);
    }
  }

  const Scene& scene_;
  PovQuality quality_;
  Camera camera_;
  Frame frame_;
  PovPicture picture_;
  std::shared_ptr<const raytrace::Prepared> prepared_;
};

}  // namespace sidelight::test
