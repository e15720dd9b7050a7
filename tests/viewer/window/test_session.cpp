// SPDX-License-Identifier: MIT
// The window's state machine and its worker, driven by keys and mouse without a display; the pictures it ends with are
// the headless ones.
#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "tests/viewer/window/session.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

const std::string kLesson =
    "[[step]]\n"
    "text = 'Which shadow?'\n"
    "mode = 'causes'\n"
    "eye = [0, 2, 7]\n"
    "set = { 'trace.depth' = 2 }\n"
    "[[step]]\n"
    "text = 'And now?'\n";

}  // namespace

TEST_CASE("session: pictures are the headless ones, after whatever was pressed on the way") {
  const Open open;
  Session session(open_state(open.file, open_small), open_small);
  check_headless(session);
  CHECK(session.worker().latest().comparison->agrees());

  for (const char* key : {"Left", "Up", "Shift+Right", ".", "D", "f", "a", "Right"}) {
    CAPTURE(key);
    CHECK(session.press(key, kPanel));
  }
  check_headless(session);
  CHECK(session.worker().latest().task.scene->trace.depth == 5);
  CHECK_FALSE(session.worker().latest().task.scene->trace.shadows);
  CHECK(session.worker().latest().traced->n == 2);

  Faults faults;
  faults.tessellate = 8;
  session.set_faults(faults);
  check_headless(session);
  CHECK(session.worker().latest().task.scene->spheres.empty());
  CHECK(window_title(session.state()).rfind("FAULTS ON PURPOSE", 0) == 0);

  session.press("z", kPanel);
  CHECK(session.state().n == 1);
  CHECK_FALSE(session.state().faults.any());
  CHECK(window_title(session.state()) == open.file);  // for it has no title
  check_headless(session);
}

TEST_CASE("session: a storm of input ends in the last one's pictures, and leaving amid it is clean") {
  const Open open;
  {
    Session session(open_state(open.file, open_small), open_small);
    for (int i = 0; i < 40; ++i) {
      session.drag_orbit({3, i % 7 - 3.0}, kPanel);
      if (i % 9 == 0) session.press("d", kPanel);
      std::this_thread::sleep_for(std::chrono::milliseconds(i % 4));
      const Pictures seen = session.worker().latest();  // as the window does, all the while
      if (seen.rastered) CHECK(seen.rastered->width() == 48);
    }
    check_headless(session);
    session.press("Left", kPanel);
  }
}

