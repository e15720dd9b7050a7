// SPDX-License-Identifier: MIT
// The two ways a run can fail through no fault of the program: the user's input, and the place it writes to.
// Loaders and writers throw them; main catches them once and turns them into exit codes 3 and 7.
#pragma once

#include <stdexcept>
#include <string>

namespace sidelight {

// Where in a user's file something stands. Lines and columns count from 1; 0 means "the file as a whole".
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

// A mistake in the user's input. what() reads "file:line:column: message" ("file: message" where line is 0);
// the message says what was found and what was expected, in one line without control characters.
class InputError : public std::runtime_error {
 public:
  InputError(const SourceLocation& where, const std::string& message);
};

// A file or folder that could not be written; nothing half-written is left behind. what() names the path.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A NaN or infinity in a finished picture: a fault of ours, reported with its pixel. Exit code 5.
class NumericalFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Two pictures that have no pixels to compare with each other: their sizes or channels differ. Exit code 4.
class PicturesDoNotMatch : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Wrong use of the program that only shows after the command line was parsed. Exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The user pressed Ctrl-C (or a caller raised RenderOptions::cancel). Exit code 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

// `text` with control characters and bytes that are not UTF-8 replaced by \xNN and cut after `max_length` bytes
// (with "..."), so that a hostile file cannot steer the terminal through an error message.
std::string printable(const std::string& text, std::size_t max_length = 200);

}  // namespace sidelight
