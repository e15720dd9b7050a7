// SPDX-License-Identifier: MIT
// OpenGL as Llvmpipe (llvmpipe.cpp, its one user) draws with it: OSMesa's context, and the functions.
#pragma once

#include "viewer/window/gl.h"  // before osmesa.h, whose header of OpenGL leaves out what this one has

#include <GL/osmesa.h>

#include <array>

namespace sidelight::bench {

// What the viewer's table lacks.
#define BENCH_GL_FUNCTIONS(F)                                  \
  F(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                 \
  F(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)               \
  F(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)   \
  F(PFNGLCLEARBUFFERFVPROC, ClearBufferfv)                     \
  F(PFNGLCLEARBUFFERUIVPROC, ClearBufferuiv)                   \
  F(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)           \
  F(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)         \
  F(PFNGLDEPTHFUNCPROC, DepthFunc)                             \
  F(PFNGLDRAWELEMENTSPROC, DrawElements)                       \
  F(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer) \
  F(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                 \
  F(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)               \
  F(PFNGLGETSTRINGPROC, GetString)                             \
  F(PFNGLREADPIXELSPROC, ReadPixels)                           \
  F(PFNGLRENDERBUFFERSTORAGEPROC, RenderbufferStorage)         \
  F(PFNGLUNIFORM1FPROC, Uniform1f)                             \
  F(PFNGLUNIFORM1UIPROC, Uniform1ui)                           \
  F(PFNGLUNIFORM3FVPROC, Uniform3fv)                           \
  F(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)

struct BenchGl : Gl {
#define BENCH_GL_MEMBER(type, name) type name = nullptr;
  BENCH_GL_FUNCTIONS(BENCH_GL_MEMBER)
#undef BENCH_GL_MEMBER
};

// With a context current.
BenchGl load_bench_gl();

// Current as long as it lives. The pictures are drawn elsewhere: OSMesa's own buffer is a token.
class LlvmpipeContext {
 public:
  // `threads` as Llvmpipe takes them. Throws std::runtime_error without OpenGL 3.3.
  explicit LlvmpipeContext(int threads);
  ~LlvmpipeContext();
  LlvmpipeContext(const LlvmpipeContext&) = delete;
  LlvmpipeContext& operator=(const LlvmpipeContext&) = delete;

 private:
  OSMesaContext context_;
  std::array<unsigned char, 4> pixel_{};
};

}  // namespace sidelight::bench
