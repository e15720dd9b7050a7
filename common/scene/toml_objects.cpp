// SPDX-License-Identifier: MIT
#include "common/scene/toml_tables.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "common/scene/build.h"
#include "common/scene/number_text.h"
#include "common/scene/obj.h"
#include "common/scene/shapes.h"

namespace sidelight::scene_file {
namespace {

std::uint32_t read_material(const ObjectSink& sink, const Value& value) {
  const std::string name = read_text(value);
  const auto found = sink.materials.find(name);
  if (found != sink.materials.end()) return found->second;
  std::vector<std::string_view> names;
  for (const auto& [known, index] : sink.materials) names.push_back(known);
  value.fail("a material: " + expected_one_of(names, name));
}

// --- Meshes written out ----------------------------------------------------------------------------------------

void read_face(const Value& value, PolygonMesh& mesh) {
  const std::string expected = "faces of 3 to " + std::to_string(kMaxCorners) + " vertex indices";
  const toml::array& indices = read_list(value, expected);
  if (indices.size() < 3 || indices.size() > kMaxCorners) value.fail(expected);
  const SourceLocation where = value.where();
  mesh.faces.push_back({.first = static_cast<std::uint32_t>(mesh.corners.size()),
                        .count = static_cast<std::uint32_t>(indices.size()),
                        .material = 0,
                        .line = where.line,
                        .column = where.column});
  const int last = static_cast<int>(mesh.positions.size()) - 1;
  for (const toml::node& index : indices)
    mesh.corners.push_back({static_cast<std::uint32_t>(read_integer(value.element(index), 0, last)), kNone});
}

PolygonMesh read_written(const TableReader& table) {
  const Value vertices = table["vertices"], faces = table["faces"];
  PolygonMesh mesh;
  for (const toml::node& vertex : read_list(vertices, "an array of vertices, each of 3 numbers"))
    mesh.positions.push_back(read_position(vertices.element(vertex)));
  if (mesh.positions.size() < 3) vertices.fail("3 vertices or more");
  for (const toml::node& face : read_list(faces, "an array of faces, each of vertex indices"))
    read_face(faces.element(face), mesh);
  if (mesh.faces.empty()) faces.fail("1 face or more");
  return mesh;
}

// --- Generated shapes ------------------------------------------------------------------------------------------

int segments_around(const TableReader& table) {
  const auto segments = table.find("segments");
  return segments ? read_integer(*segments, 3, kMaxSegments) : 64;
}

PolygonMesh read_box(const TableReader& table) { return make_box(read_vector(table["size"], kLength)); }

PolygonMesh read_cylinder(const TableReader& table) {
  return make_cylinder(read_number(table["radius"], kLength), read_number(table["height"], kLength),
                       segments_around(table));
}

PolygonMesh read_cone(const TableReader& table) {
  return make_cone(read_number(table["radius"], kLength), read_number(table["height"], kLength),
                   segments_around(table));
}

PolygonMesh read_torus(const TableReader& table) {
  const Value radii = table["radii"];
  const toml::array& lengths = read_array(radii, 2, "[major, minor]");
  const double major = read_number(radii.element(lengths[0]), kLength);
  const double minor = read_number(radii.element(lengths[1]), kLength);
  if (!(minor < major)) radii.element(lengths[1]).fail("a minor radius below the major one");

  int around = 64, tube = 32;
  if (const auto segments = table.find("segments")) {
    const toml::array& counts = read_array(*segments, 2, "[around, tube]");
    around = read_integer(segments->element(counts[0]), 3, kMaxSegments);
    tube = read_integer(segments->element(counts[1]), 3, kMaxSegments);
    if (around * tube > kMaxQuads) segments->fail("a product of at most " + std::to_string(kMaxQuads));
  }
  return make_torus(major, minor, around, tube);
}

struct Shape {
  std::string_view name;
  Keys keys;  // beyond those of every shape
  PolygonMesh (*read)(const TableReader&);
};

const std::array<Shape, 4> kShapes = {{
    {"box", {{"size"}, {}}, read_box},
    {"cylinder", {{"radius", "height"}, {"segments"}}, read_cylinder},
    {"cone", {{"radius", "height"}, {"segments"}}, read_cone},
    {"torus", {{"radii"}, {"segments"}}, read_torus},
}};

const Shape& read_shape_name(const Value& value) {
  std::array<std::string_view, kShapes.size()> names;
  for (std::size_t i = 0; i < kShapes.size(); ++i) names[i] = kShapes[i].name;
  const std::string name = read_name(value, names);
  return *std::ranges::find(kShapes, name, &Shape::name);
}

// --- Mesh files ------------------------------------------------------------------------------------------------

// Relative to the scene file's folder. Pipes and devices are refused: reading one might never end.
std::string read_path(const Value& value) {
  const std::string name = read_text(value);
  const std::filesystem::path path = std::filesystem::path(value.document.path).parent_path() / name;
  std::error_code ignored;
  const bool named = !name.empty() && name.find('\0') == std::string::npos;
  if (!named || !std::filesystem::exists(path, ignored))
    value.fail("an existing file; there is no " + in_quotes(path.string()));
  if (!std::filesystem::is_regular_file(path, ignored)) value.fail("a file, not a folder or a device");
  return path.string();
}

void count_files(ObjectSink& sink, const std::vector<std::string>& files, const Value& value) {
  sink.files_read.insert(sink.files_read.end(), files.begin(), files.end());
  std::error_code gone;
  for (const std::string& file : files)
    if (const std::uintmax_t bytes = std::filesystem::file_size(file, gone); !gone)
      sink.effort.file_bytes += bytes;
  if (sink.effort.file_bytes > kMaxFileBytes)
    value.fail("mesh files of at most 4 GiB together, each counted as often as meshes and steps need it");
}

// The polygons of an OBJ file; without a material of the table's own, the file's are added to the scene.
PolygonMesh read_obj_mesh(ObjectSink& sink, const Value& value, bool own_materials) {
  const std::string path = read_path(value);
  ObjFile obj = read_obj(path, own_materials);
  count_files(sink, obj.files, value);
  sink.scene.warnings.insert(sink.scene.warnings.end(), obj.warnings.begin(), obj.warnings.end());
  if (!own_materials) return std::move(obj.mesh);

  std::vector<std::uint32_t> scene_index;
  for (Material& material : obj.materials) {
    material.of_mesh_file = true;
    scene_index.push_back(add_material(sink.scene, std::move(material)));
  }
  for (PolygonMesh::Face& face : obj.mesh.faces) {
    if (face.material == kNone)
      throw InputError(
          {path, face.line, face.column},
          "a face before any usemtl, expected one (or a 'material' for the mesh in the scene file)");
    face.material = scene_index[face.material];
  }
  return std::move(obj.mesh);
}

// --- One mesh --------------------------------------------------------------------------------------------------

// A polygon of n corners makes n - 2 triangles.
std::size_t triangle_count(const PolygonMesh& mesh) { return mesh.corners.size() - 2 * mesh.faces.size(); }

PolygonMesh read_shape(ObjectSink& sink, const toml::table& table, const Shape& shape) {
  Keys keys = shape.keys;
  keys.required.insert(keys.required.end(), {"shape", "material"});
  keys.optional.push_back("transform");
  PolygonMesh mesh = shape.read({sink.document, table, "[[mesh]] of shape " + in_quotes(shape.name), keys});
  sink.effort.generated += triangle_count(mesh);
  if (sink.effort.generated > kMaxGenerated)
    throw InputError(
        sink.document.where(table),
        "with this mesh the scene has " + std::to_string(sink.effort.generated) +
            " triangles of generated shapes (again for each step that changes one), expected at most " +
            std::to_string(kMaxGenerated));
  return mesh;
}

void count_clipping(ObjectSink& sink, const toml::table& table, const PolygonMesh& mesh) {
  sink.effort.clipping += clipping_effort(mesh);
  if (sink.effort.clipping > kMaxClipping)
    throw InputError(sink.document.where(table),
                     "with this mesh the squares of the faces' corner counts add up to " +
                         number_text(sink.effort.clipping) +
                         " (again for each step that changes one), expected at most " +
                         number_text(kMaxClipping));
}

// A mesh is of one of three sorts, and each takes keys that make no sense for the others.
PolygonMesh read_polygons(ObjectSink& sink, const toml::table& table) {
  constexpr std::array<std::string_view, 3> kSorts = {"file", "shape", "vertices"};
  const TableReader any(sink.document, table, "[[mesh]]",
                        {.required = {},
                         .optional = {"file", "shape", "vertices", "faces", "size", "radius", "height",
                                      "radii", "segments", "material", "transform"}});
  const std::string_view sort = any.only_one_of(kSorts);
  if (sort == "file") {
    const TableReader reader(sink.document, table, "[[mesh]] with a file",
                             {.required = {"file"}, .optional = {"material", "transform"}});
    return read_obj_mesh(sink, reader["file"], !reader.find("material"));
  }
  if (sort == "vertices") {
    return read_written({sink.document,
                         table,
                         "[[mesh]] with vertices",
                         {.required = {"vertices", "faces", "material"}, .optional = {"transform"}}});
  }
  return read_shape(sink, table, read_shape_name(any["shape"]));
}

}  // namespace

void read_sphere(ObjectSink& sink, const toml::table& table) {
  const TableReader reader(sink.document, table, "[[sphere]]",
                           {.required = {"center", "radius", "material"}, .optional = {}});
  Sphere sphere;
  sphere.center = read_position(reader["center"]);
  sphere.radius = read_number(reader["radius"], kLength);
  sphere.material = read_material(sink, reader["material"]);
  add_sphere(sink.scene, sphere, reader.where());
}

void read_plane(ObjectSink& sink, const toml::table& table) {
  const TableReader reader(sink.document, table, "[[plane]]",
                           {.required = {"point", "normal", "material"}, .optional = {}});
  Plane plane;
  plane.point = read_position(reader["point"]);
  plane.normal = read_direction(reader["normal"]);
  plane.material = read_material(sink, reader["material"]);
  add_plane(sink.scene, plane, reader.where());
}

void read_mesh(ObjectSink& sink, const toml::table& table) {
  PolygonMesh mesh = read_polygons(sink, table);
  if (!table.contains("shape")) count_clipping(sink, table, mesh);
  const SourceLocation where = sink.document.where(table);
  if (const toml::node* material = table.get("material")) {
    const std::uint32_t index = read_material(sink, {sink.document, *material, "material"});
    for (PolygonMesh::Face& face : mesh.faces) face.material = index;
  }
  Transform transform;
  if (const toml::node* node = table.get("transform"))
    transform = read_transform({sink.document, *node, "transform"});
  add_mesh(sink.scene, mesh, transform, where);
}

}  // namespace sidelight::scene_file
