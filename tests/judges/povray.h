// SPDX-License-Identifier: MIT
// Debian's povray as a judge: renders a scene through common/scene/pov.h and hands back its picture and its ray counts.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "common/scene/pov.h"
#include "tests/picture/folder.h"
#include "tests/support/program.h"

namespace sidelight::test {

enum class PovQuality { local = 3, full = 9 };  // +Q

struct PovPicture {
  int width = 0, height = 0;
  std::vector<std::array<std::uint16_t, 3>> pixels;  // linear; row by row, top row first
  std::string statistics;                            // as povray prints them

  // The number behind the line of statistics that begins with `name`; 0 if there is none.
  std::uint64_t count(const std::string& name) const {
    const std::size_t at = statistics.find("\n" + name);
    if (at == std::string::npos) return 0;
    std::istringstream rest(statistics.substr(at + 1 + name.size()));
    std::string word;
    std::uint64_t value = 0;
    while (rest >> word)
      if (word.find_first_not_of(":") != std::string::npos && std::istringstream(word) >> value) break;
    return value;
  }
};

inline bool has_povray() { return std::system("povray --version >/dev/null 2>&1") == 0; }

// Binary PPM with 16 bits a channel, as povray writes it.
inline PovPicture read_ppm16(const std::string& path) {
  PovPicture picture;
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  std::getline(file, magic);
  while (file.peek() == '#') file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  int most = 0;
  file >> picture.width >> picture.height >> most;
  file.get();
  REQUIRE(magic == "P6");
  REQUIRE(most == 65535);
  picture.pixels.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  for (auto& pixel : picture.pixels)
    for (std::uint16_t& channel : pixel) {
      const int high = file.get(), low = file.get();
      channel = static_cast<std::uint16_t>(high << 8 | low);
    }
  REQUIRE(file.good());
  return picture;
}

inline PovPicture render_pov(const std::string& text, const std::vector<std::string>& options,
                             PovQuality quality) {
  const TemporaryFolder folder;
  write_bytes(folder / "scene.pov", text);
  Arguments command{"povray", "+Iscene.pov", "+Oscene.ppm", "+Q" + std::to_string(static_cast<int>(quality))};
  const Outcome outcome = Process(command + options, folder / ".").wait();
  REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
  PovPicture picture = read_ppm16(folder / "scene.ppm");
  picture.statistics = outcome.err;
  return picture;
}

inline std::string pov_text(const Scene& scene) {
  std::string text;
  write_pov(scene, [&](std::string_view piece) { text += piece; });
  return text;
}

inline PovPicture render_pov(const Scene& scene, PovQuality quality) {
  return render_pov(pov_text(scene), pov_options(scene), quality);
}

}  // namespace sidelight::test
