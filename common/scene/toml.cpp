// SPDX-License-Identifier: MIT
#include "common/scene/toml.h"

#include <algorithm>
#include <array>
#include <functional>

#include "common/float_state.h"
#include "common/scene/step_modes.h"
#include "common/scene/toml_set.h"
#include "common/scene/toml_source.h"
#include "common/scene/toml_tables.h"
#include "common/scene/toml_values.h"

namespace sidelight {
namespace scene_file {
namespace {

constexpr std::size_t kMaxSteps = 100;  // each is checked by reading the scene once more

// --- Objects -----------------------------------------------------------------------------------------------------

// One table of an object, before it is read.
struct ObjectEntry {
  std::string_view kind;  // "sphere"
  std::size_t element;    // among those of its kind
  SourceLocation where;
  const toml::table* table;
  void (*read)(ObjectSink&, const toml::table&);
};

struct ObjectReader {
  std::string_view kind;
  void (*read)(ObjectSink&, const toml::table&);
};

constexpr std::array<ObjectReader, 3> kObjectReaders = {
    {{"sphere", read_sphere}, {"plane", read_plane}, {"mesh", read_mesh}}};

// Which objects to read.
using ObjectFilter = std::function<bool(const ObjectEntry&)>;

// In the order in which the file begins them, whatever their kind: the order of their numbers.
std::vector<ObjectEntry> object_entries(const TableReader& root, const ObjectFilter& wanted) {
  std::vector<ObjectEntry> entries;
  for (const ObjectReader& reader : kObjectReaders) {
    const auto value = root.find(reader.kind);
    if (!value) continue;
    std::size_t element = 0;
    for (const toml::table* table : read_tables(*value)) {
      const ObjectEntry entry{reader.kind, element++, root.document().where(*table), table, reader.read};
      if (wanted(entry)) entries.push_back(entry);
    }
  }
  std::ranges::stable_sort(entries, {}, [](const ObjectEntry& entry) { return file_order(entry.where); });
  return entries;
}

// --- The whole file ----------------------------------------------------------------------------------------------

// All of a scene but its steps and hash; `files_read` receives the mesh files.
Scene read_scene(const Document& document, const toml::table& source, const ObjectFilter& wanted,
                 Effort& effort, std::vector<std::string>& files_read) {
  const TableReader root(document, source, "the scene",
                         {.required = {"camera"},
                          .optional = {"title", "lesson", "background", "ambient", "picture", "trace",
                                       "light", "material", "sphere", "plane", "mesh", "step"}});
  Scene scene;
  scene.file = document.path;
  if (const auto v = root.find("title")) scene.title = read_text(*v);
  if (const auto v = root.find("lesson")) scene.lesson = read_text(*v);
  if (const auto v = root.find("background")) scene.background = read_color(*v);
  if (const auto v = root.find("ambient")) scene.ambient = read_color(*v);
  if (const auto v = root.find("picture")) read_picture(*v, scene);
  read_camera(root["camera"], scene.camera);
  if (const auto v = root.find("trace")) read_trace(*v, scene.trace);
  if (const auto v = root.find("light"))
    for (const toml::table* light : read_tables(*v)) scene.lights.push_back(read_light(document, *light));

  MaterialNames materials;
  if (const auto v = root.find("material")) materials = read_materials(*v, scene);
  ObjectSink sink{.document = document, .materials = materials, .scene = scene, .effort = effort};
  for (const ObjectEntry& entry : object_entries(root, wanted)) entry.read(sink, *entry.table);
  files_read = std::move(sink.files_read);
  return scene;
}

bool every_object(const ObjectEntry&) { return true; }

// --- Steps -------------------------------------------------------------------------------------------------------

// Reads the scene as a step would change it, and drops it: the camera, lights, materials and what else is small,
// and of the objects those that the step names. Takes the step's values out of the file's tables, since only moved
// nodes keep their place: a mistake is reported at the value that makes it, or at `where` if no single one does.
void check_step(const Document& document, const toml::table& root, std::vector<Setting>& settings,
                const SourceLocation& where, Effort& effort) {
  const Document changed_document{document.path, where};
  toml::table changed = root;
  std::vector<std::pair<std::string, std::size_t>> touched;
  for (Setting& setting : settings) {
    set_value(changed_document, changed, setting.path, setting.where, std::move(*setting.value));
    const std::vector<std::string> keys = split_path(setting.path, where);
    if (keys.size() > 1) touched.emplace_back(keys[0], element_number(keys[1]));
  }
  std::vector<std::string> files_read;
  read_scene(
      changed_document, changed,
      [&](const ObjectEntry& entry) {
        return std::ranges::find(touched, std::pair(std::string(entry.kind), entry.element)) != touched.end();
      },
      effort, files_read);
}

// With an effort to count on, checks that the scene stays valid with the step applied.
Step read_step(const Document& document, const toml::table& root, toml::table& source, Effort* effort) {
  const TableReader table(document, source, "[[step]]",
                          {.required = {"text"}, .optional = {"mode", "eye", "set"}});
  Step step;
  step.text = read_text(table["text"]);
  if (const auto mode = table.find("mode")) step.mode = read_name(*mode, kStepModes);
  if (const auto eye = table.find("eye")) step.eye = read_position(*eye);

  std::vector<Setting> settings;
  if (const auto set = table.find("set")) {
    read_table(*set);
    settings = settings_in(*source.get_as<toml::table>("set"), document);
  }
  for (const Setting& setting : settings) step.set.emplace_back(setting.path, toml_text(*setting.value));

  // A step's eye moves the camera, after what it sets.
  if (toml::node* eye = source.get("eye")) settings.push_back({"camera.eye", eye->source(), eye});
  if (effort && !settings.empty()) check_step(document, root, settings, table.where(), *effort);
  return step;
}

std::vector<Step> read_steps(const Document& document, toml::table& root, Effort* effort) {
  std::vector<Step> steps;
  toml::node* node = root.get("step");
  if (!node) return steps;
  const Value value{document, *node, "step"};
  if (read_tables(value).size() > kMaxSteps) value.fail("at most " + std::to_string(kMaxSteps) + " steps");
  for (toml::node& step : *node->as_array())
    steps.push_back(read_step(document, root, *step.as_table(), effort));
  return steps;
}

// --- Entry -------------------------------------------------------------------------------------------------------

// { value = ... } from a setting's text. Mistakes in the text are reported in it, not in the scene file; the result
// is a copy, whose nodes have no place, so that mistakes found later name the file as a whole.
toml::table parse_setting(const std::string& text, const std::string& path, const std::string& key) {
  const std::string before = "value = ";
  const toml::table parsed =
      parse_toml(before + text, path + " (set " + key + ")", static_cast<int>(before.size()));
  if (parsed.size() != 1 || !parsed.contains("value"))
    throw InputError({path, 0, 0},
                     "cannot set " + in_quotes(key) + " to " + in_quotes(text) + ", expected one value");
  return toml::table(parsed);  // not moved: a copy leaves places behind
}

// `files_read` receives the mesh files.
Scene read_document(const std::string& text, const std::string& path, const Settings& set,
                    std::vector<std::string>& files_read) {
  const Document document{path, {path, 0, 0}};
  toml::table root = parse_toml(text, path);
  for (const auto& [key, value] : set) {
    toml::table parsed = parse_setting(value, path, key);
    set_value(document, root, key, {}, std::move(*parsed.get("value")));
  }

  Effort effort;
  Scene scene = read_scene(document, root, every_object, effort, files_read);
  // Steps start from the file as it is: with other settings applied, a step alone proves nothing.
  scene.steps = read_steps(document, root, set.empty() ? &effort : nullptr);

  ContentHash hash;
  hash.add(text);
  for (const std::string& file : files_read) add_file(hash, file);
  scene.hash = hash.hex();
  return scene;
}

}  // namespace
}  // namespace scene_file

Scene load_scene(const std::string& path) { return parse_scene(scene_file::read_scene_text(path), path); }

Scene parse_scene(const std::string& text, const std::string& path) {
  const StandardFloatState nearest_and_denormals;
  std::vector<std::string> files_read;
  return scene_file::read_document(text, path, {}, files_read);
}

Scene load_scene_with(const std::string& path, const std::vector<std::pair<std::string, std::string>>& set,
                      std::vector<std::string>* files) {
  const StandardFloatState nearest_and_denormals;
  std::vector<std::string> meshes;
  Scene scene = scene_file::read_document(scene_file::read_scene_text(path), path, set, meshes);
  if (files) {
    *files = std::move(meshes);
    files->insert(files->begin(), path);
  }
  return scene;
}

}  // namespace sidelight
