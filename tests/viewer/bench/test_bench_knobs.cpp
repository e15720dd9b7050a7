// SPDX-License-Identifier: MIT
// The table of knobs: every value it lists is one, sweeps and products are what they say, mistakes are named.
#include <algorithm>
#include <set>

#include "common/error.h"
#include "tests/support/program.h"
#include "viewer/bench/knobs.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

std::string value_of(const Config& config, std::string_view knob) {
  for (const KnobValue& each : config)
    if (each.knob == knob) return each.value;
  return "?";
}

std::string refusal(const std::vector<std::string>& texts) {
  try {
    product_configs(texts);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}
bool refused(const std::vector<std::string>& texts, const std::string& word) {
  const std::string message = refusal(texts);
  CAPTURE(message);
  CHECK(message.find(word) != std::string::npos);
  return message != "accepted";
}

}  // namespace

TEST_CASE("knobs: the standard value of each is one and changes nothing") {
  const Setting nothing;
  for (const Knob& knob : knobs()) {
    CAPTURE(knob.name);
    Setting setting;
    CHECK(knob.set(setting, std::string(knob.standard)));
    CHECK(setting.raster == nothing.raster);
    CHECK(setting.from_raster == nothing.from_raster);
    CHECK(setting.n == nothing.n);
    CHECK(setting.faults == nothing.faults);
    CHECK_FALSE(knob.set(setting, "nonsense"));
    CHECK_FALSE(knob.set(setting, ""));
    CHECK((knob.raster || knob.raytrace));
  }
}

TEST_CASE("knobs: every sweep begins with the two standard settings and turns one knob at a time") {
  for (const std::string& name : sweep_names()) {
    CAPTURE(name);
    const std::vector<Config> configs = sweep_configs(name);
    REQUIRE(configs.size() >= 2);
    CHECK(value_of(configs[0], "renderer") == "raytrace");
    CHECK(value_of(configs[1], "renderer") == "raster");
    std::set<std::string> seen;
    for (std::size_t i = 0; i < configs.size(); ++i) {
      const std::string varied = varied_knobs(configs[i]);
      CHECK(varied.empty() == (i < 2));
      CHECK(varied.find(',') == std::string::npos);
      if (i >= 2 && name != "default") CHECK(varied == name);
      std::string all;
      for (const KnobValue& each : configs[i]) all += each.value + ' ';
      CHECK(seen.insert(all).second);
    }
  }
  CHECK_THROWS_AS(sweep_configs("dpeth"), UsageError);
}

TEST_CASE("knobs: a knob that the renderer lacks stays out of its settings") {
  for (const Config& config : sweep_configs("default")) {
    const bool raster = value_of(config, "renderer") == "raster";
    CHECK((value_of(config, "depth") == kNotThere) == raster);
    CHECK((value_of(config, "snap-bits") == kNotThere) == !raster);
  }
}

TEST_CASE("knobs: --set makes products, each once, after the standard setting") {
  const std::vector<Config> configs = product_configs({"samples=1,4", "depth=2,3"});
  // The standard, four products of the tracer; the z-buffer has no depth, so two.
  REQUIRE(configs.size() == 7);
  CHECK(varied_knobs(configs[0]) == "");
  CHECK(varied_knobs(configs[1]) == "depth");
  CHECK(varied_knobs(configs[3]) == "samples, depth");
  const Setting setting = setting_of(configs[4]);
  CHECK((setting.n == 2 && setting.depth == 3 && !setting.raster));
  CHECK(std::count_if(configs.begin(), configs.end(),
                      [](const Config& each) { return value_of(each, "renderer") == "raster"; }) == 2);
  CHECK(product_configs({"renderer=raytrace", "cut=0.1,0.1"}).size() == 2);
}

TEST_CASE("knobs: mistakes of --set are named") {
  CHECK(refused({"samples"}, "knob=value"));
  CHECK(refused({"samples="}, "knob=value"));
  CHECK(refused({"smaples=1"}, "'samples'"));  // the nearest
  CHECK(refused({"samples=5"}, "a square number"));
  CHECK(refused({"samples=1,,4"}, "''"));
  CHECK(refused({"depth=0"}, "1 to 1000"));
  CHECK(refused({"cut=nan"}, "0 to 1"));
  CHECK(refused({"tessellation=5"}, "even"));
  CHECK(refused({"depth-format=unorm8"}, "unorm16"));
  CHECK(refused({"isa=avx9"}, "avx2"));
  CHECK(refused({"depth=1", "depth=2"}, "twice"));
  CHECK(refused({"renderer=raster", "renderer=raytrace"}, "twice"));
  CHECK(refused({"renderer=raster", "depth=1"}, "raster has no such knob"));
  CHECK(refused({"primary=raster", "precision=exact,float"}, "exact surfaces"));
  CHECK(refused({"renderer=raster", "primary=raster"}, "raster has no such knob"));
  std::string many = "cut=0";
  for (int i = 1; i < 600; ++i) many += ",0." + std::to_string(i);
  CHECK(refused({many}, "more than 500"));
}

TEST_CASE("bench: wrong usage is exit code 2 with one line, bad scenes 3, and leaves nothing") {
  const Workplace here;
  const auto check = [&](const Arguments& more, int code, const std::string& word) {
    const Outcome outcome = here.run(Arguments{"bench"} + more + Arguments{"-o", "out", "-r", "16x12"});
    CAPTURE(outcome.err);
    CHECK(outcome.code == code);
    CHECK(outcome.out.empty());
    CHECK(lines(outcome.err).size() == 1);
    CHECK(outcome.err.find(word) != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(here / "out/bench.json"));
  };
  check({}, 2, "SCENE");
  check({"good.toml", "--sweep", "everything"}, 2, "everything");
  check({"good.toml", "--set", "samples=2"}, 2, "square");
  check({"good.toml", "--set", "samples=4", "--sweep", "depth"}, 2, "exclude");
  check({"good.toml", "--runs", "6"}, 2, "runs");
  check({"good.toml", "no_such.toml"}, 3, "no_such.toml");
}
