// SPDX-License-Identifier: MIT
// Scatter plots on logarithmic axes: where ticks, marks, the front and labels stand.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "tests/support/text.h"
#include "viewer/report/label_places.h"
#include "viewer/report/log_axis.h"
#include "viewer/report/scatter_svg.h"

using namespace sidelight;
using test::contains;

namespace {

LogAxis axis_of(std::vector<double> values) { return log_axis(values); }

Mark mark_at(double x, double y, MarkState state = MarkState::good) {
  Mark mark;
  mark.x_low = mark.x = mark.x_high = x;
  mark.y = y;
  mark.state = state;
  return mark;
}

// The numbers of the path with this style, in pairs.
std::vector<glm::dvec2> corners(const std::string& svg, const std::string& style) {
  const std::size_t at = svg.find("<path class=\"" + style + "\" d=\"");
  if (at == std::string::npos) return {};
  std::string data = svg.substr(svg.find("d=\"", at) + 3);
  data = data.substr(0, data.find('"'));
  for (char& c : data)
    if (c == 'M' || c == 'L' || c == ',') c = ' ';
  std::istringstream in(data);
  std::vector<glm::dvec2> out;
  for (glm::dvec2 p; in >> p.x >> p.y;) out.push_back(p);
  return out;
}

// Where the marks of a plot stand, in the order of the drawing.
std::vector<glm::dvec2> marks(const std::string& svg) {
  std::vector<glm::dvec2> out;
  for (std::size_t at = svg.find("<g class=\"mark"); at != std::string::npos;
       at = svg.find("<g class=\"mark", at + 1)) {
    std::istringstream in(svg.substr(svg.find("translate(", at) + 10));
    glm::dvec2 p;
    REQUIRE(static_cast<bool>(in >> p.x >> p.y));
    out.push_back(p);
  }
  return out;
}

}  // namespace

TEST_CASE("scatter: ticks are 1, 2, 5 within few decades, else powers of ten, never many") {
  CHECK(axis_of({5, 610}).ticks == std::vector<double>{5, 10, 20, 50, 100, 200, 500});
  CHECK(axis_of({1e-8, 1e-3}).ticks == std::vector<double>{1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3});
  CHECK(axis_of({3, 3.0001}).ticks == std::vector<double>{2, 5});  // at least a factor of 4
  for (const auto& values :
       std::vector<std::vector<double>>{{}, {0, -1}, {5e-324, 1e308}, {1e-300}, {1e300}, {1, 1e7}}) {
    const LogAxis axis = axis_of(values);
    CHECK(axis.low > 0);
    CHECK(std::isfinite(axis.high));
    CHECK(axis.high / axis.low >= 4);
    CHECK(axis.ticks.size() >= 1);
    CHECK(axis.ticks.size() <= 9);
    for (const double tick : axis.ticks) CHECK((tick >= axis.low && tick <= axis.high));
  }
}

TEST_CASE("scatter: ticks are written as one writes them by hand") {
  const LogAxis fine = axis_of({5, 610}), wide = axis_of({1e-8, 10});
  CHECK(tick_words(fine, 500) == "500");
  CHECK(tick_words(fine, 0.02) == "0.02");
  CHECK(tick_words(fine, 2e-5) == "2·10⁻⁵");
  CHECK(tick_words(fine, 1e6) == "10⁶");
  CHECK(tick_words(wide, 1e-2) == "10⁻²");
  CHECK(tick_words(wide, 1e-12) == "10⁻¹²");
  CHECK(tick_words(wide, 1) == "1");
  CHECK(tick_words(wide, 10) == "10¹");
  CHECK(log_place(wide, wide.low) == 0);
  CHECK(log_place(wide, wide.high) == doctest::Approx(1));
}

TEST_CASE("scatter: the front is a staircase through its marks, others leave it as it is") {
  Scatter plot;
  plot.staircase = true;
  plot.marks = {mark_at(10, 1e-1), mark_at(100, 1e-2),
                mark_at(50, 1e-1),  // equal error: on a step, no corner
                mark_at(5, 1e-4, MarkState::failed), mark_at(20, 5e-2, MarkState::beaten)};
  const std::string svg = scatter_svg(plot).markup;
  const std::vector<glm::dvec2> at = marks(svg), steps = corners(svg, "staircase");
  REQUIRE(at.size() == 5);  // beaten, failed, then the good ones in their order
  const glm::dvec2 fast = at[2], good = at[3];
  REQUIRE(steps.size() == 5);
  CHECK(steps[0].x == fast.x);
  CHECK(steps[0].y < fast.y);  // down from the top
  CHECK(steps[1] == fast);
  CHECK(steps[2] == glm::dvec2(good.x, fast.y));
  CHECK(steps[3] == good);
  CHECK(steps[4].x > good.x);
  CHECK(steps[4].y == good.y);
  // Equal ratios of error are equal distances; coordinates have one decimal.
  CHECK((good.y - at[0].y) / (good.y - fast.y) == doctest::Approx(std::log10(5)).epsilon(0.002));
}

