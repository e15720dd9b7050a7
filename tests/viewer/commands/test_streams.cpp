// SPDX-License-Identifier: MIT
// Who may write where: standard output carries data and nothing else, standard error is silent with -q, and the bar is
// for terminals only. What cannot be written is exit code 7.
#include <nlohmann/json.hpp>

#include "tests/support/program.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

const Arguments kSize{"-r", "16x12"};
std::string long_render() { return test::tier_value("long_render"); }

// Every verb that needs no display, on a scene, with all its output in files but what the verb is for.
std::vector<Arguments> every_verb(const std::string& scene) {
  std::vector<Arguments> commands{{"info", scene},
                                  {"render", scene, "-o", "a.png"},
                                  {"render", scene, "-o", "a.exr", "--layers", "all", "--stats", "a.json"},
                                  {"compare", scene, "-o", "out"},
                                  {"bench", scene, "-o", "bench", "--set", "samples=1", "--no-times"},
                                  {"explain", scene, "--pixel", "8,6"},
                                  {"explain", scene, "--pixel", "8,6", "--json", "b.json"}};
#ifdef SIDELIGHT_HAVE_OSMESA
  commands.push_back({"view", scene, "--screenshot", "view.png"});
#endif
  for (Arguments& command : commands) command = command + kSize;
  return commands;
}

// A scene that is warned of.
void write_warned_scene(const Workplace& here) {
  write_bytes(here / "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n");
  write_bytes(here / "warned.toml", kGoodScene + "[[mesh]]\nfile = 'm.obj'\nmaterial = 'red'\n");
}

// With its output on a terminal of so many columns; what it shows there.
Outcome on_terminal(const Workplace& here, const std::string& arguments, int columns = 80,
                    const std::string& kind = "xterm") {
  const std::string command =
      "stty cols " + std::to_string(columns) + "; TERM=" + kind + " exec '" SIDELIGHT_BINARY "' " + arguments;
  return here.command({"script", "-qec", command, "/dev/null"});
}

}  // namespace

TEST_CASE("streams: every verb is quiet on success with -q, warnings too") {
  const Workplace here;
  write_warned_scene(here);
  for (const Arguments& command : every_verb("warned.toml")) {
    CAPTURE(command[0]);
    const Outcome loud = here.run(command), quiet = here.run(command + Arguments{"-q"});
    CHECK(loud.code == 0);
    CHECK(loud.err.find("m.obj:5:1: ") == 0);
    CHECK(quiet.code == 0);
    CHECK(quiet.err.empty());
    CHECK(quiet.out == loud.out);
  }
}

TEST_CASE("streams: standard output is data only, for the verbs that have some") {
  const Workplace here;
  write_warned_scene(here);
  for (const Arguments& command : every_verb("warned.toml")) {
    CAPTURE(command[0]);
    const bool has_data = command[0] == "info" || command[0] == "explain" || command[0] == "bench";
    CHECK(here.run(command).out.empty() == !has_data);
  }
  for (const Arguments& command : {Arguments{"explain", "warned.toml", "--pixel", "8,6", "--json", "-"},
                                   Arguments{"render", "warned.toml", "-o", "a.png", "--stats", "-"}})
    CHECK(nlohmann::json::parse(here.run(command + kSize).out).is_object());
}

TEST_CASE("streams: no bar and no colour where there is no terminal") {
  const Workplace here;
  const Outcome outcome =
      here.run({"render", "good.toml", "-o", "a.png", "-r", long_render(), "--spp", "16"});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
}

TEST_CASE("streams: on a terminal a bar that is gone at the end, and none with -q") {
  const Workplace here;
  const std::string render = "render good.toml -o a.png --spp 16 -j 1 -r " + long_render();
  const Outcome shown = on_terminal(here, render);
  CAPTURE(shown.out);
  REQUIRE(shown.code == 0);
  REQUIRE(shown.out.find(" %, ") != std::string::npos);
  CHECK(shown.out.find("ray tracer [") != std::string::npos);
  const std::string erased = "\r\x1B[K";
  CHECK(shown.out.substr(shown.out.size() - erased.size()) == erased);
  CHECK(shown.out.find('\n') == std::string::npos);  // the bar never leaves its line
  for (const Outcome& none : {on_terminal(here, render + " -q"), on_terminal(here, render, 80, "dumb")}) {
    CHECK(none.code == 0);
    CHECK(none.out.empty());
  }
}

