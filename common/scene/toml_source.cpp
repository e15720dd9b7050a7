// SPDX-License-Identifier: MIT
#include "common/scene/toml_source.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "common/error.h"

namespace sidelight::scene_file {
namespace {

// Line and column (in code points, as toml++ counts) of text[at].
toml::source_position position_of(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::string_view row = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
  const auto column = std::count_if(row.begin(), row.end(), [](char c) { return (c & 0xC0) != 0x80; }) + 1;
  return {static_cast<toml::source_index>(line), static_cast<toml::source_index>(column)};
}

// A string of several lines may end in one or two quotes of its own, before its last three.
std::size_t closing_quotes(std::string_view five) {
  return std::min(five.find_first_not_of(five[0]), five.size());
}

// Where the string (of TOML's four kinds) that begins at text[at] ends: at the character after it, or, if it is not closed,
// where toml++ will complain before it reads another key.
std::size_t after_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string_view triple = quote == '"' ? "\"\"\"" : "'''";
  const bool multi_line = text.substr(at, 3) == triple;
  const std::string_view close = multi_line ? triple : triple.substr(0, 1);
  for (std::size_t i = at + close.size(); i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\')
      ++i;
    else if (text.substr(i, close.size()) == close)
      return i + (multi_line ? closing_quotes(text.substr(i, 5)) : 1);
    else if (!multi_line && text[i] == '\n')
      return i;
  }
  return text.size();
}

// toml++ bounds the nesting of values but not the parts of a dotted key, and destroys tables recursively: one key of
// a million parts would overflow the stack, in the error path too. So keys are measured before it sees them: dots
// between separators, outside of strings and comments (a number has one at most). The first dot too many, or npos.
std::size_t overlong_key(std::string_view text) {
  int dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (c == '"' || c == '\'') {
      i = after_string(text, i);
      continue;
    }
    if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) dots = 0;
    if (c == '.' && ++dots >= kMaxKeyParts) return i;
    ++i;
  }
  return std::string_view::npos;
}

InputError unreadable(const std::string& path, const std::string& what) {
  return InputError({path, 0, 0}, what);
}

std::ifstream open(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) throw unreadable(path, "is a folder, expected a file");
  if (status.type() == std::filesystem::file_type::not_found) throw unreadable(path, "no such file");
  if (!std::filesystem::exists(status)) throw unreadable(path, "cannot be reached: " + error.message());
  std::ifstream file(path, std::ios::binary);
  if (!file) throw unreadable(path, "cannot be opened, expected a readable file");
  return file;
}

}  // namespace

std::string read_scene_text(const std::string& path) {
  std::ifstream file = open(path);
  std::string text;
  std::array<char, 65536> block;
  while (file.read(block.data(), block.size()) || file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > kMaxSceneBytes)
      throw unreadable(path,
                       "is larger than 16 MiB, expected a smaller scene file (meshes can be OBJ files)");
  }
  if (file.bad()) throw unreadable(path, "cannot be read to its end");
  return text;
}

void add_file(ContentHash& hash, const std::string& path) {
  std::ifstream file = open(path);
  std::error_code error;
  std::uintmax_t left = std::filesystem::file_size(path, error);
  if (error) throw unreadable(path, "its size cannot be found");
  std::array<char, 65536> block;
  while (left > 0 && file) {
    file.read(block.data(), static_cast<std::streamsize>(std::min<std::uintmax_t>(left, block.size())));
    hash.add({block.data(), static_cast<std::size_t>(file.gcount())});
    left -= static_cast<std::uintmax_t>(file.gcount());
  }
  if (left > 0) throw unreadable(path, "cannot be read to its end");
}

toml::table parse_toml(std::string_view text, const std::string& path, int before) {
  const auto where = [&](toml::source_position at) {
    const int column = static_cast<int>(at.column);
    return SourceLocation{path, static_cast<int>(at.line), at.line == 1 ? column - before : column};
  };
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (const std::size_t dot = overlong_key(text); dot != std::string_view::npos)
    throw InputError(where(position_of(text, dot)), "a dotted key goes on here, expected one of at most " +
                                                        std::to_string(kMaxKeyParts) + " parts");
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const std::string description(error.description());
    // toml++ does not say why it cannot read 1e400, nor what it would have read for a word without quotes.
    const bool number = description.find("parsing floating-point") != std::string::npos;
    const bool word = description.find("could not determine value type") != std::string::npos;
    throw InputError(where(error.source().begin),
                     "not valid TOML: " + description + (number ? ", expected a finite number" : "") +
                         (word ? ", expected a text in quotes, a number, true, false or an array" : ""));
  }
}

}  // namespace sidelight::scene_file