TEST_CASE("scatter: exact zeros stand on a floor below a break of the axis") {
  Scatter plot;
  plot.staircase = true;
  plot.marks = {mark_at(10, 1e-1), mark_at(20, 1e-9), mark_at(100, 0)};
  const std::string svg = scatter_svg(plot).markup;
  const std::vector<glm::dvec2> at = marks(svg);
  const std::vector<glm::dvec2> floor = corners(svg, "floor");
  REQUIRE(floor.size() >= 1);
  CHECK(floor[0].y == at[2].y);
  CHECK(at[2].y > at[1].y + 10);
  CHECK(corners(svg, "staircase").back().y == at[2].y);
  CHECK(contains(svg, ">0</text>"));

  plot.marks.pop_back();
  CHECK(corners(scatter_svg(plot).markup, "floor").empty());
}

TEST_CASE("scatter: a plot of nothing, of one mark and of impossible marks is still one") {
  Scatter plot;
  CHECK(marks(scatter_svg(plot).markup).empty());
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  plot.marks = {mark_at(0, 1),   mark_at(-1, 1), mark_at(nan, 1), mark_at(inf, 1),
                mark_at(1, nan), mark_at(1, -1), mark_at(1, inf)};
  plot.threads = {{0, 1, 2}};
  plot.staircase = true;
  std::string svg = scatter_svg(plot).markup;
  CHECK(marks(svg).empty());
  CHECK_FALSE(contains(svg, "nan"));
  CHECK_FALSE(contains(svg, "inf"));
  plot.marks = {mark_at(1, 0)};
  plot.threads = {};
  svg = scatter_svg(plot).markup;
  CHECK(marks(svg).size() == 1);
  CHECK_FALSE(contains(svg, "nan"));
}

TEST_CASE("scatter: a long reason is broken between words, and only then cut") {
  using Lines = std::vector<std::string>;
  const std::string word(kLongestLine, 'w');
  CHECK(in_two_lines("") == Lines{""});
  CHECK(in_two_lines(word) == Lines{word});
  CHECK(in_two_lines(word + " 12") == Lines{word, "12"});
  CHECK(in_two_lines("a " + word) == Lines{"a", word});
  CHECK(in_two_lines("a b " + word + "x") == Lines{"a b", word + "…"});
  CHECK(in_two_lines(word + "x y") == Lines{word + "…"});  // no blank to break at

  Scatter plot;
  plot.marks = {mark_at(1, 1, MarkState::failed)};
  plot.marks[0].name = "snap-bits 4";
  plot.marks[0].reason = "samples that show another surface: 1234567";
  const std::string svg = scatter_svg(plot).markup;
  for (const char* line : {">snap-bits 4<", ">samples that show another surface:<", ">1234567<"})
    CHECK(contains(svg, line));
}

TEST_CASE("scatter: labels overlap neither each other, nor marks, nor the edge") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(10, 590), y(10, 390), width(20, 160);
  const Rectangle frame{0, 0, 600, 400};
  std::vector<LabelRequest> requests;
  std::vector<Rectangle> taken;
  for (int i = 0; i < 60; ++i) {
    LabelRequest& request = requests.emplace_back();
    request.mark = {x(random), y(random)};
    const double wide = width(random);
    request.sizes = {{2 * wide, 28}, {wide, 14}};
    taken.push_back({request.mark.x - 6, request.mark.y - 6, request.mark.x + 6, request.mark.y + 6});
  }
  const auto places = place_labels(requests, taken, {}, frame);
  std::size_t placed = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    ++placed;
    const Rectangle& box = places[i]->box;
    CHECK((box.x0 >= 0 && box.y0 >= 0 && box.x1 <= 600 && box.y1 <= 400));
    CHECK(box.x1 - box.x0 == doctest::Approx(requests[i].sizes[places[i]->form].x));
    for (const Rectangle& mark : taken) CHECK_FALSE(overlap(box, mark));
    for (std::size_t k = 0; k < i; ++k) CHECK_FALSE((places[k] && overlap(box, places[k]->box)));
  }
  CHECK(placed >= 30);  // a crowd, yet most are named

  // A lone label stands right beside its mark, without a line to it.
  const auto lone = place_labels({requests[0]}, {}, {}, frame);
  REQUIRE(lone[0].has_value());
  CHECK_FALSE(lone[0]->leader.has_value());
  CHECK(lone[0]->form == 0);
  CHECK_FALSE(
      place_labels({{{300, 200}, {{700, 14}}}}, {}, {}, frame)[0].has_value());  // wider than the plot
}
