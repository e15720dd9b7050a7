// SPDX-License-Identifier: MIT
// Reports: their parts, the whole file that compare writes, and what a browser makes of it.
#include "viewer/report/html.h"

#include <cmath>
#include <numbers>

#include "common/picture/image_io.h"
#include "tests/support/program.h"
#include "tests/support/text.h"
#include "tests/tier.h"
#include "viewer/report/compare_report.h"
#include "viewer/report/plot_svg.h"

using namespace sidelight;
using namespace sidelight::test;
using test::contains;
using test::count;

namespace {

std::string base64_of(const std::string& text) {
  return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

// The first text between two others.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  REQUIRE(from != std::string::npos);
  const std::size_t to = text.find(end, from + begin.size());
  REQUIRE(to != std::string::npos);
  return text.substr(from + begin.size(), to - from - begin.size());
}

// As the report embeds it.
std::string embedded(const std::string& path) {
  const ImageFile file = read_image(path);
  std::vector<glm::vec3> linear;
  for (std::size_t i = 0; i < file.channels.at("R").size(); ++i)
    linear.emplace_back(file.channels.at("R")[i], file.channels.at("G")[i], file.channels.at("B")[i]);
  return base64(encode_png(to_image8(linear, file.width, file.height)));
}

std::vector<Material> materials(int count_of) {
  std::vector<Material> out;
  for (int i = 0; i < count_of; ++i) {
    Material material;
    material.name = "material <" + std::to_string(i) + ">";
    material.specular = glm::dvec3(0.5);
    material.shininess = i + 1;
    out.push_back(material);
  }
  return out;
}

// A good scene whose every text is out to break the page. TOML takes no control characters but by escapes.
std::string hostile_scene() {
  const std::string attack =
      R"(</title></style></script><script>document.title='taken'</script><img src=x onerror=alert(1)>'\")"
      R"( onload='x &lt; {} {0} --> ]]> \u0000\u0007\u001b[31m\u0085 \u202e\u2066\u200f\u2028 )";
  const std::string endless(30000, 'W'), stacked = [] {
    std::string text = "Z";
    for (int i = 0; i < 200; ++i) text += "\u0300\u0323";  // accents above and below each other
    return text;
  }();
  std::string scene = "title = \"" + attack + stacked + endless + "\"\nlesson = \"\"\"" + attack + endless +
                      "\n\n" + attack + "\"\"\"\n" + kGoodScene;
  const auto rename = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = scene.find(from); at != std::string::npos; at = scene.find(from, at + to.size()))
      scene.replace(at, from.size(), to);
  };
  rename("[material.red]", "[material.\"" + attack + endless + "\"]\nspecular = 0.5");
  rename("material = 'red'", "material = \"" + attack + endless + "\"");
  return scene;
}

// out/report.html of a hostile scene, untitled/report.html of one that has only its name.
void write_hostile_reports(const Workplace& here) {
  const std::string name = "<b onclick=x>\xff\x1b\u202E'.toml";
  write_bytes(here / name, hostile_scene());
  REQUIRE(here.run({"compare", name, "-r", "32x24", "-q", "-o", "out"}).code == 0);
  write_bytes(here / name, kGoodScene);
  REQUIRE(here.run({"compare", name, "-r", "32x24", "-q", "-o", "untitled"}).code == 0);
}

// Opens and uses the report as a person would.
void browse(const Workplace& here, const std::string& report) {
  const Outcome outcome =
      here.command({SIDELIGHT_SOURCE_DIR "/tests/viewer/report/browse_report.py", report});
  if (outcome.code == 77) return test::skip_test("no chromium");
  CHECK(outcome.out == "");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
}

}  // namespace

