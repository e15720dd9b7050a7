// SPDX-License-Identifier: MIT
// How much memory this process has, as the system counts it.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <fstream>

namespace sidelight::test {

// Sanitizers keep what they were given back, so that here less says nothing.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kMemoryReturns = false;
#else
inline constexpr bool kMemoryReturns = true;
#endif

inline std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace sidelight::test
