// SPDX-License-Identifier: MIT
#include "common/scene/toml_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include "common/scene/build.h"
#include "common/scene/unit_vector.h"

namespace sidelight::scene_file {
namespace {

constexpr int kMaxDepth = 1000, kMaxPictureEdge = 65535;
constexpr Range kFieldOfView{1e-28, 179.999999999999, "an angle in degrees above 0 and below 180"};
constexpr Range kShininess{0, kMostShininess, "a number from 0 to 1e6"};
constexpr Range kIor{kLeastIor, kMostIor, "a number from 0.25 to 4"};

Material read_material(const Value& value) {
  const TableReader table(value.document, read_table(value),
                          "[material." + printable(std::string(value.name), 60) + "]",
                          {.required = {},
                           .optional = {"ambient", "diffuse", "specular", "shininess", "local", "reflect",
                                        "refract", "ior", "casts_shadow"}});
  Material material;
  material.name = value.name;
  if (const auto v = table.find("ambient")) material.ambient = read_color(*v);
  if (const auto v = table.find("diffuse")) material.diffuse = read_color(*v);
  if (const auto v = table.find("specular")) material.specular = read_color(*v);
  if (const auto v = table.find("shininess")) material.shininess = read_number(*v, kShininess);
  if (const auto v = table.find("local")) material.local = read_color(*v);
  if (const auto v = table.find("reflect")) material.reflect = read_color(*v);
  if (const auto v = table.find("refract")) material.refract = read_color(*v);
  if (const auto v = table.find("ior")) material.ior = read_number(*v, kIor);
  if (const auto v = table.find("casts_shadow")) material.casts_shadow = read_flag(*v);
  return material;
}

// --- The transform of a mesh ---

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

void read_picture(const Value& value, Scene& scene) {
  const TableReader table(value.document, read_table(value), "[picture]",
                          {.required = {}, .optional = {"size"}});
  const auto size = table.find("size");
  if (!size) return;
  const toml::array& edges = read_array(*size, 2, "[width, height]");
  scene.width = read_integer(size->element(edges[0]), 1, kMaxPictureEdge);
  scene.height = read_integer(size->element(edges[1]), 1, kMaxPictureEdge);
}

void read_camera(const Value& value, CameraSettings& camera) {
  constexpr std::array<std::string_view, 2> kHeights = {"vertical_fov", "view_height"};
  const TableReader table(
      value.document, read_table(value), "[camera]",
      {.required = {"eye", "look_at"}, .optional = {"up", "vertical_fov", "view_height"}});
  camera.eye = read_position(table["eye"]);
  camera.look_at = read_position(table["look_at"]);
  if (camera.eye == camera.look_at) table["look_at"].fail("a point other than the eye");
  if (const auto up = table.find("up")) camera.up = read_direction(*up);
  if (table.only_one_of(kHeights) == "view_height")
    camera.view_height = read_number(table["view_height"], kLength);
  else
    camera.view_height = 2 * std::tan(glm::radians(read_number(table["vertical_fov"], kFieldOfView)) / 2);
}

void read_trace(const Value& value, TraceSettings& trace) {
  const TableReader table(value.document, read_table(value), "[trace]",
                          {.required = {},
                           .optional = {"depth", "contribution_cut", "secondary_attenuation", "shadows",
                                        "reflection", "refraction"}});
  if (const auto v = table.find("depth")) trace.depth = read_integer(*v, 1, kMaxDepth);
  if (const auto v = table.find("contribution_cut")) trace.contribution_cut = read_number(*v, kFraction);
  if (const auto v = table.find("secondary_attenuation")) trace.secondary_attenuation = read_attenuation(*v);
  if (const auto v = table.find("shadows")) trace.shadows = read_flag(*v);
  if (const auto v = table.find("reflection")) trace.reflection = read_flag(*v);
  if (const auto v = table.find("refraction")) trace.refraction = read_flag(*v);
}

Light read_light(const Document& document, const toml::table& source) {
  constexpr std::array<std::string_view, 2> kPlaces = {"position", "direction"};
  const TableReader table(document, source, "[[light]]",
                          {.required = {"intensity"}, .optional = {"position", "direction", "attenuation"}});
  Light light;
  light.directional = table.only_one_of(kPlaces) == "direction";
  if (light.directional)
    light.direction = unit_or_zero(read_direction(table["direction"]));
  else
    light.position = read_position(table["position"]);
  light.intensity = read_color(table["intensity"]);
  if (const auto attenuation = table.find("attenuation")) {
    if (light.directional) attenuation->fail("none: light from a direction has no distance to fall off with");
    light.attenuation = read_attenuation(*attenuation);
  }
  return light;
}

MaterialNames read_materials(const Value& value, Scene& scene) {
  const toml::table& table = read_table(value);
  std::vector<std::string_view> in_order;
  for (const auto& [name, node] : table) in_order.push_back(name.str());
  std::ranges::stable_sort(in_order, {}, [&](std::string_view name) {
    return file_order(value.document.where(*table.get(name)));
  });
  MaterialNames names;
  for (const std::string_view name : in_order)
    names.emplace(name, add_material(scene, read_material({value.document, *table.get(name), name})));
  return names;
}

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
