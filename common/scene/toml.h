// SPDX-License-Identifier: MIT
// Reads a scene file (TOML, README "Scene file"). Every mistake is an InputError at its line and column that says what
// was found, what was expected and, for a name, the nearest valid one.
#pragma once

#include <string>

#include "common/scene/scene.h"
#include "common/scene/settings.h"

namespace sidelight {

// Reads `path` and all mesh files it names (relative to the scene file's folder). Throws InputError.
Scene load_scene(const std::string& path);

// The same from text in memory; `path` stands in messages and anchors relative mesh files.
Scene parse_scene(const std::string& text, const std::string& path);

// The same with values of the file replaced, each by its key path ("trace.depth" = "1"), as a lesson's step does; the file
// itself stays as it is. `files`, where given, receives the names of all files that were read: the scene's, then those of
// its meshes. With any value replaced the lesson's steps are not tried, as load_scene does: they are for the file as it is.
Scene load_scene_with(const std::string& path, const Settings& set,
                      std::vector<std::string>* files = nullptr);

}  // namespace sidelight
