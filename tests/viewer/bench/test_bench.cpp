// SPDX-License-Identifier: MIT
// sidelight bench as its users meet it: bench.json with the names that others rely on, the same bytes without times, what
// is left after Ctrl-C.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

nlohmann::json read_json(const Workplace& here, const std::string& name) {
  return nlohmann::json::parse(read_bytes(here / name));
}

bool ordered(const nlohmann::json& spread) {
  return 0 <= spread["min"] && spread["min"] <= spread["median"] && spread["median"] <= spread["max"];
}

void check_error(const nlohmann::json& error) {
  for (const char* name : {"p999", "mean", "rmse", "relmse"}) CHECK(error[name] >= 0.0);
  CHECK((error["psnr"].is_null() || error["psnr"] > 0));
  CHECK(error["max"]["value"] >= error["p999"]);
  CHECK(error["rmse"] <= error["max"]["value"]);
}

}  // namespace

TEST_CASE("bench: bench.json has the names that others rely on") {
  const Workplace here;
  const Outcome outcome = here.run({"bench", "good.toml", "scenes/02-diffuse.toml", "-r", "24x18", "-o",
                                    "out", "-q", "--set", "samples=1,4"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.empty());
  const nlohmann::json result = read_json(here, "out/bench.json");
  CHECK_FALSE(result["interrupted"].get<bool>());
  CHECK(result["machine"].is_string());
  REQUIRE(result["scenes"].size() == 2);
  CHECK(result["scenes"][0]["path"] == "good.toml");
  CHECK((result["scenes"][0]["width"] == 24 && result["scenes"][0]["height"] == 18));
  CHECK(ordered(result["scenes"][0]["load_ms"]));
  REQUIRE(result["reference"].size() == 2);
  for (const nlohmann::json& reference : result["reference"]) {
    CHECK(reference["samples"] >= 16);  // twice as fine as samples=4
    CHECK(reference["finer"].get<bool>());
    CHECK(reference["remaining"] >= 0.0);
    CHECK(reference["against_brute_force"] < 1e-6);
  }
  REQUIRE(result["points"].size() == 8);  // two scenes, two renderers, two numbers of samples
  bool any_on_front = false;
  for (const nlohmann::json& point : result["points"]) {
    CHECK((point["scene"] == "good.toml" || point["scene"] == "scenes/02-diffuse.toml"));
    CHECK((point["config"]["renderer"] == "raytrace" || point["config"]["renderer"] == "raster"));
    CHECK(point["config"]["isa"].is_string());
    CHECK(point["finished"].get<bool>());
    CHECK(point["valid"].get<bool>());
    any_on_front = any_on_front || point["on_front"].get<bool>();
    CHECK(point["mismatches"] == 0);
    CHECK(point["runs"] == 7);
    CHECK(ordered(point["time_ms"]["build"]));
    CHECK(ordered(point["time_ms"]["frame"]));
    CHECK(ordered(point["cpu_ms"]["frame"]));
    check_error(point["error"]);
    check_error(point["error"]["covered"]);
    check_error(point["arithmetic"]);
    check_error(point["model"]);
    CHECK(point["sampling"]["rmse"] > 0.0);
    const bool traced = point["config"]["renderer"] == "raytrace";
    CHECK((point["rays"] > 0) == traced);
    CHECK((point["nodes_per_ray"] > 0) == traced);
    CHECK((point["fragments"] > 0) == !traced);
    CHECK(point["memory_mb"]["build"] >= 0.0);
    CHECK(point["memory_mb"]["frame"] >= 0.0);
    CHECK(point["left_out"].is_null());
  }
  CHECK(any_on_front);
  REQUIRE(result["summary"]["scenes"].size() == 2);
  CHECK(result["summary"]["scenes"][1]["standard"] == 4);
  CHECK(result["summary"]["over_scenes"]["configs"].size() == 4);
}

TEST_CASE("bench: without times equal runs give equal bytes, from the cache or not") {
  const Workplace here;
  const auto run = [&](const std::string& folder) {
    const Outcome outcome = here.run_in_shell(
        "XDG_CACHE_HOME=$PWD/cache exec \"$0\" \"$@\"",
        {"bench", "good.toml", "-r", "24x18", "-o", folder, "--no-times", "--sweep", "depth"});
    CHECK(outcome.code == 0);
    std::string all;
    for (const std::string& name : here.names(folder))
      all += name + '\n' + read_bytes(here / (folder + "/" + name));
    return all;
  };
  const std::string first = run("first");
  CHECK(std::filesystem::exists(here / "cache/sidelight"));
  CHECK(run("second") == first);
  std::filesystem::remove_all(here / "cache");
  CHECK(run("third") == first);
  const std::string text = read_bytes(here / "first/bench.json");
  const nlohmann::json result = nlohmann::json::parse(text);
  for (const nlohmann::json& point : result["points"]) {
    CHECK(point["finished"].get<bool>());
    CHECK(point["on_front"].is_null());
    CHECK_FALSE(point.contains("time_ms"));
  }
  CHECK(text.find("_ms") == std::string::npos);
}

TEST_CASE("bench: plots of an earlier run do not outlive it, and no plots are said where there are none") {
  const Workplace here;
  const Arguments small{"bench", "good.toml", "-r", "16x12", "-o", "out"};
  const auto said = [&](const Arguments& more) {
    const Outcome outcome = here.run(small + more);
    CHECK(outcome.code == 0);
    const std::vector<std::string> all = lines(outcome.err);
    return all.empty() ? std::string() : all.back();
  };
  const auto plots = [&] {
    const std::vector<std::string> names = here.names("out");
    return std::ranges::count_if(names, [](const std::string& name) { return name.ends_with(".svg"); });
  };
  CHECK(said({"--set", "samples=1,4"}).ends_with(fmt::format(" and {} plots", plots())));
  CHECK(plots() > 0);
  write_bytes(here / "out/other-total.svg", "of another scene");
  CHECK(said({"--set", "samples=1", "--no-times"}).ends_with(" and 0 plots, which want times"));
  CHECK(plots() == 1);
}

TEST_CASE("bench: interrupted, it keeps and marks what was finished") {
  const Workplace here;
  const auto interrupted_after = [&](int seconds) {
    Process process({SIDELIGHT_BINARY, "bench", "good.toml", "-r", "16x12", "--set", "samples=1,4", "--runs",
                     "100000", "-q", "-o", "out"},
                    here / ".");
    process.await_handler(SIGINT);
    std::this_thread::sleep_for(std::chrono::seconds(seconds));
    process.send(SIGINT);
    const Outcome outcome = process.wait();
    CHECK(outcome.code == 130);
    CHECK(lines(outcome.err).size() == 1);
    return read_json(here, "out/bench.json");
  };
  // In the middle of its 100,000 runs, however slow the machine: the reference image is there, and the errors.
  nlohmann::json result;
  for (int seconds = 3; seconds < 100; seconds *= 2) {
    result = interrupted_after(seconds);
    if (std::ranges::all_of(result["points"],
                            [](const nlohmann::json& point) { return point["finished"].get<bool>(); }))
      break;
  }
  CHECK(result["interrupted"].get<bool>());
  for (const nlohmann::json& point : result["points"]) {
    REQUIRE(point["finished"].get<bool>());
    CHECK(point["runs"] >= 1);
    CHECK(point["runs"] < 100000);
  }
}

TEST_CASE("bench: interrupted at once, it says so and has nothing to show") {
  const Workplace here;
  Process process({SIDELIGHT_BINARY, "bench", "good.toml", "-r", "2000x1500", "-q", "-o", "out"}, here / ".");
  process.await_handler(SIGTERM);
  process.send(SIGTERM);
  CHECK(process.wait().code == 130);
  const nlohmann::json result = read_json(here, "out/bench.json");
  CHECK(result["interrupted"].get<bool>());
  CHECK(result["reference"][0].is_null());
  for (const nlohmann::json& point : result["points"]) CHECK_FALSE(point["finished"].get<bool>());
}
