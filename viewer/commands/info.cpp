// SPDX-License-Identifier: MIT
// sidelight info: whether a scene file is valid, what is in it, and what it will use.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "common/scene/needs.h"
#include "viewer/commands/commands.h"
#include "viewer/commands/job.h"

namespace sidelight {
namespace {

std::string vector_text(const glm::dvec3& v) { return fmt::format("({:g}, {:g}, {:g})", v.x, v.y, v.z); }

std::string attenuation_text(const Attenuation& a, char distance) {
  return fmt::format("{0:g} + {1:g} {3} + {2:g} {3}²", a.q0, a.q1, a.q2, distance);
}

// Of an object, each once; none of a mesh without faces.
std::string materials_text(const Scene& scene, const Object& object) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < object.count; ++i)
    numbers.push_back(primitive_material(scene, object.first_primitive + i));
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  constexpr std::size_t kShown = 4;
  std::string text = numbers.empty() ? "no material" : numbers.size() == 1 ? "material " : "materials ";
  for (std::size_t i = 0; i < std::min(numbers.size(), kShown); ++i)
    text += (i > 0 ? ", " : "") + printable(scene.materials[numbers[i]].name, 60);
  if (numbers.size() > kShown) text += fmt::format(" and {} more", numbers.size() - kShown);
  return text;
}

void print_objects(const Scene& scene) {
  fmt::print("objects    {} ({} triangles, {} spheres, {} planes)\n", scene.objects.size(),
             scene.triangles.size(), scene.spheres.size(), scene.planes.size());
  constexpr std::array<const char*, 3> kKinds{"sphere", "plane", "mesh"};
  constexpr std::size_t kShown = 40;
  for (std::size_t i = 0; i < std::min(scene.objects.size(), kShown); ++i) {
    const Object& object = scene.objects[i];
    std::string extra;
    if (object.kind == ObjectKind::mesh)
      extra = fmt::format(", {} triangles, {}", object.count, object.closed ? "closed" : "open");
    if (object.solid) extra += fmt::format(", solid of index {:g}", object.ior);
    fmt::print("  {:>3}  line {:<4} {}, {}{}\n", i + 1, object.where.line,
               kKinds[static_cast<std::size_t>(object.kind)], materials_text(scene, object), extra);
  }
  if (scene.objects.size() > kShown) fmt::print("  ... and {} more\n", scene.objects.size() - kShown);
}

void print_needs(const Scene& scene) {
  const Needs needs = needs_of(scene);
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kNeeds; ++i)
    if (needs.has[i]) names.push_back(kNeedNames[i]);
  fmt::print("needs      {}\n", names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", ")));
}

void print_lights(const Scene& scene) {
  fmt::print("lights     {}, ambient {}\n", scene.lights.size(), vector_text(scene.ambient));
  for (const Light& light : scene.lights) {
    if (light.directional)
      fmt::print("       directional {}, intensity {}\n", vector_text(light.direction),
                 vector_text(light.intensity));
    else
      fmt::print("       point {}, intensity {}, attenuation 1/({})\n", vector_text(light.position),
                 vector_text(light.intensity), attenuation_text(light.attenuation, 'd'));
  }
}

int run_info(const JobFlags& flags) {
  const Job job = load_job(flags);
  const Scene& scene = job.scene;
  const TraceSettings& trace = scene.trace;
  fmt::print("{}: valid\n", printable(flags.scene, 1000));
  fmt::print("title      {}\n", printable(scene.title, 200));
  fmt::print("picture    {}x{}, {} sample(s) per pixel\n", scene.width, scene.height, flags.spp);
  fmt::print("camera     eye {}, looks at {}, view height {:g} at distance 1\n",
             vector_text(scene.camera.eye), vector_text(scene.camera.look_at), scene.camera.view_height);
  print_objects(scene);
  print_lights(scene);
  const auto on = [](bool value) { return value ? "on" : "off"; };
  fmt::print("trace      depth {}, cut {:g}, w(r) 1/max(1, {}), shadows {}, reflection {}, refraction {}\n",
             trace.depth, trace.contribution_cut, attenuation_text(trace.secondary_attenuation, 'r'),
             on(trace.shadows), on(trace.reflection), on(trace.refraction));
  print_needs(scene);
  fmt::print("hash       {}\n", scene.hash);
  return 0;
}

}  // namespace

void add_info_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<JobFlags>();
  CLI::App* verb = app.add_subcommand("info", "validate a scene; what is in it, what it will use");
  add_job_flags(*verb, *flags);
  remove_flags(*verb, {"--crop", "-j", "--isa"});
  verb->footer(
      "Examples:\n"
      "  sidelight info scenes/showcase.toml\n"
      "  sidelight info scenes/07-mirrors.toml --depth 3");
  verb->callback([flags, &exit_code] { exit_code = run_info(*flags); });
}

}  // namespace sidelight
