// SPDX-License-Identifier: MIT
// Reads a scene file (TOML, README "Scene file"). Every mistake is an InputError at its line and column that says what
// was found, what was expected and, for a name, the nearest valid one.
#pragma once

#include <string>

#include "common/scene/scene.h"

namespace sidelight {

// Reads `path` and all mesh files it names (relative to the scene file's folder). Throws InputError.
Scene load_scene(const std::string& path);

// The same from text in memory; `path` stands in messages and anchors relative mesh files.
Scene parse_scene(const std::string& text, const std::string& path);

// Sets one value of a scene file's text by its key path ("trace.depth" = "1"), as a lesson's step does, and returns
// the scene that results. `files`, where given, receives the names of all files that were read: the scene's, then those
// of its meshes. Throws InputError as load_scene does.
Scene load_scene_with(const std::string& path, const std::vector<std::pair<std::string, std::string>>& set,
                      std::vector<std::string>* files = nullptr);

}  // namespace sidelight
