// SPDX-License-Identifier: MIT
#include "common/large_pages.h"

#include <linux/mman.h>  // MADV_COLLAPSE, which the C library may not know yet
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace sidelight {
namespace {

// The whole pages of an array, if there are enough of them.
struct Pages {
  void* first = nullptr;
  std::size_t bytes = 0;
};
Pages whole_pages(const void* array, std::size_t bytes) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(array);
  const std::uintptr_t first = (begin + page - 1) / page * page, end = (begin + bytes) / page * page;
  if (end < first + kLargeArray) return {};
  return {reinterpret_cast<void*>(first), end - first};
}

}  // namespace

void wish_large_pages([[maybe_unused]] void* array, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  const Pages pages = whole_pages(array, bytes);
  if (pages.bytes > 0) madvise(pages.first, pages.bytes, MADV_HUGEPAGE);
#endif
}

void move_to_large_pages([[maybe_unused]] const void* array, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_COLLAPSE
  const Pages pages = whole_pages(array, bytes);
  if (pages.bytes > 0) madvise(pages.first, pages.bytes, MADV_COLLAPSE);
#endif
}

}  // namespace sidelight
