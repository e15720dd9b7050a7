// SPDX-License-Identifier: MIT
// Files that are not what they say: read_image must answer InputError, and ask for no memory that the file's
// length does not justify.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <limits>
#include <random>

#include "common/error.h"
#include "common/picture/image_io.h"
#include "common/picture/picture_claim.h"
#include "tests/picture/folder.h"
#include "tests/picture/frames.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}
std::string little_endian(std::uint32_t value) {
  const std::string bytes = big_endian(value);
  return {bytes.rbegin(), bytes.rend()};
}

std::string exr_attribute(const std::string& name, const std::string& type, const std::string& value) {
  const char zero = '\0';
  return name + zero + type + zero + little_endian(static_cast<std::uint32_t>(value.size())) + value;
}

// A header of OpenEXR with one FLOAT channel R and this data window (inclusive), and nothing behind it.
std::string exr_header(std::int32_t x0, std::int32_t y0, std::int32_t x1, std::int32_t y1) {
  std::string box;
  for (const std::int32_t value : {x0, y0, x1, y1}) box += little_endian(static_cast<std::uint32_t>(value));
  const std::string channel =
      std::string("R\0", 2) + little_endian(2) + std::string(4, '\0') + little_endian(1) + little_endian(1);
  return std::string("\x76\x2f\x31\x01\x02\0\0\0", 8) + exr_attribute("channels", "chlist", channel + '\0') +
         exr_attribute("compression", "compression", std::string(1, '\0')) +
         exr_attribute("dataWindow", "box2i", box) + exr_attribute("displayWindow", "box2i", box) +
         exr_attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         exr_attribute("pixelAspectRatio", "float", std::string("\0\0\x80\x3f", 4)) +
         exr_attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
         exr_attribute("screenWindowWidth", "float", std::string("\0\0\x80\x3f", 4)) + '\0';
}

std::string png_header(std::uint32_t width, std::uint32_t height) {
  return std::string("\x89PNG\r\n\x1a\n", 8) + big_endian(13) + "IHDR" + big_endian(width) +
         big_endian(height) + std::string("\x08\x02\0\0\0", 5) + std::string(4, '\0');
}

// While it lives, stderr is closed to libpng, which reports there what OpenImageIO reports to us as well.
class QuietStderr {
 public:
  QuietStderr() : saved_(::dup(STDERR_FILENO)) {
    const int null = ::open("/dev/null", O_WRONLY);
    ::dup2(null, STDERR_FILENO);
    ::close(null);
  }
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;
  ~QuietStderr() {
    ::dup2(saved_, STDERR_FILENO);
    ::close(saved_);
  }

 private:
  int saved_;
};

// What read_image says about these bytes; "read" if it reads them.
std::string answer(const TemporaryFolder& folder, const std::string& bytes) {
  const std::string path = folder / "hostile";
  write_bytes(path, bytes);
  const QuietStderr quiet;
  try {
    read_image(path);
  } catch (const InputError& error) {
    return std::string(error.what()).substr(path.size() + 2);
  }
  return "read";
}

Frame small_frame() {
  Frame frame = make_frame(23, 19, 1, options_with(kRaytraceLayers));
  fill_with_noise(frame, 3);
  return frame;
}

}  // namespace

TEST_CASE("the claim of a good file is its size") {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", small_frame());
  PictureClaim claim = read_claim(folder / "a.exr");
  CHECK(claim.format == PictureFormat::openexr);
  CHECK(claim.width == 23);
  CHECK(claim.height == 19);
  CHECK(claim.pixel_bytes == 27 * 4);
  write_png(folder / "a.png", to_image8(small_frame().color, 23, 19));
  claim = read_claim(folder / "a.png");
  CHECK(claim.format == PictureFormat::png);
  CHECK(claim.width == 23);
  CHECK(claim.height == 19);
}

TEST_CASE("what is not a picture file is named") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(read_image(folder / "missing.exr"), InputError);
  CHECK_THROWS_AS(read_image(folder / ""), InputError);
  CHECK_THROWS_AS(read_image("/dev/zero"), InputError);
  CHECK(answer(folder, "") == "neither a PNG nor an OpenEXR picture");
  CHECK(answer(folder, "P6 1 1 255 abc") == "neither a PNG nor an OpenEXR picture");
  CHECK(answer(folder, std::string(100000, '\0')) == "neither a PNG nor an OpenEXR picture");
}