TEST_CASE("worker: blocks become finer, and a new task cuts them short") {
  const Open open;
  OpenedScene opened = open_small(open.file, {});
  opened.scene.width = 160;
  opened.scene.height = 120;
  PictureTask task;
  task.scene = std::make_shared<const Scene>(opened.scene);
  task.camera = task.scene->camera;
  task.n = 2;
  std::mutex mutex;
  std::vector<int> blocks;
  Progressive* self = nullptr;
  Progressive worker([&] {
    const std::lock_guard lock(mutex);
    if (self) blocks.push_back(self->latest().block);
  });
  {
    const std::lock_guard lock(mutex);
    self = &worker;
  }
  worker.submit(task);
  worker.wait();
  {
    const std::lock_guard lock(mutex);
    CHECK(blocks == std::vector<int>{0, 16, 8, 4, 2, 1, 1});
    CHECK(worker.latest().traced->width() == 160);
    blocks.clear();
  }
  // 64 samples a pixel take a while; the next task does not wait for them.
  task.n = 8;
  worker.submit(task);
  while (worker.latest().task.n != 8 || worker.latest().block == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const Pictures complete = worker.last_finished();
  CHECK(complete.task.n == 2);  // what modes that compare go on showing
  task.n = 1;
  worker.submit(task);
  worker.wait();
  CHECK(worker.last_finished().task.n == 1);
}

TEST_CASE("worker: after a picture that failed the next one is without its error") {
  const Open open;
  PictureTask task = picture_task(open_state(open.file, open_small));
  const Frame none;
  task.options.primary = &none;  // which does not go with the layer of the cost
  task.layer = Layer::cost;
  Progressive worker;
  worker.submit(task);
  worker.wait();
  CHECK(worker.latest().error != "");
  task.options.primary = nullptr;
  worker.submit(task);
  worker.wait();
  CHECK(worker.latest().finished);
  CHECK(worker.latest().error == "");
}

TEST_CASE("session: modes by their keys, and layers in a ring") {
  const Open open;
  Session session(open_state(open.file, open_small), open_small);
  const std::vector<std::pair<const char*, Mode>> keys{
      {"1", Mode::side_by_side}, {"2", Mode::swipe},  {"3", Mode::flip},   {"4", Mode::difference},
      {"5", Mode::causes},       {"6", Mode::ledger}, {"9", Mode::raster}, {"9", Mode::raytrace},
      {"7", Mode::ambient},      {"8", Mode::cost}};
  for (const auto& [key, mode] : keys) {
    session.press(key, kPanel);
    CHECK(mode_name(session.state().mode) == mode_name(mode));
  }
  session.worker().wait();
  CHECK_FALSE(session.worker().latest().traced->cost.empty());  // asked for with its mode
  session.press("7", kPanel);
  CHECK(session.state().mode == Mode::ambient);

  session.press("6", kPanel);
  for (const int term : {1, 2, 3, 0}) {
    session.press("Space", kPanel);
    CHECK(session.state().ledger_term == term);
  }
  for (const char* key : {"Space", "1", "6"}) session.press(key, kPanel);
  CHECK(session.state().ledger_term == 0);  // begun anew
  CHECK_FALSE(session.press("%", kPanel));
  for (int i = 0; i < 30; ++i) session.press(">", kPanel);
  CHECK(session.state().swipe == 1);
  for (int i = 0; i < kModes; ++i) {
    const auto mode = static_cast<Mode>(i);
    CHECK(find_mode(mode_name(mode)) == mode);
  }
}

TEST_CASE("session: lessons ask first, then show") {
  const Open open(kGoodScene + kLesson);
  Session session(open_state(open.file, open_small), open_small);
  session.press("PageDown", kPanel);
  CHECK(session.state().step == 0);
  CHECK_FALSE(session.state().revealed);
  CHECK(session.state().mode == Mode::side_by_side);
  for (const char* key : {"6", "Space", "n"}) session.press(key, kPanel);
  CHECK(session.state().revealed);
  CHECK(session.state().ledger_term == 0);
  CHECK(session.state().mode == Mode::causes);
  CHECK(session.state().camera.eye == glm::dvec3(0, 2, 7));
  CHECK(session.state().scene->trace.depth == 2);
  check_headless(session);
  session.press("n", kPanel);
  session.press("n", kPanel);
  CHECK(session.state().step == 1);
  CHECK(session.state().scene->trace.depth == 6);  // each step starts from the file
  CHECK(session.state().mode == Mode::causes);     // which it does not change
  session.press("n", kPanel);
  CHECK(session.state().step == 1);
  session.press("p", kPanel);
  CHECK(session.state().step == 0);
  CHECK(session.state().revealed);
  session.press("p", kPanel);
  CHECK(session.state().step == -1);
}

TEST_CASE("session: neighbours in the folder, and their ends") {
  const Open open;
  write_bytes(open.folder / "second.toml", kGoodScene);
  write_bytes(open.folder / "tenth.toml", "broken");
  Session session(open_state(open.file, open_small), open_small);
  for (const char* key : {"t", "<", "["}) session.press(key, kPanel);
  CHECK(session.state().notice.text == "this is the first scene of its folder");
  session.press("]", kPanel);
  CHECK(std::filesystem::path(session.state().file).filename() == "second.toml");
  CHECK(session.state().text_scale == 1.25);  // what is set for the room stays
  CHECK(session.state().swipe == doctest::Approx(0.45));
  session.press("]", kPanel);
  CHECK(std::filesystem::path(session.state().file).filename() == "second.toml");
  CHECK(session.state().notice.error);
  session.press("n", kPanel);
  CHECK(session.state().notice.text == "this scene has no steps");
  session.press("z", kPanel);
  CHECK(session.state().notice.text == "");
  for (int i = 0; i < 4; ++i) session.press("t", kPanel);  // up to twice as large, and back
  CHECK(session.state().text_scale == 1);
}

TEST_CASE("session: slow motion draws the first objects only") {
  const Open open;
  Session session(open_state(open.file, open_small), open_small);
  session.press("o", kPanel);
  check_headless(session);
  for (int i = 0; i < 2; ++i) session.press("j", kPanel);
  CHECK(session.state().objects == 1);
  CHECK(session.state().rows == 12);
  session.worker().wait();
  const Pictures pictures = session.worker().latest();
  REQUIRE(pictures.finished);
  CHECK_FALSE(pictures.comparison.has_value());
  for (const std::uint32_t id : pictures.rastered->object_id) CHECK(id <= 1);
  session.set_slow(-5, 9000);
  CHECK(session.state().objects == 0);
  CHECK(session.state().rows == 36);
  session.worker().wait();
  for (const std::uint32_t id : session.worker().latest().rastered->object_id) CHECK(id == 0);
  session.set_slow(0, -1);
  CHECK(session.state().rows == 0);
  session.press("z", kPanel);
  CHECK(session.state().rows == 36);
  session.press("o", kPanel);
  check_headless(session);
}

TEST_CASE("session: Escape closes what is open, the window last") {
  const Open open;
  Session session(open_state(open.file, open_small), open_small);
  session.press("h", kPanel);
  session.inspect({3, 4});
  session.inspect({48, 4});  // outside
  CHECK(session.state().inspected == glm::ivec2(3, 4));
  session.press("Esc", kPanel);
  CHECK_FALSE(session.state().help);
  session.press("Esc", kPanel);
  CHECK_FALSE(session.state().inspected.has_value());
  session.press("l", kPanel);
  session.press("o", kPanel);
  session.press("Esc", kPanel);
  CHECK_FALSE(session.state().lesson);
  CHECK(session.state().slow);
  session.press("Esc", kPanel);
  CHECK_FALSE(session.state().slow);
  CHECK_FALSE(session.closed());
  session.press("Esc", kPanel);
  CHECK(session.closed());
}

TEST_CASE("session: a pixel that a step's larger picture had is let go with the step") {
  const Workplace here;
  write_bytes(here / "steps.toml", kGoodScene + "[picture]\nsize = [48, 36]\n[[step]]\ntext = 'larger'\n" +
                                       "set = { 'picture.size' = [64, 36] }\n");
  const SceneOpener open = [](const std::string& name, const Settings& set) {
    OpenedScene opened;
    opened.scene = load_scene_with(name, set, &opened.files);
    return opened;
  };
  Session session(open_state(here / "steps.toml", open), open);
  for (int i = 0; i < 2; ++i) session.press("n", kPanel);
  session.inspect({48, 0});
  REQUIRE(session.state().inspected.has_value());
  session.press("z", kPanel);
  CHECK_FALSE(session.state().inspected.has_value());
  session.inspect({47, 0});
  session.press("z", kPanel);
  CHECK(session.state().inspected.has_value());
}
