// SPDX-License-Identifier: MIT
// The program away from the folder where it was built, and the libraries in somebody else's.
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/program.h"

using namespace sidelight::test;

namespace {

// The example of README.md: what another project's CMakeLists.txt says, and its program, with the headers that the
// comments behind its lines name.
struct Example {
  std::string cmake, program;
};

Example example() {
  Example out;
  std::string headers = "#include \"raytrace/raytrace.h\"\n";
  const std::string readme = read_bytes(SIDELIGHT_SOURCE_DIR "/README.md");
  std::istringstream section(readme.substr(readme.find("**In a program of yours.**")));
  for (std::string line; std::getline(section, line) && !line.starts_with("## ");) {
    if (!line.starts_with("    ")) continue;
    (line.find("sidelight::") == std::string::npos ? out.cmake : out.program) += line + "\n";
    const std::size_t header = line.find("common/");
    if (header != std::string::npos) headers += "#include \"" + line.substr(header) + "\"\n";
  }
  out.program = headers + "int main() {\n" + out.program + "}\n";
  return out;
}

}  // namespace

// Where a build's codec has stand-ins (tests/support/stand_ins.sh) the installed one loads what OpenImageIO really
// brings: the files are the same, and what one wrote the other reads.
TEST_CASE("install: the installed program has all it needs with it") {
  const Workplace here;
  REQUIRE(here.command({"cmake", "--install", SIDELIGHT_BUILD_DIR, "--prefix", here / "new"}).code == 0);
  const auto installed = [&](const Arguments& more) {
    return here.command(Arguments{here / "new/bin/sidelight"} + more);
  };
  for (const std::string kind : {".png", ".exr"}) {
    CAPTURE(kind);
    const Outcome outcome = installed(render_small({"-q", "-o", "a" + kind}));
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    REQUIRE(here.run(render_small({"-q", "-o", "b" + kind})).code == 0);
    CHECK(read_bytes(here / ("a" + kind)) == read_bytes(here / ("b" + kind)));
    CHECK(installed({"diff", "a" + kind, "b" + kind, "-q"}).code == 0);
    CHECK(here.run({"diff", "a" + kind, "b" + kind, "-q"}).code == 0);
  }

  // The codec is its own, not that of the build folder.
  for (const auto& file : std::filesystem::recursive_directory_iterator(here / "new"))
    if (file.path().filename() == "libsidelight_codec.so") write_bytes(file.path().string(), "no library");
  const Outcome broken = installed(render_small({"-q", "-o", "a.png"}));
  CHECK(broken.code == 7);
  CHECK(broken.err.find("new/") != std::string::npos);
}

// Configured as a whole; compiled is the program only, since the libraries are what all other tests run.
TEST_CASE("install: README's example compiles as part of another project") {
  const Workplace here;
  const Example yours = example();
  REQUIRE(yours.cmake.find("sidelight_raytrace") != std::string::npos);
  REQUIRE(yours.program.find("raytrace::render(") != std::string::npos);
  std::filesystem::create_directory_symlink(SIDELIGHT_SOURCE_DIR, here / "sidelight");
  write_bytes(here / "yours.cpp", yours.program);
  write_bytes(
      here / "CMakeLists.txt",
      "cmake_minimum_required(VERSION 3.20)\nproject(yours CXX)\nset(CMAKE_EXPORT_COMPILE_COMMANDS ON)\n"
      "add_executable(yours yours.cpp)\n" +
          yours.cmake);
  const Outcome configured = here.command({"cmake", "-G", "Ninja", "-S", here / ".", "-B", here / "build"});
  CAPTURE(configured.err);
  REQUIRE(configured.code == 0);

  std::string compile;
  for (const auto& entry : nlohmann::json::parse(read_bytes(here / "build/compile_commands.json"))) {
    const std::string command = entry["command"];
    CHECK(command.find("-Werror") == std::string::npos);
    if (std::filesystem::path(std::string(entry["file"])).filename() == "yours.cpp")
      compile = "cd build && " + command;
  }
  REQUIRE_FALSE(compile.empty());
  CHECK(compile.find("-Wall") == std::string::npos);  // our warnings are for our code
  const Outcome compiled = here.run_in_shell(compile, {});
  CAPTURE(compiled.err);
  CHECK(compiled.code == 0);
}
