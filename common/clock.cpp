// SPDX-License-Identifier: MIT
#include "common/clock.h"

#include <malloc.h>  // malloc_trim
#include <sys/resource.h>

#include <chrono>
#include <ctime>
#include <fstream>

namespace sidelight {

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double cpu_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

// proc(5): "5" resets the peak resident size to the present one. Where it cannot be written, the peak stays. Before that
// the C library gives back what it holds in reserve, which would hide what is asked of it next.
void reset_peak_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  std::ofstream("/proc/self/clear_refs") << 5;
}

}  // namespace sidelight
