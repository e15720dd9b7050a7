// SPDX-License-Identifier: MIT
#include "common/content_hash.h"

#include <array>
#include <cstdio>

namespace sidelight {

void ContentHash::add(std::string_view bytes) {
  for (const char byte : bytes) state_ = (state_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
}

std::string ContentHash::hex() const {
  std::array<char, 17> digits;
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(state_));
  return digits.data();
}

}  // namespace sidelight
