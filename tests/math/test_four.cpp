// SPDX-License-Identifier: MIT
#include "common/math/four.h"

#include <doctest/doctest.h>

using namespace sidelight;

TEST_CASE("lanes: four rows of four become their columns") {
  const auto columns =
      transposed(Four{0, 1, 2, 3}, Four{10, 11, 12, 13}, Four{20, 21, 22, 23}, Four{30, 31, 32, 33});
  for (int k = 0; k < 4; ++k) {
    std::array<std::int32_t, 4> column{};
    store_four(columns[static_cast<std::size_t>(k)], column.data());
    CHECK(column == std::array<std::int32_t, 4>{k, 10 + k, 20 + k, 30 + k});
  }
}

TEST_CASE("lanes: x, y and z of four are interleaved") {
  const std::array<float, 4> x{1, 4, 7, 10}, y{2, 5, 8, 11}, z{3, 6, 9, 12};
  const auto parts = interleaved(load_four<FourFloats>(x.data()), load_four<FourFloats>(y.data()),
                                 load_four<FourFloats>(z.data()));
  std::array<float, 12> all{};
  for (std::size_t k = 0; k < parts.size(); ++k) store_four(parts[k], &all[4 * k]);
  CHECK(all == std::array<float, 12>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
}
