// SPDX-License-Identifier: MIT
#include "viewer/commands/primary_flag.h"

#include <fmt/format.h>

namespace sidelight {

void add_primary_flag(CLI::App& verb, JobFlags& flags) {
  verb.add_option("--primary", flags.primary,
                  "rays, or raster: the z-buffer finds what the ray tracer's samples show")
      ->type_name("WHO")
      ->check(CLI::IsMember({"rays", "raster"}).description(""))
      ->capture_default_str();
}

const Renderer& with_primary(const Job& job, const Renderer& renderer) {
  if (!job.flags.from_raster()) return renderer;
  if (renderer.name != "raytrace")
    throw UsageError(fmt::format("--primary raster is for the renderer 'raytrace'; got '{}'", renderer.name));
  if (job.options.faults.any())
    throw UsageError(
        fmt::format("--primary raster goes with no faults on purpose; got {}", job.options.faults.text()));
  return kRaytraceFromRaster;
}

}  // namespace sidelight
