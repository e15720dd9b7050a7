// SPDX-License-Identifier: MIT
#include "viewer/window/frame_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sidelight {
namespace {

// "median 3.10, p99 8.72, max 11.03 ms (2024)"; the percentile by the nearest rank.
std::string spread(std::vector<double> values) {
  if (values.empty()) return "none";
  std::sort(values.begin(), values.end());
  const auto rank = [&](double part) {
    const auto number = static_cast<std::size_t>(std::ceil(part * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(number, 1) - 1];
  };
  return fmt::format("median {:.2f}, p99 {:.2f}, max {:.2f} ms ({})", rank(0.5), rank(0.99), values.back(),
                     values.size());
}

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{:.3f}", *value) : ""; }

}  // namespace

void FrameLog::add(const FrameTime& time, const Pictures& shown) {
  Line line{time, {}, {}};
  const double asked = shown.task.asked_ms, waited = time.at + time.draw + time.swap - asked;
  if (shown.rastered && asked != zbuffer_of_) line.to_zbuffer = waited;
  if (shown.block > 0 && asked != traced_of_) line.to_traced = waited;
  if (line.to_zbuffer) zbuffer_of_ = asked;
  if (line.to_traced) traced_of_ = asked;
  lines_.push_back(line);
}

std::string FrameLog::csv() const {
  std::string out = "at,prepare,upload,draw,swap,to_zbuffer,to_traced\n";
  for (const auto& [time, to_zbuffer, to_traced] : lines_)
    out += fmt::format("{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{},{}\n", time.at - lines_.front().time.at,
                       time.prepare, time.upload, time.draw, time.swap, cell(to_zbuffer), cell(to_traced));
  return out;
}

std::string FrameLog::summary() const {
  std::vector<double> whole, own, to_zbuffer, to_traced, between;
  std::optional<double> before;
  for (const Line& line : lines_) {
    whole.push_back(line.time.total());
    own.push_back(line.time.prepare + line.time.upload);
    if (line.to_traced) to_traced.push_back(*line.to_traced);
    if (!line.to_zbuffer) continue;
    to_zbuffer.push_back(*line.to_zbuffer);
    if (before) between.push_back(line.time.at - *before);
    before = line.time.at;
  }
  return fmt::format(
      "a frame:                  {}\n"
      "  of it, pictures:        {}\n"
      "input to z-buffer:        {}\n"
      "input to first traced:    {}\n"
      "from z-buffer to z-buffer: {}\n",
      spread(whole), spread(own), spread(to_zbuffer), spread(to_traced), spread(between));
}

}  // namespace sidelight
