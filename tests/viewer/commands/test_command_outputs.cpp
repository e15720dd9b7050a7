// SPDX-License-Identifier: MIT
// What the verbs write: files whole or not at all, data on standard output only when asked for, the documented keys,
// and help that is true.
#include <nlohmann/json.hpp>

#include "common/math/isa.h"
#include "common/picture/image_io.h"
#include "tests/support/program.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

const std::vector<std::string> kCompareFiles{"causes.png",   "compare.json", "difference.png",
                                             "raster.exr",   "raster.png",   "raytrace.exr",
                                             "raytrace.png", "report.html",  "side_by_side.png"};

// The keys of an object and of those in it, as "rays.shadow", in the order of the file.
std::vector<std::string> keys(const nlohmann::ordered_json& json, const std::string& prefix = "") {
  std::vector<std::string> out;
  for (const auto& [key, value] : json.items()) {
    if (!value.is_object() || value.empty())
      out.push_back(prefix + key);
    else
      for (const std::string& inner : keys(value, prefix + key + ".")) out.push_back(inner);
  }
  return out;
}

void check_not_written(const Outcome& outcome) {
  CAPTURE(outcome.err);
  CHECK(outcome.code == 7);
  CHECK(lines(outcome.err).size() == 1);
}

}  // namespace

TEST_CASE("exit code 7: a file where the folder should be") {
  const Workplace here;
  write_bytes(here / "out", "a plain file");
  check_not_written(here.run(compare_small("out", {"-q"})));
  check_not_written(here.run(compare_small("out/deeper", {"-q"})));
  check_not_written(here.run(render_small({"-q", "-o", "out/a.png"})));
  CHECK(read_bytes(here / "out") == "a plain file");
}

TEST_CASE("exit code 7: a folder that is missing or takes the file's name") {
  const Workplace here;
  check_not_written(here.run(render_small({"-q", "-o", "missing/a.exr"})));
  check_not_written(here.run(render_small({"-q", "-o", "a.png", "--stats", "missing/a.json"})));
  CHECK(here.made() == std::vector<std::string>{"a.png"});  // the picture was finished before
  std::filesystem::create_directory(here / "b.exr");
  check_not_written(here.run(render_small({"-q", "-o", "b.exr"})));
  CHECK(here.names("b.exr").empty());
}

TEST_CASE("exit code 7: a full disk") {
  const Workplace here;
  check_not_written(here.run(render_small({"-q", "-o", "a.png", "--stats", "/dev/full"})));
  std::filesystem::create_symlink("/dev/full", here / "full.png");
  check_not_written(here.run(render_small({"-q", "-o", "full.png"})));
  check_not_written(here.run_in_shell("exec \"$0\" \"$@\" > /dev/full",
                                      render_small({"-q", "-o", "a.png", "--stats", "-"})));
  check_not_written(here.run_in_shell("exec \"$0\" \"$@\" > /dev/full", Arguments{"info"} + kSmall));
}

TEST_CASE("exit code 7: a limit on the size of files leaves finished files only") {
#ifdef __SANITIZE_THREAD__
  return test::skip_test("ThreadSanitizer maps a file of its own, which the limit breaks");
#else
  const Workplace here;
  // One block of 512 bytes: no picture fits. 8: some do, and those are whole.
  check_not_written(
      here.run_in_shell("ulimit -f 1; exec \"$0\" \"$@\"", render_small({"-q", "-o", "a.exr"})));
  CHECK(here.made().empty());

  REQUIRE(here.run(compare_small("whole", {"-q", "--no-times"})).code == 0);
  check_not_written(
      here.run_in_shell("ulimit -f 8; exec \"$0\" \"$@\"", compare_small("part", {"-q", "--no-times"})));
  for (const std::string& name : here.names("part")) {
    CAPTURE(name);
    CHECK(read_bytes(here / ("part/" + name)) == read_bytes(here / ("whole/" + name)));
  }

  write_bytes(here / "old.exr", "an older picture");
  check_not_written(
      here.run_in_shell("ulimit -f 1; exec \"$0\" \"$@\"", render_small({"-q", "-o", "old.exr"})));
  CHECK(read_bytes(here / "old.exr") == "an older picture");
#endif
}

TEST_CASE("exit code 7: a driver without OpenGL 3.3") {
#ifdef SIDELIGHT_HAVE_OSMESA
  const Workplace here;
  const Outcome outcome = here.run_in_shell("MESA_GL_VERSION_OVERRIDE=2.1 exec \"$0\" \"$@\"",
                                            Arguments{"view"} + kSmall + Arguments{"--screenshot", "a.png"});
  check_not_written(outcome);
  CHECK(outcome.err.find("OpenGL 3.3") != std::string::npos);
  CHECK(here.made().empty());
#else
  return test::skip_test("this build does not draw off screen");
#endif
}

