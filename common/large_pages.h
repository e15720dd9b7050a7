// SPDX-License-Identifier: MIT
// Memory in large pages. Of a large array that is read here and there the processor otherwise spends more time on where
// its pages are than on what is in them, and one that is new is handed out page by page as it is touched. A wish only: a
// system without large pages does as before.
#pragma once

#include <cstddef>
#include <span>

namespace sidelight {

// Bytes of an array from which it gains; smaller ones are left alone.
inline constexpr std::size_t kLargeArray = std::size_t{4} << 20;

// For memory that has not been touched yet.
void wish_large_pages(void* array, std::size_t bytes);

// For memory with something in it, which stays as it is.
void move_to_large_pages(const void* array, std::size_t bytes);
template <class T>
void move_to_large_pages(std::span<const T> array) {
  move_to_large_pages(array.data(), array.size_bytes());
}

}  // namespace sidelight
