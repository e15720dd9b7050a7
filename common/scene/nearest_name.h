// SPDX-License-Identifier: MIT
// "Did you mean": the known name that takes the fewest edits to reach from a misspelt one.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"

namespace sidelight {

inline constexpr std::size_t kNameInMessage = 60;  // bytes of a name that a message shows

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

// The edits from what was typed to a name, of the first 64 bytes of both; a name cut short, of two letters or more, is one
// edit away.
inline std::size_t edits_to(std::string_view typed, std::string_view name) {
  const bool cut_short = typed.size() > 1 && typed != name && name.starts_with(typed);
  return cut_short ? 1 : edit_distance(typed.substr(0, 64), name.substr(0, 64));
}

// The first of the nearest names; empty where there is none. Looks at the first 10,000, and not at the whole of long ones,
// so that a hostile file cannot make an error message expensive.
inline std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> known) {
  std::string_view best;
  std::size_t least = std::string_view::npos;
  for (const std::string_view name : known.first(std::min<std::size_t>(known.size(), 10'000))) {
    const std::size_t edits = edits_to(typed, name);
    if (edits >= least) continue;
    best = name;
    least = edits;
  }
  return best;
}

// The nearest name if a slip of the fingers may have meant it: one edit away, or half of the longer one's bytes at most;
// else empty. 'depht' is near 'depth', 'cube' is not near 'camera'.
inline std::string_view near_name(std::string_view typed, std::span<const std::string_view> known) {
  const std::string_view best = nearest_name(typed, known);
  if (typed.empty() || best.empty()) return "";
  const std::size_t longer = std::min<std::size_t>(64, std::max(typed.size(), best.size()));
  return edits_to(typed, best) <= std::max<std::size_t>(1, longer / 2) ? best : "";
}

// "; did you mean 'depth'?", fit for a message; nothing where no name is near. `dashes` stand before the name there.
inline std::string did_you_mean(std::string_view typed, std::span<const std::string_view> known,
                                std::string_view dashes = "") {
  const std::string_view near = near_name(typed, known);
  return near.empty()
             ? ""
             : "; did you mean '" + std::string(dashes) + printable(std::string(near), kNameInMessage) + "'?";
}

}  // namespace sidelight
