// SPDX-License-Identifier: MIT
// The program as its users meet it: started with arguments in a folder, and what it leaves behind: exit code, standard
// output, standard error. No shell in between, except where a test asks for one by name (ulimit).
#pragma once

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/picture/folder.h"

namespace sidelight::test {

using Arguments = std::vector<std::string>;

inline Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct Outcome {
  int code = -1;  // exit code; -n where signal n ended it
  std::string out, err;
};

// A child process with its output in files (a pipe that nobody drains would stop it).
class Process {
 public:
  // command[0] is looked up in PATH. Starts in `folder`, with neither display variable set and a cache of its own.
  Process(const Arguments& command, const std::string& folder) {
    std::vector<char*> argv;
    for (const std::string& each : command) argv.push_back(const_cast<char*>(each.c_str()));
    argv.push_back(nullptr);
    const std::string out = files_ / "out", err = files_ / "err", cache = files_ / "cache";
    id_ = ::fork();
    REQUIRE(id_ >= 0);
    if (id_ > 0) return;
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    ::setenv("XDG_CACHE_HOME", cache.c_str(), 1);
    const bool ready =
        redirect(out, STDOUT_FILENO) && redirect(err, STDERR_FILENO) && ::chdir(folder.c_str()) == 0;
    if (ready) ::execvp(argv[0], argv.data());
    ::_exit(126);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  Outcome wait() {
    int status = 0;
    REQUIRE(::waitpid(id_, &status, 0) == id_);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return {code, read_bytes(files_ / "out"), read_bytes(files_ / "err")};
  }

  void send(int signal) const { REQUIRE(::kill(id_, signal) == 0); }

  // Until the program is there and handles `signal` itself: before that the signal would simply end it.
  void await_handler(int signal) const {
    const std::string proc = "/proc/" + std::to_string(id_);
    for (int tries = 0; tries < 6000; ++tries, std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
      std::error_code gone;
      if (std::filesystem::read_symlink(proc + "/exe", gone) ==
          std::filesystem::read_symlink("/proc/self/exe"))
        continue;  // between fork and exec it is still this test, whose handlers it has
      std::ifstream status(proc + "/status");
      for (std::string key, value; status >> key;)
        if (key == "SigCgt:" && status >> value && std::stoull(value, nullptr, 16) >> (signal - 1) & 1)
          return;
    }
    FAIL("the program never installed a handler for signal " << signal);
  }

 private:
  static bool redirect(const std::string& path, int descriptor) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    return file >= 0 && ::dup2(file, descriptor) == descriptor;
  }

  TemporaryFolder files_;
  pid_t id_ = -1;
};

// A scene without a mistake or a warning, with a shadow, a mirror and glass in it.
inline const std::string kGoodScene =
    "[camera]\n"
    "eye = [0, 1, 6]\n"
    "look_at = [0, 0, 0]\n"
    "vertical_fov = 40\n"
    "[[light]]\n"
    "position = [2, 4, 3]\n"
    "intensity = [1, 1, 1]\n"
    "[material.red]\n"
    "diffuse = [1, 0, 0]\n"
    "reflect = 0.2\n"
    "[material.glass]\n"
    "refract = 0.9\n"
    "ior = 1.5\n"
    "[[sphere]]\n"
    "center = [0, 0, 0]\n"
    "radius = 1\n"
    "material = 'red'\n"
    "[[sphere]]\n"
    "center = [1, 0, 2]\n"
    "radius = 0.5\n"
    "material = 'glass'\n"
    "[[plane]]\n"
    "point = [0, -1, 0]\n"
    "normal = [0, 1, 0]\n"
    "material = 'red'\n";

// Eight sheets behind each other, each of which mirrors and lets through: every level has nearly twice the rays of the one
// before it.
inline std::string sheets_of_glass() {
  std::string text =
      "[camera]\neye = [0.3, 0.2, 10]\nlook_at = [0, 0, 0]\nvertical_fov = 30\n"
      "[[light]]\nposition = [2, 4, 9]\nintensity = 1\n"
      "[material.sheet]\ndiffuse = 0.1\nreflect = 0.5\nrefract = 0.5\n";
  for (int i = 0; i < 8; ++i) {
    const std::string z = std::to_string(-i);
    text += "[[mesh]]\nvertices = [[-9, -9, " + z + "], [9, -9, " + z + "], [0, 18, " + z +
            "]]\nfaces = [[0, 1, 2]]\nmaterial = 'sheet'\n";
  }
  return text;
}

// A folder to run the program in, with good.toml and links to the shipped scenes and the tests in it: paths are those
// that a user types in the project's folder, and outputs land nowhere else.
class Workplace {
 public:
  Workplace() {
    std::filesystem::create_directory_symlink(SIDELIGHT_SOURCE_DIR "/scenes", folder_ / "scenes");
    std::filesystem::create_directory_symlink(SIDELIGHT_SOURCE_DIR "/tests", folder_ / "tests");
    write_bytes(folder_ / "good.toml", kGoodScene);
  }

  std::string operator/(const std::string& name) const { return folder_ / name; }

  Outcome run(const Arguments& arguments) const { return command(Arguments{SIDELIGHT_BINARY} + arguments); }
  // Any command; "$0" "$@" in a shell's text stand for the program and its arguments.
  Outcome command(const Arguments& all) const { return Process(all, folder_ / ".").wait(); }
  Outcome run_in_shell(const std::string& text, const Arguments& arguments) const {
    return command(Arguments{"sh", "-c", text, SIDELIGHT_BINARY} + arguments);
  }

  // All names in a folder of it, hidden ones too, sorted.
  std::vector<std::string> names(const std::string& folder = ".") const {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / folder))
      out.push_back(entry.path().filename().string());
    std::sort(out.begin(), out.end());
    return out;
  }
  // Those that the test or the program made.
  std::vector<std::string> made() const {
    std::vector<std::string> out = names();
    for (const char* given : {"good.toml", "scenes", "tests"}) std::erase(out, given);
    return out;
  }

 private:
  TemporaryFolder folder_;
};

// good.toml as a small picture.
inline const Arguments kSmall{"good.toml", "-r", "16x12"};
inline Arguments render_small(const Arguments& more) { return Arguments{"render"} + kSmall + more; }
inline Arguments compare_small(const std::string& folder, const Arguments& more = {}) {
  return Arguments{"compare"} + kSmall + Arguments{"-o", folder} + more;
}

inline std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

}  // namespace sidelight::test
