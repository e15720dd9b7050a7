// SPDX-License-Identifier: MIT
// A session used without a pause: every key, the mouse, the controls, and files saved, spoilt and mended under it, by a
// seeded hand. Nothing may fail, and memory may not grow. Without a display: the frames are drawn off screen, or in
// sanitized builds, whose tools know nothing of the OpenGL driver, only prepared.
#include <doctest/doctest.h>

#include <iostream>
#include <random>

#include "common/clock.h"
#include "common/scene/step_modes.h"
#include "tests/support/memory.h"
#include "tests/tier.h"
#include "tests/viewer/window/session.h"
#include "viewer/window/frames.h"
#include "viewer/window/offscreen.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

constexpr glm::ivec2 kPicture{200, 150}, kWindow{1000, 600};

double resident_mb() { return static_cast<double>(resident_bytes()) / (1 << 20); }

// Two scenes beside each other, the first with a lesson and a mesh in a file of its own.
class Folder {
 public:
  Folder() {
    write_bytes(mesh(), mesh_text(1));
    write_bytes(scene(), scene_text(1));
    write_bytes(folder_ / "second.toml", kGoodScene);
  }
  std::string scene() const { return folder_ / "scene.toml"; }
  std::string mesh() const { return folder_ / "tetrahedron.obj"; }

  // What an editor leaves after the n-th save: now the scene, now the mesh, now and then a mistake.
  void save(int n) const {
    if (n % 7 == 3)
      save_later(scene(), "[camera]\neye = 3\n");
    else if (n % 7 == 5)
      save_later(mesh(), "v 0 0 nothing\n");
    else if (n % 2 == 0)
      save_later(scene(), scene_text(n));
    else
      save_later(mesh(), mesh_text(n));
  }

 private:
  static std::string scene_text(int n) {
    std::string text =
        kGoodScene +
        "[[mesh]]\nfile = 'tetrahedron.obj'\nmaterial = 'red'\n"
        "[[mesh]]\nshape = 'torus'\nradii = [0.6, 0.2]\nsegments = [24, 12]\nmaterial = 'glass'\n"
        "[[step]]\ntext = 'Which shadow?'\nmode = 'causes'\neye = [0, 2, 7]\n"
        "set = { 'trace.depth' = 2 }\n[[step]]\ntext = 'And now?'\n";
    const std::string radius = "radius = 1";
    return text.replace(text.find(radius), radius.size(), "radius = 1." + std::to_string(n % 10));
  }
  static std::string mesh_text(int n) {
    return "v -1 0 -" + std::to_string(1 + n % 5) + "\nv 1 0 -2\nv 0 1 -2\nv 0 0 -1\n" +
           "f 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  }
  TemporaryFolder folder_;
};

// One thing that a user does, whichever the generator says.
void use(Session& session, std::mt19937& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto part = [&] { return below(1001) / 1000.0; };
  switch (below(8)) {
    case 0:
    case 1: {
      // Any key but those that leave, and the one that writes files.
      const auto keys = Session::keys();
      const std::string_view key = keys[static_cast<std::size_t>(below(static_cast<int>(keys.size())))].name;
      if (key != "Esc" && key != "q" && key != "Q" && key != "s") session.press(key, kPanel);
      return;
    }
    case 2:
      session.point_at(glm::dvec2(kPicture) * part());
      return session.wheel(below(5) - 2, {kPanel.x0 + 100, kPanel.y0 + 80}, kPanel);
    case 3:
      return session.inspect({below(kPicture.x), below(kPicture.y)});
    case 4:
      return session.edit([&](Scene& scene) {
        scene.lights[0].intensity = glm::dvec3(part());
        scene.materials[0].reflect = glm::dvec3(part());
      });
    case 5: {
      Faults faults;
      if (below(3) == 0) faults.tessellate = 8;
      faults.float_precision = below(3) == 0;
      return session.set_faults(faults);
    }
    case 6:
      if (session.state().n > 2) session.set_samples_per_edge(1);
      return session.set_mode(static_cast<Mode>(below(kModes)));
    default:
      return session.drag_orbit({below(9) - 4.0, below(9) - 4.0}, kPanel);
  }
}

struct Memory {
  double at_twelfth = 0, at_end = 0;  // MB resident, after a twelfth of the time and after all of it
};

// Uses the session for so long. `frame` is what the window does between two events.
Memory use_for(double seconds, Session& session, const Folder& folder, const std::function<void()>& frame) {
  std::mt19937 random(1);
  Memory memory;
  int saved = 0, minutes = 0;
  const double start = wall_ms();
  for (double now = 0; now < seconds; now = (wall_ms() - start) / 1e3) {
    // A burst of input, each answered by a frame; then a rest in which the pictures may be finished.
    for (int i = 0; i < 12; ++i) {
      use(session, random);
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(random() % 20));
    }
    for (int i = 0; i < 10 && !session.worker().idle(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      frame();
    }
    folder.save(++saved);
    CHECK(session.watch() == (std::filesystem::path(session.state().file) == folder.scene()));
    frame();
    if (saved % 20 == 0) session.press("z", kPanel);
    if (now * 12 < seconds) memory.at_twelfth = resident_mb();
    if (now >= 60 * minutes) std::cout << minutes++ << " min: " << resident_mb() << " MB" << std::endl;
  }
  memory.at_end = resident_mb();
  return memory;
}

}  // namespace

TEST_CASE("endurance: a session in constant use fails nowhere and keeps its memory") {
  const auto seconds = static_cast<double>(test::tier_count("session_seconds"));
  const Folder folder;
  const SceneOpener open = opener(kPicture.x, kPicture.y);
  Session session(open_state(folder.scene(), open), open);
  Memory memory;
#ifdef SIDELIGHT_HAVE_OSMESA
  const bool drawn = test::tier() != "sanitized";
  if (drawn)
    draw_offscreen(kWindow.x, kWindow.y, [&](Canvas& canvas) {
      Frames frames(canvas, session);
      memory = use_for(seconds, session, folder, [&] {
        frames.take_pictures();
        frames.draw(kWindow, 1);
      });
    });
#else
  const bool drawn = false;
#endif
  if (!drawn) {
    FrameContents contents;
    memory = use_for(seconds, session, folder, [&] { contents.update(session); });
  }
  CHECK(session.worker().latest().error == "");
  session.press("z", kPanel);
  check_headless(session);
  // What a moment needs depends on the mode, the samples and the pictures in flight; a leak of one small picture a
  // minute would show in an hour. Shorter runs still fill their caches.
  if (seconds >= 600) CHECK(memory.at_end < memory.at_twelfth + 40);
}
