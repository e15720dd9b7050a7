// SPDX-License-Identifier: MIT
#include "common/scene/toml_values.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/scene/nearest_name.h"
#include "common/scene/number_text.h"

namespace sidelight::scene_file {
namespace {

// As TOML tells it from a whole number: 2.0, not 2.
std::string float_text(double x) {
  const std::string text = number_text(x);
  return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
}

// What a message calls the node: numbers, flags and names by their value, the rest by its kind.
std::string found(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return std::to_string(integer->get());
  if (const auto* number = node.as_floating_point()) return float_text(number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* text = node.as_string()) return "the text " + in_quotes(text->get());
  if (const auto* array = node.as_array()) return "an array of " + std::to_string(array->size());
  return node.is_table() ? "a table" : "a date or time";
}

std::string joined(std::span<const std::string_view> names) {
  constexpr std::size_t kShown = 20;
  std::string text;
  for (const std::string_view name : names.first(std::min(names.size(), kShown)))
    text += (text.empty() ? "" : ", ") + printable(std::string(name), kNameInMessage);
  return names.size() > kShown ? text + ", ..." : text;
}

}  // namespace

std::string in_quotes(std::string_view name) {
  return "'" + printable(std::string(name), kNameInMessage) + "'";
}

std::string expected_one_of(std::span<const std::string_view> names, std::string_view found_name) {
  if (names.empty()) return "one, but there are none";
  return "one of " + joined(names) + did_you_mean(found_name, names);
}

SourceLocation Document::where(const toml::source_region& region) const {
  if (region.begin.line == 0) return elsewhere;
  return {path, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

void Value::fail(const std::string& expected) const {
  throw InputError(where(), in_quotes(name) + " is " + found(node) + ", expected " + expected);
}

bool read_flag(const Value& value) {
  if (const auto* flag = value.node.as_boolean()) return flag->get();
  value.fail("true or false");
}

std::string read_text(const Value& value) {
  if (const auto* text = value.node.as_string()) return text->get();
  value.fail("a text in quotes");
}

int read_integer(const Value& value, int low, int high) {
  const auto* integer = value.node.as_integer();
  if (!integer || integer->get() < low || integer->get() > high)
    value.fail("a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  return static_cast<int>(integer->get());
}

double read_number(const Value& value, const Range& range) {
  double x = std::nan("");
  if (const auto* integer = value.node.as_integer()) x = static_cast<double>(integer->get());
  if (const auto* number = value.node.as_floating_point()) x = number->get();
  if (!(x >= range.low && x <= range.high)) value.fail(std::string(range.words));
  return x;
}

const toml::array& read_list(const Value& value, const std::string& expected) {
  if (const auto* array = value.node.as_array()) return *array;
  value.fail(expected);
}

const toml::array& read_array(const Value& value, std::size_t count, const std::string& expected) {
  const toml::array& array = read_list(value, expected);
  if (array.size() != count) value.fail(expected);
  return array;
}

glm::dvec3 read_vector(const Value& value, const Range& range) {
  const toml::array& array = read_array(value, 3, "an array of 3 numbers");
  glm::dvec3 v;
  for (int i = 0; i < 3; ++i) v[i] = read_number(value.element(array[static_cast<std::size_t>(i)]), range);
  return v;
}

glm::dvec3 read_position(const Value& value) {
  glm::dvec3 position = read_vector(value, kCoordinate);
  for (int i = 0; i < 3; ++i)
    if (std::abs(position[i]) < kSmallestLength) position[i] = 0;
  return position;
}

glm::dvec3 read_direction(const Value& value) {
  const glm::dvec3 direction = read_vector(value, kFinite);
  if (direction == glm::dvec3(0)) value.fail("a direction: 3 numbers, not all 0");
  return direction;
}

glm::dvec3 read_color(const Value& value) {
  if (value.node.is_number()) return glm::dvec3(read_number(value, kNotNegative));
  if (!value.node.is_array()) value.fail("a colour: 3 numbers from 0 to 1e30, or one for grey");
  return read_vector(value, kNotNegative);
}

Attenuation read_attenuation(const Value& value) {
  const glm::dvec3 q = read_vector(value, kNotNegative);
  if (q.x + q.y + q.z < kSmallestLength) value.fail("3 coefficients with a sum above 0 (from 1e-30)");
  return {q.x, q.y, q.z};
}

std::string read_name(const Value& value, std::span<const std::string_view> names) {
  const std::string name = read_text(value);
  if (std::ranges::find(names, name) == names.end()) value.fail(expected_one_of(names, name));
  return name;
}

const toml::table& read_table(const Value& value) {
  if (const auto* table = value.node.as_table()) return *table;
  value.fail("a table");
}

std::vector<const toml::table*> read_tables(const Value& value) {
  const std::string expected = "tables, each begun by [[" + printable(std::string(value.name)) + "]]";
  std::vector<const toml::table*> tables;
  for (const toml::node& node : read_list(value, expected)) {
    if (!node.is_table()) value.element(node).fail(expected);
    tables.push_back(node.as_table());
  }
  return tables;
}

TableReader::TableReader(const Document& document, const toml::table& table, std::string name,
                         const Keys& keys)
    : document_(document), table_(table), name_(std::move(name)) {
  std::vector<std::string_view> known = keys.required;
  known.insert(known.end(), keys.optional.begin(), keys.optional.end());
  for (const auto& [key, node] : table_)
    if (std::ranges::find(known, key.str()) == known.end())
      throw InputError(document_.where(key.source()), "unknown key " + in_quotes(key.str()) + " in " + name_ +
                                                          ", expected " + expected_one_of(known, key.str()));
  for (const std::string_view key : keys.required)
    if (!table_.contains(key))
      throw InputError(where(), name_ + " lacks " + in_quotes(key) + ", which is required");
}

std::optional<Value> TableReader::find(std::string_view key) const {
  const auto entry = table_.find(key);
  if (entry == table_.end()) return std::nullopt;
  return Value{document_, entry->second, entry->first.str()};
}

Value TableReader::operator[](std::string_view key) const {
  const std::optional<Value> value = find(key);
  assert(value);
  return *value;
}

std::string_view TableReader::only_one_of(std::span<const std::string_view> keys) const {
  std::vector<std::string_view> present;
  for (const std::string_view key : keys)
    if (table_.contains(key)) present.push_back(key);
  const std::string expected = ", expected exactly one of " + joined(keys);
  if (present.empty()) throw InputError(where(), name_ + " has none of them" + expected);
  if (present.size() > 1)
    throw InputError(
        document_.where(table_.find(present.back())->first.source()),
        name_ + " has " + in_quotes(present[0]) + " and " + in_quotes(present.back()) + expected);
  return present[0];
}

}  // namespace sidelight::scene_file
