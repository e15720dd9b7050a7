// SPDX-License-Identifier: MIT
// A bench's plots and page: what is marked, what is embedded, and what a browser makes of it.
#include "viewer/report/bench_report.h"

#include <random>
#include <set>

#include "tests/support/program.h"
#include "tests/support/text.h"
#include "tests/tier.h"
#include "tests/viewer/report/bench_results.h"
#include "viewer/report/bench_pictures.h"
#include "viewer/report/bench_plot.h"

using namespace sidelight;
using namespace sidelight::test;
using test::contains;
using test::count;

namespace {

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
      here.command({SIDELIGHT_SOURCE_DIR "/tests/viewer/report/browse_report.py", "report.html"});
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

TEST_CASE("bench report: a scene's marks are filled, grey or hollow, told by shape, named and joined") {
  const Scatter plot = total_scatter(bench_result(), 0);
  REQUIRE(plot.marks.size() == 8);
  CHECK(plot.series == std::vector<std::string>{"raytrace", "raster"});
  CHECK(plot.staircase);
  for (const Mark& mark : plot.marks) {
    const bool fails = contains(mark.words, "12 samples show another surface");
    CHECK(fails == (mark.state == MarkState::failed));
    CHECK(contains(mark.words, "; dominated") == (mark.state == MarkState::beaten));
    CHECK(mark.reason.empty() != fails);  // the reason, beside it
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
    for (const Mark& mark : plot->marks) out.insert(plot->series[mark.series] + " " + mark.name);
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
    CHECK(contains(text, "fill: #1b1d22"));
    CHECK_FALSE(contains(text, "var("));  // nor for programs that know no variables of CSS
    CHECK(count(text, "://") == 1);       // that name alone
  }
  CHECK(names.size() == 12);
  for (const char* name : {"a-total.svg", "a-2-total.svg", "a-sampling.svg", "b----n-scene-model.svg"})
    CHECK(names.count(name) == 1);
  result.scenes[2].path = "水.toml";
  CHECK(bench_plots(result)[8].name == "scene-total.svg");
  result.timed = false;
  for (const BenchPlot& plot : bench_plots(result)) CHECK(plot.svg.empty());
  CHECK(bench_plots(result).size() == 12);  // whose files of an earlier run are out of date
}

TEST_CASE("bench report: equal arguments give equal bytes") {
  CHECK(bench_report(bench_result(2)) == bench_report(bench_result(2)));
  CHECK(bench_plots(bench_result(2)) == bench_plots(bench_result(2)));
}

TEST_CASE(
    "bench report: the page holds every picture once, the tables, the reference image and the summary") {
  BenchResult result = bench_result();
  result.points[0].error.covered.metrics.rms = 0.375;
  result.points[0].cpu_ms = {1, 2, 3};
  result.points[0].frame_memory_mb = 1.5;
  result.points[0].build_memory_mb = 2.5;
  const std::string page = bench_report(result);
  for (const char* cells :
       {"<td>4.00e-08</td><td>1.00e-04</td><td>2.00e-02</td>", "<td>3,4</td>", "<td>3.75e-01</td>",
        "<td>2.00 (1.00-3.00)</td><td>40.0 (36.0-44.0)</td>", "<td>1.5</td><td>2.5</td>"})
    CHECK(contains(page, cells));
  CHECK(count(page, "id=\"picture-") == 7);  // one of the 8 is another's
  CHECK(contains(page, "the picture of raster, pixel for pixel"));
  CHECK(count(page, "id=\"difference-") == 8);
  CHECK(count(page, "<svg ") == 4);
  CHECK(count(page, "class=\"sortable\"") == 2);
  CHECK(contains(page, "8x8 samples a pixel"));
  CHECK(contains(page, "<th scope=\"row\">equal-error speed-up</th>"));
  CHECK(contains(page, "<td class=\"words\">12 samples show another surface"));
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
