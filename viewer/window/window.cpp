// SPDX-License-Identifier: MIT
#include "viewer/window/window.h"

#include "common/error.h"

#ifdef SIDELIGHT_HAVE_GLFW
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "common/clock.h"
#include "viewer/window/canvas.h"
#include "viewer/window/frames.h"
#include "viewer/window/glfw_window.h"
#endif

namespace sidelight {

NoDisplay::NoDisplay(const std::string& reason)
    : std::runtime_error("no window: " + printable(reason) +
                         "; without a display use `sidelight compare SCENE -o DIR`, or `sidelight view SCENE "
                         "--screenshot FILE.png`") {}

#ifdef SIDELIGHT_HAVE_GLFW
namespace {

// An open window: its events become the session's, the session's state becomes its picture.
class SessionWindow {
 public:
  SessionWindow(WindowState state, const SceneOpener& open, FrameLog* log)
      : title_(window_title(state)),
        window_(make_window(title_)),
        canvas_(glfwGetProcAddress, content_scale()),
        session_(std::move(state), open, [] { glfwPostEmptyEvent(); }),
        log_(log) {
    set_initial_size();
    set_callbacks();
    glfwShowWindow(window_.get());
  }

  void run() {
    while (glfwWindowShouldClose(window_.get()) == GLFW_FALSE && !session_.closed()) {
      if (frames_.take_pictures()) touch();
      if (stale_ > 0) redraw();
      // Widgets need a frame more than there are events: one to see the button go down, one to see it up.
      if (stale_ > 0)
        glfwPollEvents();
      else
        glfwWaitEventsTimeout(kWatchSeconds);
      if (session_.watch()) touch();
    }
  }

 private:
  static constexpr double kWatchSeconds = 0.25;
  static constexpr int kFrames = 3;  // drawn after the last event

  double content_scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_.get(), &x, &y);
    return std::max(x, y);
  }

  // Device pixels per window coordinate: 1 on X11, the scale of the screen where the system scales windows.
  glm::dvec2 pixel_ratio() const {
    int width = 0, height = 0;
    glfwGetWindowSize(window_.get(), &width, &height);
    const glm::ivec2 pixels = framebuffer_size();
    return width > 0 && height > 0 ? glm::dvec2(pixels) / glm::dvec2(width, height) : glm::dvec2(1);
  }

