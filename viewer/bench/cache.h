// SPDX-License-Identifier: MIT
// Pictures that took long to make, kept between runs in a folder of the user's: OpenEXR files, whose names are hashes of
// all that the picture depends on. A file appears whole or not at all; one that is damaged, truncated or of another
// picture is as good as none; and the whole folder may be deleted at any time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/picture/image_io.h"

namespace sidelight {

// $XDG_CACHE_HOME/sidelight, else ~/.cache/sidelight; empty where neither variable is an absolute path: then nothing is
// kept (XDG Base Directory Specification 0.8).
std::filesystem::path usual_cache_folder();

// A hash of this program's own file, read once: part of what a picture depends on, since another build of the same
// version may make another one. Empty where the file cannot be read.
const std::string& program_hash();

class PictureCache {
 public:
  // Made when it is first written to. An empty one keeps nothing.
  explicit PictureCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  struct Entry {
    std::vector<glm::vec3> color;
    std::map<std::string, std::string> notes;
  };
  // What was kept under `key`, a line of text; empty if it is not there or cannot be trusted.
  std::optional<Entry> find(const std::string& key, int width, int height) const;
  // Keeps the colours of `frame`, with notes (names of letters, values of one line). False where that fails: a cache
  // that cannot be written is no reason to end.
  bool keep(const std::string& key, const Frame& frame, const Metadata& notes) const;

  std::filesystem::path file_of(const std::string& key) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace sidelight
