// SPDX-License-Identifier: MIT
// What tests of the window's session share: scenes opened without a command line, a panel to press keys over, and the
// comparison with the pictures of a headless run.
#pragma once

#include <doctest/doctest.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/scene/toml.h"
#include "tests/support/program.h"
#include "viewer/window/session.h"

namespace sidelight::test {

inline constexpr Rect kPanel{24, 90, 24 + 320, 90 + 240};

// Pictures of this size, whatever the file says, drawn by two threads.
inline SceneOpener opener(int width, int height) {
  return [=](const std::string& file, const Settings& set) {
    OpenedScene opened;
    opened.scene = load_scene_with(file, set, &opened.files);
    opened.scene.width = width;
    opened.scene.height = height;
    opened.options.threads = 2;
    return opened;
  };
}

inline const SceneOpener open_small = opener(48, 36);

// A scene file in a folder of its own.
struct Open {
  TemporaryFolder folder;
  std::string file = folder / "scene.toml";
  explicit Open(const std::string& text = kGoodScene) { write_bytes(file, text); }
};

// Writes the file with a time that differs from the one before, however coarse the file system's clock.
inline void save_later(const std::string& file, const std::string& text) {
  const auto before = std::filesystem::last_write_time(file);
  write_bytes(file, text);
  std::filesystem::last_write_time(file, before + std::chrono::seconds(2));
}

inline bool same_bits(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

// Its pictures once it rests.
inline Pictures rested(const Session& session) {
  session.worker().wait();
  return session.worker().latest();
}

// Once the session rests, its pictures are those that a headless run makes of what it shows.
inline void check_headless(const Session& session) {
  const Pictures shown = rested(session);
  REQUIRE(shown.error == "");
  REQUIRE(shown.finished);
  const PictureTask task = picture_task(session.state());
  const auto rasterizer = raster::prepare(*task.scene);
  const auto tracer = raytrace::prepare(*task.scene);
  CHECK(
      same_bits(shown.rastered->color, raster::render(*rasterizer, task.made_camera(), task.options).color));
  CHECK(same_bits(shown.traced->color, raytrace::render(*tracer, task.made_camera(), task.options).color));
  CHECK(same_bits(shown.traced->color, render_pictures(task).traced->color));
}

}  // namespace sidelight::test
