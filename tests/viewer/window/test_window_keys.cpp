// SPDX-License-Identifier: MIT
// The panels by keyboard alone: frames are drawn off screen, keys come in as the window hands them on.
#include "tests/viewer/window/session.h"
#include "viewer/window/frames.h"
#include "viewer/window/offscreen.h"

using namespace sidelight;
using namespace sidelight::test;

#ifdef SIDELIGHT_HAVE_OSMESA

namespace {

constexpr glm::ivec2 kWindowSize{1000, 700};

// A session in a window off screen; `body` calls the function it is given for the frames that the window would draw.
void with_window(const std::function<void(Session&, Frames&, const std::function<void()>&)>& body) {
  const TemporaryFolder folder;
  write_bytes(folder / "scene.toml", kGoodScene);
  const SceneOpener open = opener(48, 36);
  Session session(open_state(folder / "scene.toml", open), open);
  draw_offscreen(kWindowSize.x, kWindowSize.y, [&](Canvas& canvas) {
    Frames frames(canvas, session);
    const auto draw = [&] {
      for (int left = 3; left > 0; --left)
        if (frames.take_pictures() | frames.draw(kWindowSize, 1)) left = 3;
    };
    draw();
    body(session, frames, draw);
  });
}

// The same for keys: each is followed by its frames.
void with_keys(const std::function<void(Session&, const std::function<void(const char*)>&)>& body) {
  with_window([&](Session& session, Frames& frames, const std::function<void()>& draw) {
    body(session, [&](const char* key) {
      frames.press(key, kPanel);
      draw();
    });
  });
}

}  // namespace

TEST_CASE("mouse: a click between two frames presses its button") {
  with_window([](Session& session, Frames& frames, const std::function<void()>& draw) {
    session.set_mode(Mode::swipe);
    draw();
    const Rect buttons = frames.layout().panels.footer;
    const glm::dvec2 first(buttons.x0 + 20, buttons.y0 + 15);
    frames.set_pointer(first, false, 0);
    draw();
    frames.set_pointer(first, true, 0);
    frames.set_pointer(first, false, 0);
    draw();
    CHECK(session.state().mode == Mode::side_by_side);
  });
}

TEST_CASE("keyboard: Tab gives the controls the arrows and Space, Escape gives them back") {
  with_keys([](Session& session, const std::function<void(const char*)>& press) {
    const auto eye = session.state().camera.eye;
    press("c");
    press("Tab");
    CHECK(key_target(session.state()) == KeyTarget::controls);
    press("Down");   // to the first one: depth
    press("Space");  // takes it
    press("Right");
    press("Right");
    press("Left");
    press("Enter");  // lets it go
    CHECK(session.state().scene->trace.depth == 7);
    press("Down");  // the switch of the shadows
    press("Space");
    CHECK_FALSE(session.state().scene->trace.shadows);
    press("Right");  // of the mirrors
    press("Space");
    CHECK_FALSE(session.state().scene->trace.reflection);
    CHECK(session.state().camera.eye == eye);
    press("5");  // what no widget knows is the program's
    CHECK(session.state().mode == Mode::causes);

    // To the buttons at the very end, past the sliders of lights, material and the faults.
    for (int i = 0; i < 40 && session.state().scene->trace.depth == 7; ++i) {
      press("Down");
      press("Space");
      press("Space");
    }
    CHECK(session.state().scene->trace.depth == 6);  // reset
    press("Esc");
    CHECK(key_target(session.state()) == KeyTarget::pictures);
    press("Left");
    CHECK(session.state().camera.eye != eye);
    CHECK_FALSE(session.closed());
  });
}

TEST_CASE("keyboard: Tab goes round the open panels") {
  with_keys([](Session& session, const std::function<void(const char*)>& press) {
    press("Tab");  // none is open
    CHECK(key_target(session.state()) == KeyTarget::pictures);
    press("l");
    session.inspect({20, 20});
    for (const KeyTarget target :
         {KeyTarget::fragments, KeyTarget::rays, KeyTarget::lesson, KeyTarget::pictures}) {
      press("Tab");
      CHECK(key_target(session.state()) == target);
    }
    press("Tab");
    press("Tab");
    press("Tab");
    press("l");  // closes the panel that had the keys
    CHECK(key_target(session.state()) == KeyTarget::pictures);
    const auto eye = session.state().camera.eye;
    press("Left");
    CHECK(session.state().camera.eye != eye);
  });
}

TEST_CASE(
    "keyboard: each slider of the material turns its own coefficient, and a depth format comes with its "
    "planes") {
  with_keys([](Session& session, const std::function<void(const char*)>& press) {
    session.edit([](Scene& scene) {
      Material& material = scene.materials[0];
      material.ambient = material.diffuse = material.specular = glm::dvec3(0.5);
      material.local = material.reflect = material.refract = glm::dvec3(0.5);
      material.shininess = 10;
      material.ior = 2;
    });
    Material before = session.state().scene->materials[0];
    std::string turned;  // in order
    bool planes = false;
    const auto note = [&] {
      const Material& now = session.state().scene->materials[0];
      const auto look = [&](const char* name, auto field) {
        if (now.*field != before.*field && !turned.ends_with(name)) turned += name;
      };
      look(" ka", &Material::ambient);
      look(" kd", &Material::diffuse);
      look(" ks", &Material::specular);
      look(" s", &Material::shininess);
      look(" c1", &Material::local);
      look(" c2", &Material::reflect);
      look(" c3", &Material::refract);
      look(" ior", &Material::ior);
      before = now;
      const Faults& faults = session.state().faults;
      planes =
          planes || (faults.depth_format && 0 < faults.near_plane && faults.near_plane < faults.far_plane);
    };
    press("c");
    press("Tab");
    for (int i = 0; i < 40 && !planes; ++i)
      for (const char* key : {"Down", "Space", "Right", "Enter"}) {
        press(key);
        note();
      }
    CHECK(turned == " ka kd ks s c1 c2 c3 ior");
    CHECK(planes);
  });
}

#endif
