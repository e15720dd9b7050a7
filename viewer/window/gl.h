// SPDX-License-Identifier: MIT
// The OpenGL functions that the viewer uses, fetched by name into a table, and the owner of an OpenGL object.
// Nothing links libGL: the same code then draws in a GLFW window and in an OSMesa buffer, whose libraries
// would otherwise compete for the same symbols.
//
// A table belongs to the context that was current when it was filled, and its functions may be called only
// while that context is current, on its thread. The header that types it is the Khronos registry's (Debian:
// libgl-dev).
#pragma once

#include <GL/glcorearb.h>

#include "common/picture/image_io.h"

namespace sidelight {

using GlFunction = void (*)();
using GlLoader = GlFunction (*)(const char* name);  // glfwGetProcAddress or OSMesaGetProcAddress

// Every function used, once: its type in glcorearb.h and its name without the gl.
#define SIDELIGHT_GL_FUNCTIONS(F)                              \
  F(PFNGLATTACHSHADERPROC, AttachShader)                       \
  F(PFNGLBINDBUFFERPROC, BindBuffer)                           \
  F(PFNGLBINDTEXTUREPROC, BindTexture)                         \
  F(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                 \
  F(PFNGLBLENDFUNCPROC, BlendFunc)                             \
  F(PFNGLBUFFERDATAPROC, BufferData)                           \
  F(PFNGLCLEARPROC, Clear)                                     \
  F(PFNGLCLEARCOLORPROC, ClearColor)                           \
  F(PFNGLCOMPILESHADERPROC, CompileShader)                     \
  F(PFNGLCREATEPROGRAMPROC, CreateProgram)                     \
  F(PFNGLCREATESHADERPROC, CreateShader)                       \
  F(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                     \
  F(PFNGLDELETEPROGRAMPROC, DeleteProgram)                     \
  F(PFNGLDELETESHADERPROC, DeleteShader)                       \
  F(PFNGLDELETETEXTURESPROC, DeleteTextures)                   \
  F(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)           \
  F(PFNGLDISABLEPROC, Disable)                                 \
  F(PFNGLDRAWELEMENTSBASEVERTEXPROC, DrawElementsBaseVertex)   \
  F(PFNGLENABLEPROC, Enable)                                   \
  F(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray) \
  F(PFNGLFINISHPROC, Finish)                                   \
  F(PFNGLGENBUFFERSPROC, GenBuffers)                           \
  F(PFNGLGENERATEMIPMAPPROC, GenerateMipmap)                   \
  F(PFNGLGENTEXTURESPROC, GenTextures)                         \
  F(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                 \
  F(PFNGLGETINTEGERVPROC, GetIntegerv)                         \
  F(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)             \
  F(PFNGLGETPROGRAMIVPROC, GetProgramiv)                       \
  F(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)           \
  F(PFNGLLINKPROGRAMPROC, LinkProgram)                         \
  F(PFNGLPIXELSTOREIPROC, PixelStorei)                         \
  F(PFNGLSCISSORPROC, Scissor)                                 \
  F(PFNGLSHADERSOURCEPROC, ShaderSource)                       \
  F(PFNGLTEXIMAGE2DPROC, TexImage2D)                           \
  F(PFNGLTEXPARAMETERFPROC, TexParameterf)                     \
  F(PFNGLTEXPARAMETERIPROC, TexParameteri)                     \
  F(PFNGLUNIFORM2FPROC, Uniform2f)                             \
  F(PFNGLUSEPROGRAMPROC, UseProgram)                           \
  F(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)         \
  F(PFNGLVIEWPORTPROC, Viewport)

struct Gl {
#define SIDELIGHT_GL_MEMBER(type, name) type name = nullptr;
  SIDELIGHT_GL_FUNCTIONS(SIDELIGHT_GL_MEMBER)
#undef SIDELIGHT_GL_MEMBER
};

// Fills the table from the current context. Throws OutputError naming a function that is missing
// (OSMesa's loader never says so).
Gl load_gl(GlLoader loader);

// Owns one OpenGL object. Must end its life on the context's thread, while the context is current and before
// `gl`.
class GlObject {
 public:
  using Deleter = void (*)(const Gl& gl, GLuint name);
  GlObject(const Gl& gl, GLuint name, Deleter deleter) : gl_(&gl), name_(name), delete_(deleter) {}
  ~GlObject() {
    if (name_ != 0) delete_(*gl_, name_);
  }
  GlObject(GlObject&& other) noexcept : gl_(other.gl_), name_(other.name_), delete_(other.delete_) {
    other.name_ = 0;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;

  GLuint name() const { return name_; }

 private:
  const Gl* gl_;
  GLuint name_;
  Deleter delete_;
};

GlObject make_buffer(const Gl& gl);
GlObject make_vertex_array(const Gl& gl);

// Compiles and links a program. Throws OutputError with the driver's log.
GlObject make_program(const Gl& gl, const char* vertex_source, const char* fragment_source);

// A picture as a texture: its own bytes, unfiltered, wherever it is drawn at its size or larger; smoothed
// with mipmaps, if it `may_shrink`, where it is drawn smaller. Throws UsageError if a side is longer than the driver takes.
GlObject make_picture_texture(const Gl& gl, const Image8& image, bool may_shrink);

// RGBA, 8 bits, smooth: for the font. `rgba` has 4 * width * height bytes.
GlObject make_font_texture(const Gl& gl, int width, int height, const unsigned char* rgba);

}  // namespace sidelight
