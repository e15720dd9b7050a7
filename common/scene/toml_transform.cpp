// SPDX-License-Identifier: MIT
#include "common/scene/toml_tables.h"

#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

namespace sidelight::scene_file {
namespace {

struct SinCos {
  double sin, cos;
};

// Exact at multiples of 90 degrees, so that a quarter turn maps the axes onto each other.
SinCos sin_cos(double degrees) {
  const double angle = std::fmod(degrees, 360);  // exact
  const double quarters = angle / 90;
  if (quarters != std::trunc(quarters)) return {std::sin(glm::radians(angle)), std::cos(glm::radians(angle))};
  constexpr std::array<SinCos, 4> kQuarter = {{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}};
  return kQuarter[(static_cast<std::size_t>(quarters + 4)) % 4];
}

// Counter-clockwise about the axis (0, 1, 2 for x, y, z) as seen from its tip.
glm::dmat3 rotation(int axis, double degrees) {
  const auto [sin, cos] = sin_cos(degrees);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  glm::dmat3 matrix(1);  // columns: where the axes go
  matrix[u][u] = cos;
  matrix[u][v] = sin;
  matrix[v][u] = -sin;
  matrix[v][v] = cos;
  return matrix;
}

glm::dvec3 read_scale(const Value& value) {
  if (value.node.is_number()) return glm::dvec3(read_number(value, kCoordinate));
  if (!value.node.is_array()) value.fail("a number or an array of 3");
  return read_vector(value, kCoordinate);
}

// 16 numbers, row by row; the last row must be 0 0 0 1.
Transform read_matrix(const Value& value) {
  const toml::array& array = read_array(value, 16, "an array of 16 numbers, row by row");
  constexpr std::array<double, 4> kLastRow = {0, 0, 0, 1};
  Transform transform;
  for (std::size_t i = 0; i < 16; ++i) {
    const double x = read_number(value.element(array[i]), kCoordinate);
    const int row = static_cast<int>(i / 4), column = static_cast<int>(i % 4);
    if (row == 3 && x != kLastRow[i % 4]) value.element(array[i]).fail("the last row to be 0, 0, 0, 1");
    if (row == 3) continue;
    (column < 3 ? transform.linear[column] : transform.translate)[row] = x;
  }
  return transform;
}

}  // namespace

Transform read_transform(const Value& value) {
  const TableReader table(value.document, read_table(value), "transform",
                          {.required = {}, .optional = {"translate", "rotate", "scale", "matrix"}});
  if (const auto matrix = table.find("matrix")) {
    for (const std::string_view other : {"translate", "rotate", "scale"})
      if (table.find(other)) matrix->fail("it alone, or translate, rotate and scale without it");
    return read_matrix(*matrix);
  }
  Transform transform;
  if (const auto translate = table.find("translate")) transform.translate = read_position(*translate);
  if (const auto rotate = table.find("rotate")) {
    const glm::dvec3 degrees = read_vector(*rotate, kCoordinate);
    transform.linear = rotation(2, degrees.z) * rotation(1, degrees.y) * rotation(0, degrees.x);
  }
  if (const auto scale = table.find("scale")) {
    const glm::dvec3 factors = read_scale(*scale);
    for (int axis = 0; axis < 3; ++axis) transform.linear[axis] *= factors[axis];
  }
  return transform;
}

}  // namespace sidelight::scene_file
