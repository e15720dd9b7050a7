// SPDX-License-Identifier: MIT
#include "common/scene/obj_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>
#include <utility>

#include "common/scene/number_text.h"

namespace sidelight {
namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 30;
constexpr std::size_t kMaxKinds = 16;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

// std::from_chars knows no leading plus sign.
std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

// "1, 2 or 3"
std::string listed(std::initializer_list<std::size_t> counts) {
  std::string text;
  for (const std::size_t* count = counts.begin(); count != counts.end(); ++count) {
    const bool last = count + 1 == counts.end();
    if (count != counts.begin()) text += last ? " or " : ", ";
    text += std::to_string(*count);
  }
  return text;
}

std::string listed(Range range) { return number_text(range.lowest) + " to " + number_text(range.highest); }

// The word as a finite double; a leading + is fine, and what lies below a double's range, down to 1e-4950, is 0.
double parse_number(const StatementReader& reader, const Word& word) {
  const std::string_view text = without_plus(word.text);
  const char* const end = text.data() + text.size();
  double value = 0;
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (stop != end || code == std::errc::invalid_argument)
    reader.fail(word, quoted(word) + " is not a number");
  if (code == std::errc::result_out_of_range) {
    // Too large or too small? The wider type knows, and rounds the latter to 0.
    long double wide = 0;
    const bool small = std::from_chars(text.data(), end, wide).ec == std::errc() && std::abs(wide) < 1;
    value = small ? static_cast<double>(wide) : std::numeric_limits<double>::infinity();
  }
  if (!std::isfinite(value)) reader.fail(word, quoted(word) + " is not a finite number");
  return value;
}

}  // namespace

std::string quoted(const Word& word) {
  std::string text = "'";
  text += printable(std::string(word.text), 40);
  return text += '\'';
}

std::string read_text(const std::string& path, const SourceLocation& blame) {
  const auto fail = [&](const std::string& why) {
    throw InputError(blame, "cannot read '" + path + "': " + why);
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (error) fail(error.message());
  if (!std::filesystem::is_regular_file(status)) fail("not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) fail(error.message());
  if (size > kMaxBytes) fail(std::to_string(size) + " bytes, expected at most 1 GiB");

  std::ifstream file(path, std::ios::binary);
  std::string text(size, '\0');
  if (!file || !file.read(text.data(), static_cast<std::streamsize>(size)))
    fail("it could not be opened or read");
  return text;
}

// --- Words ---

StatementReader::StatementReader(std::string file, std::string_view text)
    : file_(std::move(file)), text_(text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
}

std::size_t StatementReader::continuation() const {
  const std::string_view rest = text_.substr(at_, 3);
  if (rest.starts_with("\\\n")) return 2;
  return rest == "\\\r\n" ? 3 : 0;
}

void StatementReader::skip_blanks() {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) {
      ++at_;
    } else if (const std::size_t length = continuation()) {
      at_ += length;
      line_start_ = at_;
      ++line_;
    } else if (text_[at_] == '#') {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else {
      return;
    }
  }
}

bool StatementReader::ends_word() const {
  const char c = text_[at_];
  return c == '\n' || is_blank(c) || (c == '\\' && continuation() > 0);
}

bool StatementReader::next_word(Word& word) {
  skip_blanks();
  if (at_ == text_.size() || text_[at_] == '\n') return false;
  const std::size_t first = at_;
  while (at_ < text_.size() && !ends_word()) ++at_;
  word = {text_.substr(first, at_ - first), line_, static_cast<int>(first - line_start_) + 1};
  return true;
}

bool StatementReader::next_statement(Word& keyword) {
  while (in_statement_) in_statement_ = next_word(keyword);
  while (!next_word(keyword)) {
    if (at_ == text_.size()) return false;
    ++at_;  // the line's end
    line_start_ = at_;
    ++line_;
  }
  in_statement_ = true;
  return true;
}

// --- What words mean ---

void StatementReader::fail(const Word& word, const std::string& message) const {
  throw InputError(where(word), message);
}

Name StatementReader::name(const Word& keyword) {
  Name name;
  for (Word word; next_word(word);) {
    if (name.text.empty())
      name.at = word;
    else
      name.text += ' ';
    name.text += word.text;
  }
  if (name.text.empty()) fail(keyword, std::string(keyword.text) + " without a name");
  return name;
}

std::size_t StatementReader::numbers(const Word& keyword, std::span<double> numbers,
                                     std::initializer_list<std::size_t> counts, Range range) {
  std::size_t count = 0;
  for (Word word; next_word(word); ++count) {
    if (count == *(counts.end() - 1))
      fail(word, quoted(word) + " is one number too many for " + std::string(keyword.text) + ", expected " +
                     listed(counts));
    const double value = parse_number(*this, word);
    if (value < range.lowest || value > range.highest)
      fail(word, std::string(keyword.text) + " of " + quoted(word) + ", expected " + listed(range));
    numbers[count] = value;
  }
  if (std::find(counts.begin(), counts.end(), count) == counts.end())
    fail(keyword, std::string(keyword.text) + " with " + std::to_string(count) + " numbers, expected " +
                      listed(counts));
  return count;
}

bool parse_integer(std::string_view word, long long& value) {
  const std::string_view text = without_plus(word);
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (code == std::errc::result_out_of_range) value = std::numeric_limits<long long>::max();
  return stop == end && code != std::errc::invalid_argument;
}

void Skipped::add(const std::string& name, const StatementReader& reader, const Word& word) {
  const auto same = [&](const Kind& kind) { return kind.name == name; };
  if (std::any_of(kinds_.begin(), kinds_.end(), same)) return;
  if (kinds_.size() == kMaxKinds)
    more_ = true;
  else
    kinds_.push_back({name, reader.where(word)});
}

std::string located(const SourceLocation& where, const std::string& message) {
  return InputError(where, message).what();
}

}  // namespace sidelight
