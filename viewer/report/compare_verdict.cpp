// SPDX-License-Identifier: MIT
// What a report of a comparison says first: whether every pixel is accounted for.
#include "viewer/report/compare_report.h"

namespace sidelight {

Html verdict_html(const CompareReport& report) {
  constexpr const char* kTaken = "The ray tracer took the z-buffer's surfaces: that they agree says nothing.";
  const Comparison& result = report.result;
  const Html pixels{grouped(report.traced.pixels())};
  const std::string held = traced_words(report.scene.trace), words = held.empty() ? "terms" : held;
  if (result.agrees() && report.from_raster)
    return html(R"(<p class="verdict"><strong>Every pixel is accounted for.</strong><br>
{} Where the pictures differ, the {} below explain it: 0 unexplained of {} pixels.</p>
)",
                Html{kTaken}, words, pixels);
  if (result.agrees())
    return html(R"(<p class="verdict"><strong>Every pixel is accounted for.</strong><br>
Both renderers see the same surface at the same depth on every sample, and where their pictures differ, the {}
below explain it: 0 visibility mismatches, 0 unexplained of {} pixels.</p>
)",
                words, pixels);
  Html where;
  if (result.visibility_mismatches > 0)
    where += html(" First mismatch at pixel {},{}.", result.mismatch_x, result.mismatch_y);
  if (result.unexplained > 0)
    where += html(" First unexplained pixel at {},{}.", result.unexplained_x, result.unexplained_y);
  if (result.spoiled > 0)
    where += html(" {} pixels are spoiled by faults put in on purpose, and in neither count.",
                  Html{grouped(result.spoiled)});
  if (report.from_raster) where += html(" {}", Html{kTaken});
  return html(R"(<p class="verdict bad"><strong>Not every pixel is accounted for.</strong><br>
{} visibility mismatches, {} unexplained pixels.{}</p>
)",
              Html{grouped(result.visibility_mismatches)}, Html{grouped(result.unexplained)}, where);
}

}  // namespace sidelight
