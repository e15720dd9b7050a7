// SPDX-License-Identifier: MIT
// MTL files.
#include "common/scene/obj.h"
#include "tests/fuzz/fuzz.h"
#include "tests/picture/folder.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sidelight::test::TemporaryFolder folder;
  const std::string path = folder / "m.mtl";
  sidelight::test::write_bytes(path, std::string(reinterpret_cast<const char*>(data), size));
  sidelight::fuzz::read_or_refuse(path, [&] { sidelight::read_mtl(path, {path, 1, 1}); });
  return 0;
}
