// SPDX-License-Identifier: MIT
// The colours of everything, light and dark, and how plots look. Text has a contrast of at least 4.5 to its ground, a curve
// one of at least 3.
#include <array>

#include "viewer/report/html.h"

namespace sidelight {
namespace {

struct Color {
  std::string_view name, light, dark;
};
constexpr std::array<Color, 15> kColors{{{"paper", "#fff", "#14161a"},
                                         {"ink", "#1b1d22", "#e9ebef"},
                                         {"quiet", "#575c66", "#a7adb8"},
                                         {"rule", "#d5d8de", "#3a3f49"},
                                         {"panel", "#f4f5f7", "#1e2127"},
                                         {"accent", "#0b5cad", "#7cb8f5"},
                                         {"on-accent", "#fff", "#10131a"},
                                         {"bad", "#a8201a", "#ff8a80"},
                                         {"beaten", "#a0a4ac", "#6d737e"},
                                         {"c0", "#0072b2", "#56b4e9"},
                                         {"c1", "#c44e00", "#ff8a3d"},
                                         {"c2", "#00835f", "#2bc49a"},
                                         {"c3", "#a2457f", "#e59ac8"},
                                         {"c4", "#8a6100", "#e6b93c"},
                                         {"c5", "#1b1d22", "#e9ebef"}}};

constexpr std::string_view kRules = R"css(
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
  for (const Color& color : kColors) out += fmt::format("--{}: {}; ", color.name, color.*shade);
  return out;
}

std::string rules_with_values(std::string_view Color::*shade) {
  std::string out(kRules);
  for (const Color& color : kColors) {
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
                     definitions(&Color::light), definitions(&Color::dark), kRules);
}

std::string plot_file_style() {
  return fmt::format(R"css(
:root {{ color-scheme: light dark; }}{}@media (prefers-color-scheme: dark) {{{}}}
)css",
                     rules_with_values(&Color::light), rules_with_values(&Color::dark));
}

}  // namespace sidelight