TEST_CASE("report: text is escaped for content and attributes alike") {
  CHECK(escaped("plain, Grün, 日本, 🙂").markup == "plain, Grün, 日本, 🙂");
  CHECK(escaped("<a href=\"x\" id='y'>&amp;").markup ==
        "&lt;a href=&quot;x&quot; id=&#39;y&#39;&gt;&amp;amp;");
  CHECK(escaped("a\nb\tc\rd").markup == "a b c d");
  CHECK(escaped(std::string_view("\0|\x1b|\x7f|\u0085", 8)).markup == "\uFFFD|\uFFFD|\uFFFD|\uFFFD");
  CHECK(
      escaped("\xff|\xc0\xaf|\xed\xa0\x80|\xe2\x82").markup ==
      "\uFFFD|\uFFFD\uFFFD|\uFFFD\uFFFD\uFFFD|\uFFFD\uFFFD");  // a stray byte, overlong, a surrogate, cut off
  for (const char* mark :
       {"\u061C", "\u200E", "\u200F", "\u2028", "\u2029", "\u202A", "\u202E", "\u2066", "\u2069"})
    CHECK(escaped(mark).markup == "\uFFFD");
  CHECK(escaped("\uFFFE|\uFFFF|\uFFFD").markup == "\uFFFD|\uFFFD|\uFFFD");  // no characters of XML
  CHECK(escaped("עברית").markup == "עברית");
}

TEST_CASE("report: long text is cut between characters") {
  CHECK(escaped("12345", 5).markup == "12345");
  CHECK(escaped("123456", 5).markup == "12345…");
  CHECK(escaped("ééé", 3).markup == "éé…");
  CHECK(escaped("<<<", 2).markup == "&lt;&lt;…");
  CHECK(escaped("", 0).markup == "");
}

TEST_CASE("report: only Html enters markup as it is") {
  CHECK(html("<p>{} {:.2f} {} {}</p>", 7, 1.5, "<b>", Html{"<b>"}).markup == "<p>7 1.50 &lt;b&gt; <b></p>");
  CHECK(html("{}", std::string("{} <{0}>")).markup == "{} &lt;{0}&gt;");  // a value is no pattern
}

