// SPDX-License-Identifier: MIT
// How a report looks: one column of text, pictures as wide as there is room, light or dark as the reader's system is; and
// how plots do. Text has a contrast of at least 4.5 to its ground, a curve or a mark one of at least 3.
#include <array>

#include "viewer/report/html.h"

namespace sidelight {
namespace {

// The colours of everything.
struct Color {
  std::string_view name, light, dark;
};
constexpr std::array<Color, 15> kPalette{{{"paper", "#fff", "#14161a"},
                                          {"ink", "#1b1d22", "#e9ebef"},
                                          {"quiet", "#575c66", "#a7adb8"},
                                          {"rule", "#d5d8de", "#3a3f49"},
                                          {"panel", "#f4f5f7", "#1e2127"},
                                          {"accent", "#0b5cad", "#7cb8f5"},
                                          {"on-accent", "#fff", "#10131a"},
                                          {"bad", "#a8201a", "#ff8a80"},
                                          {"beaten", "#868b94", "#6d737e"},
                                          {"c0", "#0072b2", "#56b4e9"},
                                          {"c1", "#c44e00", "#ff8a3d"},
                                          {"c2", "#00835f", "#2bc49a"},
                                          {"c3", "#a2457f", "#e59ac8"},
                                          {"c4", "#8a6100", "#e6b93c"},
                                          {"c5", "#1b1d22", "#e9ebef"}}};

constexpr std::string_view kPlotStyle = R"css(
svg { font: 13px system-ui, "Segoe UI", Arial, "DejaVu Sans", sans-serif; fill: var(--ink); overflow: hidden; }
svg .grid { stroke: var(--rule); stroke-width: 1; fill: none; }
svg .frame { stroke: var(--quiet); stroke-width: 1.2; fill: none; }
svg .quiet { fill: var(--quiet); }
svg .curve { fill: none; stroke-width: 2.2; stroke-linejoin: round; stroke-linecap: round; }
svg .lobe { fill: var(--c0); fill-opacity: 0.18; stroke: var(--c0); stroke-width: 2; stroke-linejoin: round; }
svg .c0 { stroke: var(--c0); } svg .c1 { stroke: var(--c1); } svg .c2 { stroke: var(--c2); }
svg .c3 { stroke: var(--c3); } svg .c4 { stroke: var(--c4); } svg .c5 { stroke: var(--c5); }
svg .paper { fill: var(--paper); }
svg .floor { stroke: var(--quiet); stroke-width: 1; stroke-dasharray: 2 4; fill: none; }
svg .staircase { stroke: var(--ink); stroke-width: 1.6; fill: none; stroke-linejoin: round; }
svg .thread, svg .leader, svg .whisker { stroke: var(--quiet); stroke-width: 0.8; fill: none; }
svg .thread { stroke-dasharray: 1 3; stroke-linecap: round; }
svg .label { font-size: 12px; paint-order: stroke; stroke: var(--paper); stroke-width: 3px; stroke-linejoin: round; }
svg .reason { fill: var(--bad); }
svg .s0 { color: var(--c0); } svg .s1 { color: var(--c1); } svg .s2 { color: var(--c2); }
svg .s3 { color: var(--c3); } svg .s4 { color: var(--c4); } svg .s5 { color: var(--c5); }
svg .shape { fill: currentColor; stroke: var(--paper); stroke-width: 1; }
svg .beaten .shape { fill: var(--beaten); }
svg .failed .shape { fill: var(--paper); stroke: currentColor; stroke-width: 1.8; }
svg .good .whisker { stroke: currentColor; stroke-width: 1.2; }
svg .reach { fill: none; stroke: none; pointer-events: all; }
svg .mark.shown .reach { stroke: currentColor; stroke-width: 1.5; }
svg .mark:focus { outline: none; }
svg .mark:focus .reach { stroke: var(--accent); stroke-width: 3; }
)css";

std::string definitions(std::string_view Color::*shade) {
  std::string out;
  for (const Color& color : kPalette) out += fmt::format("--{}: {}; ", color.name, color.*shade);
  return out;
}

std::string rules_with_values(std::string_view Color::*shade) {
  std::string out(kPlotStyle);
  for (const Color& color : kPalette) {
    const std::string variable = fmt::format("var(--{})", color.name);
    for (std::size_t at = 0; (at = out.find(variable, at)) != std::string::npos;)
      out.replace(at, variable.size(), color.*shade);
  }
  return out;
}

}  // namespace

