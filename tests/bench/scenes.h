// SPDX-License-Identifier: MIT
// The scenes that sidelight and its peers race on, made here so that a run needs no file. Each has its camera and its
// bars: how many times as fast as the peer sidelight must be, and should be.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/build.h"
#include "common/scene/scene.h"

namespace sidelight::bench {

struct Entry {
  std::string name;
  double least = 0, aim = 0;  // times as fast as the peer; 0: no bar
  std::function<Scene()> make;
};

// For the z-buffer: triangles only, with a unit normal of its own, of the same number, at every position; local light of
// two lamps. Coordinates are multiples of 2^-20 below 16 in size: floats hold them, and 128-bit integers judge them.
// `mesh`, the path of an OBJ file, takes the place of both made meshes. Throws InputError.
std::vector<Entry> raster_entries(const std::optional<std::string>& mesh);

// The scene's camera at a frame: near its place, nowhere twice, looking at the same point.
CameraSettings moved_eye(const Scene& scene, int frame);

// `text` is names separated by commas, or empty for all. In the order of `entries`. Throws UsageError, which lists the
// names.
std::vector<Entry> chosen(const std::vector<Entry>& entries, const std::string& text);

}  // namespace sidelight::bench
