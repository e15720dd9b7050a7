// SPDX-License-Identifier: MIT
// A bench's plots and page: where marks, ticks and labels stand, what is embedded, and what a browser makes of it.
#include "viewer/report/bench_report.h"

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <sstream>

#include "tests/tier.h"
#include "tests/viewer/bench_results.h"
#include "tests/viewer/program.h"
#include "viewer/report/bench_pictures.h"
#include "viewer/report/bench_plot.h"
#include "viewer/report/label_places.h"
#include "viewer/report/log_axis.h"

using namespace sidelight;
using namespace sidelight::testing;

namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

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

// Noise, which no PNG makes small.
Image8 noise(int width, int height, std::mt19937& random) {
  Image8 image{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i) image.rgb.push_back(static_cast<std::uint8_t>(random()));
  return image;
}

void browse(const BenchResult& result) {
  const Workplace here;
  write_bytes(here / "report.html", bench_report(result));
  const Outcome outcome =
      here.command({SIDELIGHT_SOURCE_DIR "/tests/viewer/browse_report.py", "report.html"});
  if (outcome.code == 77) return test::skip_test("no chromium");
  CHECK(outcome.out == "");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
}

const std::string kAttack =
    R"(</title></style></script><script>document.title='taken'</script><img src=x onerror=alert(1)>'"{0} --> ]]>)"
    "\x1b[31m\xff\u202E";

BenchResult hostile_result() {
  BenchResult result = bench_result(2, 64, 48);
  result.command = result.version = result.machine = kAttack;
  for (BenchScene& scene : result.scenes)
    scene.title = scene.path = scene.hash = kAttack + std::string(5000, 'W');
  for (BenchPoint& point : result.points) {
    for (KnobValue& each : point.config)
      if (each.knob != "renderer") each.value += kAttack;
    if (!point.failures.empty()) point.failures = {kAttack};
  }
  return result;
}

}  // namespace

