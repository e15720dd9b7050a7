// SPDX-License-Identifier: MIT
// Memory for arrays as large as a picture or a mesh, of which every frame needs the same again: what one frame gives back
// the next one takes. From the system each time, its pages would have to be got and cleared anew: a tenth of a frame, and
// more of one on two cores, which wait for each other there.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace sidelight {

// At least `bytes`, aligned as a cache line. From a few megabytes on it is in large pages, if the system has them, each
// got when it is first touched, and holds what its last user left. Throws std::bad_alloc. From any thread.
void* take_memory(std::size_t bytes);
// With the number of bytes that it was taken for. Of what is given back up to 256 MB are kept, the latest.
void give_back_memory(void* memory, std::size_t bytes) noexcept;

// An allocator whose elements are not set by making them: resize() leaves them as they are, assign() sets them.
template <class T>
struct KeptMemory {
  static_assert(std::is_trivially_destructible_v<T>);
  using value_type = T;

  KeptMemory() = default;
  template <class U>
  KeptMemory(const KeptMemory<U>&) {}

  T* allocate(std::size_t size) { return static_cast<T*>(take_memory(size * sizeof(T))); }
  void deallocate(T* memory, std::size_t size) noexcept { give_back_memory(memory, size * sizeof(T)); }
  template <class U>
  void construct(U*) noexcept {}
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    std::construct_at(at, std::forward<Arguments>(arguments)...);
  }
  bool operator==(const KeptMemory&) const { return true; }
};
template <class T>
using KeptArray = std::vector<T, KeptMemory<T>>;

}  // namespace sidelight
