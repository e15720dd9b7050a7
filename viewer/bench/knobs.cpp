// SPDX-License-Identifier: MIT
#include "viewer/bench/knobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "common/error.h"
#include "common/scene/nearest_name.h"

namespace sidelight {
namespace {

template <class T>
std::optional<T> number(const std::string& text, T low, T high) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(low <= value && value <= high)) return {};
  return value;
}

// The value that leaves the setting alone, or a number in its range.
template <class T>
bool set_number(std::optional<T>& setting, const std::string& value, std::string_view standard, T low,
                T high) {
  if (value == standard) return true;
  setting = number(value, low, high);
  return setting.has_value();
}

bool set_renderer(Setting& setting, const std::string& value) {
  setting.raster = value == "raster";
  return setting.raster || value == "raytrace";
}
bool set_primary(Setting& setting, const std::string& value) {
  setting.from_raster = value == "raster";
  return setting.from_raster || value == "rays";
}
bool set_samples(Setting& setting, const std::string& value) {
  setting.n = samples_per_edge(number(value, 1, 4096).value_or(0));
  return setting.n > 0;
}
bool set_depth(Setting& setting, const std::string& value) {
  return set_number(setting.depth, value, "scene", 1, 1000);
}
bool set_cut(Setting& setting, const std::string& value) {
  return set_number(setting.cut, value, "scene", 0.0, 1.0);
}
bool set_tessellation(Setting& setting, const std::string& value) {
  return set_number(setting.faults.tessellate, value, "off", 4, 1024) &&
         setting.faults.tessellate.value_or(0) % 2 == 0;
}
bool set_precision(Setting& setting, const std::string& value) {
  setting.faults.float_precision = value == "float";
  return value == "exact" || value == "float";
}
bool set_depth_format(Setting& setting, const std::string& value) {
  if (value == "exact") return true;
  const auto at = std::find(kDepthFormatNames.begin(), kDepthFormatNames.end(), value);
  if (at == kDepthFormatNames.end()) return false;
  setting.faults.depth_format = static_cast<DepthFormat>(at - kDepthFormatNames.begin());
  return true;
}
bool set_snap_bits(Setting& setting, const std::string& value) {
  return set_number(setting.faults.snap_bits, value, "exact", 0, 16);
}
bool set_threads(Setting& setting, const std::string& value) {
  if (value == "all") return true;
  const std::optional<int> threads = number(value, 1, 1024);
  setting.threads = threads.value_or(0);
  return threads.has_value();
}
bool set_isa(Setting& setting, const std::string& value) {
  if (value == "best") return true;
  const std::optional<Isa> isa = parse_isa(value);
  setting.isa = isa.value_or(Isa::scalar);
  return isa && machine_has(*isa);
}

constexpr std::optional<ErrorKind> kTimeOnly;

const std::array kKnobs{
    Knob{"renderer", ErrorKind::model, true, true, "raytrace", "", "", "raster or raytrace", set_renderer},
    Knob{"samples", ErrorKind::sampling, true, true, "1", "4", "4,9,16",
         "samples a pixel, a square number from 1 to 4096", set_samples},
    Knob{"depth", ErrorKind::model, false, true, "scene", "1,2,3", "1,2,3,4,6,8,12",
         "rays along a path, 1 to 1000, or scene", set_depth},
    Knob{"cut", ErrorKind::model, false, true, "scene", "0.03", "0,0.001,0.01,0.03,0.1,0.3",
         "the least weight of a ray that is sent, 0 to 1, or scene", set_cut},
    Knob{"tessellation", ErrorKind::model, true, true, "off", "32", "8,16,32,64,128",
         "segments of a sphere, an even number from 4 to 1024, or off", set_tessellation},
    Knob{"precision", ErrorKind::arithmetic, true, true, "exact", "float", "float", "exact or float",
         set_precision},
    Knob{"depth-format", ErrorKind::arithmetic, true, false, "exact", "unorm16",
         "unorm16,unorm24,float,reversed", "exact, unorm16, unorm24, float or reversed", set_depth_format},
    Knob{"snap-bits", ErrorKind::arithmetic, true, false, "exact", "4", "0,2,4,6,8,12",
         "binary places of a vertex on the screen, 0 to 16, or exact", set_snap_bits},
    Knob{"primary", kTimeOnly, false, true, "rays", "", "raster",
         "rays or raster: who finds what the ray tracer's samples show", set_primary},
    Knob{"threads", kTimeOnly, true, true, "all", "", "1,2,4", "1 to 1024, or all", set_threads},
    Knob{"isa", kTimeOnly, true, false, "best", "scalar", "scalar,avx2,avx512",
         "scalar, avx2, avx512 (if this machine has it) or best", set_isa},
};

bool has(const Knob& knob, bool raster) { return raster ? knob.raster : knob.raytrace; }

std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> out;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    out.emplace_back(list.substr(0, comma));
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return out;
}

bool has_value(const Knob& knob, const std::string& value) {
  Setting ignored;
  return knob.set(ignored, value);
}

Config standard_config(bool raster) {
  Config config;
  for (const Knob& knob : kKnobs)
    config.push_back({std::string(knob.name), std::string(has(knob, raster) ? knob.standard : kNotThere)});
  config[0].value = raster ? "raster" : "raytrace";
  return config;
}

bool same(const Config& a, const Config& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](const KnobValue& x, const KnobValue& y) { return x.value == y.value; });
}
void add_new(std::vector<Config>& to, const Config& config) {
  if (std::none_of(to.begin(), to.end(), [&](const Config& each) { return same(each, config); }))
    to.push_back(config);
}

