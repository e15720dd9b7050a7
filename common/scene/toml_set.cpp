// SPDX-License-Identifier: MIT
#include "common/scene/toml_set.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <sstream>

#include "common/scene/number_text.h"

namespace sidelight::scene_file {
namespace {

void collect(toml::table& table, const std::string& prefix, std::vector<Setting>& settings) {
  for (auto&& [key, node] : table) {
    const std::string path = prefix.empty() ? std::string(key.str()) : prefix + "." + path_key(key.str());
    if (node.is_table())
      collect(*node.as_table(), path, settings);
    else
      settings.push_back({path, key.source(), &node});
  }
}

// Takes the first key off `rest`, with its quotes; nullopt if there is none.
std::optional<std::string_view> first_key(std::string_view& rest) {
  const bool is_quoted = !rest.empty() && (rest[0] == '"' || rest[0] == '\'');
  const std::size_t end = is_quoted ? rest.find(rest[0], 1) : std::min(rest.find('.'), rest.size());
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view key = is_quoted ? rest.substr(1, end - 1) : rest.substr(0, end);
  rest.remove_prefix(is_quoted ? end + 1 : end);
  if (!is_quoted && !is_bare(key)) return std::nullopt;
  return key;
}

// A path on its way through the file, for messages.
struct Walk {
  const Document& document;
  std::string_view path;
  toml::source_region region;

  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(document.where(region), "cannot set " + in_quotes(path) + ": " + why);
  }
};

// There is no `key` in `parent` and none may be added.
[[noreturn]] void fail_missing(const Walk& walk, const toml::node& parent, const std::string& key) {
  if (const auto* array = parent.as_array())
    walk.fail("there is no element " + in_quotes(key) + ", expected " +
              (array->empty()       ? "none: there are none"
               : array->size() == 1 ? "0, the only one"
                                    : "0 to " + std::to_string(array->size() - 1)));
  const auto* table = parent.as_table();
  if (!table)
    walk.fail("there is nothing inside a plain value, expected the path to end before " + in_quotes(key));
  std::vector<std::string_view> names;
  for (const auto& [name, node] : *table) names.push_back(name.str());
  walk.fail("there is no " + in_quotes(key) + ", expected " + expected_one_of(names, key));
}

// The node under `key`; a table that the file left out (say, [trace]) is made, a material is not.
toml::node& descend(const Walk& walk, toml::table& root, toml::node& parent, const std::string& key) {
  if (toml::node* node = child(parent, key)) return *node;
  auto* table = parent.as_table();
  if (!table || table == root.get("material")) fail_missing(walk, parent, key);
  return table->insert(toml::key{key, walk.region}, toml::table{}).first->second;
}

}  // namespace

std::vector<Setting> settings_in(toml::table& set, const Document& document) {
  std::vector<Setting> settings;
  collect(set, "", settings);
  std::ranges::stable_sort(settings, {},
                           [&](const Setting& setting) { return file_order(document.where(setting.where)); });
  return settings;
}

bool is_bare(std::string_view key) {
  return !key.empty() && std::ranges::all_of(key, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

std::string path_key(std::string_view key) {
  if (is_bare(key)) return std::string(key);
  const char quote = key.find('"') == std::string_view::npos ? '"' : '\'';
  return quote + std::string(key) + quote;
}

std::vector<std::string> split_path(std::string_view path, const SourceLocation& where) {
  std::vector<std::string> keys;
  for (std::string_view rest = path; keys.size() < kMaxKeyParts; rest.remove_prefix(1)) {
    const std::optional<std::string_view> key = first_key(rest);
    if (!key) break;
    keys.emplace_back(*key);
    if (rest.empty()) return keys;
    if (rest[0] != '.') break;
  }
  throw InputError(where, in_quotes(path) +
                              " is not a key path, expected keys with dots between them, such as "
                              "trace.depth or light.0.intensity");
}

std::size_t element_number(std::string_view key) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), number);
  return error == std::errc() && end == key.data() + key.size() ? number : SIZE_MAX;
}

toml::node* child(toml::node& parent, const std::string& key) {
  if (auto* table = parent.as_table()) return table->get(key);
  auto* array = parent.as_array();
  return array ? array->get(element_number(key)) : nullptr;
}

void set_value(const Document& document, toml::table& root, std::string_view path,
               const toml::source_region& where, toml::node&& value) {
  const Walk walk{document, path, where};
  const std::vector<std::string> keys = split_path(path, document.where(where));
  if (keys[0] == "step") walk.fail("settings belong to steps and cannot change them");

  toml::node* parent = &root;
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) parent = &descend(walk, root, *parent, keys[i]);

  const toml::node* old = child(*parent, keys.back());
  const bool whole_table =
      (old && (old->is_table() || old->is_array_of_tables())) || value.is_array_of_tables();
  if (whole_table) walk.fail("it is a table or an array of tables, expected the path of one value in it");
  if (auto* table = parent->as_table()) {
    table->insert_or_assign(toml::key{keys.back(), where}, std::move(value));
  } else if (old) {
    toml::array& array = *parent->as_array();
    array.replace(array.cbegin() + static_cast<std::ptrdiff_t>(element_number(keys.back())),
                  std::move(value));
  } else {
    fail_missing(walk, *parent, keys.back());
  }
}

std::string toml_text(const toml::node& value) {
  if (const auto* number = value.as_floating_point()) return number_text(number->get());
  std::ostringstream text;
  if (const auto* array = value.as_array()) {
    for (const toml::node& element : *array) text << (text.tellp() > 0 ? ", " : "") << toml_text(element);
    return "[" + text.str() + "]";
  }
  text << toml::toml_formatter{value, toml::format_flags::none};
  return text.str();
}

}  // namespace sidelight::scene_file
