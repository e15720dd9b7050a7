// SPDX-License-Identifier: MIT
// The report of a comparison made by hand, in which no two numbers and no two pictures are alike.
#include "viewer/report/compare_report.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "common/picture/signed_difference.h"
#include "tests/picture/frames.h"
#include "tests/support/program.h"
#include "tests/support/text.h"
#include "viewer/report/embedded_picture.h"
#include "viewer/report/html.h"

using namespace sidelight;
using namespace sidelight::test;

TEST_CASE("compare report: every picture and number is the one that it is said to be") {
  Pair pair = equal_pair(8, 6);
  for (const Layer layer : {Layer::ambient, Layer::diffuse, Layer::specular})
    pair.rastered.layer(layer)[static_cast<std::size_t>(layer)] = glm::vec3(0.5f);
  for (const std::size_t i : {3, 4}) pair.traced.layer(Layer::shadow)[i] = glm::vec3(0.25f);
  pair.traced.layer(Layer::reflection)[5] = glm::vec3(0.125f);
  for (const std::size_t i : {19, 20, 21}) pair.traced.layer(Layer::refraction)[i] = {0, 0.375f, 0};
  const auto sums = ledger_sums(pair.rastered, pair.traced);
  pair.traced.color = sums[3];
  Comparison result = compare(pair.rastered, pair.traced, 1);
  result.visibility_mismatches = 3;
  result.mismatch_x = 3;
  result.mismatch_y = 1;
  result.unexplained = 2;
  result.unexplained_x = 6;
  result.unexplained_y = 4;
  result.ledger_max_residual = 0.25;
  result.metrics.mean = 0.5;
  result.metrics.rms = 0.75;
  const Scene scene;
  const std::string page = compare_report({scene,
                                           pair.rastered,
                                           pair.traced,
                                           result,
                                           {},
                                           "explain",
                                           "view",
                                           Times{1.5, 2.5},
                                           Times{3.5, 4.5},
                                           {}});
  CHECK(contains(page,
                 "3 visibility mismatches, 2 unexplained pixels. First mismatch at pixel 3,1. "
                 "First unexplained pixel at 6,4."));
  CHECK(contains(page, "0.375 (green at 3,2: 0.5 left, 0.875 right)"));
  CHECK(contains(page, "differ most at pixel 3,2"));
  for (const char* row :
       {"ledger</th><td>0.25</td>", "mean difference</th><td>0.5</td>", "square</th><td>0.75</td>",
        "z-buffer</th><td>1.5 ms</td><td>2.5 ms</td>", "ray tracer</th><td>3.5 ms</td><td>4.5 ms</td>"})
    CHECK_MESSAGE(contains(page, row), row);
  const std::array causes{result.shadow, result.reflection, result.refraction};
  for (std::size_t k = 0; k < causes.size(); ++k) {
    const auto code = [&](int c) { return encode_srgb8(kCauseHues[k][c]); };
    CHECK(contains(page, fmt::format("background:#{:02x}{:02x}{:02x}\"></span>{}</th><td>{}</td>", code(0),
                                     code(1), code(2), kCauseNames[k], causes[k].pixels)));
  }

  // Enlarged to the page's 480 pixels.
  const auto shows = [&](std::span<const glm::vec3> picture, const std::string& alt) {
    CHECK_MESSAGE(contains(page, base64(encode_png(embedded_picture(picture, pair.traced))) +
                                     R"(" width="480" height="360" alt=")" + escaped(alt).markup +
                                     "\" class=\"enlarged\""),
                  alt);
  };
  constexpr std::array<const char*, 4> kSums{"R, the z-buffer's picture", "The sum R − S",
                                             "The sum R − S + M", "The sum R − S + M + G"};
  for (std::size_t k = 0; k < kSums.size(); ++k) shows(sums[k], kSums[k]);
  for (const Layer layer : {Layer::ambient, Layer::diffuse, Layer::specular})
    shows(pair.rastered.layer(layer),
          "The " + std::string(kLayerNames[static_cast<std::size_t>(layer)]) + " part of R");
  for (std::size_t k = 0; k < kCauseLayers.size(); ++k)
    shows(pair.traced.layer(kCauseLayers[k]), "The " + std::string(kCauseNames[k]) + " term alone");
  shows(signed_difference(pair.rastered, pair.traced), "The signed difference of the two pictures");
  // A quarter stands half way.
  std::vector<glm::vec3> scale;
  for (int i = -256; i <= 256; ++i) scale.push_back(signed_difference_color(i / 256.0 * std::abs(i / 256.0)));
  CHECK(contains(page, base64(encode_png(to_image8(scale, 513, 1)))));
  const DifferenceHistogram histogram = difference_histogram(pair.rastered, pair.traced);
  CHECK(contains(page, fmt::format("Darker: {} pixels, equal: {}, brighter: {}.", histogram.darker(),
                                   histogram.equal, histogram.brighter())));
  CHECK(contains(page, fmt::format("{} where it is\ntallest", histogram.most())));
  std::string bars = "M0,100";
  for (std::size_t bin = 0; bin < histogram.pixels.size(); ++bin)
    bars += fmt::format(" V{:.1f} H{}", 100 * (1 - histogram.height(bin)), bin + 1);
  CHECK(contains(page, bars + " V100 Z"));
}

