// SPDX-License-Identifier: MIT
// What a mode shows of the two renderers' pictures: one panel or two, each an 8-bit picture with its caption and the
// number behind every pixel. No drawing; the pictures are those that `compare --all-modes` writes.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/picture/signed_difference.h"
#include "common/picture/srgb.h"
#include "viewer/window/panels.h"
#include "viewer/window/state.h"

namespace sidelight {

struct ShownPanel {
  Image8 image;  // of the picture, or coarser while it is being refined
  Caption caption;
  bool of_left = false;  // the z-buffer's
  // The numbers of a pixel of the whole picture, one a line; empty where there are none.
  std::function<std::vector<std::string>(glm::ivec2 pixel)> numbers;
};

struct Shown {
  std::vector<ShownPanel> panels;                // 1 or 2, left to right, as before any flip
  bool swipe = false;                            // two panels in one place, divided by state.swipe
  std::optional<DifferenceHistogram> histogram;  // of the signed difference, where that is shown
};

// Empty before the first picture. Modes that compare show the last pictures that were finished.
Shown show(const WindowState& state, const Pictures& latest, const Pictures& finished);

// Changes whenever show() would return something else.
struct ShownKey {
  Mode mode;
  int ledger_term, rows;
  bool slow, finished;
  const void *rastered, *traced, *finished_traced;
  bool operator==(const ShownKey&) const = default;
};
ShownKey shown_key(const WindowState& state, const Pictures& latest, const Pictures& finished);

// What the causes map says beside its colours: "shadow: 12.3 % of pixels, mean 0.0310".
std::vector<std::string> cause_lines(const Comparison& comparison);

}  // namespace sidelight
