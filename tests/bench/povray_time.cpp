// SPDX-License-Identifier: MIT
#include "tests/bench/povray_time.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "common/picture/atomic_file.h"
#include "common/scene/pov.h"
#include "tests/picture/folder.h"

namespace sidelight::bench {

std::optional<double> povray_seconds(const Scene& scene) {
  const test::TemporaryFolder folder;
  write_text_file(folder / "scene.pov", [&](const AppendText& append) { write_pov(scene, append); });
  std::string command = "cd '" + folder / "." + "' && povray +Iscene.pov -F +WT1 +Q9";
  for (const std::string& option : pov_options(scene))
    if (!option.starts_with("+F")) command += " " + option;  // no picture is kept
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen((command + " 2>&1").c_str(), "r"),
                                                             ::pclose);
  if (!pipe) return {};
  std::string text;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe.get()))
    text.append(buffer.data(), n);
  // "Trace Time: ... (0.943 seconds)", then "using 1 thread(s) with 0.938 CPU-seconds total"
  const std::size_t trace = text.find("Trace Time:");
  if (trace == std::string::npos) return {};
  const std::size_t with = text.find(" with ", trace);
  if (with == std::string::npos) return {};
  return std::strtod(text.c_str() + with + 6, nullptr);
}

}  // namespace sidelight::bench