TEST_CASE("report: a lesson's commands stay lines, its other lines run together") {
  const auto lesson = [](std::string_view text) { return lesson_html(text).markup; };
  CHECK(lesson("").empty());
  CHECK(lesson(" \n\n \t\n").empty());
  CHECK(
      lesson("One\nparagraph.\n \nAnother.") ==
      "<p class=\"lesson\" dir=\"auto\">One paragraph.</p>\n<p class=\"lesson\" dir=\"auto\">Another.</p>\n");
  CHECK(lesson("Try\n  sidelight view <a>  its remark\r\n\tsidelight help\nsidelight says so.") ==
        "<p class=\"lesson\" dir=\"auto\">Try</p>\n"
        "<pre class=\"lesson\"><code>sidelight view &lt;a&gt;<span class=\"quiet\">  its remark</span>\n"
        "sidelight help</code></pre>\n<p class=\"lesson\" dir=\"auto\">sidelight says so.</p>\n");
  for (const std::string line : {" sidelight x\n", "line\n\n"}) {
    std::string endless;
    for (int i = 0; i < 4000; ++i) endless += line;
    CHECK(lesson(endless).size() < 40'000);  // of 4000 bytes with their markup
  }
}

TEST_CASE("report: base64 as in RFC 4648, section 10") {
  CHECK(base64_of("") == "");
  CHECK(base64_of("f") == "Zg==");
  CHECK(base64_of("fo") == "Zm8=");
  CHECK(base64_of("foo") == "Zm9v");
  CHECK(base64_of("foob") == "Zm9vYg==");
  CHECK(base64_of("fooba") == "Zm9vYmE=");
  CHECK(base64_of("foobar") == "Zm9vYmFy");
  CHECK(base64_of("\xfb\xff\xbf") == "+/+/");
}

TEST_CASE("report: numbers are grouped by thousands") {
  CHECK(grouped(0) == "0");
  CHECK(grouped(999) == "999");
  CHECK(grouped(1000) == "1\u202F000");
  CHECK(grouped(12345678) == "12\u202F345\u202F678");
}

TEST_CASE("report: a lobe is a power of the cosine, at every exponent") {
  const double right_angle = std::numbers::pi / 2;
  CHECK(lobe(0, 1e6) == 1);
  CHECK(lobe(right_angle / 3 * 2, 2) == doctest::Approx(0.25));
  CHECK(lobe(2 * right_angle, 3) == 0);
  CHECK(lobe_angle(0.5, 1) == doctest::Approx(right_angle / 3 * 2));
  CHECK(lobe_angle(0.5, 0) == doctest::Approx(right_angle));  // 1 everywhere
  for (const double s : {1.0, 7.0, 1e3, 1e6}) CHECK(lobe(lobe_angle(0.01, s), s) == doctest::Approx(0.01));
}

TEST_CASE("report: a plot places its curves and says what they are") {
  const Plot plot{"<title>",
                  {"x<", 0, 2, {0, 1, 2}},
                  {"y", 0, 1, {0, 1}},
                  {{"first", {{0, 0}, {1, std::nan("")}, {2, 1}}}, {"\"&\"", {{0, 1}, {2, 0}}}}};
  const std::string svg = plot_svg(plot).markup;
  CHECK(contains(svg, "aria-label=\"&lt;title&gt;\""));
  CHECK(contains(svg, ">x&lt;</text>"));
  CHECK(contains(svg, ">&quot;&amp;&quot;</text>"));
  CHECK(count(svg, "class=\"curve c0\"") == 2);                // the curve, and its line in the legend
  CHECK(contains(svg, "d=\" M58.00,318.00 M590.00,14.00\""));  // corners of the frame; begun anew behind NaN
  CHECK(contains(svg, "d=\" M58.00,14.00 L590.00,318.00\""));
  CHECK_FALSE(contains(svg, "nan"));
}

TEST_CASE("report: highlights of the first twelve shiny materials, the rest counted") {
  CHECK(highlights_html({}).empty());
  CHECK(highlights_html({Material{}}).empty());  // no specular coefficient
  const std::string few = highlights_html(materials(3)).markup,
                    many = highlights_html(materials(1000)).markup;
  CHECK(count(few, "class=\"lobe\"") == 3);
  CHECK(contains(few, "material &lt;2&gt;"));
  CHECK_FALSE(contains(few, "not shown"));
  CHECK(count(many, "class=\"lobe\"") == kMostCurves);
  CHECK(contains(many, "988 more materials"));
}

TEST_CASE("report: holds the pictures of its folder, the numbers and what to type next") {
  const Workplace here;
  std::filesystem::rename(here / "good.toml", here / "it's good.toml");
  const Arguments compare{"compare", "it's good.toml", "-r", "64x48", "-o", "out"};
  REQUIRE(here.run(compare + Arguments{"--spp", "4", "--depth", "3", "--no-refraction"}).code == 0);
  const std::string page = read_bytes(here / "out/report.html");
  for (const char* picture : {"raster.png", "raytrace.png", "causes.png"})
    CHECK(contains(page, embedded(here / ("out/" + std::string(picture)))));
  CHECK(contains(page, "Every pixel is accounted for"));
  CHECK(contains(page, " ms</td>"));
  // The line it gives is one that a shell takes.
  std::string line = between(page, "<pre><code>", "</code></pre>");
  CHECK(line.ends_with(" -r 64x48 --spp 4 --depth 3 --no-refraction --pixel " +
                       between(page, "The pictures differ most at pixel ", ". Why")));
  for (std::size_t at; (at = line.find("&#39;")) != std::string::npos;) line.replace(at, 5, "'");
  REQUIRE(line.rfind("sidelight explain ", 0) == 0);
  const Outcome outcome = here.run_in_shell("\"$0\" " + line.substr(10), {});
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "it's good.toml"));
}

