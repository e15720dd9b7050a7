// SPDX-License-Identifier: MIT
// POV-Ray, which shares no line with us, judges both pictures of every shipped scene: +Q3 the z-buffer's, +Q9 the ray
// tracer's. Where a scene asks for what POV-Ray lacks (pov_limits), both render it without, and the table says so.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "common/scene/toml.h"
#include "tests/judges/judge.h"

using namespace sidelight;
using namespace sidelight::test;
using test::tier_list;
using test::tier_value;

namespace {

struct Judged {
  std::string name;  // of the file, and what was left out
  Scene scene;
};

// The object as it was but for its refraction.
void make_opaque(Scene& scene, std::uint32_t index) {
  Object& object = scene.objects[index];
  const auto first_material = static_cast<std::uint32_t>(scene.materials.size());
  const std::vector<Material> known = scene.materials;
  for (Material material : known) {
    material.refract = glm::dvec3(0);
    scene.materials.push_back(material);
  }
  object.solid = false;
  if (object.kind == ObjectKind::sphere) scene.spheres[object.first].material += first_material;
  if (object.kind == ObjectKind::plane) scene.planes[object.first].material += first_material;
  for (std::uint32_t k = 0; object.kind == ObjectKind::mesh && k < object.count; ++k)
    scene.triangles[object.first + k].material += first_material;
}

// Without what POV-Ray lacks.
Judged expressible(const std::string& file) {
  Judged out{short_name(file), load_scene(file)};
  std::vector<std::string> left_out;
  TraceSettings& trace = out.scene.trace;
  if (trace.contribution_cut > 0) {
    trace.contribution_cut = 0;
    left_out.emplace_back("contribution_cut");
  }
  const Attenuation& w = trace.secondary_attenuation;
  if (w.q0 > 1 || w.q1 > 0 || w.q2 > 0) {
    trace.secondary_attenuation = {};
    left_out.emplace_back("w(r)");
  }
  for (std::size_t i = 0; i < out.scene.lights.size(); ++i) {
    Attenuation& f = out.scene.lights[i].attenuation;
    if (f.q1 == 0 || f.q2 == 0) continue;
    f.q1 = 0;
    left_out.push_back(fmt::format("q1 of light {}", i + 1));
  }
  std::set<std::uint32_t> objects;
  for (const PovLimit& limit : pov_limits(out.scene))
    objects.insert(limit.objects.begin(), limit.objects.end());
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t i : objects) {
    make_opaque(out.scene, i);
    numbers.push_back(i + 1);
  }
  if (!numbers.empty()) left_out.push_back(fmt::format("refraction of objects {}", fmt::join(numbers, ", ")));
  if (!left_out.empty()) out.name += fmt::format(" without {}", fmt::join(left_out, ", "));
  REQUIRE(pov_limits(out.scene).empty());
  return out;
}

std::string colour_row(const std::string& name, const char* level, const Verdict& v) {
  return fmt::format("| {} | {} | {:.4f} | {:.4f} | {} | {} | {} | {} |\n", name, level, v.percent(v.close),
                     v.percent(v.visible), v.worst, v.edge, v.smooth, v.later);
}

// POV-Ray counts a ray of a path that it then does not follow, being too deep: so ours are those of one level more.
// A term that is zero asks for no shadow; a surface in its own light asks in POV-Ray, and counts as asking here.
std::string count_row(const Judged& judged, const Judge& judge) {
  const Scene& scene = judged.scene;
  Scene deeper = scene;
  ++deeper.trace.depth;
  const RenderStats& stats = judge.frame().stats;
  const RayCounts next = traced(deeper, make_camera(scene.camera, scene.width, scene.height, 1)).stats.rays;
  const PovPicture& pov = judge.picture();
  std::string row = "| " + judged.name;
  const auto compare = [&](const std::string& what, std::uint64_t ours, std::uint64_t theirs) {
    CAPTURE(judged.name);
    CAPTURE(what);
    // One pixel in a thousand may see something else, and with it send other rays.
    const double difference = static_cast<double>(ours) - static_cast<double>(theirs);
    CHECK(std::abs(difference) <= 0.001 * static_cast<double>(ours));
    row += fmt::format(" | {} / {}", ours, theirs);
  };
  // Two counts mean different things: without shadows in the scene POV-Ray asks all the same and finds objects that
  // cast none; and for a surface with a highlight only, it asks wherever N.L > 0, we only where Rl.V > 0 as well.
  const bool highlight_only =
      std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
        const Material& m = scene.materials[primitive_material(scene, object.first_primitive)];
        return m.local * m.diffuse == glm::dvec3(0) && m.local * m.specular != glm::dvec3(0);
      });
  if (scene.trace.shadows && !highlight_only)
    compare("shadow", stats.rays.shadow + stats.self_shadowed, pov.count("Shadow Ray Tests"));
  else
    row += " | -";
  compare("reflected", next.reflection, pov.count("Reflected Rays"));
  compare("refracted", next.refraction, pov.count("Refracted Rays") + pov.count("Transmitted Rays"));
  return row + " |\n";
}

std::vector<std::string> judged_scenes() {
  std::vector<std::string> files;
  for (const std::string& name : tier_list("judged_scenes"))
    files.push_back(SIDELIGHT_SOURCE_DIR "/scenes/" + name + ".toml");
  return files.empty() ? shipped_scenes() : files;
}

}  // namespace

TEST_CASE("POV-Ray renders the same pictures, and sends as many rays") {
  if (!has_povray()) {
    test::skip_test("no povray on this machine");
    return;
  }
  const PictureSize size = parse_size(tier_value("judged_size"));
  std::string colours =
      "| scene | light | % within 16/65535 | % over 1/255 | worst, of 65535 | edge | smooth | later |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  std::string counts =
      "| rays, ours / POV-Ray's | shadow | reflected | refracted |\n| --- | --- | --- | --- |\n";
  for (const std::string& file : judged_scenes()) {
    Judged judged = expressible(file);
    judged.scene.width = size.width;
    judged.scene.height = size.height;
    const Judge local(judged.scene, PovQuality::local), full(judged.scene, PovQuality::full);
    CAPTURE(judged.name);
    check_verdict(local.verdict());
    check_verdict(full.verdict());
    colours +=
        colour_row(judged.name, "local", local.verdict()) + colour_row(judged.name, "full", full.verdict());
    counts += count_row(judged, full);
  }
  std::cout << colours << '\n' << counts;
}
