// SPDX-License-Identifier: MIT
// The keys as people read them, for the help overlay; what they do is the session's to say (Session::keys).
#pragma once

#include <span>
#include <string_view>

namespace sidelight {

// Keys of a kind together, under a title.
struct KeyHelp {
  std::string_view keys, text;
};
struct KeyGroup {
  std::string_view title;
  std::span<const KeyHelp> lines;
};
std::span<const KeyGroup> key_help();

}  // namespace sidelight
