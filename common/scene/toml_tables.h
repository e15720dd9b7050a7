// SPDX-License-Identifier: MIT
// The tables of a scene file, as toml.cpp calls for them: toml_objects.cpp reads those that put objects into the scene, in
// the order of the file, toml_parts.cpp the others. InputError for every mistake.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/scene/build.h"
#include "common/scene/scene.h"
#include "common/scene/toml_values.h"

namespace sidelight::scene_file {

// Limits on what a few bytes of scene file may ask for.
inline constexpr std::size_t kMaxGenerated = std::size_t{1} << 22;        // triangles of shapes; see Effort
inline constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 32;  // of mesh files; see Effort
inline constexpr int kMaxSegments = 4096;                                 // of a shape, around
inline constexpr int kMaxQuads = 1 << 18;                                 // of a torus

// Materials of the scene file by name; values index Scene::materials.
using MaterialNames = std::map<std::string, std::uint32_t, std::less<>>;

// What a few bytes of scene file have made the reader do so far: a shape or file counts each time that it is read, also
// for the check of a step that changes its object; kMaxClipping bounds what all meshes but shapes, whose faces are convex,
// may cost together. So no file of a lesson's size can keep the reader busy for hours.
struct Effort {
  std::size_t generated = 0;      // triangles of shapes
  std::uintmax_t file_bytes = 0;  // of mesh and material files
  double clipping = 0;            // clipping_effort of meshes
};

// What objects are read with and where they go.
struct ObjectSink {
  const Document& document;
  const MaterialNames& materials;
  Scene& scene;                           // objects are added, and warnings of mesh files
  Effort& effort;                         // goes up
  std::vector<std::string> files_read{};  // OBJ and MTL files, in order
};

void read_picture(const Value& value, Scene& scene);
void read_camera(const Value& value, CameraSettings& camera);
void read_trace(const Value& value, TraceSettings& trace);
Light read_light(const Document& document, const toml::table& source);

// All of [material], into the scene in the order of the file; their numbers by name.
MaterialNames read_materials(const Value& value, Scene& scene);

// Each adds the one object of `table`; a mesh is an OBJ file, written out, or a generated shape.
void read_sphere(ObjectSink& sink, const toml::table& table);
void read_plane(ObjectSink& sink, const toml::table& table);
void read_mesh(ObjectSink& sink, const toml::table& table);

// The `transform` of a mesh: T Rz Ry Rx S of `translate`, `rotate` (degrees) and `scale`, or `matrix`, 16 numbers row by
// row. Quarter turns are exact.
Transform read_transform(const Value& value);

}  // namespace sidelight::scene_file
