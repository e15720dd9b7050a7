// SPDX-License-Identifier: MIT
// Changes of a scene as settings of its file (toml.h: load_scene_with), and a file's text with settings written into it:
// how a scene that was changed in the window becomes a command line, or a scene file again.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/scene/scene.h"

namespace sidelight {

using Settings = std::vector<std::pair<std::string, std::string>>;  // key path, value as TOML

// What to set in the file of `from` to get `to`, in every bit: picture size, camera, trace, background, ambient, lights
// and materials, of which both have the same. Objects are not looked at. Throws InputError where a material of a mesh file
// differs: no setting reaches it.
Settings settings_between(const Scene& from, const Scene& to);

// The scene file's text with the values in the places of the old ones, or as new lines of their tables; all else,
// comments and order too, stays. `path` is for messages. Throws InputError where a path leads nowhere.
std::string with_settings(std::string text, const Settings& settings, const std::string& path);

}  // namespace sidelight
