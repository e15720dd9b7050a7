// SPDX-License-Identifier: MIT
// The functions of OSMesa that draw_offscreen calls, from a library that is loaded by the first who asks and then kept:
// with it comes all of LLVM, nine tenths of the time that the program would otherwise take to start.
#pragma once

#include <GL/osmesa.h>

namespace sidelight {

struct Osmesa {
  decltype(&OSMesaCreateContextAttribs) create_context;
  decltype(&OSMesaDestroyContext) destroy_context;
  decltype(&OSMesaMakeCurrent) make_current;
  decltype(&OSMesaPixelStore) pixel_store;
  decltype(&OSMesaGetProcAddress) get_proc_address;
};

// May be called from any thread. Throws OutputError with the loader's reason where there is no such library.
const Osmesa& osmesa();

}  // namespace sidelight
