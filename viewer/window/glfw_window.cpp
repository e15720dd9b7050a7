// SPDX-License-Identifier: MIT
#include "viewer/window/glfw_window.h"

#include <array>
#include <utility>

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
  constexpr std::array kNames{
      std::pair{GLFW_KEY_ESCAPE, "Esc"},     std::pair{GLFW_KEY_TAB, "Tab"},
      std::pair{GLFW_KEY_ENTER, "Enter"},    std::pair{GLFW_KEY_HOME, "Home"},
      std::pair{GLFW_KEY_PAGE_UP, "PageUp"}, std::pair{GLFW_KEY_PAGE_DOWN, "PageDown"},
      std::pair{GLFW_KEY_F1, "F1"}};
  constexpr std::array kArrows{std::pair{GLFW_KEY_LEFT, "Left"}, std::pair{GLFW_KEY_RIGHT, "Right"},
                               std::pair{GLFW_KEY_UP, "Up"}, std::pair{GLFW_KEY_DOWN, "Down"}};
  for (const auto& [known, name] : kNames)
    if (known == key) return name;
  for (const auto& [known, name] : kArrows)
    if (known == key) return std::string(modifiers & GLFW_MOD_SHIFT ? "Shift+" : "") + name;
  return {};
}

std::string character_name(unsigned character) {
  if (character == ' ') return "Space";
  return character < 0x80 ? std::string(1, static_cast<char>(character)) : std::string();
}

}  // namespace sidelight
