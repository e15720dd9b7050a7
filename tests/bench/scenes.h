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

// A Phong material of this colour.
Material painted(const glm::dvec3& color);

// The scene's camera at a frame: near its place, nowhere twice, looking at the same point.
CameraSettings moved_eye(const Scene& scene, int frame);

// Which of `names` stand in `text`, names separated by commas; all where it is empty. Throws UsageError, which lists
// the names.
std::vector<bool> chosen(const std::vector<std::string>& names, const std::string& text);
template <class SomeEntry>
std::vector<SomeEntry> chosen(const std::vector<SomeEntry>& entries, const std::string& text) {
  std::vector<std::string> names;
  for (const SomeEntry& entry : entries) names.push_back(entry.name);
  const std::vector<bool> wanted = chosen(names, text);
  std::vector<SomeEntry> out;
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (wanted[i]) out.push_back(entries[i]);
  return out;
}

}  // namespace sidelight::bench
