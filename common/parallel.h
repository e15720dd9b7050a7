// SPDX-License-Identifier: MIT
// All cores on one loop: std::thread and one atomic counter. (TBB's scheduler is opaque to ThreadSanitizer.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace sidelight {

// The number of threads that `requested` means: itself, or all cores for 0. At least 1.
int thread_count(int requested);

// Calls body(item, thread) once for each item in [0, items), thread in [0, thread_count(threads)); which thread gets
// which item is not determined. Returns when all are done. If a body throws, no further items start, and the first
// exception is rethrown here. Where the system cannot start that many threads, fewer do it all.
void parallel_for(int items, int threads, const std::function<void(int item, int thread)>& body);

// The same where an item alone is too little: body(block, first, last) once for each block [first, last) of kBlockItems.
inline constexpr std::size_t kBlockItems = 1024;
inline std::size_t blocks_of(std::size_t items) { return (items + kBlockItems - 1) / kBlockItems; }
template <class Body>
void parallel_blocks(std::size_t items, int threads, const Body& body) {
  parallel_for(static_cast<int>(blocks_of(items)), threads, [&](int each, int) {
    const auto block = static_cast<std::size_t>(each);
    body(block, block * kBlockItems, std::min(items, (block + 1) * kBlockItems));
  });
}

}  // namespace sidelight
