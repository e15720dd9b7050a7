// SPDX-License-Identifier: MIT
// "Is my renderer right?": diff with a picture and a scene. Our own picture passes; one that lacks a term fails
// and the term is named, pixel by pixel, with a command that shows it.
#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "common/picture/image_io.h"
#include "tests/support/program.h"

using namespace sidelight;
using namespace sidelight::test;
using Json = nlohmann::json;

namespace {

const Arguments kTiny{"-r", "40x30", "-q"};

// Makes theirs.exr (or another) by one of our renderers.
void render(const Workplace& here, const std::string& scene, const Arguments& more,
            const std::string& file = "theirs.exr") {
  REQUIRE(here.run(Arguments{"render", scene, "-o", file} + kTiny + more).code == 0);
}

Json account(const Workplace& here, const std::string& scene, const Arguments& more = {},
             const std::string& file = "theirs.exr") {
  const Outcome outcome = here.run(Arguments{"diff", file, scene, "--json", "-"} + more);
  CAPTURE(outcome.err);
  REQUIRE_FALSE(outcome.out.empty());
  return Json::parse(outcome.out);
}

}  // namespace

TEST_CASE("diff with a scene: our own pictures pass, at their size, samples and part") {
  const Workplace here;
  for (const Arguments& how : {Arguments{}, {"--spp", "4"}, {"--depth", "2"}, {"--no-shadows"}}) {
    for (const char* file : {"theirs.exr", "theirs.png"}) {
      render(here, "good.toml", how, file);
      CHECK(here.run(Arguments{"diff", file, "good.toml"} + how).code == 0);
    }
    render(here, "good.toml", how + Arguments{"--renderer", "raster"});
    CHECK(here.run(Arguments{"diff", "theirs.exr", "good.toml", "--renderer", "raster"} + how).code == 0);
  }
  render(here, "good.toml", {"--crop", "10,8,31,27"});
  CHECK(here.run({"diff", "theirs.exr", "good.toml"}).code == 0);
}

TEST_CASE("diff with a scene: a term that is missing is named") {
  const Workplace here;
  for (const char* term : {"shadow", "reflection", "refraction"}) {
    CAPTURE(term);
    const std::string off = "--no-" + std::string(term) + (term == std::string("shadow") ? "s" : "");
    for (const char* file : {"theirs.exr", "theirs.png"}) {
      render(here, "good.toml", {off}, file);
      CHECK(here.run({"diff", file, "good.toml", "-q"}).code == 1);
      const Json json = account(here, "good.toml", {}, file);
      REQUIRE_FALSE(json["reasons"].empty());
      CHECK(json["reasons"][0]["equals"] == "ours without the " + std::string(term));
      // Every pixel that is over has one reason or none.
      std::uint64_t counted = json["without_reason"];
      for (const Json& reason : json["reasons"]) counted += reason["pixels"].get<std::uint64_t>();
      CHECK(counted == json["over"]);
    }
  }
}

TEST_CASE("diff with a scene: only shadows are missing in a scene of shadows, and every pixel says so") {
  const Workplace here;
  render(here, "scenes/06-shadows.toml", {"--no-shadows"});
  const Json json = account(here, "scenes/06-shadows.toml");
  CHECK(json["nearer"] == "raster");  // without shadows this scene has nothing that a z-buffer does not know
  CHECK(json["rms"]["raster"] == 0);
  CHECK(json["without_reason"] == 0);
  CHECK(json["reasons"] == Json::array({{{"equals", "ours without the shadow"}, {"pixels", json["over"]}}}));
  CHECK(here.run({"diff", "theirs.exr", "scenes/06-shadows.toml", "--renderer", "raster"}).code == 0);

  // The other way round: a picture with shadows against our z-buffer's, which knows none.
  render(here, "scenes/06-shadows.toml", {});
  const Json added = account(here, "scenes/06-shadows.toml", {"--renderer", "raster"});
  CHECK(added["nearer"] == "raytrace");
  CHECK(added["reasons"][0]["equals"] == "ours with the shadow");
  CHECK(added["reasons"][0]["pixels"] == added["over"]);
}

