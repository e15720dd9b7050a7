// SPDX-License-Identifier: MIT
// --primary, for the verbs that render: who finds what each sample shows.
#pragma once

#include <CLI/App.hpp>

#include "viewer/commands/renderers.h"

namespace sidelight {

void add_primary_flag(CLI::App& verb, JobFlags& flags);

// The renderer, or what stands for it where the job takes its primary surfaces from the z-buffer. Throws UsageError
// where they cannot serve: for another renderer than raytrace, and with faults on purpose.
const Renderer& with_primary(const Job& job, const Renderer& renderer);

}  // namespace sidelight
