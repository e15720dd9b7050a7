// SPDX-License-Identifier: MIT
// The verb diff from outside, with two picture files. What counts as near is tested in
// picture/test_tolerance.cpp; a picture against a scene in test_diff_scene.cpp.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/picture/image_io.h"
#include "tests/picture/frames.h"
#include "tests/support/program.h"

using namespace sidelight;
using namespace sidelight::test;
using Json = nlohmann::json;

namespace {

Frame grey(int width, int height, LayerMask layers = 0, const Rect& crop = {}) {
  RenderOptions options = options_with(layers);
  options.crop = crop;
  Frame frame = make_frame(width, height, 1, options);
  frame.color.assign(frame.pixels(), glm::vec3(0.5f, 0.25f, 0.125f));
  return frame;
}

void write_8bit(const std::string& path, const Frame& frame) {
  write_png(path, to_image8(frame.color, frame.width(), frame.height()));
}

// Exit code of `diff a b more`, with nothing on standard output.
int diff(const Workplace& here, const std::string& a, const std::string& b, const Arguments& more = {}) {
  const Outcome outcome = here.run(Arguments{"diff", a, b} + more);
  CHECK(outcome.out.empty());
  return outcome.code;
}

Json findings(const Workplace& here, const std::string& a, const std::string& b, const Arguments& more = {}) {
  const Outcome outcome = here.run(Arguments{"diff", a, b, "--json", "-"} + more);
  CAPTURE(outcome.err);
  REQUIRE_FALSE(outcome.out.empty());
  return Json::parse(outcome.out);
}

}  // namespace

TEST_CASE("diff: equal pictures, and one pixel in any size of picture") {
  const Workplace here;
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {1000, 700}}) {
    CAPTURE(width);
    Frame frame = grey(width, height);
    write_exr(here / "a.exr", frame);
    CHECK(diff(here, "a.exr", "a.exr") == 0);
    frame.color.back().y = std::nextafter(0.25f, 1.0f);
    write_exr(here / "b.exr", frame);
    CHECK(diff(here, "a.exr", "b.exr") == 1);
    CHECK(diff(here, "a.exr", "b.exr", {"--allow", "1"}) == 0);
    CHECK(diff(here, "b.exr", "a.exr", {"--fail", "1e-6"}) == 0);
  }
}

TEST_CASE("diff: the tolerances of the command line") {
  const Workplace here;
  Frame frame = grey(10, 10);
  write_exr(here / "a.exr", frame);
  for (const std::size_t i : {std::size_t{3}, std::size_t{44}, std::size_t{99}}) frame.color[i].z += 0.25f;
  write_exr(here / "b.exr", frame);
  CHECK(here.run({"diff", "a.exr", "b.exr"}).err.find("greatest 0.25 at 3,0 in B (0.125 and 0.375),") !=
        std::string::npos);
  const auto code = [&](const Arguments& more) { return diff(here, "a.exr", "b.exr", more); };
  CHECK(code({"--fail", "0.25"}) == 0);
  CHECK(code({"--fail", "0.2499"}) == 1);
  CHECK(code({"--failpercent", "3"}) == 0);
  CHECK(code({"--failpercent", "2.9"}) == 1);
  CHECK(code({"--failpercent", "1", "--allow", "3"}) == 0);
  CHECK(code({"--failpercent", "1", "--allow", "2"}) == 1);
  CHECK(code({"--allow", "3", "--hardfail", "0.25"}) == 0);
  CHECK(code({"--allow", "3", "--hardfail", "0.2"}) == 1);
  CHECK(code({"--fail", "inf", "--hardfail", "inf"}) == 0);
}

TEST_CASE("diff: the documented findings, and the difference as a picture") {
  const Workplace here;
  Frame frame = grey(4, 3, layer_bit(Layer::object) | layer_bit(Layer::primitive) | layer_bit(Layer::depth));
  frame.object_id = {0, 0, 0, 0, 7, 7, 7, 7, 0, 0, 0, 0};
  write_exr(here / "a.exr", frame);
  frame.color[5].x = 1;              // (1, 1), on the object
  frame.color[11].y = 0;             // (3, 2), on background
  frame.object_id[11] = 8;           // covered in b only
  frame.primitive_id[2] = 1u << 31;  // ids are compared as whole numbers
  frame.primitive_id[3] = (1u << 31) + 1;
  write_exr(here / "b.exr", frame);

  const Json json = findings(here, "a.exr", "b.exr", {"-o", "d.png"});
  CHECK(json["width"] == 4);
  CHECK(json["values"] == "linear");
  CHECK(json["over"] == 2);
  CHECK(json["percent_over"].get<double>() == doctest::Approx(100.0 * 2 / 12));
  CHECK(json["percent_covered_over"] == 40);  // 2 of 5
  CHECK(json["non_finite"] == 0);
  CHECK(json["metrics"]["max"] == Json{{"value", 0.5}, {"x", 1}, {"y", 1}, {"channel", "R"}});
  CHECK(json["metrics"]["mean"].get<double>() == doctest::Approx(0.75 / 36));
  CHECK(json["metrics"]["psnr"].is_number());
  CHECK(json["differing"] == Json{{"object", 1}, {"primitive", 2}, {"depth", 0}});
  CHECK(here.run({"diff", "a.exr", "b.exr"}).err.find("; 40 % of those with an object\n") !=
        std::string::npos);

  const ImageFile difference = read_image(here / "d.png");
  CHECK(difference.width == 4);
  CHECK(difference.height == 3);
  CHECK(encode_srgb8(difference.channels.at("R")[5]) == encode_srgb8(0.5f));
  CHECK(encode_srgb8(difference.channels.at("G")[11]) == encode_srgb8(0.25f));
  CHECK(difference.channels.at("G")[5] == 0);

  write_exr(here / "plain.exr", grey(4, 3));
  const Json plain = findings(here, "plain.exr", "plain.exr");
  CHECK(plain["percent_covered_over"].is_null());
  CHECK(plain["differing"]["depth"].is_null());
  CHECK(plain["metrics"]["psnr"].is_null());
  CHECK(findings(here, "plain.exr", "b.exr")["percent_covered_over"] == 40);  // ids in either file
}

