// SPDX-License-Identifier: MIT
#include "viewer/bench/cache.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <span>
#include <string_view>

#include "common/content_hash.h"
#include "common/error.h"

namespace sidelight {
namespace {

std::string hash_of(std::string_view bytes) {
  ContentHash hash;
  hash.add(bytes);
  return hash.hex();
}
std::string hash_of(std::span<const glm::vec3> colors) {
  return hash_of({reinterpret_cast<const char*>(colors.data()), colors.size() * sizeof(glm::vec3)});
}

std::filesystem::path absolute_from(const char* variable) {
  const char* value = std::getenv(variable);
  const std::filesystem::path path = value ? value : "";
  return path.is_absolute() ? path : std::filesystem::path();
}

}  // namespace

std::filesystem::path usual_cache_folder() {
  if (const auto folder = absolute_from("XDG_CACHE_HOME"); !folder.empty()) return folder / "sidelight";
  const auto home = absolute_from("HOME");
  return home.empty() ? home : home / ".cache" / "sidelight";
}

const std::string& program_hash() {
  static const std::string hash = [] {
    std::ifstream file("/proc/self/exe", std::ios::binary);
    ContentHash content;
    std::array<char, 65536> block{};
    bool any = false;
    while (file.read(block.data(), block.size()) || file.gcount() > 0) {
      content.add({block.data(), static_cast<std::size_t>(file.gcount())});
      any = true;
    }
    return any ? content.hex() : std::string();
  }();
  return hash;
}

std::filesystem::path PictureCache::file_of(const std::string& key) const {
  return folder_ / (hash_of(std::string_view(key)) + ".exr");
}

std::optional<PictureCache::Entry> PictureCache::find(const std::string& key, int width, int height) const {
  if (folder_.empty()) return {};
  try {
    ImageFile file = read_image(file_of(key).string());
    Entry entry{colors(file), std::move(file.metadata)};
    const bool whole = file.width == width && file.height == height && entry.notes["key"] == key &&
                       entry.notes["checksum"] == hash_of(entry.color);
    if (whole) return entry;
  } catch (const InputError&) {
    // not there, or not a picture any more
  }
  return {};
}

bool PictureCache::keep(const std::string& key, const Frame& frame, const Metadata& notes) const {
  if (folder_.empty()) return false;
  Metadata all = notes;
  all.emplace_back("key", key);
  all.emplace_back("checksum", hash_of(frame.color));
  Frame colors_only = frame;
  for (KeptArray<glm::vec3>& layer : colors_only.rgb) layer.clear();
  try {
    make_folder(folder_.string());
    write_exr(file_of(key).string(), colors_only, all);
    return true;
  } catch (const OutputError&) {
    return false;
  }
}

}  // namespace sidelight