std::string plot_style() {
  return fmt::format(R"css(
:root {{ color-scheme: light dark; {}}}
@media (prefers-color-scheme: dark) {{ :root {{ {}}} }}{})css",
                     definitions(&Color::light), definitions(&Color::dark), kPlotStyle);
}

std::string plot_file_style() {
  return fmt::format(R"css(
:root {{ color-scheme: light dark; }}{}@media (prefers-color-scheme: dark) {{{}}}
)css",
                     rules_with_values(&Color::light), rules_with_values(&Color::dark));
}

const std::string_view kPageStyle = R"css(
* { box-sizing: border-box; }
body {
  margin: 0; background: var(--paper); color: var(--ink);
  font: 1.0625rem/1.55 system-ui, "Segoe UI", "Helvetica Neue", Arial, "DejaVu Sans", sans-serif;
  overflow-wrap: anywhere;
}
main { max-width: 84rem; margin: 0 auto; padding: 2.5rem clamp(1rem, 3vw, 2.5rem) 4rem; }
h1, h2, h3 { line-height: 1.2; text-wrap: balance; overflow: clip; overflow-clip-margin: 0.2em; }
h1 { font-size: clamp(1.9rem, 4vw, 2.9rem); font-weight: 650; letter-spacing: -0.015em; margin: 0.2rem 0 1rem; }
h2 { font-size: 1.6rem; font-weight: 650; letter-spacing: -0.01em; margin: 3.5rem 0 0.6rem;
     padding-top: 1.2rem; border-top: 1px solid var(--rule); }
h3 { font-size: 1.15rem; margin: 0 0 0.4rem; }
.lobes + h3, .lobes + .quiet { margin-top: 2rem; }
p, figcaption, table { max-width: 46rem; }
p { margin: 0 0 1rem; }
.lesson { font-size: 1.15rem; overflow: clip; overflow-clip-margin: 0.3em; }
.over, .quiet, figcaption, caption { color: var(--quiet); }
.over { margin: 0; }
.verdict { border-left: 0.3rem solid var(--accent); padding: 0.3rem 0 0.3rem 1rem; margin: 1.5rem 0; }
.verdict.bad { border-color: var(--bad); }
.verdict strong { font-size: 1.15rem; }
code, kbd { font-family: ui-monospace, "Cascadia Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace;
            font-size: 0.9em; }
kbd { border: 1px solid; border-radius: 0.2rem; padding: 0 0.35em; opacity: 0.8; }
.pair:not(:focus-within) kbd { visibility: hidden; }   /* the key counts where the focus is in the pair */
pre { background: var(--panel); border: 1px solid var(--rule); border-radius: 0.4rem; padding: 0.8rem 1rem;
      margin: 0 0 1rem; white-space: pre-wrap; }
pre.lesson { font-size: 1rem; }
pre .quiet { user-select: none; }
.formula { font: italic 1.35rem/1.5 "Iowan Old Style", Palatino, Georgia, "DejaVu Serif", serif; }

figure { margin: 0; min-width: 0; }
figcaption { margin-top: 0.5rem; font-size: 0.95rem; line-height: 1.45; }
figcaption b { color: var(--ink); }
img, svg { display: block; max-width: 100%; height: auto; }
.enlarged { image-rendering: pixelated; }
.columns { display: grid; gap: 1.5rem; grid-template-columns: repeat(auto-fit, minmax(min(26rem, 100%), 1fr)); }
.lobes { display: grid; gap: 1.5rem 1rem; grid-template-columns: repeat(auto-fill, minmax(min(15rem, 100%), 1fr)); }

table { border-collapse: collapse; min-width: min(100%, 30rem); margin: 1rem 0 1.5rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; padding-bottom: 0.4rem; }
th, td { padding: 0.35rem 1.6rem 0.35rem 0; border-bottom: 1px solid var(--rule); text-align: left;
         vertical-align: top; font-weight: 400; }