TEST_CASE("diff: quiet says nothing, and a file for JSON takes nothing from standard output") {
  const Workplace here;
  write_exr(here / "a.exr", grey(2, 2));
  CHECK_FALSE(here.run({"diff", "a.exr", "a.exr"}).err.empty());
  const Outcome quiet = here.run({"diff", "a.exr", "a.exr", "-q", "--json", "a.json"});
  CHECK(quiet.out.empty());
  CHECK(quiet.err.empty());
  CHECK(Json::parse(read_bytes(here / "a.json"))["over"] == 0);
  CHECK(here.run({"diff", "a.exr", "a.exr", "-q", "--json", "missing/a.json"}).code == 7);
  CHECK(here.run({"diff", "a.exr", "a.exr", "-q", "-o", "missing/a.png"}).code == 7);
}

TEST_CASE("diff: exit code 4 where sizes or channels differ") {
  const Workplace here;
  write_exr(here / "a.exr", grey(6, 4));
  write_exr(here / "turned.exr", grey(4, 6));  // as many pixels
  write_exr(here / "crop.exr", grey(12, 8, 0, {2, 1, 8, 5}));
  write_exr(here / "moved.exr", grey(12, 8, 0, {3, 1, 9, 5}));
  write_exr(here / "taller.exr", grey(12, 9, 0, {2, 1, 8, 5}));
  write_8bit(here / "a.png", grey(6, 4));
  write_8bit(here / "turned.png", grey(4, 6));
  REQUIRE(here.command({"oiiotool", "a.png", "--ch", "R,G,B,A=1", "-o", "alpha.png"}).code == 0);
  // OpenEXR keeps the colours, which a PNG would have divided by alpha.
  for (const std::string alpha : {"1", "0.5"})
    REQUIRE(here.command({"oiiotool", "a.exr", "--ch", "R,G,B,A=" + alpha, "-o", "alpha" + alpha + ".exr"})
                .code == 0);
  for (const auto& [a, b] : {std::pair{"a.exr", "turned.exr"},
                             {"a.png", "turned.png"},
                             {"a.png", "turned.exr"},
                             {"a.exr", "crop.exr"},
                             {"crop.exr", "moved.exr"},
                             {"crop.exr", "taller.exr"},
                             {"a.png", "alpha.png"}}) {
    CAPTURE(a);
    CAPTURE(b);
    const Outcome outcome = here.run({"diff", a, b, "--fail", "inf", "-o", "d.png"});
    CHECK(outcome.code == 4);
    CHECK(lines(outcome.err).size() == 1);
    CHECK(outcome.err.find(b) != std::string::npos);
    CHECK(diff(here, b, a) == 4);
  }
  CHECK_FALSE(std::filesystem::exists(here / "d.png"));
  CHECK(diff(here, "alpha.png", "alpha.png") == 0);
  CHECK(diff(here, "alpha1.exr", "alpha0.5.exr") == 1);  // alpha is a channel too
}

TEST_CASE("diff: a crop is compared in its place, and with a PNG of its size") {
  const Workplace here;
  Frame frame = grey(12, 8, 0, {2, 1, 8, 5});
  write_exr(here / "a.exr", frame);
  write_8bit(here / "a.png", frame);
  frame.color[frame.index(7, 3)].x = 0.75f;
  write_exr(here / "b.exr", frame);
  const Json json = findings(here, "a.exr", "b.exr");
  CHECK(json["over"] == 1);
  CHECK(json["width"] == 6);
  CHECK(json.at("crop") == Json::array({2, 1, 8, 5}));
  CHECK(json["metrics"]["max"]["x"] == 7);  // of the whole picture
  CHECK(json["metrics"]["max"]["y"] == 3);
  CHECK(diff(here, "a.png", "a.exr") == 0);
  CHECK(findings(here, "a.png", "b.exr")["metrics"]["max"]["x"] == 7);
  CHECK(findings(here, "a.png", "b.exr").at("crop") == json.at("crop"));
  write_exr(here / "corner.exr", grey(12, 8, 0, {0, 0, 6, 4}));
  CHECK(findings(here, "a.png", "corner.exr").at("crop") == Json::array({0, 0, 6, 4}));
  CHECK_FALSE(findings(here, "a.png", "a.png").contains("crop"));  // which knows of no whole
}

