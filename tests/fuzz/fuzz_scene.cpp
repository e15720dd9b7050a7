// SPDX-License-Identifier: MIT
// Scene files. Mesh files that they name are looked for in a folder that is not there.
#include "common/scene/toml.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  sidelight::fuzz::read_or_refuse("/nowhere/", [&] { sidelight::parse_scene(text, "/nowhere/scene.toml"); });
  return 0;
}
