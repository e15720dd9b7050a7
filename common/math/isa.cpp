// SPDX-License-Identifier: MIT
#include "common/math/isa.h"

#include <cstdlib>

namespace sidelight {

bool machine_has(Isa isa) {
  switch (isa) {
    case Isa::scalar:
      return true;
    case Isa::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case Isa::avx512:
#ifdef __clang__
      // In the std::experimental::simd of GCC 12, _S_blend_avx512 lets clang take all lanes or none where a mask says
      // which: wrong pictures.
      return false;
#else
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
#endif
  }
  return false;
}

Isa best_isa() {
  static const Isa best = [] {
    const char* wanted = std::getenv("SIDELIGHT_ISA");
    const std::optional<Isa> named = parse_isa(wanted ? wanted : "");
    if (named && machine_has(*named)) return *named;
    return machine_has(Isa::avx512) ? Isa::avx512 : machine_has(Isa::avx2) ? Isa::avx2 : Isa::scalar;
  }();
  return best;
}

std::string_view isa_name(Isa isa) {
  switch (isa) {
    case Isa::avx2:
      return "avx2";
    case Isa::avx512:
      return "avx512";
    case Isa::scalar:
      break;
  }
  return "scalar";
}

std::optional<Isa> parse_isa(std::string_view name) {
  for (const Isa isa : kIsas)
    if (name == isa_name(isa)) return isa;
  return std::nullopt;
}

}  // namespace sidelight