TEST_CASE("diff: PNG against EXR as 8-bit codes, PNG against PNG as linear light") {
  const Workplace here;
  Frame frame = make_frame(256, 1, 1, {});
  for (std::size_t i = 0; i < 256; ++i)
    frame.color[i] = glm::vec3(static_cast<float>(i) * 1.37f / 256 - 0.1f);
  write_exr(here / "a.exr", frame);  // below 0 and above 1 too
  write_8bit(here / "a.png", frame);
  write_png_linear16(here / "a16.png", frame);
  CHECK(diff(here, "a.exr", "a.png") == 0);
  CHECK(diff(here, "a.png", "a.exr") == 0);
  // 16 bits round once more, so a value may cross to the next code, and no farther.
  CHECK(diff(here, "a.exr", "a16.png", {"--fail", "0.004"}) == 0);

  Frame one = grey(1, 1);
  one.color[0] = glm::vec3(decode_srgb8(200));
  write_exr(here / "c.exr", one);
  one.color[0].y = decode_srgb8(201);
  write_exr(here / "d.exr", one);
  write_8bit(here / "c.png", one);
  one.color[0].y = decode_srgb8(203);
  write_8bit(here / "d.png", one);

  Json json = findings(here, "c.exr", "c.png");
  CHECK(json["values"] == "srgb8");
  CHECK(json["metrics"]["max"]["value"].get<double>() == doctest::Approx(1.0 / 255));
  CHECK(json["metrics"]["psnr"].get<double>() == doctest::Approx(10 * std::log10(255.0 * 255 * 3)));
  json = findings(here, "c.exr", "d.png");
  CHECK(json["metrics"]["psnr"].get<double>() == doctest::Approx(10 * std::log10(255.0 * 255 * 3 / 9)));
  CHECK(diff(here, "c.exr", "c.png") == 1);
  CHECK(diff(here, "c.exr", "c.png", {"--fail", "0.004"}) == 0);
  CHECK(diff(here, "d.exr", "c.png") == 0);

  json = findings(here, "c.png", "d.png");
  CHECK(json["values"] == "linear");
  const double step = double{decode_srgb8(203)} - double{decode_srgb8(201)};
  CHECK(json["metrics"]["max"]["value"].get<double>() == doctest::Approx(step).epsilon(1e-6));
}

TEST_CASE("diff: exit code 5 for what is not finite, named with its file, channel and pixel") {
  const Workplace here;
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  Frame frame = grey(4, 3);
  write_exr(here / "fine.exr", frame);
  frame.color[6].y = nan;
  frame.color[9].x = -inf;
  write_exr(here / "bad.exr", frame);
  frame.color[6].y = 1;
  frame.color[9].x = inf;  // 255 in 8 bits, and so is the code below
  write_exr(here / "bright.exr", frame);
  write_8bit(here / "bright.png", frame);

  const Arguments lenient{"--fail", "inf", "--failpercent", "100", "--allow", "1000"};
  for (const auto& [a, b] :
       {std::pair{"fine.exr", "bad.exr"}, {"bad.exr", "fine.exr"}, {"bad.exr", "bad.exr"}}) {
    const Outcome outcome =
        here.run(Arguments{"diff", a, b, "-q", "--json", "a.json", "-o", "d.png"} + lenient);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 5);
    CHECK(lines(outcome.err).size() == 1);
    CHECK(outcome.err.find("bad.exr: G at pixel (2, 1); 2 such pixels") != std::string::npos);
    const Json json = Json::parse(read_bytes(here / "a.json"));
    CHECK(json["non_finite"] == 2);
    CHECK(json["metrics"]["mean"] == 0);  // of the rest
    const ImageFile difference = read_image(here / "d.png");
    for (const std::size_t i : {std::size_t{6}, std::size_t{9}}) CHECK(difference.channels.at("B")[i] == 1);
    CHECK(difference.channels.at("B")[0] == 0);
  }
  CHECK(diff(here, "bright.png", "bright.exr", lenient) == 5);
  const std::string said = here.run({"diff", "fine.exr", "bad.exr"}).err;
  CAPTURE(said);
  CHECK(said.find("off by more than 0, 2 not finite\n  of what is finite: greatest 0 ") != std::string::npos);
  CHECK(said.find("inf\n") == std::string::npos);
}
