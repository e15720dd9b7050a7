// SPDX-License-Identifier: MIT
#include "viewer/commands/all_modes.h"

#include <fmt/format.h>

#include <span>

#include "common/picture/compare.h"
#include "common/picture/layer_picture.h"
#include "common/picture/signed_difference.h"

namespace sidelight {
namespace {

void write_layers(const Job& job, const std::string& folder, const Renderer& renderer, const Frame& frame) {
  const Metadata metadata = job_metadata(job, std::string(renderer.name));
  for (int i = 0; i < kLayers; ++i) {
    const auto layer = static_cast<Layer>(i);
    if (!(renderer.layers & layer_bit(layer))) continue;
    const std::string_view name = kLayerNames[static_cast<std::size_t>(i)];
    write_png(fmt::format("{}/{}_{}.png", folder, renderer.name, name), layer_picture(frame, layer),
              metadata);
  }
}

}  // namespace

void write_all_modes(const Job& job, const std::string& folder, const Frame& rastered, const Frame& traced) {
  make_folder(folder);
  write_layers(job, folder, *find_renderer("raster"), rastered);
  write_layers(job, folder, *find_renderer("raytrace"), traced);

  const Metadata both = job_metadata(job, "raster, raytrace");
  const auto write = [&](const std::string& name, std::span<const glm::vec3> linear) {
    write_png(folder + "/" + name, to_image8(linear, traced.width(), traced.height()), both);
  };
  constexpr std::array<const char*, 4> kSteps{"1_raster", "2_minus_shadow", "3_plus_reflection",
                                              "4_plus_refraction"};
  const auto sums = ledger_sums(rastered, traced);
  for (std::size_t k = 0; k < sums.size(); ++k) write(fmt::format("ledger_{}.png", kSteps[k]), sums[k]);
  write("signed_difference.png", signed_difference(rastered, traced));
}

}  // namespace sidelight
