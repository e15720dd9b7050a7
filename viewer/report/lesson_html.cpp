// SPDX-License-Identifier: MIT
#include "viewer/report/compare_report.h"

#include <algorithm>

namespace sidelight {
namespace {

constexpr std::size_t kMostLesson = 4000;  // bytes shown

enum class Line { blank, command, prose };

std::string_view first_line(std::string_view text) { return text.substr(0, text.find('\n')); }

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

// A command stands on an indented line; prose that begins with the program's name does not.
Line kind_of(std::string_view line) {
  const std::string_view words = trimmed(line);
  if (words.empty()) return Line::blank;
  return words.starts_with("sidelight ") && words.data() != line.data() ? Line::command : Line::prose;
}

// How long the lines of one kind are that a text begins with.
std::size_t block_length(std::string_view text, Line kind) {
  std::size_t end = 0;
  while (end < text.size() && kind_of(first_line(text.substr(end))) == kind)
    end = std::min(end + first_line(text.substr(end)).size() + 1, text.size());
  return end;
}

Html commands_html(std::string_view block, std::size_t room) {
  Html lines;
  while (!block.empty() && room > 0) {
    const std::string_view line = trimmed(first_line(block));
    block.remove_prefix(std::min(first_line(block).size() + 1, block.size()));
    const std::size_t remark = std::min(line.find("  "), line.size());
    if (!lines.empty()) lines += Html{"\n"};
    lines += escaped(line.substr(0, remark), room);
    if (remark < line.size())
      lines += html("<span class=\"quiet\">{}</span>", escaped(line.substr(remark), room));
    room -= std::min(room, line.size());
  }
  return html("<pre class=\"lesson\"><code>{}</code></pre>\n", lines);
}

}  // namespace

Html lesson_html(std::string_view lesson) {
  Html out;
  for (std::size_t room = kMostLesson; !lesson.empty() && room > 0;) {
    const Line kind = kind_of(first_line(lesson));
    const std::string_view block = lesson.substr(0, block_length(lesson, kind));
    lesson.remove_prefix(block.size());
    if (kind == Line::blank) continue;
    out += kind == Line::command
               ? commands_html(block, room)
               : html("<p class=\"lesson\" dir=\"auto\">{}</p>\n", escaped(trimmed(block), room));
    room -= std::min(room, block.size());
  }
  return out;
}

}  // namespace sidelight
