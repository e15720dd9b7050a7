// SPDX-License-Identifier: MIT
// What stands around the pictures: their captions with names and times, in the window and as `compare` draws them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "viewer/window/layout.h"

namespace sidelight {

struct Times {
  double build_ms = 0, frame_ms = 0;
  std::string rate = {};  // "3.1 M rays/s"; empty: not said
};

// Text over one picture. Any text may be given: control characters and broken UTF-8 are shown as \xNN, and
// what is longer than its line ends in an ellipsis.
struct Caption {
  std::string name;
  std::optional<Times> times;  // absent: no line of times (--no-times)
};

// What the tracer's picture holds that a z-buffer's does not: "shadows", "mirrors", "glass", of these what is on; of eye
// rays alone (depth 1) the first at most. Here, since the window's library builds on that of the reports, which have
// these words too.
inline std::vector<std::string> traced_terms(const TraceSettings& trace) {
  std::vector<std::string> out;
  if (trace.shadows) out.emplace_back("shadows");
  if (trace.reflection && trace.depth > 1) out.emplace_back("mirrors");
  if (trace.refraction && trace.depth > 1) out.emplace_back("glass");
  return out;
}

// "ray tracer: shadows, mirrors, glass".
std::string traced_name(const TraceSettings& trace);

struct Labels {
  std::string title;  // of the scene; empty: no title line
  Caption left{"z-buffer: local light only", {}};
  Caption right{traced_name({}), {}};
};

// The lines that these labels need.
LayoutOptions layout_options(const Labels& labels);

}  // namespace sidelight
