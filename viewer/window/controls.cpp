// SPDX-License-Identifier: MIT
// The sliders: what may be changed in the scene while it is looked at, and slow motion.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "common/error.h"
#include "viewer/window/canvas.h"
#include "viewer/window/paint.h"
#include "viewer/window/window_panels.h"

namespace sidelight {
namespace {

using Commands = std::vector<Command>;

template <class Change>
void edit(Commands& out, Change change) {
  out.push_back([change](Session& session) { session.edit(change); });
}

// Doubles on a slider; true while they are being changed.
bool slide(const char* label, double& value, double low, double high, const char* format = "%.2f",
           int flags = 0) {
  return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format, flags);
}
bool slide(const char* label, glm::dvec3& value, double low, double high) {
  return ImGui::SliderScalarN(label, ImGuiDataType_Double, &value.x, 3, &low, &high, "%.2f");
}

void heading(const Canvas& canvas, const char* words) {
  ImGui::Spacing();
  ImGui::PushFont(canvas.fonts().caption);
  ImGui::TextUnformatted(words);
  ImGui::PopFont();
}

void draw_trace(const WindowState& state, Commands& out) {
  TraceSettings trace = state.scene->trace;
  bool changed = ImGui::SliderInt("depth", &trace.depth, 1, 12, "%d", ImGuiSliderFlags_AlwaysClamp);
  changed = ImGui::Checkbox("shadows", &trace.shadows) || changed;
  ImGui::SameLine();
  changed = ImGui::Checkbox("mirrors", &trace.reflection) || changed;
  ImGui::SameLine();
  changed = ImGui::Checkbox("glass", &trace.refraction) || changed;
  // w(r) = 1 / max(1, q0 + q1 r + q2 r²), of which q1 is what the lecture turns.
  changed = slide("w(r): q1", trace.secondary_attenuation.q1, 0, 1) || changed;
  changed = slide("w(r): q2", trace.secondary_attenuation.q2, 0, 1) || changed;
  if (changed) edit(out, [trace](Scene& scene) { scene.trace = trace; });

  int n = state.n;
  if (ImGui::SliderInt("samples", &n, 1, state.opened.most_n, "%d squared"))
    out.push_back([n](Session& session) { session.set_samples_per_edge(n); });
}

void draw_light(const WindowState& state, std::size_t i, Commands& out) {
  Light light = state.scene->lights[i];
  ImGui::PushID(static_cast<int>(i));
  ImGui::Text("light %d", static_cast<int>(i) + 1);
  bool changed = slide("I", light.intensity, 0, 2);
  if (!light.directional) {
    const double reach = 2 * glm::distance(state.opened.scene.camera.eye, state.opened.scene.camera.look_at);
    changed = slide("place", light.position, -reach, reach) || changed;
  }
  if (changed) edit(out, [light, i](Scene& scene) { scene.lights[i] = light; });
  ImGui::PopID();
}

void draw_material(const WindowState& state, Commands& out) {
  const std::vector<Material>& materials = state.scene->materials;
  if (materials.empty()) return;
  const auto i =
      static_cast<std::size_t>(std::clamp(state.material, 0, static_cast<int>(materials.size()) - 1));
  Material material = materials[i];
  if (ImGui::BeginCombo("material", printable(material.name, 40).c_str())) {
    for (std::size_t k = 0; k < materials.size(); ++k) {
      const std::string name = fmt::format("{}##{}", printable(materials[k].name, 40), k);
      if (ImGui::Selectable(name.c_str(), k == i))
        out.push_back([k](Session& session) { session.choose_material(static_cast<int>(k)); });
    }
    ImGui::EndCombo();
  }
  bool changed = slide("ka", material.ambient, 0, 1);
  changed = slide("kd", material.diffuse, 0, 1) || changed;
  changed = slide("ks", material.specular, 0, 1) || changed;
  changed = slide("s", material.shininess, 1, 2000, "%.0f", ImGuiSliderFlags_Logarithmic) || changed;
  changed = slide("c1 local", material.local, 0, 1) || changed;
  changed = slide("c2 reflect", material.reflect, 0, 1) || changed;
  changed = slide("c3 refract", material.refract, 0, 1) || changed;
  changed = slide("ior", material.ior, 0.25, 4, "%.3f", ImGuiSliderFlags_AlwaysClamp) || changed;
  if (changed) edit(out, [material, i](Scene& scene) { scene.materials[i] = material; });
}

// What is off goes on with the value that shows it well; the command line has the others. Behind ### stands a widget's
// name, since its words change with the value.
void draw_faults(const WindowState& state, Commands& out) {
  Faults faults = state.faults;
  const auto toggle = [](const std::string& label, auto& value, auto when_on) {
    bool on = value.has_value();
    if (ImGui::Checkbox(label.c_str(), &on)) value = on ? std::optional(when_on) : std::nullopt;
  };
  toggle("shadow rays start on the surface", faults.shadow_offset, 0.0);
  const auto format = static_cast<std::size_t>(faults.depth_format.value_or(DepthFormat::unorm16));
  toggle(fmt::format("depth stored as {}###depth", kDepthFormatNames[format]), faults.depth_format,
         DepthFormat::unorm16);
  if (!faults.depth_format)
    faults.near_plane = faults.far_plane = 0;
  else if (!state.faults.depth_format)
    faults.set_usual_planes(glm::distance(state.camera.eye, state.camera.look_at));
  const int bits = faults.snap_bits.value_or(0);
  const std::string places = bits == 0 ? "whole pixels" : fmt::format("1/{} of a pixel", 1 << bits);
  toggle("vertices on " + places + "###snap", faults.snap_bits, 0);
  toggle(fmt::format("spheres of {} segments###spheres", faults.tessellate.value_or(16)), faults.tessellate,
         16);
  ImGui::Checkbox("triangles in float", &faults.float_precision);
  if (faults != state.faults) out.push_back([faults](Session& session) { session.set_faults(faults); });
}

}  // namespace

