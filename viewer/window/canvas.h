// SPDX-License-Identifier: MIT
// A Dear ImGui context with its fonts and the OpenGL objects to draw it: where panels are drawn, in a window
// or off screen. It knows neither GLFW nor OSMesa; whoever makes it has made an OpenGL context current, on
// this thread, and keeps it so while the canvas lives.
//
// ImGui keeps "the current context" in one global pointer. A canvas sets it for the length of each call,
// under a lock, and puts it back: canvases of several threads cannot meet. No imgui.ini and no log is read or
// written.
#pragma once

#include <imgui.h>

#include <deque>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/picture/image_io.h"
#include "viewer/window/draw_lists.h"
#include "viewer/window/gl.h"

namespace sidelight {

// DejaVu Sans in three sizes (layout.h), or ImGui's built-in font where that is not installed.
struct Fonts {
  ImFont* title = nullptr;
  ImFont* caption = nullptr;
  ImFont* small = nullptr;
};

class Canvas {
 public:
  // Throws OutputError if the OpenGL context lacks something.
  explicit Canvas(GlLoader loader, double scale = 1);
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  // Sizes of text, as a factor; not within draw. Does nothing where the factor is the present one.
  void set_scale(double scale);
  double scale() const { return scale_; }
  const Fonts& fonts() const { return fonts_; }

  // Uploads a picture; the handle is good until clear_pictures, or as long as the canvas. Drawn smaller than it is, it is
  // smoothed only if it `may_shrink`. Throws UsageError if it is too large for OpenGL.
  ImTextureID add_picture(const Image8& image, bool may_shrink = true);
  // Drops all pictures; not within draw.
  void clear_pictures() { pictures_.clear(); }

  // What the mouse did since the last frame, for the widgets: its place in device pixels, the left button, the wheel. A
  // press that ends before the next frame is down in that frame, and up in the one after.
  void set_pointer(glm::dvec2 position, bool left_down, double wheel);
  // The widgets of the last frame want the mouse: it is over one, or one is held.
  bool wants_pointer() const { return wants_pointer_; }

  // A key for the widgets that have the keyboard: an arrow (with "Shift+" a slider goes faster), "Space" or "Enter". It is
  // down for one frame and up for the next; several wait for each other. False for any other key.
  bool press_key(std::string_view key);
  bool has_keys_waiting() const { return !keys_.empty(); }

  // One frame: `contents` calls ImGui, and the result is painted over the framebuffer of width x height. No
  // canvas may be used within `contents` but this one's fonts. What `contents` throws passes through.
  void draw(int width, int height, const std::function<void()>& contents);

  // Waits until all drawing has reached the framebuffer.
  void finish() const { gl_.Finish(); }

 private:
  void move_keys();
  void set_style();
  void load_fonts();

  struct DestroyContext {
    void operator()(ImGuiContext* context) const;
  };

  Gl gl_;
  DrawListPainter painter_;
  double scale_;
  Fonts fonts_;
  std::optional<GlObject> font_texture_;
  std::vector<GlObject> pictures_;
  std::unique_ptr<ImGuiContext, DestroyContext> context_;
  bool wants_pointer_ = false;
  bool left_down_ = false;        // now; ImGui's state is as the next frame shall see it
  std::deque<std::string> keys_;  // the first one may be down
  bool key_down_ = false;
};

}  // namespace sidelight