// One "knob=value,value".
struct Choice {
  std::size_t knob;  // in the table
  std::vector<std::string> values;
};

Choice parse_choice(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size())
    throw UsageError(fmt::format("--set wants knob=value,value; got '{}'", printable(text)));
  const std::string name = text.substr(0, equals);
  std::vector<std::string_view> names;
  for (const Knob& knob : kKnobs) names.push_back(knob.name);
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    throw UsageError(fmt::format("--set: there is no knob '{}', only {}{}", printable(name),
                                 fmt::join(names, ", "), did_you_mean(name, names)));
  Choice choice{static_cast<std::size_t>(at - names.begin()),
                split(std::string_view(text).substr(equals + 1))};
  const Knob& knob = kKnobs[choice.knob];
  for (const std::string& value : choice.values)
    if (!has_value(knob, value))
      throw UsageError(
          fmt::format("--set {}: wanted {}; got '{}'", knob.name, knob.wanted, printable(value)));
  return choice;
}

std::vector<Choice> parse_choices(const std::vector<std::string>& texts) {
  std::vector<Choice> choices{{0, {"raytrace", "raster"}}};  // the first is the renderer's
  std::size_t product = 2;
  bool renderer_chosen = false;
  for (const std::string& text : texts) {
    const Choice choice = parse_choice(text);
    const bool again = choice.knob == 0
                           ? renderer_chosen
                           : std::any_of(choices.begin() + 1, choices.end(),
                                         [&](const Choice& each) { return each.knob == choice.knob; });
    if (again) throw UsageError(fmt::format("--set names the knob '{}' twice", kKnobs[choice.knob].name));
    product *= choice.values.size();
    if (product > 2 * kMostConfigs)
      throw UsageError(fmt::format("--set asks for more than {} configurations", kMostConfigs));
    if (choice.knob == 0) {
      renderer_chosen = true;
      choices[0] = choice;
    } else {
      choices.push_back(choice);
    }
  }
  return choices;
}

// Every renderer's choice with every value of every other knob that it has.
void add_products(const std::vector<Choice>& choices, std::size_t next, const Config& config, bool raster,
                  std::vector<Config>& out) {
  if (next == choices.size()) return add_new(out, config);
  const Choice& choice = choices[next];
  if (!has(kKnobs[choice.knob], raster)) return add_products(choices, next + 1, config, raster, out);
  for (const std::string& value : choice.values) {
    Config turned = config;
    turned[choice.knob].value = value;
    add_products(choices, next + 1, turned, raster, out);
  }
}

}  // namespace

std::span<const Knob> knobs() { return kKnobs; }

Setting setting_of(const Config& config) {
  Setting setting;
  for (std::size_t k = 0; k < kKnobs.size(); ++k)
    if (config[k].value != kNotThere) kKnobs[k].set(setting, config[k].value);
  return setting;
}

std::string varied_knobs(const Config& config) {
  std::vector<std::string_view> varied;
  for (std::size_t k = 1; k < kKnobs.size(); ++k)
    if (config[k].value != kNotThere && config[k].value != kKnobs[k].standard)
      varied.push_back(kKnobs[k].name);
  return fmt::format("{}", fmt::join(varied, ", "));
}

std::vector<std::string> sweep_names() {
  std::vector<std::string> names{"default"};
  for (const Knob& knob : kKnobs) names.emplace_back(knob.name);
  return names;
}

std::vector<Config> sweep_configs(const std::string& name) {
  const std::vector<std::string> names = sweep_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw UsageError(fmt::format("--sweep: there is no sweep '{}'; there are {}", printable(name),
                                 fmt::join(names, ", ")));
  std::vector<Config> out{standard_config(false), standard_config(true)};
  for (const bool raster : {false, true})
    for (std::size_t k = 0; k < kKnobs.size(); ++k) {
      const Knob& knob = kKnobs[k];
      if (!has(knob, raster) || (name != "default" && name != knob.name)) continue;
      for (const std::string& value : split(name == "default" ? knob.by_default : knob.sweep)) {
        if (!has_value(knob, value)) continue;  // an instruction set that this machine lacks
        Config config = standard_config(raster);
        config[k].value = value;
        add_new(out, config);
      }
    }
  return out;
}

std::vector<Config> product_configs(const std::vector<std::string>& texts) {
  const std::vector<Choice> choices = parse_choices(texts);
  const std::vector<std::string>& renderers = choices[0].values;
  const auto chosen_has = [&](const Knob& knob) {
    return std::any_of(renderers.begin(), renderers.end(),
                       [&](const std::string& renderer) { return has(knob, renderer == "raster"); });
  };
  for (const Choice& choice : choices)
    if (const Knob& knob = kKnobs[choice.knob]; !chosen_has(knob))
      throw UsageError(fmt::format("--set {}: {} has no such knob", knob.name, renderers.front()));

  std::vector<Config> out{standard_config(false)};
  for (const std::string& renderer : renderers)
    add_products(choices, 1, standard_config(renderer == "raster"), renderer == "raster", out);
  if (out.size() > kMostConfigs)
    throw UsageError(fmt::format("--set asks for more than {} configurations", kMostConfigs));
  for (const Config& config : out)
    if (const Setting setting = setting_of(config); setting.from_raster && setting.faults.float_precision)
      throw UsageError(
          "--set: primary=raster takes the z-buffer's exact surfaces, so not with precision=float");
  return out;
}

}  // namespace sidelight
