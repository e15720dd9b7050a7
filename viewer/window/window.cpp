// SPDX-License-Identifier: MIT
#include "viewer/window/window.h"

#include "common/error.h"

#ifdef SIDELIGHT_HAVE_GLFW
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <memory>

#include "viewer/window/canvas.h"
#endif

namespace sidelight {

NoDisplay::NoDisplay(const std::string& reason)
    : std::runtime_error("no window: " + printable(reason) +
                         "; without a display use `sidelight compare SCENE -o DIR`, or `sidelight view SCENE "
                         "--screenshot FILE.png`") {}

#ifdef SIDELIGHT_HAVE_GLFW
namespace {

std::string last_glfw_error(const std::string& otherwise) {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : otherwise;
}

struct GlfwLibrary {
  GlfwLibrary() {
    if (glfwInit() == GLFW_FALSE) throw NoDisplay(last_glfw_error("GLFW does not start"));
  }
  ~GlfwLibrary() { glfwTerminate(); }
  GlfwLibrary(const GlfwLibrary&) = delete;
  GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

struct DestroyWindow {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowHandle = std::unique_ptr<GLFWwindow, DestroyWindow>;

// Not shown yet; its OpenGL context is current.
WindowHandle make_window(const std::string& title) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  const std::string caption = title.empty() ? "sidelight" : "sidelight: " + printable(title);
  WindowHandle window(glfwCreateWindow(640, 480, caption.c_str(), nullptr, nullptr));
  if (!window) throw NoDisplay(last_glfw_error("no OpenGL 3.3 core context"));
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(1);
  return window;
}

// The state of an open window, and what its events do to it.
class ComparisonWindow {
 public:
  explicit ComparisonWindow(const PicturePair& comparison)
      : labels_(comparison.labels),
        window_(make_window(comparison.labels.title)),
        canvas_(glfwGetProcAddress, content_scale()),
        pictures_{canvas_.add_picture(comparison.left),
                  canvas_.add_picture(comparison.right),
                  {comparison.left.width, comparison.left.height}} {
    set_initial_size();
    set_callbacks();
    glfwShowWindow(window_.get());
  }

  void run() {
    while (glfwWindowShouldClose(window_.get()) == GLFW_FALSE) {
      if (stale_) redraw();
      glfwWaitEvents();
    }
  }

 private:
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
    const LayoutOptions options = layout_options(labels_, true, canvas_.scale());
    int x = 0, y = 0, width = 1280, height = 720;
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor())
      glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
    constexpr double kTitleBar = 40;  // the part of the work area that goes to the window's own frame
    const glm::dvec2 ratio = pixel_ratio();
    const glm::ivec2 room(glm::dvec2(width, height - kTitleBar * canvas_.scale() / ratio.y) * ratio);

    const double zoom = std::max(1.0, fit(View{}, pictures_.size, make_layout(room, options).left).zoom);
    const glm::ivec2 panel = panel_for(pictures_.size * static_cast<int>(zoom), options);
    const glm::dvec2 size = glm::dvec2(glm::min(layout_size(panel, options), room)) / ratio;
    glfwSetWindowSize(window_.get(), static_cast<int>(std::ceil(size.x)),
                      static_cast<int>(std::ceil(size.y)));
  }

  void set_callbacks() {
    GLFWwindow* window = window_.get();
    glfwSetWindowUserPointer(window, this);
    static const auto self = [](GLFWwindow* w) {
      return static_cast<ComparisonWindow*>(glfwGetWindowUserPointer(w));
    };
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { self(w)->stale_ = true; });
    glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { self(w)->stale_ = true; });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { self(w)->stale_ = true; });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { self(w)->scroll(y); });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { self(w)->move_cursor({x, y}); });
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
      if (action == GLFW_PRESS) self(w)->press(key);
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) { self(w)->type(character); });
  }

  void show(const View& view) {
    view_ = view;
    stale_ = true;
  }

  void scroll(double amount) {
    scrolled_ += amount;  // touchpads scroll in parts of a step
    const double steps = std::trunc(scrolled_);
    scrolled_ -= steps;
    const bool over_right = cursor_.x >= layout_.right.x0;
    const Rect& panel = over_right ? layout_.right : layout_.left;
    show(zoom_about(view_, pictures_.size, panel, cursor_, static_cast<int>(steps)));
  }

  void move_cursor(glm::dvec2 window_position) {
    const glm::dvec2 position = window_position * pixel_ratio();
    const bool dragging = glfwGetMouseButton(window_.get(), GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS ||
                          glfwGetMouseButton(window_.get(), GLFW_MOUSE_BUTTON_MIDDLE) == GLFW_PRESS;
    if (dragging) show(pan(view_, pictures_.size, layout_.left, position - cursor_));
    cursor_ = position;
  }

  void press(int key) {
    if (key == GLFW_KEY_ESCAPE) close();
    if (key == GLFW_KEY_HOME) show(fit(view_, pictures_.size, layout_.left));
  }

  // Characters, not keys: GLFW names keys by their place on an American keyboard.
  void type(unsigned character) {
    if (character == 'q' || character == 'Q') close();
    if (character == '0') show(fit(view_, pictures_.size, layout_.left));
    if (character == ' ') {
      View flipped = view_;
      flipped.flipped = !flipped.flipped;
      show(flipped);
    }
  }

  void close() { glfwSetWindowShouldClose(window_.get(), GLFW_TRUE); }

  void redraw() {
    stale_ = false;
    const glm::ivec2 size = framebuffer_size();
    if (size.x < 1 || size.y < 1) return;  // minimised
    canvas_.set_scale(content_scale());
    layout_ = make_layout(size, layout_options(labels_, true, canvas_.scale()));
    view_ = clamp(view_, pictures_.size, layout_.left);
    canvas_.draw(size.x, size.y, [&] { draw_comparison(canvas_, pictures_, labels_, layout_, view_); });
    glfwSwapBuffers(window_.get());
  }

  Labels labels_;
  GlfwLibrary library_;
  WindowHandle window_;
  Canvas canvas_;
  ShownPictures pictures_;
  Layout layout_;
  View view_;
  glm::dvec2 cursor_{0};  // device pixels
  double scrolled_ = 0;   // parts of a wheel step not yet used
  bool stale_ = true;
};

}  // namespace

void require_display() { const GlfwLibrary library; }

int run_window(const PicturePair& comparison) {
  check_pictures(comparison.left, comparison.right);
  ComparisonWindow(comparison).run();
  return 0;
}
#else
void require_display() { throw NoDisplay("this build of sidelight has no window"); }
int run_window(const PicturePair& comparison) {
  check_pictures(comparison.left, comparison.right);
  require_display();
  return 0;
}
#endif

}  // namespace sidelight
