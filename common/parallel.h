// SPDX-License-Identifier: MIT
// All cores on one loop: std::thread and one atomic counter. (TBB's scheduler is opaque to ThreadSanitizer.)
#pragma once

#include <functional>

namespace sidelight {

// The number of threads that `requested` means: itself, or all cores for 0. At least 1.
int thread_count(int requested);

// Calls body(item, thread) once for each item in [0, items), thread in [0, thread_count(threads)); which thread gets
// which item is not determined. Returns when all are done. If a body throws, no further items start, and the first
// exception is rethrown here.
void parallel_for(int items, int threads, const std::function<void(int item, int thread)>& body);

}  // namespace sidelight
