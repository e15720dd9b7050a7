// SPDX-License-Identifier: MIT
#include "viewer/window/panels.h"

namespace sidelight {

std::string traced_name(const TraceSettings& trace) {
  std::string terms;
  for (const std::string& term : traced_terms(trace)) terms += (terms.empty() ? "" : ", ") + term;
  return "ray tracer: " + (terms.empty() ? "local light only" : terms);
}

LayoutOptions layout_options(const Labels& labels) {
  return {1, !labels.title.empty(), labels.left.times || labels.right.times, false};
}

}  // namespace sidelight
