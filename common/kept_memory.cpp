// SPDX-License-Identifier: MIT
#include "common/kept_memory.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <new>

#include "common/large_pages.h"

namespace sidelight {
namespace {

constexpr std::size_t kLeast = kLargeArray;            // what is smaller the system's own allocator keeps
constexpr std::size_t kMost = std::size_t{256} << 20;  // kept in all
constexpr std::align_val_t kLine{64};
constexpr std::size_t kLargePage = std::size_t{2} << 20;

struct Block {
  void* memory = nullptr;
  std::size_t bytes = 0;
};
void free_block(const Block& block) { ::operator delete (block.memory, std::align_val_t{kLargePage}); }

// No part of an array is left to small pages.
std::size_t in_large_pages(std::size_t bytes) {
  if (bytes > std::numeric_limits<std::size_t>::max() - kLargePage) throw std::bad_alloc();
  return (bytes + kLargePage - 1) / kLargePage * kLargePage;
}

class Kept {
 public:
  void* take(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(blocks_.rbegin(), blocks_.rend(),
                                    [bytes](const Block& block) { return block.bytes == bytes; });
    if (found == blocks_.rend()) return nullptr;
    void* const memory = found->memory;
    blocks_.erase(std::prev(found.base()));
    return memory;
  }
  void give_back(const Block& block) noexcept {
    const std::lock_guard lock(mutex_);
    try {
      blocks_.push_back(block);
    } catch (const std::bad_alloc&) {
      return free_block(block);
    }
    std::size_t all = 0;
    for (const Block& each : blocks_) all += each.bytes;
    for (; all > kMost; all -= blocks_.front().bytes, blocks_.erase(blocks_.begin()))
      free_block(blocks_.front());
  }

 private:
  std::mutex mutex_;
  std::vector<Block> blocks_;  // the latest last
};

// Never destroyed: frames with static storage outlive what is.
Kept& kept() {
  static Kept& blocks = *new Kept;
  return blocks;
}

}  // namespace

void* take_memory(std::size_t bytes) {
  if (bytes < kLeast) return ::operator new(bytes, kLine);
  const std::size_t whole = in_large_pages(bytes);
  if (void* const memory = kept().take(whole)) return memory;
  void* const memory = ::operator new (whole, std::align_val_t{kLargePage});
  wish_large_pages(memory, whole);
  return memory;
}

void give_back_memory(void* memory, std::size_t bytes) noexcept {
  if (bytes < kLeast)
    ::operator delete(memory, kLine);
  else
    kept().give_back({memory, in_large_pages(bytes)});
}

}  // namespace sidelight
