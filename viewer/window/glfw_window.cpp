// SPDX-License-Identifier: MIT
#include "viewer/window/glfw_window.h"

#include "common/error.h"
#include "viewer/window/window.h"

namespace sidelight {
namespace {

std::string last_glfw_error(const std::string& otherwise) {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : otherwise;
}

std::string title_bar(const std::string& title) {
  return title.empty() ? "sidelight" : "sidelight: " + printable(title);
}

}  // namespace

GlfwLibrary::GlfwLibrary() {
  if (glfwInit() == GLFW_FALSE) throw NoDisplay(last_glfw_error("GLFW does not start"));
}
GlfwLibrary::~GlfwLibrary() { glfwTerminate(); }

WindowHandle make_window(const std::string& title) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  WindowHandle window(glfwCreateWindow(640, 480, title_bar(title).c_str(), nullptr, nullptr));
  if (!window) throw NoDisplay(last_glfw_error("no OpenGL 3.3 core context"));
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(1);
  return window;
}

void set_title(GLFWwindow* window, const std::string& title) {
  glfwSetWindowTitle(window, title_bar(title).c_str());
}

std::string key_name(int key, int modifiers) {
  const std::string shift = modifiers & GLFW_MOD_SHIFT ? "Shift+" : "";
  switch (key) {
    case GLFW_KEY_ESCAPE:
      return "Esc";
    case GLFW_KEY_TAB:
      return "Tab";
    case GLFW_KEY_ENTER:
      return "Enter";
    case GLFW_KEY_HOME:
      return "Home";
    case GLFW_KEY_PAGE_UP:
      return "PageUp";
    case GLFW_KEY_PAGE_DOWN:
      return "PageDown";
    case GLFW_KEY_F1:
      return "F1";
    case GLFW_KEY_LEFT:
      return shift + "Left";
    case GLFW_KEY_RIGHT:
      return shift + "Right";
    case GLFW_KEY_UP:
      return shift + "Up";
    case GLFW_KEY_DOWN:
      return shift + "Down";
    default:
      return {};
  }
}

std::string character_name(unsigned character) {
  if (character == ' ') return "Space";
  return character < 0x80 ? std::string(1, static_cast<char>(character)) : std::string();
}

}  // namespace sidelight