  glm::ivec2 framebuffer_size() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window_.get(), &size.x, &size.y);
    return size;
  }

  // Both pictures at the largest whole zoom for which the window fits on the screen, or else the whole
  // screen.
  void set_initial_size() {
    const WindowState& state = session_.state();
    const LayoutOptions options{canvas_.scale(), true, state.opened.times, true};
    int x = 0, y = 0, width = 1280, height = 720;
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor())
      glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
    constexpr double kTitleBar = 40;  // the part of the work area that goes to the window's own frame
    const glm::dvec2 ratio = pixel_ratio();
    const glm::ivec2 room(glm::dvec2(width, height - kTitleBar * canvas_.scale() / ratio.y) * ratio);

    const glm::ivec2 picture = picture_size(state);
    const double zoom = std::max(1.0, fit(View{}, picture, make_layout(room, options).left).zoom);
    const glm::ivec2 panel = panel_for(picture * static_cast<int>(zoom), options);
    const glm::dvec2 size = glm::dvec2(glm::min(layout_size(panel, options), room)) / ratio;
    glfwSetWindowSize(window_.get(), static_cast<int>(std::ceil(size.x)),
                      static_cast<int>(std::ceil(size.y)));
  }

  void set_callbacks() {
    GLFWwindow* window = window_.get();
    glfwSetWindowUserPointer(window, this);
    static const auto self = [](GLFWwindow* w) -> SessionWindow& {
      auto& that = *static_cast<SessionWindow*>(glfwGetWindowUserPointer(w));
      that.touch();
      return that;
    };
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { self(w); });
    glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { self(w); });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { self(w); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { self(w).scroll(y); });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { self(w).move_cursor({x, y}); });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int which, int action, int) {
      self(w).press_button(which, action == GLFW_PRESS);
    });
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
      if (action != GLFW_RELEASE) self(w).press(key_name(key, modifiers));
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned c) { self(w).press(character_name(c)); });
  }

  void touch() { stale_ = kFrames; }
  bool is_down(int key) const { return glfwGetKey(window_.get(), key) == GLFW_PRESS; }
  bool shift() const { return is_down(GLFW_KEY_LEFT_SHIFT) || is_down(GLFW_KEY_RIGHT_SHIFT); }
  bool control() const { return is_down(GLFW_KEY_LEFT_CONTROL) || is_down(GLFW_KEY_RIGHT_CONTROL); }

  const WindowLayout& layout() const { return frames_.layout(); }
  // The panel under the cursor, or else the first.
  const Rect& panel() const {
    return panel_at(layout(), cursor_) == 1 ? layout().panels.right : layout().panels.left;
  }

  void press(const std::string& key) { frames_.press(key, panel()); }

  void scroll(double amount) {
    if (canvas_.wants_pointer()) return frames_.set_pointer(cursor_, widget_button_, amount);
    scrolled_ += amount;  // touchpads scroll in parts of a step
    const double steps = std::trunc(scrolled_);
    scrolled_ -= steps;
    if (steps == 0) return;
    if (control())
      session_.dolly_by(static_cast<int>(steps));
    else
      session_.wheel(static_cast<int>(steps), cursor_, panel());
  }

  // A press that moves no further than this before the button comes up is a click.
  static constexpr double kClickReach = 4;

  void press_button(int which, bool down) {
    const bool left = which == GLFW_MOUSE_BUTTON_LEFT;
    if (down && canvas_.wants_pointer()) {
      widget_button_ = left;
    } else if (down && panel_at(layout(), cursor_) >= 0) {
      held_ = which;
      pressed_at_ = cursor_;
      dragged_ = false;
    } else if (!down) {
      if (which == held_ && left && !dragged_ && session_.state().cursor) session_.press("i", panel());
      if (left) widget_button_ = false;
      held_ = -1;
    }
    frames_.set_pointer(cursor_, widget_button_, 0);
  }

  void move_cursor(glm::dvec2 window_position) {
    const glm::dvec2 position = window_position * pixel_ratio(), by = position - cursor_;
    cursor_ = position;
    frames_.set_pointer(cursor_, widget_button_, 0);
    if (held_ >= 0 && glm::distance(cursor_, pressed_at_) > kClickReach * canvas_.scale()) dragged_ = true;
    if (held_ >= 0 && dragged_) drag(by);
    point_at_picture();
  }

  void drag(glm::dvec2 by) {
    const Rect& box = layout().panels.left;
    const View& view = session_.state().view;
    if (held_ == GLFW_MOUSE_BUTTON_RIGHT)
      session_.drag_pictures(by, box);
    else if (session_.state().mode == Mode::swipe)
      session_.set_swipe((cursor_.x - picture_origin(view, box).x) /
                         (view.zoom * picture_size(session_.state()).x));
    else if (held_ == GLFW_MOUSE_BUTTON_MIDDLE || shift())
      session_.drag_slide(by, box);
    else
      session_.drag_orbit(by, box);
  }

  void point_at_picture() {
    const int which = panel_at(layout(), cursor_);
    const glm::dvec2 at =
        (cursor_ - picture_origin(session_.state().view, panel())) / session_.state().view.zoom;
    const glm::dvec2 size(picture_size(session_.state()));
    const bool inside = which >= 0 && at.x >= 0 && at.y >= 0 && at.x < size.x && at.y < size.y;
    session_.point_at(inside ? std::optional(at) : std::nullopt);
  }

  void redraw() {
    --stale_;
    const glm::ivec2 size = framebuffer_size();
    if (size.x < 1 || size.y < 1) return;  // minimised
    if (std::string title = window_title(session_.state()); title != title_) {
      title_ = std::move(title);
      set_title(window_.get(), title_);
    }
    if (frames_.draw(size, content_scale())) touch();
    const double drawn = wall_ms();
    glfwSwapBuffers(window_.get());
    if (log_) {
      FrameTime time = frames_.time();
      time.swap = wall_ms() - drawn;
      log_->add(time, frames_.contents().latest());
    }
    if (std::string text = session_.take_clipboard(); !text.empty())
      glfwSetClipboardString(window_.get(), text.c_str());
  }

  GlfwLibrary library_;
  std::string title_;
  WindowHandle window_;
  Canvas canvas_;
  Session session_;
  Frames frames_{canvas_, session_};
  FrameLog* log_;
  glm::dvec2 cursor_{0}, pressed_at_{0};  // device pixels
  int held_ = -1;                         // button that went down on a picture
  bool dragged_ = false, widget_button_ = false;
  double scrolled_ = 0;  // parts of a wheel step not yet used
  int stale_ = kFrames;  // frames still to be drawn
};

}  // namespace

void require_display() { const GlfwLibrary library; }

int run_window(WindowState state, const SceneOpener& open, FrameLog* log) {
  SessionWindow(std::move(state), open, log).run();
  return 0;
}
#else
void require_display() { throw NoDisplay("this build of sidelight has no window"); }
int run_window(WindowState, const SceneOpener&, FrameLog*) {
  require_display();
  return 0;
}
#endif

}  // namespace sidelight