TEST_CASE("diff with a scene: the worst pixels stand apart, with both colours and the object") {
  const Workplace here;
  // Behind the triangles of a box no object has the number of its primitive.
  const std::string scene = "[[mesh]]\nshape = 'box'\nsize = [1, 1, 1]\nmaterial = 'red'\n" + kGoodScene;
  write_bytes(here / "box.toml", scene);
  render(here, "box.toml", {"--no-shadows"});
  render(here, "box.toml", {"--layers", "all"}, "ours.exr");
  const Json json = account(here, "box.toml");
  const Json& worst = json["worst"];
  REQUIRE(worst.size() == 5);
  CHECK(worst[0]["off"] == json["metrics"]["max"]["value"]);
  CHECK(worst[0]["x"] == json["metrics"]["max"]["x"]);
  CHECK(worst[0]["y"] == json["metrics"]["max"]["y"]);
  const ImageFile theirs = read_image(here / "theirs.exr"), ours = read_image(here / "ours.exr");
  for (std::size_t i = 0; i < worst.size(); ++i) {
    const int x = worst[i]["x"], y = worst[i]["y"];
    const auto at = static_cast<std::size_t>(y * 40 + x);
    CHECK(worst[i]["picture"][0] == theirs.channels.at("R")[at]);
    CHECK(worst[i]["object"] == ours.ids.at("object.id")[at] - 1);
    CHECK(worst[i]["primitive"] == ours.ids.at("primitive.id")[at] - 1);
    for (const std::string term : {"shadow", "reflection", "refraction"})
      CHECK(worst[i][term][0] == ours.channels.at(term + ".R")[at]);
    CHECK(worst[i]["material"].is_string());
    CHECK(lines(scene).at(worst[i]["line"].get<std::size_t>() - 1).starts_with("[["));
    if (i == 0) continue;
    CHECK(worst[i]["off"].get<double>() <= worst[i - 1]["off"].get<double>());
    const int dx = x - worst[0]["x"].get<int>(), dy = y - worst[0]["y"].get<int>();
    CHECK(std::max(std::abs(dx), std::abs(dy)) >= 2);
  }
}

TEST_CASE("diff with a scene: says in words what it says to programs") {
  const Workplace here;
  render(here, "good.toml", {"--no-shadows", "--no-refraction"});
  const Outcome outcome = here.run({"diff", "theirs.exr", "good.toml", "--json", "a.json"});
  CAPTURE(outcome.err);
  const Json json = Json::parse(read_bytes(here / "a.json"));
  const auto said = [&](const std::string& words) { return outcome.err.find(words) != std::string::npos; };
  const double one = json["rms"]["raster"], other = json["rms"]["raytrace"];
  CHECK(said(fmt::format("(rms {:.3g}; the other {:.3g})\n", std::min(one, other), std::max(one, other))));
  REQUIRE(json["reasons"].size() > 1);
  for (const Json& reason : json["reasons"])
    CHECK(said(fmt::format("\n  {} pixels equal {}\n", reason["pixels"].get<int>(),
                           reason["equals"].get<std::string>())));
  REQUIRE(json["without_reason"] > 0);
  CHECK(said(fmt::format("\n  {} pixels equal no sum", json["without_reason"].get<int>())));
  const auto triple = [](const Json& v) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", v[0].get<float>(), v[1].get<float>(), v[2].get<float>());
  };
  for (const Json& worst : json["worst"]) {
    const Json& equals = worst["equals"];
    CHECK(said(fmt::format("\n  {},{}: theirs {}, ours {}{}\n", worst["x"].get<int>(), worst["y"].get<int>(),
                           triple(worst["picture"]), triple(worst["ours"]),
                           equals.is_null() ? "" : "; theirs equals " + equals.get<std::string>())));
    for (const std::string term : {"shadow", "reflection", "refraction"})
      CHECK((worst[term] == Json{0, 0, 0} || said(term + " " + triple(worst[term]))));
  }
}

TEST_CASE("diff with a scene: how far a worst pixel is off is the distance of the colours beside it") {
  const Workplace here;
  for (const char* file : {"theirs.exr", "theirs.png"}) {
    CAPTURE(file);
    render(here, "good.toml", {"--no-shadows"}, file);
    const Json worst = account(here, "good.toml", {}, file)["worst"];
    REQUIRE(worst.size() == 5);
    for (const Json& pixel : worst) {
      double off = 0;
      for (std::size_t c = 0; c < 3; ++c)
        off = std::max(off, std::abs(pixel["picture"][c].get<double>() - pixel["ours"][c].get<double>()));
      CHECK(off == doctest::Approx(pixel["off"].get<double>()).epsilon(1e-6));
    }
  }
}

