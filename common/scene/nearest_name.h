// SPDX-License-Identifier: MIT
// "Did you mean": the known name that takes the fewest edits to reach from a misspelt one.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sidelight {

// Insertions, deletions and substitutions of bytes between a and b. V. I. Levenshtein, "Binary codes capable
// of correcting deletions, insertions, and reversals", Soviet Physics Doklady 10, 1966; by rows, O(|a| |b|).
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, diagonal + 1});
    }
  }
  return row[b.size()];
}

// The first of the nearest names; empty where there is none. A name cut short, of two letters or more, is one edit away.
// Looks at the first 64 bytes of the first 10,000 names, so that a hostile file cannot make an error message expensive.
inline std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known) {
  std::string_view best;
  std::size_t best_distance = std::string_view::npos;
  for (const std::string_view candidate : known.first(std::min<std::size_t>(known.size(), 10'000))) {
    const bool cut_short = name.size() > 1 && name != candidate && candidate.starts_with(name);
    const std::size_t distance = cut_short ? 1 : edit_distance(name.substr(0, 64), candidate.substr(0, 64));
    if (distance >= best_distance) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

// The nearest name if a slip of the fingers may have meant it: cut short, one edit away, or half of the longer one's
// bytes at most; else empty. 'depht' is near 'depth', 'cube' is not near 'camera'.
inline std::string_view near_name(std::string_view name, std::span<const std::string_view> known) {
  const std::string_view best = nearest_name(name, known);
  if (name.empty() || best.empty()) return "";
  if (name.size() > 1 && best.starts_with(name)) return best;
  const std::string_view a = name.substr(0, 64), b = best.substr(0, 64);
  return edit_distance(a, b) <= std::max<std::size_t>(1, std::max(a.size(), b.size()) / 2) ? best : "";
}

}  // namespace sidelight
