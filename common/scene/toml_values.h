// SPDX-License-Identifier: MIT
// One node of a scene file at a time: readers that return a value of the stated type and range, or throw an
// InputError at the node's line and column that says what was found and what was expected. They know TOML and
// numbers, not the scene format; toml.cpp and toml_objects.cpp say which key is what.
#pragma once

#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/scene/limits.h"
#include "common/scene/scene.h"
#include "common/scene/toml_source.h"

namespace sidelight::scene_file {

// The file that nodes come from. Nodes that did not come from it (values set by a caller) have no place of their
// own; errors at them are reported at `elsewhere`.
struct Document {
  std::string path;
  SourceLocation elsewhere;

  SourceLocation where(const toml::source_region& region) const;
  SourceLocation where(const toml::node& node) const { return where(node.source()); }
};

// Sorts by place in the file.
inline std::pair<int, int> file_order(const SourceLocation& where) { return {where.line, where.column}; }

// A node under the name that messages give it: its key, which its array's elements share.
struct Value {
  const Document& document;
  const toml::node& node;
  std::string_view name;

  // "'name' is <what was found>, expected <expected>", at the node.
  [[noreturn]] void fail(const std::string& expected) const;
  Value element(const toml::node& child) const { return {document, child, name}; }
  SourceLocation where() const { return document.where(node); }
};

// The closed interval a number must lie in, in words too. NaN lies in none.
struct Range {
  double low, high;
  std::string_view words;
};

inline constexpr Range kFinite{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max(),
                               "a finite number"};
inline constexpr Range kCoordinate{-kLargest, kLargest, "a number from -1e15 to 1e15"};
inline constexpr Range kLength{kSmallestLength, kLargest, "a length above 0 (from 1e-30 to 1e15)"};
inline constexpr Range kNotNegative{0, kMostLight, "a number from 0 to 1e30"};
inline constexpr Range kFraction{0, 1, "a number from 0 to 1"};

bool read_flag(const Value& value);
std::string read_text(const Value& value);
// Whole numbers only: 3.0 is not one.
int read_integer(const Value& value, int low, int high);
// Integers are numbers too.
double read_number(const Value& value, const Range& range);
// An array of `count` values; `expected` is for messages.
const toml::array& read_array(const Value& value, std::size_t count, const std::string& expected);
// Of any length.
const toml::array& read_list(const Value& value, const std::string& expected);
glm::dvec3 read_vector(const Value& value, const Range& range);
// Coordinates below 1e-30 in magnitude become 0.
glm::dvec3 read_position(const Value& value);
// Finite and not zero, of any length.
glm::dvec3 read_direction(const Value& value);
// Three numbers, or one for grey; not negative.
glm::dvec3 read_color(const Value& value);
// Three numbers, not negative, with a sum of at least 1e-30.
Attenuation read_attenuation(const Value& value);
// One of `names`.
std::string read_name(const Value& value, std::span<const std::string_view> names);
const toml::table& read_table(const Value& value);
// The elements of an array of tables, as [[name]] makes them.
std::vector<const toml::table*> read_tables(const Value& value);

// `name` in quotes, fit for a message.
std::string in_quotes(std::string_view name);
// "one of a, b, c; did you mean 'b'?" or, with none that is near, "one of a, b, c" (nearest_name.h).
std::string expected_one_of(std::span<const std::string_view> names, std::string_view found);

// The keys of one table.
struct Keys {
  std::vector<std::string_view> required, optional;
};

class TableReader {
 public:
  // InputError for a key that `keys` does not list, then for a required one that is missing. `name` is what
  // messages call the table. The document and the table must outlive the reader.
  TableReader(const Document& document, const toml::table& table, std::string name, const Keys& keys);

  const Document& document() const { return document_; }
  // Where the table begins.
  SourceLocation where() const { return document_.where(table_); }
  std::optional<Value> find(std::string_view key) const;
  // The key must be there: a required one, or one that was found.
  Value operator[](std::string_view key) const;
  // The one of `keys` that is there; InputError at the last one of several, or at the table if there is none.
  std::string_view only_one_of(std::span<const std::string_view> keys) const;

 private:
  const Document& document_;
  const toml::table& table_;
  std::string name_;
};

}  // namespace sidelight::scene_file
