// SPDX-License-Identifier: MIT
// The parts that a report is put together from: text made safe, pictures, tables, widgets and the page around them.
// A page is one file that asks nothing of the network, reads well without JavaScript and works from a double click.
//
// Markup and text are different types: Html is trusted and only made here, of patterns in the source; a string is text
// from anywhere and is escaped on its way in. So no text of a scene can become markup.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/picture/srgb.h"

namespace sidelight {

struct Html {
  std::string markup;

  Html& operator+=(const Html& more) {
    markup += more.markup;
    return *this;
  }
  bool empty() const { return markup.empty(); }
};

// Text as inert HTML, for element content and quoted attributes alike: & < > " ' as entities; control characters, bytes
// that are not UTF-8, marks that turn the direction of writing and what XML forbids replaced by U+FFFD; line breaks and
// tabs as spaces; cut after `max_length` bytes with an ellipsis.
Html escaped(std::string_view text, std::size_t max_length = 200);

// What html() inserts for an argument.
template <class T>
auto as_markup(const T& value) {
  if constexpr (std::is_same_v<T, Html>)
    return std::string_view(value.markup);
  else if constexpr (std::is_convertible_v<T, std::string_view>)
    return escaped(value).markup;
  else
    return value;
}

// fmt's pattern with its arguments: numbers as they are, Html as it is, any other string escaped.
template <class... Arguments>
Html html(std::string_view pattern, const Arguments&... arguments) {
  return {fmt::format(fmt::runtime(pattern), as_markup(arguments)...)};
}

// RFC 4648, section 4, padded.
std::string base64(std::span<const std::uint8_t> bytes);

// 307200 as "307 200", with thin spaces that do not break.
std::string grouped(std::uint64_t number);

// One picture with its caption, embedded as PNG. Small ones are enlarged by a whole factor. `alt` says what is to be
// seen, for those who cannot.
struct Figure {
  Image8 image;
  std::string alt;
  Html caption;
  std::string id = {};  // of the picture's element; may be empty
};
Html figure_html(const Figure& figure);
// Its picture alone.
Html image_html(const Figure& figure);

// What either side of a pair can show.
struct PairChoices {
  struct Choice {
    std::string label, id;  // the id of a picture's element elsewhere on the page
  };
  std::vector<Choice> all;
  std::size_t left = 0, right = 0;  // what they show at first
};
// Two pictures of one size: beside each other, under a slider, or flipped in place. Without JavaScript: beside each
// other. `name`: of this pair within the page, a word.
Html pair_html(std::string_view name, const Figure& left, const Figure& right,
               const PairChoices& choices = {});

// Pages of which JavaScript shows one at a time, so that pictures in the same place flip; without it all are shown in
// their order. `name`: of this list within the page, a word. Labels are the text of the buttons.
struct StepPage {
  std::string label;
  Html content;
};
Html steps_html(std::string_view name, const std::vector<StepPage>& pages);

// A table with a caption; the first column names its row. A sortable one is sorted by a click on a heading: by the
// numbers that its cells begin with, else by their text; it scrolls sideways where it is too wide.
struct Table {
  std::string caption;
  std::vector<std::string> columns;     // may be empty: no heading
  std::vector<std::vector<Html>> rows;  // each as long as the others
  bool sortable = false;
  std::vector<std::size_t> of_words = {};  // columns set flush left, as the first is; numbers go flush right
};
Html table_html(const Table& table);

// The whole file.
std::string page_html(std::string_view title, const Html& body);

// What page_html embeds (page_style.cpp, page_script.cpp): the style of plots has the colours of all.
std::string plot_style();
extern const std::string_view kPageStyle;
extern const std::string_view kPageScript;

// The style of plots for a file of its own, which may be drawn by what knows no variables of CSS: no colour is one.
std::string plot_file_style();

}  // namespace sidelight
