// SPDX-License-Identifier: MIT
#include "viewer/commands/result_json.h"

#include <fmt/format.h>

#include "common/picture/atomic_file.h"

namespace sidelight {

Json triple_json(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

void add_crop(Json& json, const Rect& part, int full_width, int full_height) {
  if (part != Rect{0, 0, full_width, full_height}) json["crop"] = {part.x0, part.y0, part.x1, part.y1};
}

Json metrics_json(const Metrics& m) {
  constexpr std::array<const char*, 3> kChannels{"R", "G", "B"};
  return {{"max",
           {{"value", m.max.value},
            {"x", m.max.x},
            {"y", m.max.y},
            {"channel", kChannels[static_cast<std::size_t>(m.max.channel)]}}},
          {"mean", m.mean},
          {"rms", m.rms},
          {"psnr", or_null(m.psnr)}};
}

void write_json(const std::string& path, const Json& json) {
  const std::string text = json.dump(2) + "\n";
  if (path == "-")
    fmt::print("{}", text);
  else
    write_text_file(path, text);
}

Json spread_json(const Spread& spread) {
  return {{"min", spread.min}, {"median", spread.median}, {"max", spread.max}};
}

}  // namespace sidelight