TEST_CASE("streams: a bar is shorter than a row of its terminal") {
  const Workplace here;
  for (const std::size_t columns : {5u, 20u, 40u, 200u}) {
    CAPTURE(columns);
    const Outcome shown = on_terminal(here, "render good.toml -o a.png --spp 16 -j 1 -r " + long_render(),
                                      static_cast<int>(columns));
    REQUIRE(shown.code == 0);
    std::size_t longest = 0;
    for (std::size_t at = shown.out.find('\r'); at != std::string::npos;) {
      const std::size_t next = shown.out.find('\r', at + 1);
      const std::size_t length = std::min(next, shown.out.size()) - at;
      longest = std::max(longest, length - std::string_view("\r\x1B[K").size());
      at = next;
    }
    CHECK(longest > 0);
    CHECK(longest < columns);
    CHECK((shown.out.find("tracer [") != std::string::npos) == (columns >= 40));
  }
}

TEST_CASE("streams: a terminal that goes away takes the bar with it, not the picture") {
  const Workplace here;
  const std::string python = R"(
import os, pty, subprocess, sys
ours, theirs = pty.openpty()
render = subprocess.Popen(sys.argv[1:], stderr=theirs)
os.close(theirs)
os.read(ours, 1)  # the bar has begun
os.close(ours)
sys.exit(render.wait() & 255))";
  const Outcome outcome = here.command({"python3", "-c", python, SIDELIGHT_BINARY, "render", "good.toml",
                                        "-o", "a.png", "--spp", "16", "-j", "1", "-r", long_render()});
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(std::filesystem::exists(here / "a.png"));
}

TEST_CASE("streams: data that standard output does not take is exit code 7") {
  const Workplace here;
  for (const Arguments& command :
       {Arguments{"info", "good.toml"} + kSize, Arguments{"explain", "good.toml", "--pixel", "8,6"} + kSize,
        Arguments{"explain", "good.toml", "--pixel", "8,6", "--json", "-"} + kSize,
        Arguments{"render", "good.toml", "-o", "a.png", "--stats", "-"} + kSize, Arguments{"--help"},
        Arguments{"render", "--help"}, Arguments{"--version"}}) {
    CAPTURE(command[0]);
    for (const char* where : {"exec \"$0\" \"$@\" > /dev/full", "exec \"$0\" \"$@\" >&-"}) {
      CAPTURE(where);
      const Outcome outcome = here.run_in_shell(where, command);
      CHECK(outcome.code == 7);
      CHECK(lines(outcome.err).size() == 1);
      CHECK(outcome.err.find("standard output") != std::string::npos);
    }
  }
}

TEST_CASE("streams: a full standard error takes nothing from the exit code") {
  const Workplace here;
  write_warned_scene(here);
  const auto code = [&](const Arguments& command) {
    return here.run_in_shell("exec \"$0\" \"$@\" 2> /dev/full", command).code;
  };
  CHECK(code({"info", "no_such.toml"}) == 3);
  CHECK(code({"paint"}) == 2);
  CHECK(code(Arguments{"render", "good.toml", "-o", "missing/a.png"} + kSize) == 7);
  CHECK(code(Arguments{"render", "warned.toml", "-o", "a.png", "-q"} + kSize) == 0);
  CHECK(code(Arguments{"render", "warned.toml", "-o", "a.png"} + kSize) ==
        7);  // the warning cannot be written
}

TEST_CASE("streams: closed ones do no harm to files that are written meanwhile") {
  const Workplace here;
  REQUIRE(here.run(Arguments{"render", "good.toml", "-o", "open.exr"} + kSize).code == 0);
  const Outcome outcome = here.run_in_shell("exec \"$0\" \"$@\" <&- >&- 2>&-",
                                            Arguments{"render", "good.toml", "-o", "closed.exr"} + kSize);
  CHECK(outcome.code == 0);
  CHECK(read_bytes(here / "closed.exr") == read_bytes(here / "open.exr"));
  write_warned_scene(here);
  const Arguments compare = Arguments{"compare", "warned.toml", "--no-times"} + kSize;
  REQUIRE(here.run(compare + Arguments{"-o", "open"}).code == 0);
  CHECK(here.run_in_shell("exec \"$0\" \"$@\" >&- 2>&-", compare + Arguments{"-o", "closed"}).code == 0);
  for (const std::string& name : here.names("open")) {
    CAPTURE(name);
    CHECK(read_bytes(here / ("open/" + name)) == read_bytes(here / ("closed/" + name)));
  }
}
