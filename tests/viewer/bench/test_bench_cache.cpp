// SPDX-License-Identifier: MIT
// Pictures kept between runs: found again in every bit, never believed when damaged, and not needed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/picture/folder.h"
#include "tests/picture/frames.h"
#include "tests/support/scenes.h"
#include "viewer/bench/reference.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

Frame noise_frame(int width, int height, unsigned seed) {
  Frame frame = make_frame(width, height, 1, {});
  fill_with_noise(frame, seed);
  return frame;
}

bool finds(const PictureCache& cache, const std::string& key, const Frame& frame) {
  const auto found = cache.find(key, frame.width(), frame.height());
  return found && std::ranges::equal(found->color, frame.color);
}

// A lit sphere, small enough to be traced in no time.
Scene small_scene(const std::string& hash) {
  Scene scene = test::scene_of(Sphere{{0, 0, 0}, 1, 0});
  scene.lights = {test::sun({0, 0, 1}, 1)};
  scene.camera.eye = {0, 0, 4};
  scene.camera.look_at = {0, 0, 0};
  scene.width = 8;
  scene.height = 6;
  scene.hash = hash;
  return scene;
}

}  // namespace

TEST_CASE("cache: what is kept is found, with its notes, and nothing else is") {
  const TemporaryFolder folder;
  const PictureCache cache(folder / "new/deep");
  const Frame a = noise_frame(7, 5, 1), b = noise_frame(7, 5, 2);
  CHECK_FALSE(finds(cache, "a", a));
  REQUIRE(cache.keep("a", a, {{"depth", "12"}}));
  REQUIRE(cache.keep("b", b, {}));
  CHECK(finds(cache, "a", a));
  CHECK(finds(cache, "b", b));
  CHECK(cache.find("a", 7, 5)->notes.at("depth") == "12");
  CHECK_FALSE(cache.find("a", 5, 7).has_value());
  REQUIRE(cache.keep("a", b, {}));  // once more: the later one
  CHECK(finds(cache, "a", b));
}

TEST_CASE("cache: a damaged file is no file, wherever it is damaged") {
  const TemporaryFolder folder;
  const PictureCache cache(folder / ".");
  const Frame frame = noise_frame(9, 4, 3);
  REQUIRE(cache.keep("key", frame, {}));
  const std::string path = cache.file_of("key").string(), whole = read_bytes(path);
  for (std::size_t cut = 0; cut < whole.size(); cut += 1 + whole.size() / 16) {
    write_bytes(path, whole.substr(0, cut));
    CHECK_FALSE(cache.find("key", 9, 4).has_value());
  }
  // A flipped bit may fall where nothing is read; then the picture is right all the same.
  for (std::size_t at = 0; at < whole.size(); at += 7) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    write_bytes(path, bytes);
    if (cache.find("key", 9, 4)) CHECK(finds(cache, "key", frame));
  }
  // Another picture under this name, as a collision of hashes would bring.
  REQUIRE(cache.keep("other", frame, {}));
  std::filesystem::copy_file(cache.file_of("other"), path, std::filesystem::copy_options::overwrite_existing);
  CHECK_FALSE(cache.find("key", 9, 4).has_value());
}

TEST_CASE("cache: where it cannot be written, or there is none, nothing is kept and nothing fails") {
  const TemporaryFolder folder;
  write_bytes(folder / "file", "in the way");
  for (const PictureCache& cache : {PictureCache(folder / "file/cache"), PictureCache("")}) {
    CHECK_FALSE(cache.keep("a", noise_frame(2, 2, 4), {}));
    CHECK_FALSE(cache.find("a", 2, 2).has_value());
  }
}

TEST_CASE("cache: its folder is the user's") {
  const std::string home = std::getenv("HOME") ? std::getenv("HOME") : "";
  const std::string xdg = std::getenv("XDG_CACHE_HOME") ? std::getenv("XDG_CACHE_HOME") : "";
  ::setenv("HOME", "/home/someone", 1);
  ::setenv("XDG_CACHE_HOME", "relative", 1);  // which the specification says to ignore
  CHECK(usual_cache_folder() == "/home/someone/.cache/sidelight");
  ::setenv("XDG_CACHE_HOME", "/var/elsewhere", 1);
  CHECK(usual_cache_folder() == "/var/elsewhere/sidelight");
  ::unsetenv("XDG_CACHE_HOME");
  ::unsetenv("HOME");
  CHECK(usual_cache_folder().empty());
  if (!home.empty()) ::setenv("HOME", home.c_str(), 1);
  if (!xdg.empty()) ::setenv("XDG_CACHE_HOME", xdg.c_str(), 1);
}

TEST_CASE("reference: from the cache the same one, made anew where the cache fails, and of this scene only") {
  const TemporaryFolder folder;
  const PictureCache cache(folder / ".");
  const auto converge = [&](const std::string& hash, bool& made) {
    Stage stage(small_scene(hash));
    Reference reference(stage, cache);
    const ReferenceImage image = reference.converge();
    made = reference.made_any();
    return std::pair(image.steps, reference.picture(image.n).color);
  };
  bool made = false;
  const auto first = converge("one", made);
  CHECK(made);
  const std::size_t files = folder.count();
  CHECK(files == first.first.size() + 1);  // one for each n
  CHECK(converge("one", made) == first);
  CHECK_FALSE(made);

  // Interrupted before the last, or with a file cut short: only what is missing is made.
  const auto some_file = std::filesystem::directory_iterator(folder / ".")->path();
  std::filesystem::resize_file(some_file, 40);
  CHECK(converge("one", made) == first);
  CHECK(made);
  std::filesystem::remove(some_file);
  CHECK(converge("one", made) == first);
  CHECK(made);
  converge("two", made);
  CHECK(made);
  CHECK(folder.count() == 2 * files);
}

TEST_CASE(
    "reference: at least twice as fine as what is measured against it, however soon it would do by itself") {
  Scene scene = small_scene("dark");
  scene.lights.clear();  // black on black: one step tells all
  Stage stage(scene);
  for (const auto& [finest, n] : {std::pair(1, 2), std::pair(2, 4), std::pair(3, 8), std::pair(16, 32)}) {
    CAPTURE(finest);
    const ReferenceImage image = Reference(stage, PictureCache("")).converge(finest);
    CHECK(image.n == n);
    CHECK(image.finer);
  }
}

TEST_CASE("reference: what remains is the rest of a geometric series") {
  CHECK(remaining_error({0.25}) == 0.25);  // after one step, halves
  CHECK(remaining_error({0.3, 0.1}) == doctest::Approx(0.05).epsilon(1e-12));
  CHECK(std::isinf(remaining_error({0.1, 0.1})));
  CHECK(remaining_error({0.1, 0}) == 0);
}
