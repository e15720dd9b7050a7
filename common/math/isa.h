// SPDX-License-Identifier: MIT
// Which instruction set the lane kernels run on. Every choice gives the same bytes; only the speed differs.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace sidelight {

enum class Isa { scalar, avx2, avx512 };
inline constexpr std::array kIsas{Isa::scalar, Isa::avx2, Isa::avx512};

// Whether this machine has it, and this build may use it: one by clang does without avx512.
bool machine_has(Isa isa);
// The widest one this machine has; the environment variable SIDELIGHT_ISA, read once, may name a narrower one, so that
// a whole test suite can run on it. Any other value of it is ignored.
Isa best_isa();
std::string_view isa_name(Isa isa);
// "scalar", "avx2", "avx512"; anything else is empty.
std::optional<Isa> parse_isa(std::string_view name);

// Of one thing for each instruction set, that for `isa`.
template <class T>
T by_isa(Isa isa, T scalar, T avx2, T avx512) {
  if (isa == Isa::avx512) return avx512;
  return isa == Isa::avx2 ? avx2 : scalar;
}

}  // namespace sidelight
