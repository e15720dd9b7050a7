// SPDX-License-Identifier: MIT
// The report of a comparison made by hand, in which no two numbers and no two pictures are alike.
#include "viewer/report/compare_report.h"

#include <doctest/doctest.h>

#include "tests/picture/frames.h"
#include "tests/support/text.h"
#include "viewer/report/embedded_picture.h"
#include "viewer/report/html.h"

using namespace sidelight;
using namespace sidelight::test;

TEST_CASE("compare report: every sum stands at its step, and every pixel where it is") {
  Pair pair = equal_pair(8, 6);
  pair.traced.layer(Layer::shadow)[3] = glm::vec3(0.25f);
  pair.traced.layer(Layer::reflection)[4] = glm::vec3(0.125f);
  pair.traced.layer(Layer::refraction)[2 * 8 + 5] = {0, 0.375f, 0};
  const auto sums = ledger_sums(pair.rastered, pair.traced);
  pair.traced.color = sums[3];
  Comparison result = compare(pair.rastered, pair.traced, 1);
  result.visibility_mismatches = 3;
  result.mismatch_x = 3;
  result.mismatch_y = 1;
  result.unexplained = 2;
  result.unexplained_x = 6;
  result.unexplained_y = 4;
  const Scene scene;
  const std::string page =
      compare_report({scene, pair.rastered, pair.traced, result, {}, "explain", "view", {}, {}, {}});
  CHECK(contains(page,
                 "3 visibility mismatches, 2 unexplained pixels. First mismatch at pixel 3,1. "
                 "First unexplained pixel at 6,4."));
  CHECK(contains(page, "0.375 (green at 5,2)"));
  CHECK(contains(page, "differ most at pixel 5,2"));
  // Enlarged to the page's 480 pixels.
  constexpr std::array<const char*, 4> kSums{"R, the z-buffer's picture", "The sum R − S",
                                             "The sum R − S + M", "The sum R − S + M + G"};
  for (std::size_t k = 0; k < kSums.size(); ++k) {
    CAPTURE(k);
    CHECK(contains(page, base64(encode_png(embedded_picture(sums[k], pair.traced))) +
                             R"(" width="480" height="360" alt=")" + escaped(kSums[k]).markup +
                             "\" class=\"enlarged\""));
  }
}