TEST_CASE("compare report: does not praise an agreement that --primary raster makes by itself") {
  const Workplace here;
  const Arguments verb{"compare", "good.toml", "-r", "32x24", "--no-times", "-q", "-o"};
  REQUIRE(here.run(verb + Arguments{"rays"}).code == 0);
  REQUIRE(here.run(verb + Arguments{"raster", "--primary", "raster"}).code == 0);
  const std::string rays = read_bytes(here / "rays/report.html"),
                    raster = read_bytes(here / "raster/report.html");
  for (const char* words :
       {"Both renderers see the same surface", "0 visibility mismatches, 0 unexplained"}) {
    CHECK(contains(rays, words));
    CHECK_FALSE(contains(raster, words));
  }
  const char* taken = "The ray tracer took the z-buffer's surfaces: that they agree says nothing.";
  CHECK(contains(raster, taken));
  CHECK_FALSE(contains(rays, taken));

  // Where the account is not right it says so, too.
  const Pair pair = equal_pair(8, 6);
  Comparison result = compare(pair.rastered, pair.traced, 1);
  result.unexplained = 1;
  const Scene scene;
  CompareReport wrong{scene, pair.rastered, pair.traced, result, {}, "explain", "view", {}, {}, {}};
  CHECK_FALSE(contains(compare_report(wrong), taken));
  wrong.from_raster = true;
  CHECK(contains(compare_report(wrong), taken));
}

TEST_CASE("compare report: says of the tracer's picture what is on in it") {
  const Workplace here;
  const auto caption = [&](const Arguments& flags) {
    REQUIRE(here.run(Arguments{"compare", "good.toml", "-r", "32x24", "-q", "-o", "out"} + flags).code == 0);
    const std::string page = read_bytes(here / "out/report.html"), begin = "<b>Ray tracer.</b> ";
    const std::size_t from = page.find(begin) + begin.size();
    return page.substr(from, page.find("</figcaption>", from) - from);
  };
  const std::string same = "The same surfaces and the same local light, ";
  CHECK(caption({}) == same + "with shadows, mirrors and glass.");
  CHECK(caption({"--no-shadows"}) == same + "with mirrors and glass.");
  CHECK(caption({"--no-shadows", "--no-refraction"}) == same + "with mirrors.");
  CHECK(caption({"--local"}) == same + "and nothing besides.");
  CHECK(caption({"--depth", "2"}) == same + "with shadows, mirrors and glass.");
  CHECK(caption({"--depth", "1"}) == same + "with shadows.");  // eye rays alone
  CHECK(contains(read_bytes(here / "out/report.html"),
                 "where their pictures differ, the shadows\nbelow explain it"));
}
