// SPDX-License-Identifier: MIT
// The window's session and the files that it opens: saved under it, and with how many samples they may be drawn.
#include "tests/viewer/window/session.h"

using namespace sidelight;
using namespace sidelight::test;

TEST_CASE("session: a saved file is loaded again, a mistake in it is told, and the picture stays") {
  const Open open;
  Session session(open_state(open.file, open_small), open_small);
  CHECK_FALSE(session.watch());
  const auto before = session.state().scene;
  save_later(open.file, "[camera]\neye = 3\nlook_at = [0, 0, 0]\nview_height = 1\n");
  CHECK(session.watch());
  CHECK(session.state().scene == before);
  CHECK(session.state().notice.error);
  CHECK(session.state().notice.text.find("scene.toml:2:7") != std::string::npos);
  CHECK_FALSE(session.watch());  // told once
  check_headless(session);

  for (const char* key : {"Left", "f", "g", "r", "a", "4", "D"}) session.press(key, kPanel);
  Faults faults;
  faults.tessellate = 8;
  session.set_faults(faults);
  const glm::dvec3 eye = session.state().camera.eye;
  std::string text = "[trace]\ndepth = 3\n" + kGoodScene;
  text.replace(text.find("radius = 1"), 10, "radius = 2");
  save_later(open.file, text);
  CHECK(session.watch());
  CHECK(session.state().notice.text == "");
  CHECK(session.state().scene->spheres[0].radius == 2);
  CHECK(session.state().scene->trace.depth == 3);  // which the file changed, too
  CHECK(session.state().camera.eye == eye);        // the user's, as what follows
  CHECK_FALSE(session.state().scene->trace.shadows);
  CHECK_FALSE(session.state().scene->trace.reflection);
  CHECK_FALSE(session.state().scene->trace.refraction);
  CHECK(session.state().mode == Mode::difference);
  CHECK(session.state().n == 2);
  CHECK(session.state().faults == faults);
  check_headless(session);
  session.press("z", kPanel);
  CHECK(session.state().scene->trace.shadows);
  CHECK_FALSE(session.state().faults.any());

  std::filesystem::remove(open.file);
  CHECK_FALSE(session.watch());
}

TEST_CASE(
    "session: of a camera that the user moved, the file still sets the angle, and its own moves go first") {
  const Open open;
  Session session(open_state(open.file, open_small), open_small);
  session.press("Left", kPanel);
  const glm::dvec3 eye = session.state().camera.eye;
  std::string text = kGoodScene;
  save_later(open.file, text.replace(text.find("vertical_fov = 40"), 17, "vertical_fov = 20"));
  CHECK(session.watch());
  CHECK(session.state().camera.eye == eye);
  CHECK(session.state().camera.view_height == session.state().scene->camera.view_height);
  session.press("s", kPanel);  // the angle would not be there twice
  CHECK_FALSE(session.state().notice.error);

  save_later(open.file, text.replace(text.find("eye = [0, 1, 6]"), 15, "eye = [0, 1, 9]"));
  CHECK(session.watch());
  CHECK(session.state().camera.eye == glm::dvec3(0, 1, 9));
}

TEST_CASE("session: a mesh file under another name is read once the scene says so") {
  const std::string text = kGoodScene + "[[mesh]]\nfile = 'a.obj'\nmaterial = 'red'\n";
  const Open open(text);
  write_bytes(open.folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  Session session(open_state(open.file, open_small), open_small);
  std::filesystem::rename(open.folder / "a.obj", open.folder / "b.obj");
  CHECK_FALSE(session.watch());  // an editor may be about to replace it
  std::string renamed = text;
  renamed.replace(renamed.find("a.obj"), 5, "b.obj");
  save_later(open.file, renamed);
  CHECK(session.watch());
  CHECK(session.state().notice.text == "");
  CHECK(session.state().opened.files.back() == open.folder / "b.obj");
  CHECK_FALSE(session.watch());
}

TEST_CASE("session: a saved file keeps the step that is shown and the mode, as long as it has the step") {
  const std::string text = kGoodScene + "[[step]]\ntext = 'See.'\nmode = 'causes'\neye = [0, 2, 7]\n";
  const Open open(text);
  Session session(open_state(open.file, open_small), open_small);
  for (const char* key : {"n", "n", "4"}) session.press(key, kPanel);
  save_later(open.file, text + "# and more\n");
  CHECK(session.watch());
  CHECK(session.state().revealed);
  CHECK(session.state().camera.eye == glm::dvec3(0, 2, 7));
  CHECK(session.state().mode == Mode::difference);
  save_later(open.file, kGoodScene);
  CHECK(session.watch());
  CHECK(session.state().step == -1);
  CHECK_FALSE(session.state().revealed);
}

TEST_CASE("session: keys add samples as far as memory holds them, and never make more of them fewer") {
  const Open scene;
  const auto opens_with = [](int OpenedScene::*field, int value) -> SceneOpener {
    return [=](const std::string& name, const Settings& set) {
      OpenedScene opened = open_small(name, set);
      opened.*field = value;
      return opened;
    };
  };
  const SceneOpener in_little_memory = opens_with(&OpenedScene::most_n, 2);
  const SceneOpener with_many = opens_with(&OpenedScene::n, 16);
  Session session(open_state(scene.file, open_small), open_small);
  session.set_samples_per_edge(9);
  CHECK(session.state().n == 8);
  Session little(open_state(scene.file, in_little_memory), in_little_memory);
  for (int i = 0; i < 3; ++i) little.press("a", kPanel);
  CHECK(little.state().n == 2);
  Session many(open_state(scene.file, with_many), with_many);
  many.press("a", kPanel);
  CHECK(many.state().n == 16);
  many.press("A", kPanel);
  CHECK(many.state().n == 15);
  for (int i = 0; i < 9; ++i) many.press("D", kPanel);
  CHECK(many.state().scene->trace.depth == 1);
}
