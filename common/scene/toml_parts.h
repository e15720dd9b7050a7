// SPDX-License-Identifier: MIT
// The tables of a scene file beside its objects: [picture], [camera], [trace], [[light]] and [material.NAME]. Called by
// toml.cpp. InputError for every mistake.
#pragma once

#include "common/scene/scene.h"
#include "common/scene/toml_objects.h"
#include "common/scene/toml_values.h"

namespace sidelight::scene_file {

void read_picture(const Value& value, Scene& scene);
void read_camera(const Value& value, CameraSettings& camera);
void read_trace(const Value& value, TraceSettings& trace);
Light read_light(const Document& document, const toml::table& source);

// All of [material], into the scene in the order of the file; their numbers by name.
MaterialNames read_materials(const Value& value, Scene& scene);

}  // namespace sidelight::scene_file
