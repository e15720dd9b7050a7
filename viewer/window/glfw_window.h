// SPDX-License-Identifier: MIT
// GLFW's library and window as owners, and its keys by their names in session.h. Only for builds that have GLFW.
#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <memory>
#include <string>

namespace sidelight {

// GLFW, while it lives. Throws NoDisplay.
struct GlfwLibrary {
  GlfwLibrary();
  ~GlfwLibrary();
  GlfwLibrary(const GlfwLibrary&) = delete;
  GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

struct DestroyWindow {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowHandle = std::unique_ptr<GLFWwindow, DestroyWindow>;

// Not shown yet; its OpenGL context is current. Throws NoDisplay.
WindowHandle make_window(const std::string& title);
void set_title(GLFWwindow* window, const std::string& title);

// What keys are called where they do not type a character; empty otherwise. GLFW names keys by their place on an
// American keyboard, so letters and digits come as characters.
std::string key_name(int key, int modifiers);
std::string character_name(unsigned character);

}  // namespace sidelight