thead th { color: var(--quiet); font-size: 0.92rem; }
thead th:not(:first-child), td { text-align: right; padding-right: 0.4rem; padding-left: 1.2rem; }
thead th, thead + tbody th, thead + tbody td { overflow-wrap: normal; }
@media (max-width: 30rem) {
  thead th, thead + tbody { font-size: 0.85rem; }
  thead th, thead + tbody th { padding-right: 0; }
  thead th:not(:first-child), thead + tbody td { padding-right: 0; padding-left: 0.5rem; }
}
.swatch { display: inline-block; width: 0.85em; height: 0.85em; margin-right: 0.5em; border-radius: 0.15em;
          border: 1px solid var(--quiet); vertical-align: -0.08em; }
.scale { max-width: 46rem; margin-top: 0.8rem; }
.scale img { width: 100%; height: 1rem; image-rendering: pixelated; }
.scale .histogram { width: 100%; height: 5rem; fill: var(--quiet); }
.scale div { display: flex; justify-content: space-between; font-size: 0.9rem; font-variant-numeric: tabular-nums; }

.controls:not([hidden]) { display: flex; flex-wrap: wrap; align-items: center; gap: 0.6rem; margin: 0.5rem 0 1rem; }
fieldset { border: 0; margin: 0; padding: 0; display: flex; flex-wrap: wrap; min-width: 0; }
legend { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
.controls label, button { font: inherit; line-height: 1.3; padding: 0.45rem 1rem; background: var(--panel);
                          color: var(--ink); border: 1px solid var(--rule); cursor: pointer; }
button { border-radius: 0.4rem; }
.controls label { margin-left: -1px; }
.controls label:first-of-type { border-radius: 0.4rem 0 0 0.4rem; margin-left: 0; }
.controls label:last-of-type { border-radius: 0 0.4rem 0.4rem 0; }
.controls label:has(input:checked) { background: var(--accent); color: var(--on-accent); border-color: var(--accent); }
.controls label input { position: absolute; opacity: 0; pointer-events: none; }
:focus-visible, .controls label:has(:focus-visible), .cover:focus-within {
  outline: 3px solid var(--accent); outline-offset: 3px; z-index: 1;
}

/* Two pictures: beside each other; else in one cell, as large as the window allows. */
.stage { display: grid; gap: 1.5rem; grid-template-columns: repeat(auto-fit, minmax(min(20rem, 100%), 1fr));
         position: relative; }
.cover { display: none; }
.pair:not([data-mode=two-up]) .stage {
  grid-template-columns: 1fr;
  width: min(100%, 2 * var(--picture-width), (100vh - 9rem) * var(--ratio));
}
.pair:not([data-mode=two-up]) .stage > * { grid-area: 1 / 1; }
.pair:not([data-mode=two-up]) img { width: 100%; }
.pair[data-mode=swipe] .cover { display: block; position: relative; width: 100%; aspect-ratio: var(--ratio);
                                align-self: start; }
.pair[data-mode=swipe] .cover::after {
  content: "\2194"; position: absolute; top: 0; bottom: 0; left: var(--at); width: 2px; margin-left: -1px;
  background: #fff; box-shadow: 0 0 0 1px #000; pointer-events: none;
  display: grid; place-content: center; font: 1.3rem/2rem sans-serif; color: #fff; text-shadow: 0 0 2px #000, 0 0 6px #000;
}
.pair[data-mode=swipe] input[type=range] { position: absolute; inset: 0; width: 100%; height: 100%; margin: 0;
                                           opacity: 0; cursor: ew-resize; touch-action: pan-y; }
.pair[data-mode=swipe] figure:nth-of-type(2) img { clip-path: inset(0 0 0 var(--at)); }
.pair[data-mode=swipe] figure:nth-of-type(1) figcaption { margin-right: 52%; }
.pair[data-mode=swipe] figure:nth-of-type(2) figcaption { margin-left: 52%; text-align: right; }
.pair[data-mode=flip] figure { visibility: hidden; }
.pair[data-mode=flip][data-shown=left] figure:nth-of-type(1),
.pair[data-mode=flip][data-shown=right] figure:nth-of-type(2) { visibility: visible; }

/* Steps: all below each other, or one at a time in the same place. */
.steps ol { list-style: none; margin: 0; padding: 0; }
.steps li { margin: 0 0 3rem; }
.steps.one li { display: none; margin: 0; }
.steps.one li.shown { display: block; }
.step { display: grid; gap: 1rem 1.5rem; grid-template-columns: minmax(0, 1fr) minmax(0, 2fr); }
.step > :last-child img { width: min(100%, 60rem); }
.terms figure { display: grid; gap: 0.8rem; grid-template-columns: minmax(0, 15rem) minmax(max-content, 1fr);
                margin-bottom: 0.8rem; }
.terms figcaption { margin: 0; align-self: end; }
@media (max-width: 46rem) { .step { grid-template-columns: minmax(0, 1fr); } }

/* A bench: the plot and what its marks point to; many pictures in small; tables with more columns than a page has room. */
.bench h3 { margin-top: 2.6rem; }
.explore { display: grid; gap: 1rem 2rem; grid-template-columns: minmax(0, 680px); align-items: start; }
.pointed p { margin: 0 0 0.8rem; font-size: 0.95rem; line-height: 1.45; min-height: 3em; }
.pointed .columns { gap: 0.8rem; grid-template-columns: repeat(auto-fit, minmax(min(12rem, 100%), 1fr)); }
.pointed img, .gallery img { width: 100%; }
@media (min-width: 72rem) {
  .explore:has(.pointed:not([hidden])) { grid-template-columns: minmax(0, 680px) minmax(0, 1fr); }
  .pointed .columns { grid-template-columns: minmax(0, 1fr); max-width: 20rem; }
}
.small { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fit, minmax(min(20rem, 100%), 1fr)); }
.kinds figure { display: flex; flex-direction: column; justify-content: space-between; }
.kinds figcaption { margin: 0; }
.small svg { width: 100%; max-width: 28rem; margin-top: 0.4rem; }
.gallery { display: grid; gap: 1.4rem 1rem; grid-template-columns: repeat(auto-fill, minmax(min(11rem, 100%), 1fr)); }
.gallery img { margin-bottom: 0.3rem; }
.gallery .same { aspect-ratio: var(--ratio); margin: 0 0 0.3rem; border: 1px solid var(--rule); padding: 0.5rem;
                 display: grid; place-content: center; text-align: center; font-size: 0.85rem; line-height: 1.35; }
