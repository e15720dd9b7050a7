// SPDX-License-Identifier: MIT
// An OBJ file and, after the first NUL byte, the MTL file that it may name (m.mtl), as parts of a scene: reading,
// triangulation, normals, closed or not.
#include <algorithm>

#include "common/scene/toml.h"
#include "tests/fuzz/fuzz.h"
#include "tests/picture/folder.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sidelight::test::TemporaryFolder folder;
  static const std::string scene =
      "[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nvertical_fov = 40\n[[mesh]]\nfile = 'm.obj'\n";
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(text.find('\0'), text.size());
  sidelight::test::write_bytes(folder / "m.obj", text.substr(0, end));
  sidelight::test::write_bytes(folder / "m.mtl", text.substr(std::min(end + 1, size)));
  sidelight::fuzz::read_or_refuse(folder / "", [&] { sidelight::parse_scene(scene, folder / "scene.toml"); });
  const std::string with_material = scene + "material = 'red'\n[material.red]\n";
  sidelight::fuzz::read_or_refuse(folder / "",
                                  [&] { sidelight::parse_scene(with_material, folder / "scene.toml"); });
  return 0;
}
