// SPDX-License-Identifier: MIT
// A hint to the processor that what lies there will be read soon. No address is wrong: it may even be nobody's.
#pragma once

namespace sidelight {

inline void prefetch(const void* at) {
  __builtin_prefetch(at);
  asm volatile("");  // without it GCC 12 drops calls of functions that do nothing but prefetch
}

}  // namespace sidelight
