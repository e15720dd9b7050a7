// SPDX-License-Identifier: MIT
// How a run ends without its result, a class for each: main catches it once and turns it into the exit code said here.
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
// the message says what was found and what was expected, in one line without control characters. Exit code 3.
class InputError : public std::runtime_error {
 public:
  InputError(const SourceLocation& where, const std::string& message);
};

// What was asked for cannot be written, or not be drawn for lack of OpenGL; nothing half-written is left behind. what()
// names the path, where it is one. Exit code 7.
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

// `text` as it may stand in one line on a terminal or in a page: whatever could steer the terminal, reorder the line or
// hide in it is replaced, byte by byte, by \xNN, and the rest is cut after `max_length` bytes (with "..."). Replaced are
//   bytes that are not well-formed UTF-8 (RFC 3629): overlong forms, surrogates, stray bytes;
//   C0 controls with newline and NUL, DEL, and C1 controls (U+0080..U+009F), which begin escape sequences;
//   line and paragraph separators (U+2028, U+2029), at which some programs break the line;
//   characters that are drawn as nothing (Default_Ignorable_Code_Point, UAX 44): bidirectional overrides and isolates,
//   zero-width characters, byte order marks, tags, variation selectors.
// N. Boucher, R. Anderson, "Trojan Source: Invisible Vulnerabilities", 2021; Unicode Technical Report 36, section 3.
// The result is well-formed UTF-8, at most max_length + 18 bytes long.
std::string printable(const std::string& text, std::size_t max_length = 200);

}  // namespace sidelight
