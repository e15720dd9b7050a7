// SPDX-License-Identifier: MIT
// Scene texts for the tests of the reader: a snippet from line 1 on, and after it what every scene needs.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "common/scene/toml.h"

namespace sidelight::test {

inline const std::string kCamera = "\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nvertical_fov = 90\n";
inline const std::string kMaterial = "[material.m]\n";

inline Scene parse(const std::string& snippet) {
  return parse_scene(snippet + kCamera + kMaterial, "scene.toml");
}

// What the InputError of reading `text` says, or "no error".
inline std::string error_of(const std::string& text, const std::string& path = "scene.toml") {
  try {
    parse_scene(text, path);
    return "no error";
  } catch (const InputError& error) {
    return error.what();
  }
}

struct Mistake {
  std::string text;
  std::string place;    // "line:column"
  std::string message;  // a part of it
};

inline void check(const std::vector<Mistake>& mistakes, const std::string& before, const std::string& after) {
  for (const Mistake& mistake : mistakes) {
    CAPTURE(mistake.text);
    const std::string error = error_of(before + mistake.text + after);
    CAPTURE(error);
    CHECK(error.find("scene.toml:" + mistake.place + ": ") == 0);
    CHECK(error.find(mistake.message) != std::string::npos);
  }
}

inline void check(const std::vector<Mistake>& mistakes) { check(mistakes, "", kCamera + kMaterial); }

}  // namespace sidelight::test
