// SPDX-License-Identifier: MIT
// FNV-1a, 64 bits (Fowler, Noll and Vo; RFC 9923): names content and notices accidents, protects nothing.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sidelight {

class ContentHash {
 public:
  void add(std::string_view bytes);
  std::string hex() const;  // 16 digits

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace sidelight
