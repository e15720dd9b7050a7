// SPDX-License-Identifier: MIT
// What README.md, scenes/README.md and tests/hardcases/README.md tell a reader to type, typed in order; what they show
// as the answer, the functions they name and the files they point to.
//
// A command line begins with "sidelight", or, where its answer follows, with "$ sidelight"; a comment behind it may name
// the exit code. It is run as it stands but in little: pictures of 64x48, and no window, since there is no display.
#include <filesystem>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/program.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

struct Command {
  std::string line;                 // without the comment
  std::string comment;              // from its # on
  std::vector<std::string> answer;  // lines that the command must print, in this order
};

std::string source_text(const std::string& file) { return read_bytes(SIDELIGHT_SOURCE_DIR "/" + file); }

std::string trimmed(const std::string& line) {
  const std::size_t first = line.find_first_not_of(' ');
  return first == std::string::npos ? "" : line.substr(first, line.find_last_not_of(' ') + 1 - first);
}

std::vector<Command> commands_of(const std::string& text) {
  std::vector<Command> out;
  bool answered = false;  // the lines that follow are an answer
  for (const std::string& each : lines(text)) {
    const std::string line = trimmed(each);
    const bool asks = line.rfind("$ sidelight ", 0) == 0;
    if (asks || line.rfind("sidelight ", 0) == 0) {
      const std::string typed = asks ? line.substr(2) : line;
      const std::size_t hash = std::min(typed.find(" #"), typed.size());
      out.push_back({trimmed(typed.substr(0, hash)), typed.substr(hash), {}});
      answered = asks;
    } else if (line.rfind("```", 0) == 0) {
      answered = false;
    } else if (answered && !line.empty() && line != "...") {
      out.back().answer.push_back(line);
    }
  }
  return out;
}

Arguments in_little(const std::string& line) {
  std::istringstream words(line.substr(sizeof("sidelight")));
  Arguments command{std::istream_iterator<std::string>(words), {}};
  const std::set<std::string> drawing{"render", "compare", "view"};
  if (drawing.count(command.front()) > 0 && line.find(" -r ") == std::string::npos)
    command = command + Arguments{"-r", "64x48"};
  return command;
}

int promised_code(const Command& command) {
  if (command.line.rfind("sidelight view ", 0) == 0 && command.line.find("--screenshot") == std::string::npos)
    return 6;
  std::smatch code;
  return std::regex_search(command.comment, code, std::regex("exit code ([0-9]+)")) ? std::stoi(code[1]) : 0;
}

// Each line of `answer` is one of `printed`, and they come in this order.
void check_answer(const std::vector<std::string>& answer, const std::string& printed) {
  const std::vector<std::string> all = lines(printed);
  auto at = all.begin();
  for (const std::string& line : answer) {
    CAPTURE(line);
    at = std::find_if(at, all.end(), [&](const std::string& one) { return trimmed(one) == line; });
    REQUIRE(at != all.end());
    ++at;
  }
}

// At least `least` commands, and none that hides from commands_of in the middle of a line.
void check_commands(const std::string& file, std::size_t least) {
  const std::string text = source_text(file);
  const std::vector<Command> commands = commands_of(text);
  CHECK(commands.size() >= least);
  const std::regex with_file("sidelight [a-z]+ [^ `]+\\.(toml|exr|png)");
  CHECK(std::distance(std::sregex_iterator(text.begin(), text.end(), with_file), {}) ==
        static_cast<std::ptrdiff_t>(commands.size()));

  const Workplace here;
  for (const Command& command : commands) {
    CAPTURE(command.line);
    const Arguments arguments = in_little(command.line);
    const Outcome outcome = here.run(arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == promised_code(command));
    check_answer(command.answer, outcome.out + outcome.err);
  }
}

// Pictures and links to files, relative to the folder of `file`.
void check_links(const std::string& file, std::size_t least) {
  const std::string text = source_text(file);
  const std::filesystem::path folder = std::filesystem::path(SIDELIGHT_SOURCE_DIR "/" + file).parent_path();
  const std::regex link("\\]\\(([^)#:]+)(#[^)]*)?\\)");
  std::size_t found = 0;
  for (std::sregex_iterator each(text.begin(), text.end(), link), end; each != end; ++each, ++found) {
    const std::string target = (*each)[1];
    CAPTURE(target);
    CHECK(std::filesystem::exists(folder / target));
  }
  CHECK(found >= least);
}

}  // namespace

TEST_CASE("readme: the commands of README.md do what it says") { check_commands("README.md", 11); }

TEST_CASE("readme: the commands of scenes/README.md do and print what it says") {
  check_commands("scenes/README.md", 17);
}

TEST_CASE("readme: the commands of tests/hardcases/README.md do and print what it says") {
  if (test::tier() == "sanitized") return test::skip_test("answers of pictures of 320x240");
  check_commands("tests/hardcases/README.md", 14);
}

TEST_CASE("readme: the scene file in README.md is one") {
  std::string scene;
  bool in_it = false;
  for (const std::string& line : lines(source_text("README.md"))) {
    if (line.rfind("    title = ", 0) == 0) in_it = true;
    if (!line.empty() && line[0] != ' ') in_it = false;
    if (in_it) scene += line + "\n";
  }
  for (const char* table :
       {"[camera]", "[trace]", "[[light]]", "[material.", "[[sphere]]", "[[plane]]", "[[mesh]]"})
    CHECK(scene.find(table) != std::string::npos);
  const Workplace here;
  write_bytes(here / "shown.toml", scene);
  const Outcome outcome = here.run({"render", "shown.toml", "-o", "shown.png", "-r", "16x12"});
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
}

TEST_CASE("readme: links lead to files") {
  check_links("README.md", 1);
  check_links("scenes/README.md", 30);
  check_links("tests/hardcases/README.md", 24);
}

TEST_CASE("readme: the walk names every scene and only functions of the references and what they call") {
  const std::string text = source_text("scenes/README.md");
  for (const auto& entry : std::filesystem::directory_iterator(SIDELIGHT_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string name = entry.path().filename().string();
    CAPTURE(name);
    CHECK(text.find(name) != std::string::npos);
  }

  const std::string code = source_text("raster/reference.cpp") + source_text("raytrace/reference.cpp") +
                           source_text("common/model/visibility.h") + source_text("common/scene/camera.h");
  const std::regex function("`([a-z_]+)\\(\\)`");
  std::size_t found = 0;
  for (std::sregex_iterator each(text.begin(), text.end(), function), end; each != end; ++each, ++found) {
    const std::string name = (*each)[1];
    CAPTURE(name);
    CHECK(std::regex_search(code, std::regex("\\b" + name + "\\(")));
  }
  CHECK(found >= 15);
}
