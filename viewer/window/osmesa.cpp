// SPDX-License-Identifier: MIT
#include "viewer/window/osmesa.h"

#include <dlfcn.h>

#include <string>

#include "common/error.h"

namespace sidelight {
namespace {

[[noreturn]] void refuse() {
  throw OutputError(std::string("nothing can be drawn off screen: ") + dlerror());
}

template <class Function>
Function fetch(void* library, const char* name) {
  void* function = dlsym(library, name);
  if (!function) refuse();
  return reinterpret_cast<Function>(function);
}

Osmesa load() {
  void* library = dlopen(SIDELIGHT_OSMESA, RTLD_NOW | RTLD_LOCAL);
  if (!library) refuse();
#define SIDELIGHT_FETCH(name) fetch<decltype(&name)>(library, #name)
  return {SIDELIGHT_FETCH(OSMesaCreateContextAttribs), SIDELIGHT_FETCH(OSMesaDestroyContext),
          SIDELIGHT_FETCH(OSMesaMakeCurrent), SIDELIGHT_FETCH(OSMesaPixelStore),
          SIDELIGHT_FETCH(OSMesaGetProcAddress)};
#undef SIDELIGHT_FETCH
}

}  // namespace

const Osmesa& osmesa() {
  static const Osmesa loaded = load();
  return loaded;
}

}  // namespace sidelight