TEST_CASE("report: asks nothing of the network and has no times with --no-times") {
  const Workplace here;
  REQUIRE(here.run({"compare", "good.toml", "-r", "32x24", "-q", "-o", "out", "--no-times"}).code == 0);
  const std::string page = read_bytes(here / "out/report.html");
  CHECK(contains(page, "content=\"default-src 'none'; img-src data:;"));
  CHECK_FALSE(contains(page, "://"));
  CHECK_FALSE(contains(page, " ms</td>"));
  CHECK(count(page, "<img ") == count(page, " src=\"data:image/png;base64,"));
}

TEST_CASE("report: of equal pictures says so and leaves out empty terms") {
  const Workplace here;
  REQUIRE(here.run({"compare", "good.toml", "-r", "32x24", "-q", "-o", "out", "--local"}).code == 0);
  const std::string page = read_bytes(here / "out/report.html");
  CHECK(contains(page, "The pictures are equal."));
  CHECK(count(page, "Zero in every pixel") == 3);
}

TEST_CASE("report: with a fault on purpose it does not say that the account is right in every pixel") {
  const Workplace here;
  const Arguments compare{"compare", "good.toml", "-r", "32x24", "--no-times", "-q", "-o"};
  REQUIRE(here.run(compare + Arguments{"right"}).code == 0);
  REQUIRE(here.run(compare + Arguments{"wrong", "--tessellate", "8"}).code == 1);
  const std::string right = read_bytes(here / "right/report.html"),
                    wrong = read_bytes(here / "wrong/report.html");
  for (const char* words : {"equal in every bit.</f", "to the last rounding.</p>",
                            "and this is the ray tracer's picture", "in both renderers, term"}) {
    CHECK(contains(right, words));
    CHECK_FALSE(contains(wrong, words));
  }
  CHECK(contains(wrong, "pixels that the fault tessellate spoils"));
}

TEST_CASE("report: pictures of more than four million pixels are embedded reduced") {
  if (test::tier() == "sanitized") return test::skip_test("a large picture, which sanitizers make slow");
  const Workplace here;
  REQUIRE(here.run({"compare", "good.toml", "-r", "2400x1801", "-q", "-o", "out"}).code == 0);
  const std::string page = read_bytes(here / "out/report.html");
  CHECK(contains(page, "2×2 pixels became one"));
  CHECK(contains(page, " width=\"1200\" height=\"900\""));
}

TEST_CASE("report: the showcase's is under 5 MB") {
  if (test::tier() == "sanitized") return test::skip_test("the size does not depend on the build");
  const Workplace here;
  REQUIRE(here.run({"compare", "scenes/showcase.toml", "-q", "-o", "out"}).code == 0);
  CHECK(std::filesystem::file_size(here / "out/report.html") < 5'000'000);
}

TEST_CASE("report: hostile text of a scene and its name is inert") {
  const Workplace here;
  write_hostile_reports(here);
  for (const char* folder : {"out", "untitled"}) {
    const std::string page = read_bytes(here / (std::string(folder) + "/report.html"));
    CHECK(count(page, "<script") == 1);
    CHECK(count(page, "</script") == 1);
    CHECK(count(page, "</style") == 1);
    CHECK_FALSE(contains(page, "<b onclick"));
    CHECK_FALSE(contains(page, "<img src=x"));
    CHECK_FALSE(contains(page, "\x1b"));
    CHECK_FALSE(contains(page, "\xff"));
    CHECK_FALSE(contains(page, "\u202E"));
  }
  CHECK(contains(between(read_bytes(here / "untitled/report.html"), "<title>", "</title>"),
                 "&lt;b onclick=x&gt;"));
}

TEST_CASE("report: in a browser it swipes, flips and steps, and needs no JavaScript and no network") {
  const Workplace here;
  REQUIRE(here.run({"compare", "good.toml", "-r", "160x120", "-q", "-o", "out"}).code == 0);
  browse(here, "out/report.html");
}

TEST_CASE("report: in a browser hostile text breaks neither the page nor its widgets") {
  const Workplace here;
  write_hostile_reports(here);
  browse(here, "out/report.html");
  browse(here, "untitled/report.html");
}
