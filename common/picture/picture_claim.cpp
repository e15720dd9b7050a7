// SPDX-License-Identifier: MIT
#include "common/picture/picture_claim.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "common/error.h"

namespace sidelight {
namespace {

constexpr std::int64_t kMaxEdge = 65536;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;
constexpr std::uint64_t kAlwaysFine = std::uint64_t{64} << 20;  // bytes
constexpr std::uint64_t kMaxRatio = 4096;
constexpr std::size_t kMaxHeader = std::size_t{4} << 20;  // bytes; a lesson's text fits many times

// The first bytes of a file, read from left to right; what lies behind the end reads as "broken".
class Header {
 public:
  Header(const std::string& path, std::string bytes) : path_(path), bytes_(std::move(bytes)) {}

  bool starts_with(std::string_view magic) const { return std::string_view(bytes_).starts_with(magic); }

  void skip(std::size_t count) {
    if (count > bytes_.size() - at_) reject_file(path_, "the header of the picture is broken or cut off");
    at_ += count;
  }
  std::uint32_t byte() {
    skip(1);
    return static_cast<unsigned char>(bytes_[at_ - 1]);
  }
  std::uint32_t big_endian() {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | byte();
    return value;
  }
  std::uint32_t little_endian() {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value |= byte() << (8 * i);
    return value;
  }
  std::int64_t little_endian_signed() { return static_cast<std::int32_t>(little_endian()); }
  // A string that ends with a zero byte.
  std::string text() {
    const std::size_t begin = at_;
    while (byte() != 0) {
    }
    return bytes_.substr(begin, at_ - begin - 1);
  }
  std::size_t position() const { return at_; }
  [[noreturn]] void reject(const std::string& why) const { reject_file(path_, why); }

 private:
  const std::string& path_;
  std::string bytes_;
  std::size_t at_ = 0;
};

constexpr std::string_view kPngMagic("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kExrMagic("\x76\x2f\x31\x01", 4);

PictureClaim png_claim(Header& header) {
  header.skip(kPngMagic.size() + 8);  // and the length and name of the chunk, which must be IHDR
  PictureClaim claim{PictureFormat::png, header.big_endian(), header.big_endian(), 0};
  const std::uint64_t depth = header.byte();
  claim.pixel_bytes = 4 * std::max<std::uint64_t>(1, depth / 8);  // at most RGBA
  return claim;
}

// Every chunk (length, name, data, checksum) up to IEND must be there: where a file is cut off, OpenImageIO's
// reader leaks and libpng writes to stderr.
void require_whole_png(std::istream& file, std::uint64_t file_bytes, const std::string& path) {
  std::uint64_t at = kPngMagic.size();
  std::string start(8, '\0');
  do {
    file.seekg(static_cast<std::streamoff>(at));
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    if (!file) reject_file(path, "the picture is cut off");
    at += 4 + 4 + Header(path, start).big_endian() + 4;
    if (at > file_bytes) reject_file(path, "the picture is cut off");
  } while (start.substr(4) != "IEND");
}

// The bytes of one pixel, from the list of channels: name, type, 4 bytes of flags, two sampling rates each.
std::uint64_t exr_pixel_bytes(Header& header) {
  std::uint64_t bytes = 0;
  while (!header.text().empty()) {
    const std::uint32_t type = header.little_endian();  // 0 UINT, 1 HALF, 2 FLOAT
    bytes += type == 1 ? 2 : 4;
    header.skip(4 + 2 * 4);
  }
  return bytes;
}

PictureClaim exr_claim(Header& header) {
  header.skip(kExrMagic.size());
  const std::uint32_t version = header.little_endian();
  constexpr std::uint32_t kDeep = 0x800, kManyParts = 0x1000;
  if (version & kDeep) header.reject("a deep OpenEXR picture; expected a flat one");
  if (version & kManyParts) header.reject("an OpenEXR file of several parts; expected one part");

  PictureClaim claim{PictureFormat::openexr, 0, 0, 0};
  std::int64_t tile_width = 0, tile_height = 0;
  for (std::string name = header.text(); !name.empty(); name = header.text()) {
    const std::string type = header.text();
    const std::uint32_t size = header.little_endian();
    const std::size_t value = header.position();
    if (name == "dataWindow" && type == "box2i") {
      const std::int64_t x0 = header.little_endian_signed(), y0 = header.little_endian_signed();
      claim.width = header.little_endian_signed() - x0 + 1;
      claim.height = header.little_endian_signed() - y0 + 1;
    } else if (name == "channels" && type == "chlist") {
      claim.pixel_bytes = exr_pixel_bytes(header);
    } else if (name == "tiles" && type == "tiledesc") {
      tile_width = header.little_endian();
      tile_height = header.little_endian();
    }
    if (header.position() > value + size) header.reject("the header of the picture is broken");
    header.skip(value + size - header.position());
  }
  // A reader allocates whole tiles, even for a picture smaller than one.
  claim.width = std::max(claim.width, claim.width > 0 ? tile_width : 0);
  claim.height = std::max(claim.height, claim.height > 0 ? tile_height : 0);
  return claim;
}

void check(const PictureClaim& claim, std::uint64_t file_bytes, const std::string& path) {
  const std::string size = std::to_string(claim.width) + "x" + std::to_string(claim.height);
  if (claim.width <= 0 || claim.height <= 0)
    reject_file(path, "a picture of " + size + " pixels; expected at least 1x1");
  if (claim.width > kMaxEdge || claim.height > kMaxEdge || claim.width * claim.height > kMaxPixels) {
    reject_file(path, "a picture of " + size +
                          " pixels; expected edges up to 65536 and at most 268435456 pixels in all");
  }
  if (claim.pixel_bytes == 0) reject_file(path, "a picture without channels");
  const std::uint64_t unpacked = static_cast<std::uint64_t>(claim.width * claim.height) * claim.pixel_bytes;
  if (unpacked > kAlwaysFine && unpacked / kMaxRatio > file_bytes) {
    reject_file(path, "claims " + size + " pixels, which a file of " + std::to_string(file_bytes) +
                          " bytes cannot hold");
  }
}

}  // namespace

void reject_file(const std::string& path, const std::string& why) {
  throw InputError({path, 0, 0}, why.substr(0, why.find('\n')));  // libraries add lines that say less
}

PictureClaim read_claim(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) reject_file(path, "no such file");
  if (!std::filesystem::is_regular_file(status))
    reject_file(path, "not a file; expected a PNG or OpenEXR picture");
  const std::uint64_t file_bytes = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file) reject_file(path, "cannot be opened for reading");
  std::string bytes(std::min<std::uint64_t>(file_bytes, kMaxHeader), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) reject_file(path, "cannot be read");

  Header header(path, std::move(bytes));
  const bool png = header.starts_with(kPngMagic);
  if (!png && !header.starts_with(kExrMagic)) reject_file(path, "neither a PNG nor an OpenEXR picture");
  const PictureClaim claim = png ? png_claim(header) : exr_claim(header);
  check(claim, file_bytes, path);
  if (png) require_whole_png(file, file_bytes, path);
  return claim;
}

}  // namespace sidelight
