// SPDX-License-Identifier: MIT
#include "tests/bench/llvmpipe_gl.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace sidelight::bench {
namespace {

OSMesaContext make_context(int threads) {
  ::setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  ::setenv("LP_NUM_THREADS", std::to_string(threads == 1 ? 0 : threads).c_str(), 1);
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  OSMesaContext context = OSMesaCreateContextAttribs(attributes, nullptr);
  if (!context) throw std::runtime_error("OSMesa has no OpenGL 3.3 core context");
  return context;
}

}  // namespace

BenchGl load_bench_gl() {
  BenchGl gl{load_gl(OSMesaGetProcAddress)};
#define BENCH_GL_FETCH(type, name) gl.name = reinterpret_cast<type>(OSMesaGetProcAddress("gl" #name));
  BENCH_GL_FUNCTIONS(BENCH_GL_FETCH)
#undef BENCH_GL_FETCH
  return gl;
}

LlvmpipeContext::LlvmpipeContext(int threads) : context_(make_context(threads)) {
  if (OSMesaMakeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == 0)
    throw std::runtime_error("OSMesa cannot draw");
}
LlvmpipeContext::~LlvmpipeContext() { OSMesaDestroyContext(context_); }

}  // namespace sidelight::bench
