// SPDX-License-Identifier: MIT
#include "common/picture/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "common/error.h"

namespace sidelight {
namespace {

namespace fs = std::filesystem;

// An open file, and the name to remove unless it is renamed. Functions return 0 or an errno.
class OutputFile {
 public:
  OutputFile(int descriptor, std::string temporary)
      : descriptor_(descriptor), temporary_(std::move(temporary)) {}
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile() {
    close();
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }

  int write(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return 0;
  }
  int close() {
    if (descriptor_ < 0) return 0;
    const int descriptor = descriptor_;
    descriptor_ = -1;
    return ::close(descriptor) == 0 ? 0 : errno;  // some file systems report a full disk only here
  }
  int rename_to(const std::string& final_name) {
    if (std::rename(temporary_.c_str(), final_name.c_str()) != 0) return errno;
    temporary_.clear();
    return 0;
  }

 private:
  int descriptor_;
  std::string temporary_;  // empty: nothing to remove
};

// A name in the same folder (a rename must not cross file systems) that no other process or thread uses, and
// short, so that it fits wherever the final name does.
std::string temporary_beside(const fs::path& path) {
  static std::atomic<unsigned> count{0};
  const std::string name =
      ".sidelight-" + std::to_string(::getpid()) + "-" + std::to_string(count++) + ".tmp";
  return (path.parent_path() / name).string();
}

// Writes what a file is to hold; 0 or an errno.
using Contents = std::function<int(OutputFile&)>;

int write_beside_and_rename(const fs::path& path, const Contents& contents) {
  std::string temporary;
  int descriptor = -1;
  do {  // a name may be taken by what an earlier process of our number left when it was killed
    temporary = temporary_beside(path);
    descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) return errno;

  OutputFile file(descriptor, temporary);
  if (const int error = contents(file)) return error;
  if (const int error = file.close()) return error;
  return file.rename_to(path.string());
}

int write_directly(const fs::path& path, const Contents& contents) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  OutputFile file(descriptor, {});
  if (const int error = contents(file)) return error;
  return file.close();
}

int write_whole(const fs::path& path, const Contents& contents) {
  if (!path.has_filename()) return path.empty() ? ENOENT : EISDIR;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::status_known(status)) return error.value();  // a link that leads to itself, say
  if (fs::is_directory(status)) return EISDIR;
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_directly(path, contents);
  // Through links, so that they stay links, even where the last leads to what is not there yet.
  fs::path target = path;
  while (fs::is_symlink(fs::symlink_status(target, error)))
    target = target.parent_path() / fs::read_symlink(target, error);
  return write_beside_and_rename(target, contents);
}

void write_or_throw(const std::string& path, const Contents& contents) {
  if (const int error = write_whole(path, contents)) {
    throw OutputError(printable(path, 1000) + ": cannot write: " + std::generic_category().message(error));
  }
}

}  // namespace

void write_file(const std::string& path, std::span<const std::uint8_t> bytes) {
  write_or_throw(path, [&](OutputFile& file) { return file.write(bytes); });
}

void write_text_file(const std::string& path, const std::string& text) {
  write_file(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void write_text_file(const std::string& path, const std::function<void(const AppendText&)>& produce) {
  write_or_throw(path, [&](OutputFile& file) {
    constexpr std::size_t kPiece = 1 << 16;  // bytes written at once
    std::string piece;
    int error = 0;
    const auto flush = [&] {
      if (error == 0) error = file.write({reinterpret_cast<const std::uint8_t*>(piece.data()), piece.size()});
      piece.clear();
    };
    produce([&](std::string_view text) {
      piece += text;
      if (piece.size() >= kPiece) flush();
    });
    flush();
    return error;
  });
}

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!error && !fs::is_directory(path, error) && !error)
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) throw OutputError(printable(path, 1000) + ": cannot make the folder: " + error.message());
}

OutputFolder::OutputFolder(const std::string& path) {
  std::error_code ignored;
  for (fs::path at = path; !at.empty() && !fs::exists(at, ignored); at = at.parent_path())
    made_.push_back(at.string());
  make_folder(path);
}

OutputFolder::~OutputFolder() {
  std::error_code not_empty;
  for (const std::string& folder : made_) fs::remove(folder, not_empty);
}

}  // namespace sidelight
