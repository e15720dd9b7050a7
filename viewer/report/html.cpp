// SPDX-License-Identifier: MIT
#include "viewer/report/html.h"

#include <algorithm>
#include <array>

#include "common/picture/image_io.h"
#include "common/utf8.h"

namespace sidelight {
namespace {

constexpr std::string_view kReplacement = "\uFFFD";
constexpr int kLeastWidth = 480;  // of a picture on the page, in CSS pixels: what is smaller is enlarged

std::string_view inert(std::string_view sequence) {
  constexpr std::array<std::pair<char, std::string_view>, 8> kEntities{{{'&', "&amp;"},
                                                                        {'<', "&lt;"},
                                                                        {'>', "&gt;"},
                                                                        {'"', "&quot;"},
                                                                        {'\'', "&#39;"},
                                                                        {'\t', " "},
                                                                        {'\r', " "},
                                                                        {'\n', " "}}};
  for (const auto& [c, entity] : kEntities)
    if (c == sequence[0]) return entity;
  const char32_t code = code_point(sequence, 0, sequence.size());
  const bool in_xml = code != 0xFFFE && code != 0xFFFF;  // which a plot's own file is
  return is_harmful(code) || !in_xml ? kReplacement : sequence;
}

// By which whole factor a picture is enlarged on the page.
int enlargement(const Image8& image) { return std::max(1, kLeastWidth / image.width); }

// A select box for either side, if there is anything to choose.
Html choosers(const PairChoices& choices) {
  Html out;
  if (choices.all.empty()) return out;
  for (const auto& [side, chosen] : {std::pair{"left", choices.left}, std::pair{"right", choices.right}}) {
    Html options;
    for (std::size_t i = 0; i < choices.all.size(); ++i)
      options += html("<option value=\"{}\"{}>{}</option>\n", choices.all[i].id,
                      Html{i == chosen ? " selected" : ""}, choices.all[i].label);
    out += html("<label class=\"choose\">{}: <select data-side=\"{}\">\n{}</select></label>\n", side, side,
                options);
  }
  return out;
}

}  // namespace

Html escaped(std::string_view text, std::size_t max_length) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    if (i >= max_length) return {out + "…"};
    const std::size_t length = utf8_length(text, i);
    out += length == 0 ? kReplacement : inert(text.substr(i, length));
    i += std::max<std::size_t>(length, 1);
  }
  return {out};
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= count ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return out;
}

std::string grouped(std::uint64_t number) {
  const std::string digits = std::to_string(number);
  std::string out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) out += "\u202F";
    out += digits[i];
  }
  return out;
}

Html image_html(const Figure& figure) {
  const int factor = enlargement(figure.image);
  return html(R"(<img{} src="data:image/png;base64,{}" width="{}" height="{}" alt="{}"{}>)",
              figure.id.empty() ? Html{} : html(" id=\"{}\"", figure.id),
              Html{base64(encode_png(figure.image))}, factor * figure.image.width,
              factor * figure.image.height, escaped(figure.alt, 1000),
              Html{factor > 1 ? " class=\"enlarged\"" : ""});
}

Html figure_html(const Figure& figure) {
  return html("<figure>{}<figcaption>{}</figcaption></figure>\n", image_html(figure), figure.caption);
}

Html pair_html(std::string_view name, const Figure& left, const Figure& right, const PairChoices& choices) {
  return html(R"(<div class="pair" data-mode="two-up" style="--picture-width:{0}px;--ratio:{1}/{2}">
<div class="controls" hidden>
<fieldset><legend>Show the pictures</legend>
<label><input type="radio" name="{3}" value="two-up" checked>side by side</label>
<label><input type="radio" name="{3}" value="swipe">swipe</label>
<label><input type="radio" name="{3}" value="flip">in place</label>
</fieldset>
<button type="button" class="flip" aria-keyshortcuts="F">Flip <kbd>F</kbd></button>
{4}</div>
<div class="stage">
{5}{6}<div class="cover"><input type="range" min="0" max="1000" step="5" value="500" aria-label="Where the left picture ends and the right one begins"></div>
</div>
</div>
)",
              enlargement(left.image) * left.image.width, left.image.width, left.image.height, name,
              choosers(choices), figure_html(left), figure_html(right));
}

Html steps_html(std::string_view name, const std::vector<StepPage>& pages) {
  Html buttons, items;
  for (const StepPage& page : pages) {
    buttons += html(R"(<label><input type="radio" name="{}"{}>{}</label>
)",
                    name, Html{buttons.empty() ? " checked" : ""}, page.label);
    items += html("<li>{}</li>\n", page.content);
  }
  return html(R"(<div class="steps">
<div class="controls" hidden>
<fieldset><legend>Show the step</legend>
{}</fieldset>
<button type="button" class="back">Back</button>
<button type="button" class="next">Next</button>
</div>
<ol>
{}</ol>
</div>
)",
              buttons, items);
}

Html table_html(const Table& table) {
  Html head, rows;
  const auto style = [&](std::size_t column) {
    const bool words =
        std::find(table.of_words.begin(), table.of_words.end(), column) != table.of_words.end();
    return Html{words ? " class=\"words\"" : ""};
  };
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    head += html("<th scope=\"col\"{}>{}</th>", style(c), table.columns[c]);
  for (const std::vector<Html>& row : table.rows) {
    rows += html("<tr><th scope=\"row\">{}</th>", row.front());
    for (std::size_t c = 1; c < row.size(); ++c) rows += html("<td{}>{}</td>", style(c), row[c]);
    rows += html("</tr>\n");
  }
  if (!head.empty()) head = html("<thead><tr>{}</tr></thead>\n", head);
  const Html whole = html("<table{}><caption>{}</caption>\n{}<tbody>\n{}</tbody></table>\n",
                          Html{table.sortable ? " class=\"sortable\"" : ""}, table.caption, head, rows);
  if (!table.sortable) return whole;
  return html("<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{}\">\n{}</div>\n",
              table.caption, whole);
}

// The policy forbids every request, whatever the page holds.
std::string page_html(std::string_view title, const Html& body) {
  return html(R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="sidelight )" SIDELIGHT_VERSION R"(">
<title>{}</title>
<style>{}{}</style>
</head>
<body>
<main>
{}</main>
<script>{}</script>
</body>
</html>
)",
              title, Html{plot_style()}, Html{std::string(kPageStyle)}, body, Html{std::string(kPageScript)})
      .markup;
}

}  // namespace sidelight
