// SPDX-License-Identifier: MIT
// The picture that errors are measured against: the ray tracer's own rays with all light in double, nothing left out, and
// so many samples that more of them change little. Its shorter forms, with fewer samples, tell the kinds of error apart.
//
// Cost: all pictures of the sequence together take no more than kReferenceSteps steps a pixel (stage.h), the one of 2x2
// samples always made. At 22 ns a step that is 47 s of two cores for 640x480.
//
// Depth: from 1 on until the mean weight of the rays not sent is below 2^-24, which is less than a float can tell from
// white, without any cut; or until kMostDepth; but one picture of a sample a pixel takes at most the 21st part of the
// above, so that n = 1, 2, 4 fit. Where that is too little, for rays within glass within glass multiply without end, the
// rays below a weight are cut: of the weights 0 and 1/8, 1/16, ..., each with the depth that it can afford, and of the
// scene's own depth and cut whatever they cost, that which leaves out least. What is left out is reported, with what it
// can amount to.
//
// Samples: n x n with n = 1, 2, 4, 8, 16, until the RMSE between two pictures in a row is below kReferenceBound and n is
// at least twice that of whatever is measured against it: against its own samples a picture would seem to have no error.
// With q the ratio of the last two such steps, what remains is estimated as the rest of a geometric series, q / (1 - q) of
// the last; after a single step q = 1/2, which is slow: a box filter over n x n points converges at least as 1/n.
#pragma once

#include <functional>
#include <limits>
#include <map>

#include "viewer/bench/cache.h"
#include "viewer/bench/stage.h"

namespace sidelight {

inline constexpr double kReferenceBound = 1.0 / 255;  // one step of 8 bits
inline constexpr int kMostDepth = 1000;
inline constexpr double kReferenceSteps = 14000;

class Reference {
 public:
  Reference(Stage& stage, PictureCache cache) : stage_(stage), cache_(std::move(cache)) {}

  struct Picture {
    Model model;
    double cut_weight = 0;
    double steps = 0;                           // a pixel
    std::optional<double> against_brute_force;  // of n = 1
    KeptArray<glm::vec3> color;
  };
  // The full model with n x n samples, from memory, from the cache, or made.
  const Picture& picture(int n);

  // The sequence until it stops, for pictures of up to finest x finest samples a pixel: fills all but `ms` and the 8-bit
  // picture. `progress` hears how many steps a pixel are done.
  ReferenceImage converge(int finest = 1, std::function<void(double steps)> progress = {});
  // Whether a picture had to be made.
  bool made_any() const { return made_any_; }

 private:
  std::string key(int n) const;
  // What it leaves out and takes, tried out.
  struct Trial {
    Model model;
    double unsent = std::numeric_limits<double>::infinity(), steps = 0;
    bool all_sent = false;
  };
  Trial trial(int depth, double cut);
  Trial deepest(double cut);
  Model full_model();
  Picture make(int n);

  Stage& stage_;
  PictureCache cache_;
  bool made_any_ = false;
  std::function<void(double steps)> progress_;
  double spent_ = 0;  // steps a pixel
  std::map<int, Picture> pictures_;
};

// What remains after these steps; infinite where they do not fall.
double remaining_error(const std::vector<double>& steps);

// The most that rays not sent, of this mean weight, can take from the mean of a channel: the weight times the brightest
// that a ray can bring. That is the background, or L / (1 - k) of a surface: L its local light in all lamps, k what it
// mirrors and transmits of another such ray. (One with L = 0 and k = 1 adds nothing.) Infinite where k > 1, or k = 1 and
// L > 0, or a lamp has no bound.
double unsent_bound(const Scene& scene, double cut_weight);

}  // namespace sidelight
