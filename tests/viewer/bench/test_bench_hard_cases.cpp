// SPDX-License-Identifier: MIT
// The hard cases of a bench: exact settings pass them, and each fault on purpose fails the one that is made for it.
#include "viewer/bench/hard_cases.h"

#include <doctest/doctest.h>

#include "tests/support/text.h"

using namespace sidelight;
using test::contains;

namespace {

Setting renderer(bool raster) {
  Setting setting;
  setting.raster = raster;
  return setting;
}

}  // namespace

TEST_CASE("hard cases: exact settings show every surface right, whatever else is turned") {
  HardCases hard;
  for (const bool raster : {false, true}) {
    CAPTURE(raster);
    Setting setting = renderer(raster);
    CHECK(hard.failures(setting) == "");
    setting.isa = Isa::scalar;
    setting.threads = 1;
    setting.n = 2;
    setting.depth = 3;
    setting.cut = 0.1;
    CHECK(hard.failures(setting) == "");
  }
}

TEST_CASE("hard cases: each fault fails that which is made for it") {
  HardCases hard;
  const auto fails = [&](const Setting& setting, const std::string& name) {
    const std::string failures = hard.failures(setting);
    CAPTURE(failures);
    CHECK(failures.rfind("hard cases: ", 0) == 0);
    CHECK(contains(failures, name + " "));
  };
  for (const bool raster : {false, true}) {
    Setting setting = renderer(raster);
    setting.faults.float_precision = true;
    fails(setting, "far from the origin");
    setting = renderer(raster);
    setting.faults.tessellate = 64;
    fails(setting, "balls in balls");
  }
  Setting setting = renderer(true);
  for (const int bits : {0, 4, 8}) {
    setting.faults.snap_bits = bits;
    fails(setting, "needles");
  }
  setting.faults.snap_bits = {};
  for (const DepthFormat format : {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::float32}) {
    setting.faults.depth_format = format;
    fails(setting, "layers a hair apart");
  }
  // A reversed float has 24 bits at every distance: the gaps are five of its steps, or more.
  setting.faults.depth_format = DepthFormat::reversed;
  CHECK_FALSE(contains(hard.failures(setting), "layers a hair apart"));
}
