// SPDX-License-Identifier: MIT
#include "common/large_pages.h"

#include <linux/mman.h>  // MADV_COLLAPSE, which the C library may not know yet
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>

#include "common/parallel.h"

namespace sidelight {
namespace {

constexpr std::size_t kLeast = std::size_t{4} << 20;  // bytes from which they are worth it
constexpr std::size_t kPart = std::size_t{2} << 20;   // got by a thread at a time

// The whole pages of an array, if there are enough of them.
struct Pages {
  void* first = nullptr;
  std::size_t bytes = 0;
};
Pages whole_pages(const void* array, std::size_t bytes) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(array);
  const std::uintptr_t first = (begin + page - 1) / page * page, end = (begin + bytes) / page * page;
  if (end < first + kLeast) return {};
  return {reinterpret_cast<void*>(first), end - first};
}

}  // namespace

void wish_large_pages([[maybe_unused]] void* array, [[maybe_unused]] std::size_t bytes,
                      [[maybe_unused]] int threads) {
#ifdef MADV_HUGEPAGE
  const Pages pages = whole_pages(array, bytes);
  if (pages.bytes == 0) return;
  madvise(pages.first, pages.bytes, MADV_HUGEPAGE);
#ifdef MADV_POPULATE_WRITE
  if (thread_count(threads) == 1) return;
  const auto address = reinterpret_cast<std::uintptr_t>(pages.first), end = address + pages.bytes;
  const std::uintptr_t first = address / kPart * kPart;
  parallel_for(static_cast<int>((end - first + kPart - 1) / kPart), threads, [&](int item, int) {
    const std::uintptr_t from = std::max(address, first + static_cast<std::uintptr_t>(item) * kPart);
    const std::uintptr_t to = std::min(end, first + (static_cast<std::uintptr_t>(item) + 1) * kPart);
    madvise(reinterpret_cast<void*>(from), to - from, MADV_POPULATE_WRITE);
  });
#endif
#endif
}

void move_to_large_pages([[maybe_unused]] const void* array, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_COLLAPSE
  const Pages pages = whole_pages(array, bytes);
  if (pages.bytes > 0) madvise(pages.first, pages.bytes, MADV_COLLAPSE);
#endif
}

}  // namespace sidelight
