// SPDX-License-Identifier: MIT
// A scene file before its tables mean anything: bytes from disk, their hash, and TOML parsed within limits that no
// input can talk its way around. Private to the scene reader; the only place that includes toml++.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

// Arrays and inline tables within each other; the format needs four. Keeps every recursion over a document shallow.
#define TOML_MAX_NESTED_VALUES 32
#include <toml++/toml.h>

namespace sidelight::scene_file {

// A parsed value takes up to 40 times its text in memory, so this is the reader's bound on memory too. Meshes that
// are larger belong in files of their own.
inline constexpr std::size_t kMaxSceneBytes = std::size_t{16} << 20;

// Parts of one dotted key (a.b.c has three); the format needs three.
inline constexpr int kMaxKeyParts = 16;

// The whole file. InputError if it is missing, a folder, unreadable or larger than kMaxSceneBytes.
std::string read_scene_text(const std::string& path);

// FNV-1a, 64 bits (Fowler, Noll and Vo; RFC 9923): names a scene's content, protects nothing.
class ContentHash {
 public:
  void add(std::string_view bytes);
  void add_file(const std::string& path);  // its bytes; InputError if it cannot be read
  std::string hex() const;                 // 16 digits

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

// Valid UTF-8 and TOML 1.0, or an InputError at the line and column where it ceases to be. `path` is for messages.
toml::table parse_toml(std::string_view text, const std::string& path);

}  // namespace sidelight::scene_file
