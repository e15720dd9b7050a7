// SPDX-License-Identifier: MIT
#include "viewer/window/draw_lists.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sidelight {
namespace {

constexpr const char* kVertexShader = R"(#version 330 core
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texel;
layout(location = 2) in vec4 color;
uniform vec2 size;
out vec2 fragment_texel;
out vec4 fragment_color;
void main() {
  fragment_texel = texel;
  fragment_color = color;
  gl_Position = vec4(2 * position.x / size.x - 1, 1 - 2 * position.y / size.y, 0, 1);
})";

constexpr const char* kFragmentShader = R"(#version 330 core
in vec2 fragment_texel;
in vec4 fragment_color;
uniform sampler2D image;
layout(location = 0) out vec4 color;
void main() { color = fragment_color * texture(image, fragment_texel); })";

// Describes one member of ImDrawVert to attribute `location` of the bound vertex array.
void describe_attribute(const Gl& gl, GLuint location, GLint count, GLenum type, bool normalized,
                        std::size_t offset) {
  gl.EnableVertexAttribArray(location);
  gl.VertexAttribPointer(location, count, type, normalized ? GL_TRUE : GL_FALSE, sizeof(ImDrawVert),
                         reinterpret_cast<const void*>(offset));
}

template <class Item>
void upload(const Gl& gl, GLenum target, const ImVector<Item>& items) {
  gl.BufferData(target, static_cast<GLsizeiptr>(items.size_in_bytes()), items.Data, GL_STREAM_DRAW);
}

}  // namespace

ImTextureID texture_id(const GlObject& texture) {
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture.name()));
}

DrawListPainter::DrawListPainter(const Gl& gl)
    : gl_(gl),
      program_(make_program(gl, kVertexShader, kFragmentShader)),
      vertex_array_(make_vertex_array(gl)),
      vertices_(make_buffer(gl)),
      indices_(make_buffer(gl)),
      size_uniform_(gl.GetUniformLocation(program_.name(), "size")) {
  gl.BindVertexArray(vertex_array_.name());
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices_.name());
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  describe_attribute(gl, 0, 2, GL_FLOAT, false, offsetof(ImDrawVert, pos));
  describe_attribute(gl, 1, 2, GL_FLOAT, false, offsetof(ImDrawVert, uv));
  describe_attribute(gl, 2, 4, GL_UNSIGNED_BYTE, true, offsetof(ImDrawVert, col));
}

void DrawListPainter::paint(const ImDrawData& data, ImU32 page) const {
  const int width = static_cast<int>(data.DisplaySize.x), height = static_cast<int>(data.DisplaySize.y);
  gl_.Viewport(0, 0, width, height);
  // Mesa 22.3 takes notice of a window's new size at the first drawing after glViewport, too late for the scissor of
  // that same drawing: without this, a full-window rectangle ended at the old height.
  gl_.Disable(GL_SCISSOR_TEST);
  const ImVec4 color = ImGui::ColorConvertU32ToFloat4(page);
  gl_.ClearColor(color.x, color.y, color.z, 1);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl_.UseProgram(program_.name());
  gl_.Uniform2f(size_uniform_, data.DisplaySize.x, data.DisplaySize.y);
  gl_.BindVertexArray(vertex_array_.name());
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_.name());
  for (int i = 0; i < data.CmdListsCount; ++i) paint_list(*data.CmdLists[i], width, height);
}

void DrawListPainter::paint_list(const ImDrawList& list, int width, int height) const {
  upload(gl_, GL_ARRAY_BUFFER, list.VtxBuffer);
  upload(gl_, GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer);
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const int x0 = std::clamp(static_cast<int>(command.ClipRect.x), 0, width);
    const int y0 = std::clamp(static_cast<int>(command.ClipRect.y), 0, height);
    const int x1 = std::clamp(static_cast<int>(command.ClipRect.z), 0, width);
    const int y1 = std::clamp(static_cast<int>(command.ClipRect.w), 0, height);
    if (x0 >= x1 || y0 >= y1) continue;
    gl_.Scissor(x0, height - y1, x1 - x0, y1 - y0);  // OpenGL's y goes up

    // Pictures are opaque: llvmpipe spends half its time on blending them.
    const bool picture = command.GetTexID() != ImGui::GetIO().Fonts->TexID;
    picture ? gl_.Disable(GL_BLEND) : gl_.Enable(GL_BLEND);
    gl_.BindTexture(GL_TEXTURE_2D, static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
    constexpr GLenum index_type = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
    const auto first_byte = static_cast<std::uintptr_t>(command.IdxOffset) * sizeof(ImDrawIdx);
    gl_.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), index_type,
                               reinterpret_cast<const void*>(first_byte),
                               static_cast<GLint>(command.VtxOffset));
  }
}

}  // namespace sidelight
