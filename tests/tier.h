// SPDX-License-Identifier: MIT
// What tests ask about the run they are part of: how much to do (the row of tests/tiers.txt for the tier in the
// environment variable SIDELIGHT_TIER, which tests/run.sh sets), and how to say that a test does not apply here.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace sidelight::test {

// "default", "ci", "long" or "sanitized"; without the environment variable what suits this build.
inline std::string tier() {
  const char* named = std::getenv("SIDELIGHT_TIER");
  return named && *named ? named : SIDELIGHT_USUAL_TIER;
}

// The entry of row `name` as it stands in the table. Throws for a row or tier that is not there.
inline std::string tier_value(const std::string& name) {
  std::ifstream file(SIDELIGHT_SOURCE_DIR "/tests/tiers.txt");
  std::size_t column = 0;   // 0: the line of column names has not come yet
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::vector<std::string> row;
    for (std::string word; words >> word;) row.push_back(word);
    if (row.empty() || row[0][0] == '#') continue;
    if (column == 0) {
      while (column < row.size() && row[column] != tier()) ++column;
      if (column == row.size()) throw std::runtime_error("tests/tiers.txt has no tier " + tier());
    } else if (row[0] == name) {
      return row.at(column);
    }
  }
  throw std::runtime_error("tests/tiers.txt has no row " + name);
}

// A whole number, "1e5" included.
inline std::uint64_t tier_count(const std::string& name) {
  const std::string text = tier_value(name);
  std::size_t end = 0;
  const double value = std::stod(text, &end);
  if (end != text.size() || value < 0 || value > 1e18 || value != std::floor(value))
    throw std::runtime_error("tests/tiers.txt: " + name + " is " + text + ", expected a count");
  return static_cast<std::uint64_t>(value);
}

// Edge of a square picture of about rays_per_case pixels, 1024 at most.
inline int tier_edge() {
  return static_cast<int>(std::min(1024.0, std::sqrt(static_cast<double>(tier_count("rays_per_case")))));
}

// The entries of a list: "1,9" gives 1 and 9, "-" nothing.
inline std::vector<std::string> tier_list(const std::string& name) {
  std::vector<std::string> entries;
  const std::string text = tier_value(name);
  if (text == "-") return entries;
  std::istringstream words(text);
  for (std::string entry; std::getline(words, entry, ',');) entries.push_back(entry);
  return entries;
}

// Set by skip_test, read by tests/main.cpp.
inline bool test_was_skipped = false;

// For a test that does not apply to this machine or build: `skip_test("no AVX-512"); return;`. Such a test is counted
// as skipped, not as passed.
inline void skip_test(const std::string& why) {
  std::cout << "skipped: " << why << '\n';
  test_was_skipped = true;
}

}  // namespace sidelight::test
