// SPDX-License-Identifier: MIT
// The report of a comparison: one page that shows both pictures, tells what differs and why, builds the right picture
// from the left one term by term, and says how to go on.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/picture/compare.h"
#include "common/picture/image_io.h"
#include "common/scene/scene.h"
#include "viewer/report/html.h"
#include "viewer/window/panels.h"

namespace sidelight {

struct CompareReport {
  const Scene& scene;
  const Frame& rastered;  // with kRasterLayers
  const Frame& traced;    // with kLedgerLayers
  const Comparison& result;
  Metadata settings;            // what was rendered, shown as a table
  std::string explain_command;  // for the pixel of greatest difference; what to type, as view_command
  std::string view_command;
  std::optional<Times> raster_times, traced_times;
  // Put in on purpose: which, and the pixels that it spoils.
  std::vector<std::pair<std::string, std::uint64_t>> faults;
  bool from_raster = false;  // the tracer took the z-buffer's surfaces (--primary raster)
};

// The page. Pictures of more than 2^22 pixels are embedded reduced by a whole factor, which the page says. Equal
// arguments give equal bytes.
std::string compare_report(const CompareReport& report);

// ---- Its parts in files of their own ----

// "shadows, mirrors and glass": of these what the tracer's picture holds (traced_terms); empty where that is none.
std::string traced_words(const TraceSettings& trace);

// Whether every pixel is accounted for, in a paragraph.
Html verdict_html(const CompareReport& report);

// A scene's lesson as paragraphs, which blank lines part; other line breaks are those of the file, not of the page. An
// indented line that begins with "sidelight " is a command and stays a line; what stands behind two blanks in it is a
// remark. Cut after 4000 bytes.
Html lesson_html(std::string_view lesson);

// The section on highlights: what cos^s looks like for the materials with a specular coefficient, the first kMostCurves in
// the order of the file; how many were left out is said. Empty where there is none.
Html highlights_html(const std::vector<Material>& materials);

}  // namespace sidelight