// A scene's name that a shell would take apart.
TEST_CASE("diff with a scene: the line to type runs, and explains the colour that diff calls ours") {
  const Workplace here;
  std::filesystem::rename(here / "good.toml", here / "Ann's scene.toml");
  render(here, "Ann's scene.toml", {"--no-shadows", "--spp", "4", "--depth", "3"});
  const Json json = account(here, "Ann's scene.toml", {"--spp", "4", "--depth", "3", "--no-refraction"});
  const Json& worst = json["worst"][0];
  const std::string line = worst["explain"];
  REQUIRE(line.rfind("sidelight explain ", 0) == 0);
  const Outcome outcome = here.run_in_shell("sidelight() { \"$0\" \"$@\"; }; " + line + " --json -", {});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const Json explained = Json::parse(outcome.out);
  CHECK(explained["pixel"] == Json::array({worst["x"], worst["y"]}));
  CHECK(explained["color"]["raytrace"] == worst["ours"]);
}

TEST_CASE("diff with a scene: a colour that no sum of terms gives stays without a reason") {
  const Workplace here;
  const Frame blank = make_frame(40, 30, 1, {});
  Frame theirs = blank;
  theirs.color.assign(theirs.pixels(), glm::vec3(7, 11, 13));
  write_exr(here / "theirs.exr", theirs);
  Json json = account(here, "good.toml");
  CHECK(json["over"] == 40 * 30);
  CHECK(json["without_reason"] == 40 * 30);
  CHECK(json["reasons"].empty());
  CHECK(json["worst"][0]["equals"].is_null());

  theirs.color[41].x = std::numeric_limits<float>::quiet_NaN();
  write_exr(here / "theirs.exr", theirs);
  json = account(here, "good.toml", {"--fail", "inf"});
  CHECK(json["non_finite"] == 1);
  CHECK(json["without_reason"] == 1);
  CHECK(json["worst"][0]["x"] == 1);
  CHECK(json["worst"][0]["off"].is_null());
  CHECK(here.run({"diff", "theirs.exr", "good.toml"}).code == 5);
}

TEST_CASE("diff with a scene: one step of 8 bits is near, and so is what --fail lets pass") {
  const Workplace here;
  const auto shift = [&](const std::string& file, const std::string& by) {
    REQUIRE(here.command({"oiiotool", file, "--addc", by, "-o", file}).code == 0);
  };
  render(here, "good.toml", {}, "theirs.png");
  shift("theirs.png", "0.00392157");
  Json json = account(here, "good.toml", {}, "theirs.png");
  CHECK(json["over"] == 40 * 30);
  CHECK(json["reasons"] ==
        Json::array({{{"equals", "ours within one 8-bit step"}, {"pixels", json["over"]}}}));

  render(here, "scenes/06-shadows.toml", {"--no-shadows"});
  shift("theirs.exr", "0.005");
  json = account(here, "scenes/06-shadows.toml", {"--fail", "0.01"});
  CHECK(json["over"].get<int>() > 0);
  CHECK(json["reasons"] == Json::array({{{"equals", "ours without the shadow"}, {"pixels", json["over"]}}}));
}

TEST_CASE("diff with a scene: 16-bit floats are near, and alpha is left out") {
  const Workplace here;
  render(here, "good.toml", {});
  REQUIRE(here.command({"oiiotool", "theirs.exr", "-d", "half", "-o", "half.exr"}).code == 0);
  const Json json = account(here, "good.toml", {}, "half.exr");
  CHECK(json["over"].get<int>() > 0);
  CHECK(json["reasons"] == Json::array({{{"equals", "ours within a thousandth"}, {"pixels", json["over"]}}}));
  CHECK(here.run({"diff", "half.exr", "good.toml", "--fail", "0.001"}).code == 0);
  // Of bright colours it is the thousandth part.
  write_bytes(here / "bright.toml", "background = 30.01\n" + kGoodScene);
  render(here, "bright.toml", {});
  REQUIRE(here.command({"oiiotool", "theirs.exr", "-d", "half", "-o", "half.exr"}).code == 0);
  CHECK(account(here, "bright.toml", {}, "half.exr")["without_reason"] == 0);

  render(here, "good.toml", {}, "theirs.png");
  REQUIRE(here.command({"oiiotool", "theirs.png", "--ch", "R,G,B,A=1", "-o", "alpha.png"}).code == 0);
  CHECK(here.run({"diff", "alpha.png", "good.toml"}).code == 0);
}
