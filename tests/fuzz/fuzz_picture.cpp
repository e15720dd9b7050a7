// SPDX-License-Identifier: MIT
// PNG and EXR files. OpenImageIO below it is Debian's, so only our own code steers the search.
#include "common/picture/image_io.h"
#include "tests/fuzz/fuzz.h"
#include "tests/picture/folder.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sidelight::test::TemporaryFolder folder;
  const std::string path = folder / "picture";
  sidelight::test::write_bytes(path, std::string(reinterpret_cast<const char*>(data), size));
  sidelight::fuzz::read_or_refuse(path, [&] { sidelight::read_image(path); });
  return 0;
}
