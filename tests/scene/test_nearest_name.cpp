// SPDX-License-Identifier: MIT
#include "common/scene/nearest_name.h"

#include <doctest/doctest.h>

using namespace sidelight;

TEST_CASE("nearest_name: fewest edits, first of equals") {
  const std::vector<std::string_view> names{"glass", "glaze", "gold", ""};
  CHECK(nearest_name("glas", names) == "glass");
  CHECK(nearest_name("glase", names) == "glass");
  CHECK(nearest_name("golden", names) == "gold");
  CHECK(nearest_name("go", names) == "gold");  // glass is two away, but this is cut short
  CHECK(nearest_name("cyl", std::vector<std::string_view>{"box", "cylinder"}) == "cylinder");
  CHECK(nearest_name("c", std::vector<std::string_view>{"box", "cylinder"}) ==
        "box");  // one letter is no name
  CHECK(nearest_name("", names) == "");
  CHECK(nearest_name("x", {}) == "");
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("nearest_name: a name is near that a slip of the fingers may have meant, and no other") {
  const std::vector<std::string_view> names{"camera", "torus", "ior", "m", "vertical_fov"};
  CHECK(near_name("tours", names) == "torus");
  CHECK(near_name("cam", names) == "camera");
  CHECK(near_name("lens", std::vector<std::string_view>{"less"}) == "less");
  CHECK(near_name("n", names) == "m");
  CHECK(near_name("cube", names) == "");  // four edits from "camera"
  CHECK(near_name("color", names) == "");
  CHECK(near_name("", names) == "");
  CHECK(near_name("x", {}) == "");
  CHECK(near_name(std::string(1000, 'q'), names) == "");
  CHECK(did_you_mean("cam", names) == "; did you mean 'camera'?");
  CHECK(did_you_mean("cam", names, "--") == "; did you mean '--camera'?");
  CHECK(did_you_mean("cube", names) == "");
}
