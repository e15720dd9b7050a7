// SPDX-License-Identifier: MIT
#include "common/scene/settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/scene/number_text.h"
#include "common/scene/toml_set.h"
#include "common/scene/toml_source.h"

namespace sidelight {
namespace {

// ---- Differences ----

std::string toml(double value) { return number_text(value); }
std::string toml(double a, double b, double c) {
  return fmt::format("[{}, {}, {}]", number_text(a), number_text(b), number_text(c));
}
std::string toml(bool value) { return value ? "true" : "false"; }
std::string toml(int value) { return fmt::format("{}", value); }
std::string toml_key(const std::string& key) {
  if (scene_file::is_bare(key)) return key;
  std::string quoted = "\"";
  for (const char c : key) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7F)
      quoted += fmt::format("\\u{:04X}", code);
    else
      quoted += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  }
  return quoted + '"';
}
std::string toml(const glm::dvec3& v) { return toml(v.x, v.y, v.z); }
std::string toml(const Attenuation& a) { return toml(a.q0, a.q1, a.q2); }

bool same(const Attenuation& a, const Attenuation& b) { return a.q0 == b.q0 && a.q1 == b.q1 && a.q2 == b.q2; }
template <class T>
bool same(const T& a, const T& b) {
  return a == b;
}

class Differences {
 public:
  template <class T>
  void add(const std::string& path, const T& from, const T& to) {
    if (!same(from, to)) settings.emplace_back(path, toml(to));
  }
  Settings settings;
};

void add_light(Differences& out, const std::string& path, const Light& from, const Light& to) {
  out.add(path + ".intensity", from.intensity, to.intensity);
  if (to.directional) return out.add(path + ".direction", from.direction, to.direction);
  out.add(path + ".position", from.position, to.position);
  out.add(path + ".attenuation", from.attenuation, to.attenuation);
}

void add_material(Differences& out, const Material& from, const Material& to) {
  const std::string path = "material." + scene_file::path_key(to.name);
  out.add(path + ".ambient", from.ambient, to.ambient);
  out.add(path + ".diffuse", from.diffuse, to.diffuse);
  out.add(path + ".specular", from.specular, to.specular);
  out.add(path + ".shininess", from.shininess, to.shininess);
  out.add(path + ".local", from.local, to.local);
  out.add(path + ".reflect", from.reflect, to.reflect);
  out.add(path + ".refract", from.refract, to.refract);
  out.add(path + ".ior", from.ior, to.ior);
  out.add(path + ".casts_shadow", from.casts_shadow, to.casts_shadow);
}

// ---- Text ----

// Where line and column (both from 1, columns in characters) stand in the text.
std::size_t offset_of(const std::string& text, toml::source_position at) {
  std::size_t i = text.starts_with(scene_file::kByteOrderMark) ? scene_file::kByteOrderMark.size() : 0;
  for (toml::source_index line = 1; line < at.line && i < text.size(); ++i)
    if (text[i] == '\n') ++line;
  const auto goes_on = [&] {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80;
  };
  for (toml::source_index column = 1; column < at.column && i < text.size(); ++column) {
    ++i;
    while (goes_on()) ++i;
  }
  return i;
}

// Whether keys can be put into the table where it begins: it has a header, or is inline. One of dotted keys has neither.
bool has_place(const std::string& text, const toml::node& table) {
  const std::size_t begin = offset_of(text, table.source().begin);
  return begin < text.size() && (text[begin] == '{' || text[begin] == '[');
}

void insert_key(std::string& text, const toml::node& table, bool is_root, const std::string& line) {
  if (is_root) {
    text.insert(offset_of(text, {1, 1}), line + "\n");
    return;
  }
  const std::size_t begin = offset_of(text, table.source().begin);
  if (text[begin] == '{') {
    const std::size_t inside = text.find_first_not_of(" \t", begin + 1);
    text.insert(begin + 1, " " + line + (text.compare(inside, 1, "}") == 0 ? "" : ","));
  } else {
    const std::size_t end = text.find('\n', begin);
    text.insert(end == std::string::npos ? text.size() : end, "\n" + line);
  }
}

std::string with_setting(std::string text, const std::string& key_path, const std::string& value,
                         const std::string& path) {
  const SourceLocation nowhere{path, 0, 0};
  toml::table root = scene_file::parse_toml(text, path);
  const std::vector<std::string> keys = scene_file::split_path(key_path, nowhere);
  toml::node *at = &root, *home = &root;  // home: the table around `at` that has a place for keys
  std::string from_home;                  // the dotted keys that lead from there to `at`
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (toml::node* const next = scene_file::child(*at, keys[i])) {
      at = next;
      from_home += toml_key(keys[i]) + ".";
      if (has_place(text, *at)) {
        home = at;
        from_home.clear();
      }
      continue;
    }
    const std::string line = keys.back() + " = " + value;
    const bool last = i + 1 == keys.size();
    if (last && at->is_table()) {
      insert_key(text, *home, home == &root, from_home + line);
    } else if (i == 0 && keys.size() == 2) {
      text += "\n[" + keys[0] + "]\n" + line + "\n";
    } else {
      throw InputError(nowhere, "'" + key_path + "' leads nowhere");
    }
    return text;
  }
  const std::size_t begin = offset_of(text, at->source().begin), end = offset_of(text, at->source().end);
  text.replace(begin, end - begin, value);
  return text;
}

}  // namespace

Settings settings_between(const Scene& from, const Scene& to) {
  Differences out;
  out.add("background", from.background, to.background);
  out.add("ambient", from.ambient, to.ambient);
  if (from.width != to.width || from.height != to.height)
    out.settings.emplace_back("picture.size", fmt::format("[{}, {}]", to.width, to.height));
  out.add("camera.eye", from.camera.eye, to.camera.eye);
  out.add("camera.look_at", from.camera.look_at, to.camera.look_at);
  out.add("camera.up", from.camera.up, to.camera.up);
  out.add("camera.view_height", from.camera.view_height, to.camera.view_height);
  out.add("trace.depth", from.trace.depth, to.trace.depth);
  out.add("trace.contribution_cut", from.trace.contribution_cut, to.trace.contribution_cut);
  out.add("trace.secondary_attenuation", from.trace.secondary_attenuation, to.trace.secondary_attenuation);
  out.add("trace.shadows", from.trace.shadows, to.trace.shadows);
  out.add("trace.reflection", from.trace.reflection, to.trace.reflection);
  out.add("trace.refraction", from.trace.refraction, to.trace.refraction);
  for (std::size_t i = 0; i < std::min(from.lights.size(), to.lights.size()); ++i)
    add_light(out, fmt::format("light.{}", i), from.lights[i], to.lights[i]);
  for (std::size_t i = 0; i < std::min(from.materials.size(), to.materials.size()); ++i) {
    const std::size_t before = out.settings.size();
    add_material(out, from.materials[i], to.materials[i]);
    // By its name a setting would reach another material, of the scene file, or none.
    if (from.materials[i].of_mesh_file && out.settings.size() > before)
      throw InputError({from.file, 0, 0}, "the material " + scene_file::in_quotes(from.materials[i].name) +
                                              " is a mesh file's, expected changes of the scene file's own");
  }
  return out.settings;
}

std::string with_settings(std::string text, const Settings& settings, const std::string& path) {
  for (const auto& [key, value] : settings) text = with_setting(std::move(text), key, value, path);
  return text;
}

}  // namespace sidelight