.gallery figcaption { font-size: 0.85rem; line-height: 1.35; margin-top: 0.2rem; }
.bench .pair[data-mode=two-up] .stage {
  grid-template-columns: repeat(2, minmax(0, var(--picture-width)));
}
@media (max-width: 36rem) { .bench .pair[data-mode=two-up] .stage { grid-template-columns: minmax(0, 1fr); } }
.wide { overflow-x: auto; }
.wide table { max-width: none; font-size: 0.92rem; }
.wide th, .wide td { white-space: nowrap; }
.wide th, .wide td { padding-top: 0.2rem; padding-bottom: 0.2rem; }
.wide thead th:not(:first-child), .wide td { padding-left: 0.9rem; }
.wide thead th.words, .wide td.words { text-align: left; }
.wide tbody tr:hover { background: var(--panel); }
th button { font: inherit; color: inherit; background: none; border: 0; padding: 0; text-align: inherit; }
th button::after { content: "\2195"; opacity: 0.3; margin-left: 0.3em; }
th[aria-sort=ascending] button::after { content: "\2191"; opacity: 1; }
th[aria-sort=descending] button::after { content: "\2193"; opacity: 1; }
.controls label.choose { background: none; border: 0; padding: 0.45rem 0; margin: 0; cursor: auto; min-width: 0; }
select { font: inherit; max-width: 100%; padding: 0.4rem 0.5rem; background: var(--panel); color: var(--ink);
         border: 1px solid var(--rule); border-radius: 0.4rem; }
.facts th { white-space: nowrap; }
.facts td { text-align: left; }
@page numbers { size: landscape; }
@media print {
  main { padding: 0; }
  .controls { display: none !important; }
  .steps.one li { display: block; }
  h2, p, figure, li, table { break-inside: avoid; }
  h2, h3, p:has(+ pre) { break-after: avoid; }
  .numbers { page: numbers; }
  .wide { overflow: visible; }
  .wide table { font-size: 0.6rem; break-inside: auto; }
  .wide th, .wide td { font-size: inherit; padding-right: 0; }
  .wide th, .wide td.words { white-space: normal; }
  .wide thead th:not(:first-child), .wide td { padding-left: 0.35rem; }
  th button::after { display: none; }
}
)css";

}  // namespace sidelight
