// SPDX-License-Identifier: MIT
// The picture that errors are measured against: the ray tracer's own rays with all light in double, nothing left out, and
// so many samples that more of them change little. Its shorter forms, with fewer samples, tell the kinds of error apart.
//
// Depth: from the scene's on until the mean weight of the rays not sent is below 2^-24, which is less than a float can
// tell from white, and no cut; or until kMostDepth; or as long as it takes no more than kMostRays rays an eye ray, since
// rays within glass within glass multiply without end. Where even the scene's own depth takes more, the scene's own
// depth and cut: nothing is then nearer the truth than what the scene asks for. The weight left out is reported.
//
// Samples: n x n with n = 1, 2, 4, 8, 16, until the RMSE between two pictures in a row is below kReferenceBound. With q
// the ratio of the last two such steps, what remains is estimated as the rest of a geometric series, q / (1 - q) of the
// last; after a single step q = 1/2, which is slow: a box filter over n x n points converges at least as 1/n.
#pragma once

#include <functional>
#include <limits>
#include <map>

#include "viewer/bench/cache.h"
#include "viewer/bench/stage.h"

namespace sidelight {

inline constexpr double kReferenceBound = 1.0 / 255;  // one step of 8 bits
inline constexpr int kMostDepth = 1000;
inline constexpr double kMostRays = 16;

class Reference {
 public:
  Reference(Stage& stage, PictureCache cache) : stage_(stage), cache_(std::move(cache)) {}

  struct Picture {
    Model model;
    double cut_weight = 0;
    std::optional<double> against_brute_force;  // of n = 1
    std::vector<glm::vec3> color;
  };
  // The full model with n x n samples, from memory, from the cache, or made.
  const Picture& picture(int n);

  // The sequence until it stops: fills all but `ms` and the 8-bit picture. `progress` hears of each n beforehand.
  ReferenceImage converge(const std::function<void(int n)>& progress = {});
  // Whether a picture had to be made.
  bool made_any() const { return made_any_; }

 private:
  std::string key(int n) const;
  Model full_model();
  Picture make(int n);

  Stage& stage_;
  PictureCache cache_;
  bool made_any_ = false;
  double rays_an_eye_ray_ = 0;  // with that model
  std::map<int, Picture> pictures_;
};

// What remains after these steps; infinite where they do not fall.
double remaining_error(const std::vector<double>& steps);

}  // namespace sidelight