void draw_controls(const Canvas& canvas, const WindowContents& contents, const Rect& box, Commands& out) {
  const WindowState& state = contents.state;
  const DockWindow window("##controls", box, true);
  follow_keys(state, KeyTarget::controls);
  ImGui::PushStyleColor(ImGuiCol_Text, kQuiet);
  ImGui::TextWrapped(key_target(state) == KeyTarget::controls
                         ? "Arrows choose, Space takes a slider and lets it go. Esc: back"
                         : "Tab: with the keyboard");
  ImGui::PopStyleColor();
  ImGui::PushItemWidth(-0.3f * static_cast<float>(box.width()));
  heading(canvas, "Rays");
  draw_trace(state, out);
  heading(canvas, "Lights");
  for (std::size_t i = 0; i < state.scene->lights.size(); ++i) draw_light(state, i, out);
  heading(canvas, "Material");
  draw_material(state, out);
  heading(canvas, "Faults on purpose");
  draw_faults(state, out);
  ImGui::Spacing();
  for (const char* label : {"z reset", "s save"}) {
    key_button(label, out);
    ImGui::SameLine();
  }
  ImGui::PopItemWidth();
}

// A slider for each of the two loop orders, under the picture that it builds up.
void draw_slow_motion(const Canvas& canvas, const WindowContents& contents, const Rect& box,
                      std::vector<Command>& out) {
  const WindowState& state = contents.state;
  const DockWindow window("##slow", box);
  int objects = state.objects, rows = state.rows;
  const auto half = static_cast<float>(box.width() / 2.0 - 24 * canvas.scale());
  ImGui::SetNextItemWidth(half);
  bool moved = ImGui::SliderInt("##objects", &objects, 0, static_cast<int>(state.drawn->objects.size()),
                                "for each object: %d rasterized");
  ImGui::SameLine(static_cast<float>(box.width() / 2.0 + 4 * canvas.scale()));
  ImGui::SetNextItemWidth(half);
  moved =
      ImGui::SliderInt("##rows", &rows, 0, state.scene->height, "for each pixel: %d rows traced") || moved;
  if (moved) out.push_back([objects, rows](Session& session) { session.set_slow(objects, rows); });
}

}  // namespace sidelight
