// SPDX-License-Identifier: MIT
// Every way a file can fail to be written; all of them fail for root, too.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <string>

#include "common/error.h"
#include "common/picture/atomic_file.h"
#include "tests/picture/folder.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// While it lives, no file may grow beyond `bytes`: a full disk, without one.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_{};
  void (*old_handler_)(int);
};

// What the error says; empty if there is none.
std::string error_of(const std::string& path, const std::string& text) {
  try {
    write_text_file(path, text);
  } catch (const OutputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a file is written, and replaced") {
  const TemporaryFolder folder;
  write_text_file(folder / "a.json", "one");
  CHECK(read_bytes(folder / "a.json") == "one");
  write_text_file(folder / "a.json", std::string("two\0three", 9));
  CHECK(read_bytes(folder / "a.json") == std::string("two\0three", 9));
  write_text_file(folder / "empty", "");
  CHECK(read_bytes(folder / "empty").empty());
  CHECK(folder.count() == 2);
}

TEST_CASE("a name as long as the file system takes") {
  const TemporaryFolder folder;
  const std::string name(255, 'x');
  write_text_file(folder / name, "text");
  CHECK(read_bytes(folder / name) == "text");
  CHECK(error_of(folder / (name + "x"), "text") != "");
  CHECK(folder.count() == 1);
}

TEST_CASE("permissions follow the umask") {
  const TemporaryFolder folder;
  const mode_t mask = ::umask(022);
  write_text_file(folder / "a", "text");
  ::umask(mask);
  struct stat status {};
  REQUIRE(::stat((folder / "a").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0644);
}

TEST_CASE("where no file can be, the error names path and reason, and nothing is left behind") {
  const TemporaryFolder folder;
  write_text_file(folder / "plain", "text");
  make_folder(folder / "folder");
  const auto check = [&](const std::string& path, const std::string& reason) {
    CHECK(error_of(path, "new") == path + ": cannot write: " + reason);
  };
  check(folder / "missing/a.json", "No such file or directory");
  check(folder / "plain/a.json", "Not a directory");
  check(folder / "folder", "Is a directory");
  check(folder / "folder/", "Is a directory");
  check("", "No such file or directory");
  check("/dev/full", "No space left on device");
  CHECK(read_bytes(folder / "plain") == "text");
  CHECK(folder.count() == 2);
  struct stat status {};
  REQUIRE(::stat("/dev/full", &status) == 0);
  CHECK(S_ISCHR(status.st_mode));  // still the device: not replaced by a file
}

TEST_CASE("a full disk leaves the older file as it was") {
  const TemporaryFolder folder;
  write_text_file(folder / "a.json", "old");
  std::string error, error_of_new;
  {
    const FileSizeLimit limit(1000);
    error = error_of(folder / "a.json", std::string(1001, 'x'));
    error_of_new = error_of(folder / "b.json", std::string(100000, 'x'));
    CHECK(error_of(folder / "c.json", std::string(1000, 'x')).empty());
  }
  CHECK(error == folder / "a.json" + ": cannot write: File too large");
  CHECK(error_of_new == folder / "b.json" + ": cannot write: File too large");
  CHECK(read_bytes(folder / "a.json") == "old");
  CHECK(folder.count() == 2);
}

TEST_CASE("a text made piece by piece is whole or not there") {
  const TemporaryFolder folder;
  std::string whole;
  write_text_file(folder / "a.pov", [&](const AppendText& append) {
    for (int i = 0; i < 40000; ++i) {
      const std::string piece = std::to_string(i) + '\n';
      append(piece);
      whole += piece;
    }
  });
  CHECK(read_bytes(folder / "a.pov") == whole);

  const auto interrupted = [](const AppendText& append) {
    append(std::string(1 << 20, 'x'));
    throw Interrupted();
  };
  CHECK_THROWS_AS(write_text_file(folder / "a.pov", interrupted), Interrupted);
  CHECK_THROWS_AS(write_text_file(folder / "b.pov", interrupted), Interrupted);
  {
    const FileSizeLimit limit(1000);
    const auto long_text = [](const AppendText& append) {
      for (int i = 0; i < 3; ++i) append(std::string(1 << 16, 'x'));
    };
    CHECK_THROWS_AS(write_text_file(folder / "a.pov", long_text), OutputError);
  }
  CHECK(read_bytes(folder / "a.pov") == whole);
  CHECK(folder.count() == 1);
}

TEST_CASE("a link stays a link") {
  const TemporaryFolder folder;
  make_folder(folder / "elsewhere");
  write_text_file(folder / "elsewhere/target", "old");
  REQUIRE(::symlink("elsewhere/target", (folder / "link").c_str()) == 0);
  write_text_file(folder / "link", "new");
  CHECK(std::filesystem::is_symlink(folder / "link"));
  CHECK(read_bytes(folder / "elsewhere/target") == "new");
}

TEST_CASE("a link to what is not there yet stays one, and one to itself is no place to write") {
  const TemporaryFolder folder;
  make_folder(folder / "elsewhere");
  REQUIRE(::symlink("second", (folder / "first").c_str()) == 0);
  REQUIRE(::symlink("elsewhere/target", (folder / "second").c_str()) == 0);
  write_text_file(folder / "first", "new");
  CHECK(std::filesystem::is_symlink(folder / "first"));
  CHECK(std::filesystem::is_symlink(folder / "second"));
  CHECK(read_bytes(folder / "elsewhere/target") == "new");

  REQUIRE(::symlink("no/such/folder", (folder / "lost").c_str()) == 0);
  CHECK(error_of(folder / "lost", "text").find("lost: cannot write: No such file") != std::string::npos);
  REQUIRE(::symlink("loop", (folder / "loop").c_str()) == 0);
  CHECK(error_of(folder / "loop", "text").find("loop: cannot write: ") != std::string::npos);
  CHECK(std::filesystem::is_symlink(folder / "loop"));
}

TEST_CASE("a device is written to") {
  write_text_file("/dev/null", "text");
  CHECK(std::filesystem::is_character_file("/dev/null"));
}

TEST_CASE("what an earlier process of our number left does not stand in the way") {
  const TemporaryFolder folder;
  const std::string stem = ".sidelight-" + std::to_string(::getpid()) + "-";
  for (int i = 0; i < 200; ++i) write_bytes(folder / (stem + std::to_string(i) + ".tmp"), "left over");
  write_text_file(folder / "a", "text");
  CHECK(read_bytes(folder / "a") == "text");
  CHECK(folder.count() == 201);
}

TEST_CASE("folders are made with their parents, once or twice") {
  const TemporaryFolder folder;
  make_folder(folder / "a/b/c");
  make_folder(folder / "a/b/c");
  make_folder(folder / "a/b/d/");
  CHECK(std::filesystem::is_directory(folder / "a/b/c"));
  CHECK(std::filesystem::is_directory(folder / "a/b/d"));
  write_text_file(folder / "plain", "text");
  CHECK_THROWS_AS(make_folder(folder / "plain"), OutputError);
  CHECK_THROWS_AS(make_folder(folder / "plain/below"), OutputError);
  CHECK_THROWS_AS(make_folder(""), OutputError);
  CHECK_THROWS_AS(make_folder("/proc/no-such-folder"), OutputError);
}