TEST_CASE("claims beyond measure are refused before anything is allocated") {
  const TemporaryFolder folder;
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  const auto refused = [&](const std::string& bytes) {
    return answer(folder, bytes).starts_with("a picture of ");
  };
  CHECK(refused(exr_header(0, 0, kMost, kMost)));
  CHECK(refused(exr_header(-kMost - 1, -kMost - 1, kMost, kMost)));
  CHECK(refused(exr_header(0, 0, 65536, 0)));
  CHECK(refused(exr_header(0, 0, 16384, 16384)));  // 2^28 and a bit more
  CHECK(refused(exr_header(0, 0, -1, -1)));
  CHECK(refused(exr_header(kMost, 0, -kMost - 1, 0)));
  CHECK(refused(png_header(0x7FFFFFFF, 0x7FFFFFFF)));
  CHECK(refused(png_header(0xFFFFFFFF, 1)));
  CHECK(refused(png_header(0, 5)));

  const auto cannot_hold = [&](const std::string& bytes) {
    return answer(folder, bytes).find("bytes cannot hold") != std::string::npos;
  };
  CHECK(cannot_hold(exr_header(0, 0, 16383, 16383)));
  CHECK(cannot_hold(png_header(16384, 16384)));

  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const long before = usage.ru_maxrss;
  CHECK(answer(folder, exr_header(0, 0, 99, 65535)) != "read");  // small enough to be tried
  CHECK(answer(folder, png_header(65536, 100)) != "read");
  ::getrusage(RUSAGE_SELF, &usage);
  CHECK(usage.ru_maxrss - before < 200 * 1024);  // KiB
}

TEST_CASE("headers with lies about their own parts are broken") {
  const TemporaryFolder folder;
  const std::string magic("\x76\x2f\x31\x01\x02\0\0\0", 8);
  for (const std::string& header :
       {magic, magic + "name without end", magic + exr_attribute("dataWindow", "box2i", "short"),
        magic + exr_attribute("channels", "chlist", "R"),
        magic + std::string("a\0b\0", 4) + little_endian(0xFFFFFFFF) + "x"}) {
    CHECK(answer(folder, header).find("broken") != std::string::npos);
  }
  CHECK(answer(folder, magic + '\0').find("expected at least 1x1") != std::string::npos);
  std::string deep = exr_header(0, 0, 3, 3), parts = deep;
  deep[5] = 0x08;
  parts[5] = 0x10;
  CHECK(answer(folder, deep) == "a deep OpenEXR picture; expected a flat one");
  CHECK(answer(folder, parts) == "an OpenEXR file of several parts; expected one part");
}

TEST_CASE("a picture without colours is not one") {
  const TemporaryFolder folder;
  std::string only_r = exr_header(0, 0, 0, 0);
  // Uncompressed: one offset, then row 0 of 4 bytes.
  only_r += little_endian(static_cast<std::uint32_t>(only_r.size()) + 8) + little_endian(0) +
            little_endian(0) + little_endian(4) + little_endian(0x3F800000);
  CHECK(answer(folder, only_r) == "no channel G; expected R, G and B");

  std::string grey = only_r;
  grey[grey.find(std::string("R\0", 2))] = 'Y';
  CHECK(answer(folder, grey) == "read");
  const ImageFile image = read_image(folder / "hostile");
  CHECK(image.channels.size() == 3);
  for (const char* name : {"R", "G", "B"}) CHECK(image.channels.at(name) == std::vector<float>{1});
}

TEST_CASE("a picture of luminance and chroma is not a grey one") {
  const TemporaryFolder folder;
  std::string bytes;
  for (const std::string name : {"BY", "RY", "Y"})
    bytes += name + '\0' + little_endian(2) + std::string(4, '\0') + little_endian(1) + little_endian(1);
  std::string header = exr_header(0, 0, 0, 0);
  const std::size_t list = header.find("chlist") + 7;  // its length, then channel R
  header.replace(list, 4 + 18 + 1,
                 little_endian(static_cast<std::uint32_t>(bytes.size() + 1)) + bytes + '\0');
  const auto row_at = static_cast<std::uint32_t>(header.size() + 8);
  const std::string row = little_endian(0) + little_endian(12) + std::string(12, '\0');
  CHECK(answer(folder, header + little_endian(row_at) + little_endian(0) + row) ==
        "luminance and chroma (Y, RY, BY); expected R, G and B");
}

TEST_CASE("a file cut off anywhere is refused") {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", small_frame(), {{"scene", "x"}});
  write_png(folder / "a.png", to_image8(small_frame().color, 23, 19), {{"scene", "x"}});
  const std::string exr = read_bytes(folder / "a.exr"), png = read_bytes(folder / "a.png");
  int read = 0;
  for (std::size_t length = 0; length < exr.size(); length += 1 + length / 40) {
    read += answer(folder, exr.substr(0, length)) == "read";
  }
  CHECK(read == 0);
  for (std::size_t length = 0; length < png.size(); length += 1 + length / 40) {
    read += answer(folder, png.substr(0, length)) == "read";
  }
  read += answer(folder, png.substr(0, png.size() - 1)) == "read";
  read += answer(folder, exr.substr(0, exr.size() - 1)) == "read";
  CHECK(read == 0);
}

TEST_CASE("damaged files are refused or read, but never more") {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", small_frame());
  write_png(folder / "a.png", to_image8(small_frame().color, 23, 19));
  std::mt19937 generator(5);
  for (const std::string& good : {read_bytes(folder / "a.exr"), read_bytes(folder / "a.png")}) {
    for (int round = 0; round < 200; ++round) {
      std::string bytes = good;
      // Half of the damage into the header, where it is worst.
      const std::size_t range = round % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 800);
      for (int i = 0; i < 3; ++i) bytes[generator() % range] = static_cast<char>(generator());
      CHECK_FALSE(answer(folder, bytes).empty());
    }
  }
}
