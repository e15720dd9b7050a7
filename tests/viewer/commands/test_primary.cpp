// SPDX-License-Identifier: MIT
// --primary raster: the tracer's eye rays are answered by the z-buffer, where that can serve.
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

using namespace sidelight;
using namespace sidelight::test;

TEST_CASE("output: surfaces found by the z-buffer give the same picture, which says so") {
  const Workplace here;
  REQUIRE(here.run(render_small({"-q", "-o", "rays.exr", "--layers", "depth,primitive,shadow"})).code == 0);
  const Outcome outcome =
      here.run(render_small({"-q", "-o", "raster.exr", "--layers", "depth,primitive,shadow", "--primary",
                             "raster", "--stats", "-"}));
  REQUIRE(outcome.code == 0);
  CHECK(here.run({"diff", "rays.exr", "raster.exr"}).code == 0);
  const auto json = nlohmann::ordered_json::parse(outcome.out);
  CHECK(json["renderer"] == "raytrace");
  CHECK(json["primary"] == "raster");
  CHECK(json["rays"]["primary"] == 0);
  CHECK(json["stages_ms"]["raster"].get<double>() + json["stages_ms"]["raytrace"].get<double>() <=
        json["frame_ms"]["max"]);

  const Outcome compared = here.run(compare_small("out", {"--primary", "raster"}));
  CHECK(compared.code == 0);
  CHECK(compared.err.find("took the z-buffer's surfaces") != std::string::npos);
  CHECK(nlohmann::ordered_json::parse(read_bytes(here / "out/compare.json"))["primary"] == "raster");
}

TEST_CASE("exit code 2: surfaces found by the z-buffer where they cannot serve") {
  const Workplace here;
  const auto refused = [&](const Arguments& more, const std::string& word) {
    const Outcome outcome = here.run(more + Arguments{"-q", "--primary", "raster"});
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(lines(outcome.err).size() == 1);
    CHECK(outcome.err.find(word) != std::string::npos);
    CHECK(here.made().empty());
  };
  refused(render_small({"-o", "a.png", "--renderer", "raster"}), "is for the renderer 'raytrace'");
  refused(render_small({"-o", "a.png", "--renderer", "raytrace-reference"}),
          "is for the renderer 'raytrace'");
  refused(render_small({"-o", "a.png", "--shadow-offset", "0.1"}), "no faults on purpose");
  refused(compare_small("out", {"--snap-bits", "2"}), "no faults on purpose");
  refused(render_small({"-o", "a.exr", "--layers", "cost"}), "with --primary raster does not make");
}
