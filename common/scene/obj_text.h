// SPDX-License-Identifier: MIT
// What OBJ and MTL files have in common: lines of words, each word with its line and column. Private to
// obj.cpp and mtl.cpp. A statement is a keyword and its words up to the end of the line; a backslash at the
// end of a line continues it; # at the start of a word begins a comment; carriage returns are blanks. Nothing
// is copied or collected: words are views of the text, read one by one, so a line may be as long as the file.
#pragma once

#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"

namespace sidelight {

// The file's bytes. Throws InputError at `blame` where it cannot be read, is not a regular file or exceeds 1
// GiB.
std::string read_text(const std::string& path, const SourceLocation& blame);

struct Word {
  std::string_view text;
  int line = 0, column = 0;  // column in bytes; both from 1
};

// The word in quotes, safe to print and cut after 40 bytes.
std::string quoted(const Word& word);

// The words that are left of a statement, joined by single blanks, and where they begin.
struct Name {
  std::string text;
  Word at;
};

// What a number may be, bounds included.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

class StatementReader {
 public:
  // `text` must outlive the reader; `file` stands in messages.
  StatementReader(std::string file, std::string_view text);

  // The next statement's keyword; false at the end of the text. Words of the statement before that were not
  // read are skipped.
  bool next_statement(Word& keyword);
  // The statement's next word; false at its end.
  bool next_word(Word& word);

  // All words that are left. Throws InputError at the keyword where there are none.
  Name name(const Word& keyword);
  // All words that are left, as numbers, into `numbers`; returns how many. Throws InputError at a word that is no
  // number or out of `range`, at one too many, or at the keyword where their count is not one of `counts` (rising,
  // none above numbers.size()).
  std::size_t numbers(const Word& keyword, std::span<double> numbers,
                      std::initializer_list<std::size_t> counts, Range range = {});

  SourceLocation where(const Word& word) const { return {file_, word.line, word.column}; }
  [[noreturn]] void fail(const Word& word, const std::string& message) const;

 private:
  void skip_blanks();
  std::size_t continuation() const;  // length of backslash and line end at at_, or 0
  bool ends_word() const;

  std::string file_;
  std::string_view text_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
  bool in_statement_ = false;
};

// The word as an integer (beyond 64 bits: the largest); false if it is none.
bool parse_integer(std::string_view text, long long& value);

// What a reader passed over: kinds, in order, with the place of the first of each; at most 16, so that a file
// of noise does not make a page of warnings.
class Skipped {
 public:
  struct Kind {
    std::string name;
    SourceLocation first;
  };

  void add(const std::string& name, const StatementReader& reader, const Word& word);
  const std::vector<Kind>& kinds() const { return kinds_; }
  bool more() const { return more_; }  // kinds beyond the 16

 private:
  std::vector<Kind> kinds_;
  bool more_ = false;
};

// "file:line:column: message", as an InputError reads.
std::string located(const SourceLocation& where, const std::string& message);

}  // namespace sidelight
