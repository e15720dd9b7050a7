// SPDX-License-Identifier: MIT
#include "viewer/window/camera_moves.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace sidelight {
namespace {

// The least angle between the viewing direction and up: nearer, the picture would roll at a touch.
constexpr double kPole = 0.02;
// What a scene file may say: half a power of ten inside of it, so that a saved scene loads again.
constexpr double kNearest = 1e-9, kFarthest = 1e14;

bool usable(const CameraSettings& camera) {
  const auto within = [](const glm::dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < kFarthest;  // false for NaN
  };
  return within(camera.eye) && within(camera.look_at) && glm::distance(camera.eye, camera.look_at) > kNearest;
}

CameraSettings moved_if_usable(const CameraSettings& before, const CameraSettings& after) {
  return usable(after) ? after : before;
}

}  // namespace

CameraSettings orbit(const CameraSettings& camera, double around, double over) {
  // The frame of the turn: the camera's own right side, and the up direction of the scene made square to it.
  const Camera frame = make_camera(camera, 1, 1, 1);
  const glm::dvec3 right = glm::normalize(frame.right);
  const bool upright = glm::length(glm::cross(camera.up, frame.forward)) > 1e-9 * glm::length(camera.up);
  const glm::dvec3 up = upright ? glm::normalize(camera.up) : glm::normalize(frame.up);
  const glm::dvec3 level = glm::normalize(glm::cross(right, up));  // towards the eye, level

  const glm::dvec3 arm = camera.eye - camera.look_at;
  const double length = glm::length(arm);
  const double height = std::asin(std::clamp(glm::dot(arm, up) / length, -1.0, 1.0));
  const double limit = std::numbers::pi / 2 - kPole;
  const double turned = std::clamp(height + over, std::min(-limit, height), std::max(limit, height));
  const glm::dvec3 side = std::sin(around) * right + std::cos(around) * level;

  CameraSettings out = camera;
  out.eye = camera.look_at + length * (std::cos(turned) * side + std::sin(turned) * up);
  return moved_if_usable(camera, out);
}

CameraSettings slide(const CameraSettings& camera, glm::dvec2 by) {
  const Camera frame = make_camera(camera, 1, 1, 1);  // right and up carry the view height
  const double distance = glm::distance(camera.eye, camera.look_at);
  const glm::dvec3 step = distance * (by.x * frame.right + by.y * frame.up);
  CameraSettings out = camera;
  out.eye += step;
  out.look_at += step;
  return moved_if_usable(camera, out);
}

CameraSettings dolly(const CameraSettings& camera, double factor) {
  CameraSettings out = camera;
  out.eye = camera.look_at + factor * (camera.eye - camera.look_at);
  return moved_if_usable(camera, out);
}

//   d = (2x - W) r + (H - 2y) u + 2H f   with x = X + 1/2, so a point p - eye = t d has
//   t = (p - eye).f / 2H,   2x - W = (p - eye).r / (t r.r),   H - 2y = (p - eye).u / (t u.u)
glm::dvec2 project(const Camera& camera, const glm::dvec3& point) {
  const glm::dvec3 v = point - camera.eye;
  const double t = glm::dot(v, camera.forward) / (2.0 * camera.height);
  const double across = glm::dot(v, camera.right) / (t * glm::dot(camera.right, camera.right));
  const double upward = glm::dot(v, camera.up) / (t * glm::dot(camera.up, camera.up));
  return {(camera.width + across) / 2, (camera.height - upward) / 2};
}

double in_front(const Camera& camera, const glm::dvec3& point) {
  return glm::dot(point - camera.eye, camera.forward);
}

}  // namespace sidelight
