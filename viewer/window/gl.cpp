// SPDX-License-Identifier: MIT
#include "viewer/window/gl.h"

#include <algorithm>
#include <array>
#include <string>

#include "common/error.h"

namespace sidelight {
namespace {

template <class Function>
void fetch(GlLoader loader, Function& function, const char* name) {
  function = reinterpret_cast<Function>(loader(name));
  if (function == nullptr) throw OutputError(std::string("OpenGL has no ") + name);
}

// The shader lives until the program that holds it is deleted; errors show when that is linked.
void attach_shader(const Gl& gl, GLuint program, GLenum stage, const char* source) {
  const GlObject shader(gl, gl.CreateShader(stage),
                        [](const Gl& table, GLuint name) { table.DeleteShader(name); });
  gl.ShaderSource(shader.name(), 1, &source, nullptr);
  gl.CompileShader(shader.name());
  gl.AttachShader(program, shader.name());
}

// A texture with level 0 uploaded, bound; the caller sets its filters.
GlObject make_texture(const Gl& gl, int width, int height, GLenum format, const unsigned char* bytes) {
  GLint limit = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (std::max(width, height) > limit)
    throw UsageError("a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                     " is too large to show: OpenGL stops at " + std::to_string(limit));
  GLuint name = 0;
  gl.GenTextures(1, &name);
  GlObject texture(gl, name, [](const Gl& table, GLuint old) { table.DeleteTextures(1, &old); });
  gl.BindTexture(GL_TEXTURE_2D, name);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);  // rows of RGB need not end on multiples of four
  const GLint stored = format == GL_RGB ? GL_RGB8 : GL_RGBA8;
  gl.TexImage2D(GL_TEXTURE_2D, 0, stored, width, height, 0, format, GL_UNSIGNED_BYTE, bytes);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

Gl load_gl(GlLoader loader) {
  Gl gl;
#define SIDELIGHT_GL_FETCH(type, name) fetch(loader, gl.name, "gl" #name);
  SIDELIGHT_GL_FUNCTIONS(SIDELIGHT_GL_FETCH)
#undef SIDELIGHT_GL_FETCH
  return gl;
}

GlObject make_buffer(const Gl& gl) {
  GLuint name = 0;
  gl.GenBuffers(1, &name);
  return {gl, name, [](const Gl& table, GLuint old) { table.DeleteBuffers(1, &old); }};
}

GlObject make_vertex_array(const Gl& gl) {
  GLuint name = 0;
  gl.GenVertexArrays(1, &name);
  return {gl, name, [](const Gl& table, GLuint old) { table.DeleteVertexArrays(1, &old); }};
}

GlObject make_program(const Gl& gl, const char* vertex_source, const char* fragment_source) {
  GlObject program(gl, gl.CreateProgram(), [](const Gl& table, GLuint name) { table.DeleteProgram(name); });
  attach_shader(gl, program.name(), GL_VERTEX_SHADER, vertex_source);
  attach_shader(gl, program.name(), GL_FRAGMENT_SHADER, fragment_source);
  gl.LinkProgram(program.name());
  GLint linked = 0;
  gl.GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked == 0) {
    std::array<char, 1000> log{};
    gl.GetProgramInfoLog(program.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw OutputError("the window's shaders do not link: " + printable(log.data(), log.size()));
  }
  return program;
}

GlObject make_picture_texture(const Gl& gl, const Image8& image, bool may_shrink) {
  GlObject texture = make_texture(gl, image.width, image.height, GL_RGB, image.rgb.data());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, may_shrink ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  if (!may_shrink) return texture;
  gl.GenerateMipmap(GL_TEXTURE_2D);
  // Zoom 1 is the border between the two filters: this puts it, with room for rounding, on the exact side.
  gl.TexParameterf(GL_TEXTURE_2D, GL_TEXTURE_LOD_BIAS, -1.0f / 32);
  return texture;
}

GlObject make_font_texture(const Gl& gl, int width, int height, const unsigned char* rgba) {
  GlObject texture = make_texture(gl, width, height, GL_RGBA, rgba);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

}  // namespace sidelight
