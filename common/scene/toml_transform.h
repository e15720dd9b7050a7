// SPDX-License-Identifier: MIT
// The `transform` of a mesh: T Rz Ry Rx S of `translate`, `rotate` (degrees) and `scale`, or `matrix`, 16 numbers row by
// row. Quarter turns are exact.
#pragma once

#include "common/scene/build.h"
#include "common/scene/toml_values.h"

namespace sidelight::scene_file {

// InputError for every mistake.
Transform read_transform(const Value& value);

}  // namespace sidelight::scene_file