TEST_CASE("output: nothing on standard output unasked and nothing at all with -q") {
  const Workplace here;
  CHECK(here.run(render_small({"-o", "a.png"})).out.empty());
  CHECK(here.run(compare_small("out")).out.empty());
  for (const Arguments& quiet : {render_small({"-o", "a.png", "-q"}), compare_small("out", {"-q"})}) {
    const Outcome outcome = here.run(quiet);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
  }
}

TEST_CASE("output: SIDELIGHT_ISA names a narrower instruction set, --isa has the last word") {
  const Workplace here;
  const auto isa = [&](const std::string& named, const Arguments& more = {}) {
    const Arguments asked = render_small({"-q", "-o", "a.png", "--stats", "-"}) + more;
    const Outcome outcome =
        here.command(Arguments{"env", "SIDELIGHT_ISA=" + named, SIDELIGHT_BINARY} + asked);
    REQUIRE(outcome.code == 0);
    return nlohmann::json::parse(outcome.out).at("isa").get<std::string>();
  };
  CHECK(isa("scalar") == "scalar");
  CHECK(isa("avx999") == isa(""));
  if (machine_has(Isa::avx2)) CHECK(isa("scalar", {"--isa", "avx2"}) == "avx2");
}

TEST_CASE("output: the statistics have the documented keys") {
  const Workplace here;
  const Outcome outcome =
      here.run(render_small({"-o", "a.png", "--spp", "4", "--repeat", "2", "--stats", "-"}));
  REQUIRE(outcome.code == 0);
  const auto json = nlohmann::ordered_json::parse(outcome.out);
  CHECK(keys(json) == std::vector<std::string>{"renderer",        "primary",
                                               "scene",           "scene_hash",
                                               "version",         "width",
                                               "height",          "spp",
                                               "threads",         "isa",
                                               "triangles",       "spheres",
                                               "planes",          "load_ms",
                                               "build_ms",        "frame_ms.min",
                                               "frame_ms.median", "frame_ms.max",
                                               "frame_ms.runs",   "cpu_ms.min",
                                               "cpu_ms.median",   "cpu_ms.max",
                                               "rays.primary",    "rays.shadow",
                                               "rays.reflection", "rays.refraction",
                                               "tests",           "exact.filtered",
                                               "exact.double",    "exact.exact",
                                               "self_shadowed",   "cut_weight",
                                               "peak_memory_mb"});
  CHECK(json["renderer"] == "raytrace");
  CHECK(json["primary"] == "rays");
  CHECK(json["width"] == 16);
  CHECK(json["height"] == 12);
  CHECK(json["spp"] == 4);
  CHECK(json["spheres"] == 2);
  CHECK(json["planes"] == 1);
  CHECK(json["frame_ms"]["runs"] == 2);
  CHECK(json["rays"]["primary"] == 16 * 12 * 4);
  CHECK(json["tests"] > 16 * 12 * 4);  // each of them asks at least the plane
  CHECK(json["cut_weight"] > 0);

  write_bytes(here / "good.toml", "trace.contribution_cut = 0\n" + kGoodScene);
  const Outcome cut =
      here.run(render_small({"-o", "a.png", "--no-reflection", "--depth", "3", "--stats", "-"}));
  REQUIRE(cut.code == 0);
  const auto some = nlohmann::json::parse(cut.out);
  CHECK(some["rays"]["reflection"] == 0);
  CHECK(some["rays"]["refraction"] > 0);
  CHECK(some["cut_weight"] == 0);

  // Of a part, counts and times are the part's.
  const Outcome cropped = here.run(render_small({"-o", "a.png", "--crop", "4,2,16,12", "--stats", "-"}));
  REQUIRE(cropped.code == 0);
  const auto part = nlohmann::json::parse(cropped.out);
  CHECK(part.at("crop") == nlohmann::json::array({4, 2, 16, 12}));
  CHECK(part["width"] == 16);
  CHECK(part["rays"]["primary"] == 12 * 10);
}

TEST_CASE("output: the z-buffer's statistics tell where its time goes") {
  const Workplace here;
  const Outcome outcome =
      here.run(render_small({"-o", "a.png", "--renderer", "raster", "-j", "1", "--stats", "-"}));
  REQUIRE(outcome.code == 0);
  const auto json = nlohmann::ordered_json::parse(outcome.out);
  std::vector<std::string> stages;
  double sum = 0;
  for (const auto& [stage, ms] : json["stages_ms"].items()) {
    stages.push_back(stage);
    CHECK(ms >= 0);
    sum += ms.get<double>();
  }
  CHECK(stages == std::vector<std::string>{"project", "set_up", "draw", "shade"});
  CHECK(sum > 0);
  CHECK(sum <= json["frame_ms"]["max"]);
}

