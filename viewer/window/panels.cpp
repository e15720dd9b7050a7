// SPDX-License-Identifier: MIT
#include "viewer/window/panels.h"

namespace sidelight {

std::string traced_name(const TraceSettings& trace) {
  std::string terms;
  const auto add = [&](bool on, const char* name) {
    if (on) terms += (terms.empty() ? "" : ", ") + std::string(name);
  };
  add(trace.shadows, "shadows");
  add(trace.reflection, "mirrors");
  add(trace.refraction, "glass");
  return "ray tracer: " + (terms.empty() ? "local light only" : terms);
}

LayoutOptions layout_options(const Labels& labels) {
  return {1, !labels.title.empty(), labels.left.times || labels.right.times, false};
}

}  // namespace sidelight
