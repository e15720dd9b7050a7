// SPDX-License-Identifier: MIT
#include "common/kept_memory.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <numeric>
#include <thread>
#include <vector>

#include "tests/support/memory.h"

using namespace sidelight;

namespace {

constexpr std::size_t kLarge = (std::size_t{8} << 20) / sizeof(std::uint32_t);

KeptArray<std::uint32_t> counted(std::size_t size) {
  KeptArray<std::uint32_t> array(size);
  std::iota(array.begin(), array.end(), 0u);
  return array;
}

}  // namespace

TEST_CASE("kept memory: an array behaves as a vector, at any size") {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, kLarge, kLarge + 1}) {
    const KeptArray<std::uint32_t> array = counted(size);
    KeptArray<std::uint32_t> copy = array, moved = std::move(copy);
    CHECK(moved == array);
    moved.push_back(7);
    moved.assign(size, 5);
    CHECK(std::count(moved.begin(), moved.end(), 5u) == static_cast<std::ptrdiff_t>(size));
  }
}

TEST_CASE("kept memory: what one array gives back the next of its size takes, and it starts a cache line") {
  const std::uint32_t* first = nullptr;
  {
    const KeptArray<std::uint32_t> array = counted(kLarge);
    first = array.data();
    CHECK(reinterpret_cast<std::uintptr_t>(first) % 64 == 0);
    const KeptArray<std::uint32_t> other = counted(kLarge);  // two at a time are two
    CHECK(other.data() != first);
    CHECK(array[kLarge - 1] == kLarge - 1);
  }
  const KeptArray<std::uint32_t> again(kLarge);
  CHECK(again.data() == first);
  CHECK(again[kLarge - 1] == kLarge - 1);  // not set
}

TEST_CASE("kept memory: more than is kept goes back to the system, and what no number holds is refused") {
  constexpr std::size_t kBytes = kLarge * sizeof(std::uint32_t), kKept = std::size_t{256} << 20;
  std::size_t held = 0;
  {
    std::vector<KeptArray<std::uint32_t>> many;
    while (many.size() * kBytes < 2 * kKept) many.push_back(counted(kLarge));
    held = test::resident_bytes();
  }
  // All of it was touched, and half of it is too much; a quarter of that is room for what else comes and goes.
  const std::size_t left = test::resident_bytes();
  if (test::kMemoryReturns) CHECK(left + kKept * 3 / 4 < held);
  CHECK(counted(kLarge)[kLarge - 1] == kLarge - 1);
  CHECK_THROWS_AS(take_memory(std::numeric_limits<std::size_t>::max()), std::bad_alloc);
}

TEST_CASE("kept memory: threads take and give back at once") {
  std::vector<std::thread> threads;
  std::vector<int> whole(4, 0);
  for (std::size_t t = 0; t < whole.size(); ++t)
    threads.emplace_back([&whole, t] {
      for (std::uint32_t i = 0; i < 10; ++i) {
        KeptArray<std::uint32_t> array(kLarge / 2 + i % 2 * kLarge / 2);
        const auto mark = static_cast<std::uint32_t>(t) * 100 + i;
        array.front() = array.back() = mark;
        std::this_thread::yield();
        whole[t] += array.front() == mark && array.back() == mark;
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const int times : whole) CHECK(times == 10);
}