TEST_CASE("bench report: ticks are 1, 2, 5 within few decades, else powers of ten, never many") {
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

TEST_CASE("bench report: ticks are written as one writes them by hand") {
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

TEST_CASE("bench report: the front is a staircase through its marks, others leave it as it is") {
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

TEST_CASE("bench report: exact zeros stand on a floor below a break of the axis") {
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

TEST_CASE("bench report: a plot of nothing, of one mark and of impossible marks is still one") {
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

TEST_CASE("bench report: labels overlap neither each other, nor marks, nor the edge") {
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

TEST_CASE("bench report: a scene's marks are filled, grey or hollow, told by shape, named and joined") {
  const Scatter plot = total_scatter(bench_result(), 0);
  REQUIRE(plot.marks.size() == 8);
  CHECK(plot.series == std::vector<std::string>{"raytrace", "raster"});
  CHECK(plot.staircase);
  for (const Mark& mark : plot.marks) {
    const bool fails = contains(mark.words, "12 samples show another surface");
    CHECK(fails == (mark.state == MarkState::failed));
    CHECK(contains(mark.words, "; dominated") == (mark.state == MarkState::beaten));
    CHECK(mark.label.size() == (fails ? 2 : 1));  // the reason, beside it
    CHECK(mark.x_low == doctest::Approx(0.9 * mark.x));
  }
  // The values of depth and of samples, each with the default; precision has but one.
  REQUIRE(plot.threads.size() == 2);
  for (const std::vector<std::size_t>& thread : plot.threads) {
    CHECK(thread.size() == 3);
    for (std::size_t k = 1; k < thread.size(); ++k)
      CHECK(plot.marks[thread[k - 1]].x < plot.marks[thread[k]].x);
  }
  const std::string svg = scatter_svg(plot).markup;
  CHECK(count(svg, "class=\"mark s0 good\"") == 5);
  CHECK(count(svg, "class=\"mark s1 failed\"") == 1);
  CHECK(count(svg, "class=\"mark s0 beaten\"") == 1);
  CHECK(contains(svg, "data-point=\"7\""));
}

TEST_CASE("bench report: each kind of error is drawn with what moves it alone") {
  const BenchResult result = bench_result();
  const auto names = [&](ErrorKind kind) {
    std::set<std::string> out;
    const std::optional<Scatter> plot = kind_scatter(result, 0, kind);
    REQUIRE(plot.has_value());
    CHECK_FALSE(plot->staircase);
    for (const Mark& mark : plot->marks) out.insert(plot->series[mark.series] + " " + mark.label[0]);
    return out;
  };
  using Names = std::set<std::string>;
  CHECK(names(ErrorKind::arithmetic) ==
        Names{"raytrace default", "raster default", "raytrace precision float", "raster precision float"});
  CHECK(names(ErrorKind::model) ==
        Names{"raytrace default", "raster default", "raytrace depth 1", "raytrace depth 2"});
  CHECK(names(ErrorKind::sampling) == Names{"raytrace default", "raster default", "raytrace samples 4"});

  BenchResult unknown = bench_result();
  for (BenchPoint& point : unknown.points) point.by_kind = {};
  CHECK_FALSE(kind_scatter(unknown, 0, ErrorKind::model).has_value());
  CHECK(small_kind_scatters(unknown, 0).empty());
}

TEST_CASE("bench report: SVG files stand alone and have harmless names") {
  BenchResult result = bench_result(3);
  result.scenes[1].path = "elsewhere/a.toml";
  result.scenes[2].path = "../x/<b> \x1b%n.scene.toml";
  std::set<std::string> names;
  for (const auto& [name, text] : bench_plots(result)) {
    CHECK(names.insert(name).second);
    CHECK(name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.") ==
          std::string::npos);
    CHECK(text.rfind("<svg xmlns=\"http://www.w3.org/2000/svg\"", 0) == 0);
    CHECK(contains(text, "prefers-color-scheme: dark"));
    CHECK(count(text, "://") == 1);  // that name alone
  }
  CHECK(names.size() == 12);
  for (const char* name : {"a-total.svg", "a-2-total.svg", "a-sampling.svg", "-b----n-scene-model.svg"})
    CHECK(names.count(name) == 1);
  result.timed = false;
  CHECK(bench_plots(result).empty());
}

TEST_CASE("bench report: equal arguments give equal bytes") {
  CHECK(bench_report(bench_result(2)) == bench_report(bench_result(2)));
  CHECK(bench_plots(bench_result(2)) == bench_plots(bench_result(2)));
}

TEST_CASE(
    "bench report: the page holds every picture once, the tables, the reference image and the summary") {
  const std::string page = bench_report(bench_result());
  CHECK(count(page, "id=\"picture-") == 7);  // one of the 8 is another's
  CHECK(contains(page, "the picture of raster, pixel for pixel"));
  CHECK(count(page, "id=\"difference-") == 8);
  CHECK(count(page, "<svg ") == 4);
  CHECK(count(page, "class=\"sortable\"") == 2);
  CHECK(contains(page, "8x8 samples a pixel"));
  CHECK(contains(page, "<th scope=\"row\">equal-error speed-up</th>"));
  CHECK(contains(page, "as fast as"));
  CHECK_FALSE(contains(page, "shown reduced"));
  CHECK_FALSE(contains(page, "://"));
  CHECK(count(page, "<img ") == count(page, " src=\"data:image/png;base64,"));
}

TEST_CASE("bench report: several scenes begin with the worst, and only ratios go over them") {
  BenchResult result = bench_result(3);
  result.equal_error_speedup = RatioOverScenes{2.5, 1.5, 1};
  result.over_scenes = {{0, RatioOverScenes{1, 1, 0}, {}},
                        {1, RatioOverScenes{0.125, 0.25, 2}, RatioOverScenes{3, 4, 0}}};
  const std::string page = bench_report(result);
  CHECK(page.find(">Scene b</h2>") < page.find(">Scene a</h2>"));
  CHECK(page.find(">Scene a</h2>") < page.find(">Scene c</h2>"));
  CHECK(contains(page, "<b>0.125</b></td><td>0.25</td><td class=\"words\">Scene c</td>"));
  CHECK(contains(page, "2.5 (worst 1.5: Scene b)"));
  CHECK_FALSE(contains(bench_report(bench_result()), "Over 1"));
}

TEST_CASE("bench report: interrupted and untimed ones say so, empty ones are pages too") {
  BenchResult result = bench_result();
  result.interrupted = true;
  result.points[3].finished = false;
  const std::string cut = bench_report(result);
  CHECK(contains(cut, "The sweep was interrupted."));
  CHECK(contains(cut, "<b>Not finished:</b> raytrace samples=16."));
  CHECK_FALSE(contains(cut, "id=\"point-3\""));

  result = bench_result();
  result.timed = false;
  const std::string untimed = bench_report(result);
  CHECK(contains(untimed, "without times"));
  CHECK_FALSE(contains(untimed, "<svg "));
  CHECK_FALSE(contains(untimed, " ms"));
  CHECK(contains(untimed, "id=\"picture-0\""));

  for (BenchPoint& point : result.points) point.finished = false;
  CHECK(contains(bench_report(result), "No configuration was finished."));
  result.points.resize(1);
  result.points[0].finished = true;
  result.timed = true;
  CHECK(count(bench_report(result), "<g class=\"mark") == 4);  // one on each plot
  CHECK(contains(bench_report({}), "</html>"));
}

TEST_CASE("bench report: pictures are reduced in linear light") {
  const Image8 image{3, 2, {255, 255, 255, 0, 0, 0, 9, 9, 9, 0, 0, 0, 255, 255, 255, 9, 9, 9}};
  const Image8 half = reduced(image, 2);
  CHECK(half.width == 1);
  CHECK(half.height == 1);
  CHECK(half.rgb == std::vector<std::uint8_t>{188, 188, 188});  // sRGB of one half
  CHECK(reduced(image, 5).width == 1);
  CHECK(reduced(image, 1).rgb == image.rgb);
}

TEST_CASE("bench report: stays under 10 MB by reducing its pictures, and says so") {
  std::mt19937 random(7);
  BenchResult result = bench_result(3, 320, 240);
  for (BenchPoint& point : result.points) {
    point.picture = noise(320, 240, random);
    point.difference = noise(320, 240, random);
  }
  const std::string page = bench_report(result);
  CHECK(page.size() < 10'000'000);
  CHECK(page.size() > 1'000'000);
  CHECK(contains(page, "measured at 320×240; shown reduced, 2×2 pixels as one"));
}

TEST_CASE("bench report: hostile text is inert") {
  const BenchResult result = hostile_result();
  std::string all = bench_report(result);
  CHECK(count(all, "<script") == 1);
  CHECK(count(all, "</script") == 1);
  CHECK(count(all, "</style") == 1);
  for (const auto& [name, text] : bench_plots(result)) {
    CHECK(count(text, "</title") == 1 + count(text, "<g class=\"mark"));
    all += text;
  }
  for (const char* harm : {"<img src=x", "<script>document", "\x1b", "\xff", "\u202E"})
    CHECK_FALSE(contains(all, harm));
}

TEST_CASE("bench report: in a browser marks show their pictures, tables sort, any two pictures swipe") {
  browse(bench_result(2, 160, 120));
}

TEST_CASE("bench report: in a browser hostile text breaks nothing") { browse(hostile_result()); }
