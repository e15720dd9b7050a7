// SPDX-License-Identifier: MIT
// How long a window's frames took while it was open, and how long an input waited for its pictures: kept in memory, as a
// table (CSV) and in a few lines of words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/window/frames.h"

namespace sidelight {

class FrameLog {
 public:
  // A frame that is on the screen now, and the pictures it shows.
  void add(const FrameTime& time, const Pictures& shown);

  // A line a frame, in ms: at, prepare, upload, draw, swap; and where the frame was the first with that picture of an
  // input, the time since the input: to_zbuffer, to_traced.
  std::string csv() const;

  // Median, 99th percentile and maximum of the frames' times and of the inputs' waits; pictures a second.
  std::string summary() const;

 private:
  struct Line {
    FrameTime time;
    std::optional<double> to_zbuffer, to_traced;
  };
  std::vector<Line> lines_;
  double zbuffer_of_ = -1, traced_of_ = -1;  // tasks, by asked_ms, whose pictures have been on the screen
};

}  // namespace sidelight
