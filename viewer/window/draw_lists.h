// SPDX-License-Identifier: MIT
// Draws what Dear ImGui has laid out, through the table of gl.h: OpenGL 3.3 core, one program, one call per
// draw command. It replaces ImGui's own OpenGL backend, which Debian does not package in a form that needs no
// libGL. Vertices are device pixels, y down. Called by the canvas only.
//
// Source: Dear ImGui, imgui_impl_opengl3.cpp (Cornut and contributors), for the order of calls. Departure: GL
// state is not saved and restored, since nothing else draws in our contexts.
#pragma once

#include <imgui.h>

#include "viewer/window/gl.h"

namespace sidelight {

// How ImGui names a texture, and back.
ImTextureID texture_id(const GlObject& texture);

class DrawListPainter {
 public:
  explicit DrawListPainter(const Gl& gl);  // gl must outlive the painter

  // Paints over all of the current framebuffer, whose size is data.DisplaySize, on `page`, an opaque colour. User
  // callbacks are not supported.
  void paint(const ImDrawData& data, ImU32 page) const;

 private:
  void paint_list(const ImDrawList& list, int width, int height) const;

  const Gl& gl_;
  GlObject program_, vertex_array_, vertices_, indices_;
  GLint size_uniform_ = -1;
};

}  // namespace sidelight
