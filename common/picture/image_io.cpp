// SPDX-License-Identifier: MIT
// Files, and the codec that makes and reads their bytes.
#include "common/picture/image_io.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <new>

#include "common/error.h"
#include "common/picture/picture_claim.h"
#include "common/picture/picture_codec.h"

#ifdef __SANITIZE_ADDRESS__
// The AddressSanitizer of GCC 12 takes thread-local data of a library that was loaded late, if its address ends in 010, for
// that of a glibc before 2.25, and the two words before it for its place and size. The leak check then reads there and
// ends the program ("Tracer caught signal 11", once in some forty times). Without this option it does not guess.
extern "C" const char* __asan_default_options() { return "intercept_tls_get_addr=0"; }
#endif

namespace sidelight {
namespace {

// Beside the program if that was installed, else where it was built.
std::string codec_file() {
  std::error_code unknown;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::filesystem::path installed = program.parent_path() / SIDELIGHT_INSTALLED_CODEC;
  return std::filesystem::exists(installed, unknown) ? installed.string() : SIDELIGHT_CODEC;
}

const PictureCodec& load_codec() {
  void* library = dlopen(codec_file().c_str(), RTLD_NOW | RTLD_LOCAL);
  void* function = library ? dlsym(library, "sidelight_picture_codec") : nullptr;
  if (!function) throw OutputError(std::string("pictures cannot be read or written: ") + dlerror());
  return *reinterpret_cast<decltype(&sidelight_picture_codec)>(function)();
}

// Loaded once, by the first who asks, and kept.
const PictureCodec& codec() {
  static const PictureCodec& loaded = load_codec();
  return loaded;
}

// libpng writes a line of its own about a broken file, whatever error handler it was given. Not while other threads
// have something to say.
class MutedStderr {
 public:
  MutedStderr() : kept_(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)) {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    if (kept_ >= 0) ::dup2(nowhere, STDERR_FILENO);
    ::close(nowhere);
  }
  MutedStderr(const MutedStderr&) = delete;
  MutedStderr& operator=(const MutedStderr&) = delete;
  ~MutedStderr() {
    if (kept_ < 0) return;
    ::dup2(kept_, STDERR_FILENO);
    ::close(kept_);
  }

 private:
  int kept_;  // -1: there is none, or no number left for it
};

}  // namespace

void write_png(const std::string& path, const Image8& image, const Metadata& metadata) {
  write_file(path, codec().png(path, image, metadata));
}

std::vector<std::uint8_t> encode_png(const Image8& image) { return codec().png("picture", image, {}); }

void write_png_linear16(const std::string& path, const Frame& frame, const Metadata& metadata) {
  write_file(path, codec().png_linear16(path, frame, metadata));
}

void write_exr(const std::string& path, const Frame& frame, const Metadata& metadata) {
  write_file(path, codec().exr(path, frame, metadata));
}

ImageFile read_image(const std::string& path) {
  const PictureClaim claim = read_claim(path);
  const PictureCodec& reader = codec();
  const MutedStderr muted;
  try {
    return reader.read(path, claim);
  } catch (const std::bad_alloc&) {
    reject_file(path, "a picture of " + std::to_string(claim.width) + "x" + std::to_string(claim.height) +
                          " pixels needs more memory than there is");
  }
}

std::vector<glm::vec3> colors(const ImageFile& image) {
  const auto &r = image.channels.at("R"), &g = image.channels.at("G"), &b = image.channels.at("B");
  std::vector<glm::vec3> colors(r.size());
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = {r[i], g[i], b[i]};
  return colors;
}

}  // namespace sidelight
