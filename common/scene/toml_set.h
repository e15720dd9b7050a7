// SPDX-License-Identifier: MIT
// Settings: values put into a parsed scene file by key path, as a lesson's step does ("trace.depth" = 1). A path is
// keys joined by dots; elements of arrays count from 0 (light.0.intensity), and a key with a dot in it stands in
// quotes (material."dark.red".diffuse). A setting changes one value; it adds no material, light or object.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/scene/toml_values.h"

namespace sidelight::scene_file {

// One entry of a table of settings.
struct Setting {
  std::string path;
  toml::source_region where;    // of its key
  toml::node* value = nullptr;  // in that table; not a table itself
};

// The entries of `set`, in the order of the file. { trace = { depth = 1 } } is trace.depth, like { "trace.depth" = 1 }.
std::vector<Setting> settings_in(toml::table& set, const Document& document);

// Whether TOML, and a path, can do without quotes around the key.
bool is_bare(std::string_view key);

// A key as a path writes it, in quotes where it needs them. (A path has no key with both sorts of quotes.)
std::string path_key(std::string_view key);

// The keys of a path. InputError at `where` if it is not a path.
std::vector<std::string> split_path(std::string_view path, const SourceLocation& where);

// The number of an array's element as a path writes it; SIZE_MAX if `key` is none.
std::size_t element_number(std::string_view key);

// The node under one key of a path, or null.
toml::node* child(toml::node& parent, const std::string& key);

// Puts `value`, which keeps its place in the file, under `path`, whose keys' place is `where`. InputError there if
// the path leads nowhere; keys that the format does not know are left for the reader of the table to find.
void set_value(const Document& document, toml::table& root, std::string_view path,
               const toml::source_region& where, toml::node&& value);

// The value as TOML text, on one line.
std::string toml_text(const toml::node& value);

}  // namespace sidelight::scene_file