TEST_CASE("output: compare writes its nine files and the documented keys") {
  const Workplace here;
  REQUIRE(here.run(compare_small("out")).code == 0);
  CHECK(here.names("out") == kCompareFiles);
  const std::string text = read_bytes(here / "out/compare.json");
  const auto json = nlohmann::ordered_json::parse(text);
  CHECK(keys(json) == std::vector<std::string>{"width",
                                               "height",
                                               "primary",
                                               "covered",
                                               "visibility_mismatches",
                                               "unexplained",
                                               "ledger_max_residual",
                                               "causes.shadow.pixels",
                                               "causes.shadow.energy",
                                               "causes.reflection.pixels",
                                               "causes.reflection.energy",
                                               "causes.refraction.pixels",
                                               "causes.refraction.energy",
                                               "metrics.max.value",
                                               "metrics.max.x",
                                               "metrics.max.y",
                                               "metrics.max.channel",
                                               "metrics.mean",
                                               "metrics.rms",
                                               "metrics.psnr",
                                               "time_ms.raster.build",
                                               "time_ms.raster.frame",
                                               "time_ms.raytrace.build",
                                               "time_ms.raytrace.frame",
                                               "faults"});
  CHECK(json["faults"] == nlohmann::ordered_json::object());
  CHECK(read_image(here / "out/raster.exr").metadata.at("renderer") == "raster");
  CHECK(read_image(here / "out/raytrace.exr").metadata.at("renderer") == "raytrace");

  REQUIRE(here.run(compare_small("local", {"--local"})).code == 0);
  const auto equal = nlohmann::ordered_json::parse(read_bytes(here / "local/compare.json"));
  CHECK(equal["metrics"]["psnr"].is_null());  // identical
  CHECK(equal["metrics"]["max"]["value"] == 0);
  CHECK(read_bytes(here / "local/report.html").find(" --local --pixel ") != std::string::npos);

  REQUIRE(here.run(compare_small("part", {"--crop", "4,2,16,12"})).code == 0);
  const auto part = nlohmann::ordered_json::parse(read_bytes(here / "part/compare.json"));
  CHECK(part.at("crop") == nlohmann::ordered_json::array({4, 2, 16, 12}));

  // A scene without a title has its path for one.
  write_bytes(here / "titled.toml", "title = 'good.toml'\n" + kGoodScene);
  for (const std::string scene : {"good", "titled"})
    REQUIRE(here.run({"compare", scene + ".toml", "-r", "16x12", "-q", "--no-times", "-o", scene}).code == 0);
  CHECK(colors(read_image(here / "good/side_by_side.png")) ==
        colors(read_image(here / "titled/side_by_side.png")));
}

TEST_CASE("output: without times two runs write the same bytes") {
  const Workplace here;
  REQUIRE(here.run(compare_small("first", {"--no-times", "-j", "1"})).code == 0);
  REQUIRE(here.run(compare_small("second", {"--no-times", "-j", "2"})).code == 0);
  CHECK(here.names("second") == kCompareFiles);
  for (const std::string& name : kCompareFiles) {
    CAPTURE(name);
    CHECK(read_bytes(here / ("first/" + name)) == read_bytes(here / ("second/" + name)));
  }
}

TEST_CASE("help: fits a screen for every verb and its examples run") {
  const Workplace here;
  for (const char* verb : {"view", "compare", "render", "diff", "explain", "bench", "info", "convert"}) {
    CAPTURE(verb);
    const Outcome help = here.run({verb, "--help"});
    CHECK(help.code == 0);
    CHECK(help.err.empty());
    const std::vector<std::string> shown = lines(help.out);
    CHECK(shown.size() <= 40);
    for (const std::string& line : shown) CHECK(line.size() <= 110);
    REQUIRE(shown.size() > 3);
    CHECK(shown[shown.size() - 3] == "Examples:");  // and two of them, the last thing one reads
    int examples = 0;
    for (const std::string& line : shown) {
      if (line.rfind("  sidelight ", 0) != 0) continue;
      ++examples;
      CAPTURE(line);
      // The line as a user types it, but in little, and without a display.
      std::istringstream words(line.substr(sizeof("  sidelight")));
      Arguments command{std::istream_iterator<std::string>(words), {}};
      const bool has_size =
          command[0] == "explain" || command[0] == "diff";  // of the pixel or picture it names
      if (line.find(" -r ") == std::string::npos && !has_size) command = command + Arguments{"-r", "64x48"};
      const Outcome outcome = here.run(command);
      CAPTURE(outcome.err);
      const bool wants_window = command[0] == "view" && line.find("--screenshot") == std::string::npos;
      CHECK(outcome.code == (wants_window ? 6 : 0));
      REQUIRE(command.size() > 1);
      CHECK(std::filesystem::exists(here / command[1]));
    }
    CHECK(examples == 2);
  }
}
