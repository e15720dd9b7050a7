// SPDX-License-Identifier: MIT
#include "viewer/window/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace sidelight {
namespace {

// The zooms of the wheel from 1 up; below 1 their reciprocals.
constexpr std::array<double, 12> kLadder{1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, kMaxZoom};

// The nearest rung above `zoom` (below, if not up); beyond the ends of the ladder its ends.
double next_zoom(double zoom, bool up) {
  if (!up) return 1 / next_zoom(1 / zoom, true);
  if (zoom >= 1) {
    const auto rung = std::upper_bound(kLadder.begin(), kLadder.end(), zoom);
    return rung == kLadder.end() ? kMaxZoom : *rung;
  }
  for (auto rung = kLadder.rbegin(); rung != kLadder.rend(); ++rung)
    if (1 / *rung > zoom) return 1 / *rung;
  return 1;
}

glm::dvec2 extent(const Rect& panel) { return {std::max(1, panel.width()), std::max(1, panel.height())}; }

double fit_zoom(glm::ivec2 picture, const Rect& panel) {
  const glm::dvec2 ratio = extent(panel) / glm::dvec2(glm::max(picture, glm::ivec2(1)));
  const double zoom = std::min(ratio.x, ratio.y);
  return zoom < 1 ? zoom : std::min(std::floor(zoom), kMaxZoom);
}

// The view with the picture in the middle along `axis`, to a whole device pixel: what View says is what shows, so
// that zooming about the cursor starts from the pixel the user sees.
void put_in_middle(View& view, glm::ivec2 picture, const Rect& panel, int axis) {
  view.center[axis] = picture[axis] / 2.0;
  view.center[axis] = (middle(panel) - picture_origin(view, panel))[axis] / view.zoom;
}

}  // namespace

glm::dvec2 middle(const Rect& panel) { return glm::dvec2(panel.x0, panel.y0) + extent(panel) / 2.0; }

View fit(const View& view, glm::ivec2 picture, const Rect& panel) {
  View fitted = view;
  fitted.fitted = true;
  fitted.zoom = fit_zoom(picture, panel);
  for (int axis = 0; axis < 2; ++axis) put_in_middle(fitted, picture, panel, axis);
  return fitted;
}

View clamp(const View& view, glm::ivec2 picture, const Rect& panel) {
  if (view.fitted) return fit(view, picture, panel);
  View clamped = view;
  for (int axis = 0; axis < 2; ++axis) {
    const double half = extent(panel)[axis] / (2 * view.zoom);
    if (2 * half >= picture[axis])
      put_in_middle(clamped, picture, panel, axis);
    else
      clamped.center[axis] = std::clamp(view.center[axis], half, picture[axis] - half);
  }
  return clamped;
}

View zoom_about(const View& view, glm::ivec2 picture, const Rect& panel, glm::dvec2 cursor, int steps) {
  const double whole = fit_zoom(picture, panel);
  View zoomed = view;
  for (int i = 0; i < std::abs(steps); ++i) zoomed.zoom = next_zoom(zoomed.zoom, steps > 0);
  // A zoom out ends at the whole picture; where that is already passed, a step out changes nothing.
  if (steps < 0) zoomed.zoom = std::max(zoomed.zoom, std::min({1.0, whole, view.zoom}));
  zoomed.fitted = zoomed.zoom == whole;

  const glm::dvec2 under_cursor = view.center + (cursor - middle(panel)) / view.zoom;
  zoomed.center = under_cursor - (cursor - middle(panel)) / zoomed.zoom;
  return clamp(zoomed, picture, panel);
}

View pan(const View& view, glm::ivec2 picture, const Rect& panel, glm::dvec2 by) {
  View panned = view;
  panned.center -= by / view.zoom;
  return clamp(panned, picture, panel);
}

glm::dvec2 picture_origin(const View& view, const Rect& panel) {
  return glm::floor(middle(panel) - view.center * view.zoom + 0.5);
}

}  // namespace sidelight
