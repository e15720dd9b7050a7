// SPDX-License-Identifier: MIT
#include "common/scene/closed_mesh.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

namespace sidelight {
namespace {

using glm::dvec3;

// A number for each position, the same for equal ones.
std::vector<std::uint32_t> welded(std::span<const dvec3> positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const dvec3 &a = positions[i], &b = positions[j];
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  });
  std::vector<std::uint32_t> number(positions.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool repeated = k > 0 && positions[order[k]] == positions[order[k - 1]];
    number[order[k]] = repeated ? number[order[k - 1]] : order[k];
  }
  return number;
}

}  // namespace

bool is_closed(std::span<const Triangle> triangles, std::span<const dvec3> positions,
               std::uint32_t first_position) {
  const std::vector<std::uint32_t> point = welded(positions);
  // Edges as (lower, higher) end, by the sense they are walked in.
  std::vector<std::uint64_t> rising, falling;
  rising.reserve(triangles.size() * 3 / 2 + 1);
  falling.reserve(triangles.size() * 3 / 2 + 1);
  for (const Triangle& triangle : triangles) {
    std::array<std::uint64_t, 3> v{};
    for (std::size_t k = 0; k < 3; ++k) v[k] = point[triangle.vertex[k] - first_position];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t from = v[k], to = v[(k + 1) % 3];
      if (from < to)
        rising.push_back(from << 32 | to);
      else
        falling.push_back(to << 32 | from);
    }
  }
  if (rising.empty() || rising.size() != falling.size()) return false;
  std::sort(rising.begin(), rising.end());
  std::sort(falling.begin(), falling.end());
  return rising == falling && std::adjacent_find(rising.begin(), rising.end()) == rising.end();
}

bool is_inside_out(std::span<const Triangle> triangles, std::span<const dvec3> positions,
                   std::uint32_t first_position) {
  const dvec3 origin = positions[triangles.front().vertex[0] - first_position];
  double volume = 0, permanent = 0;
  for (const Triangle& triangle : triangles) {
    std::array<dvec3, 3> v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = positions[triangle.vertex[k] - first_position] - origin;
    const auto& [a, b, c] = v;
    volume += glm::dot(a, glm::cross(b, c));
    permanent += glm::dot(glm::abs(a), glm::abs(dvec3(b.y * c.z, b.z * c.x, b.x * c.y)) +
                                           glm::abs(dvec3(b.z * c.y, b.x * c.z, b.y * c.x)));
  }
  // Per term 8 roundings, then one sum a term; twice that, for room.
  return volume < -2 * (static_cast<double>(triangles.size()) + 8) * 0x1p-53 * permanent;
}

}  // namespace sidelight
