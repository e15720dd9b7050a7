// SPDX-License-Identifier: MIT
// The arrows between the folders, read from the #include lines of the tree: who may know whom. And one arrow that only the
// linker sees: no file compiled for a newer instruction set may lend its functions to the rest of the program.
#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/tier.h"

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;  // relative to the top, e.g. "raster/tile.cpp"
  int line = 0;
  std::string target;  // as written, e.g. "common/scene/scene.h" or "GLFW/glfw3.h"
  std::string where() const { return file + ':' + std::to_string(line) + ": #include " + target; }
};

bool starts_with_any(std::string_view text, std::initializer_list<std::string_view> prefixes) {
  for (const std::string_view prefix : prefixes)
    if (text.starts_with(prefix)) return true;
  return false;
}

// What an #include line names, without its brackets or quotes; empty for any other line.
std::string included(const std::string& line) {
  std::istringstream text(line);
  std::string word, target;
  text >> word;
  if (word == "#") text >> word, word = '#' + word;
  if (word != "#include" || !(text >> target) || target.size() < 3) return {};
  return target.substr(1, target.find_first_of("\">", 1) - 1);
}

std::vector<Include> includes_of_the_tree() {
  const fs::path root = SIDELIGHT_SOURCE_DIR;
  std::vector<Include> found;
  for (const char* folder : {"common", "raster", "raytrace", "viewer", "tests"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream file(entry.path());
      int number = 0;
      for (std::string line; std::getline(file, line);) {
        ++number;
        const std::string target = included(line);
        if (!target.empty())
          found.push_back({fs::relative(entry.path(), root).generic_string(), number, target});
      }
    }
  }
  return found;
}

// What the arrow broken by `include` says, or empty.
std::string broken_arrow(const Include& include) {
  const std::string_view from = include.file, to = include.target;
  const auto from_any = [&](auto... folders) { return starts_with_any(from, {folders...}); };
  const auto to_any = [&](auto... folders) { return starts_with_any(to, {folders...}); };

  if (from_any("common/") && to_any("raster/", "raytrace/", "viewer/", "tests/"))
    return "common knows none of the others";
  if (from_any("raster/") && to_any("raytrace/", "viewer/", "tests/")) return "raster knows only common";
  if (from_any("raytrace/") && to_any("raster/", "viewer/", "tests/")) return "raytrace knows only common";
  if (from_any("viewer/") && to_any("tests/")) return "the program does not know its tests";
  if (from_any("viewer/") && to_any("raster/", "raytrace/") && to != "raster/raster.h" &&
      to != "raytrace/raytrace.h")
    return "raster.h and raytrace.h are the only public headers of their folders";
  if (to_any("GLFW/", "GL/", "EGL/", "imgui") && !from_any("viewer/window/", "tests/bench/"))
    return "only viewer/window and tests/bench draw with OpenGL";
  return {};
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  REQUIRE(pipe);
  std::string text;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe.get()))
    text.append(buffer.data(), n);
  return text;
}

// Whether a weak function with this demangled name can only ever be called by code for the same instruction set:
// its name carries that set's lane type (or the set itself).
bool belongs_to(bool avx512, std::string_view name) {
  const auto has = [&](std::string_view part) { return name.find(part) != std::string_view::npos; };
  return avx512 ? has("_VecBltnBtmsk<64") || has("avx512") : has("_VecBuiltin<32") || has("avx2");
}

}  // namespace

TEST_SUITE("arrows") {
  TEST_CASE("arrows: every include points the right way") {
    const std::vector<Include> includes = includes_of_the_tree();
    CHECK(includes.size() > 100);
    for (const Include& include : includes) {
      const std::string broken = broken_arrow(include);
      CHECK_MESSAGE(broken.empty(), include.where(), ": ", broken);
    }
  }

  TEST_CASE("arrows: include lines are read") {
    CHECK(included("#include \"raster/tile.h\"   // why") == "raster/tile.h");
    CHECK(included("  # include <GLFW/glfw3.h>") == "GLFW/glfw3.h");
    CHECK(included("// #include <vector>").empty());
    CHECK(included("").empty());
  }

  TEST_CASE("arrows: wrong includes are told from right ones") {
    for (const auto& [file, target] : {std::pair{"raster/tile.cpp", "raytrace/raytrace.h"},
                                       {"raytrace/bvh.h", "raster/raster.h"},
                                       {"raster/tile.cpp", "viewer/commands/job.h"},
                                       {"common/model/phong.h", "raster/raster.h"},
                                       {"viewer/commands/render.cpp", "raytrace/bvh.h"},
                                       {"viewer/commands/render.cpp", "GLFW/glfw3.h"},
                                       {"raster/tile.cpp", "GL/glcorearb.h"},
                                       {"common/error.h", "tests/tier.h"}})
      CHECK_FALSE(broken_arrow({file, 1, target}).empty());
    for (const auto& [file, target] : {std::pair{"raster/tile.cpp", "common/model/visibility.h"},
                                       {"raster/tile.cpp", "raster/setup.h"},
                                       {"viewer/commands/render.cpp", "raster/raster.h"},
                                       {"viewer/window/gl.h", "GL/glcorearb.h"},
                                       {"tests/raster/test_setup.cpp", "raster/setup.h"}})
      CHECK(broken_arrow({file, 1, target}).empty());
  }

  // An inline or template function that the compiler does not inline becomes a weak symbol, and the linker keeps one
  // copy for the whole program. If that is the copy of a file compiled with -mavx512f, every other caller runs AVX-512
  // code, and the program dies on a machine without it, although --isa never chose it. (Weak data, V and u in nm's
  // terms, has no instructions and may be shared.)
  TEST_CASE("arrows: code for newer machines keeps to itself") {
#ifndef __OPTIMIZE__
    return sidelight::test::skip_test("without optimisation every std:: accessor is a weak function");
#endif
    const auto commands = nlohmann::json::parse(std::ifstream(SIDELIGHT_BUILD_DIR "/compile_commands.json"));
    int objects = 0;
    for (const auto& entry : commands) {
      const std::string command = entry.at("command");
      if (command.find(" -mavx") == std::string::npos && command.find(" -mfma") == std::string::npos)
        continue;
      ++objects;
      const bool avx512 = command.find(" -mavx512") != std::string::npos;
      const std::size_t object = command.find(" -o ") + 4;
      const std::string path = command.substr(object, command.find(" -c ") - object);
      std::istringstream symbols(output_of("cd '" SIDELIGHT_BUILD_DIR "' && nm -C --defined-only " + path));
      int functions = 0;
      for (std::string line; std::getline(symbols, line);) {
        const std::size_t type = line.find_first_not_of("0123456789abcdef ");
        if (type == std::string::npos) continue;
        functions += line[type] == 'T';
        if (line[type] != 'W') continue;
        CHECK_MESSAGE(belongs_to(avx512, line), path, " lends ", line);
      }
      CHECK_MESSAGE(functions > 0, "nm found no function in ", path);
    }
    CHECK(objects >= 2);
  }
}
