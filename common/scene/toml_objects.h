// SPDX-License-Identifier: MIT
// The tables of a scene file that put objects into the scene: [[sphere]], [[plane]] and [[mesh]], the last as an OBJ
// file, written out, or as a generated shape, with its transform. Called by toml.cpp in the order of the file.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

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
// for the check of a step that changes its object. So no file of a lesson's size can keep the reader busy for hours.
struct Effort {
  std::size_t generated = 0;      // triangles of shapes
  std::uintmax_t file_bytes = 0;  // of mesh and material files
};

// What objects are read with and where they go.
struct ObjectSink {
  const Document& document;
  const MaterialNames& materials;
  Scene& scene;                           // objects are added, and warnings of mesh files
  Effort& effort;                         // goes up
  std::vector<std::string> files_read{};  // OBJ and MTL files, in order
};

// Each adds the one object of `table`. InputError for every mistake.
void read_sphere(ObjectSink& sink, const toml::table& table);
void read_plane(ObjectSink& sink, const toml::table& table);
void read_mesh(ObjectSink& sink, const toml::table& table);

}  // namespace sidelight::scene_file
