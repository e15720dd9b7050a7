// SPDX-License-Identifier: MIT
// The compiler flags are part of the algorithm: a fused multiply-add chosen by the compiler, or fast-math,
// breaks E(a,b) = -E(b,a) and with it watertightness, and makes instruction sets disagree. What is checked: the macros
// and the rounding state here, products at run time, and the flags of every file of this build.
#include <doctest/doctest.h>
#include <immintrin.h>

#include <atomic>
#include <cfenv>
#include <cfloat>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "common/math/isa.h"
#include "common/parallel.h"
#include "tests/hardcases/result.h"
#include "tests/tier.h"

#if defined(__FAST_MATH__) || __FINITE_MATH_ONLY__ || defined(__RECIPROCAL_MATH__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "sidelight must be compiled without -ffast-math and its parts"
#endif
static_assert(FLT_EVAL_METHOD == 0, "float must be computed in float, double in double");
static_assert(std::numeric_limits<float>::is_iec559 && std::numeric_limits<double>::is_iec559);

namespace {

constexpr int kPairs = 10000;

// What a compiler that may contract turns into fused operations; noinline: it may not see the arguments. Once as this
// file is compiled, and once as in files compiled with -mfma, where the machine has such operations.
template <class T>
struct Plain {
  [[gnu::noinline]] static T minus_product(T a, T b, T c) { return a * b - c; }
  [[gnu::noinline]] static T edge(T a, T b, T c, T d) { return a * b - c * d; }
};
template <class T>
struct WithFma {
  [[gnu::noinline, gnu::target("avx2,fma")]] static T minus_product(T a, T b, T c) { return a * b - c; }
  [[gnu::noinline, gnu::target("avx2,fma")]] static T edge(T a, T b, T c, T d) { return a * b - c * d; }
};

// With rounded products a·b - fl(a·b) is 0 and E(a,b) = -E(b,a); a fused form leaves a product's rounding error.
template <class T, class Compiled>
void check_products(const std::string& what) {
  std::mt19937 random(1);
  std::uniform_real_distribution<T> uniform(-1, 1);
  int residues = 0, asymmetries = 0;
  int telling = 0;  // pairs whose product does round: those on which a fused form shows
  for (int i = 0; i < kPairs; ++i) {
    const T a = uniform(random), b = uniform(random), c = uniform(random), d = uniform(random);
    const volatile T product = a * b;
    residues += Compiled::minus_product(a, b, product) != 0;
    asymmetries += Compiled::edge(a, b, c, d) != -Compiled::edge(c, d, a, b);
    telling += std::fma(a, b, -product) != 0;
  }
  const sidelight::test::HardCase flags("TRI-3");
  flags.none("contracted products, " + what, static_cast<std::uint64_t>(residues), kPairs);
  flags.none("edges that are not antisymmetric, " + what, static_cast<std::uint64_t>(asymmetries), kPairs);
  CHECK(telling > kPairs * 9 / 10);
}

// Flush-to-zero and denormals-are-zero, of this thread. A library built with fast-math switches them on for all.
bool flushes_denormals() { return (_mm_getcsr() & 0x8040u) != 0; }

}  // namespace

TEST_SUITE("math") {
  TEST_CASE("flags: products are not contracted") {
    check_products<float, Plain<float>>("float");
    check_products<double, Plain<double>>("double");
  }

  TEST_CASE("flags: products are not contracted where the machine could") {
    if (!sidelight::machine_has(sidelight::Isa::avx2)) return sidelight::test::skip_test("no FMA");
    check_products<float, WithFma<float>>("float, where the machine could");
    check_products<double, WithFma<double>>("double, where the machine could");
  }

  TEST_CASE("flags: rounding to nearest, denormals kept, on every thread") {
    CHECK(std::fegetround() == FE_TONEAREST);
    CHECK_FALSE(flushes_denormals());
    std::atomic<int> wrong = 0;
    sidelight::parallel_for(
        64, 4, [&](int, int) { wrong += std::fegetround() != FE_TONEAREST || flushes_denormals(); });
    CHECK(wrong == 0);

    volatile double smallest = std::numeric_limits<double>::min();
    CHECK(smallest / 2 > 0);
    CHECK(smallest / 2 * 2 == smallest);
  }

  TEST_CASE("flags: every file of the build is compiled with -ffp-contract=off and no fast-math") {
    const auto commands = nlohmann::json::parse(std::ifstream(SIDELIGHT_BUILD_DIR "/compile_commands.json"));
    int files = 0;
    for (const auto& entry : commands) {
      const std::string command = entry.at("command").get<std::string>() + ' ';
      INFO(command);
      const std::size_t off = command.rfind(" -ffp-contract=off ");
      REQUIRE(off != std::string::npos);
      CHECK(command.rfind(" -ffp-contract=") == off);  // the last one counts
      const std::size_t no_fast_math = command.rfind(" -fno-fast-math ");
      REQUIRE(no_fast_math != std::string::npos);
#if defined(__GNUC__) && !defined(__clang__)
      CHECK(command.find(" -fno-tree-slp-vectorize ") != std::string::npos);
#endif
      for (const char* flag :
           {" -ffast-math ", " -Ofast ", " -funsafe-math-optimizations ", " -ffinite-math-only ",
            " -fassociative-math ", " -freciprocal-math ", " -march=native "})
        CHECK(command.find(flag) == std::string::npos);
      ++files;
    }
    CHECK(files > 20);
  }
}
