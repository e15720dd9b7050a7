// SPDX-License-Identifier: MIT
#include "viewer/commands/diff_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "common/picture/compare.h"
#include "viewer/commands/renderers.h"
#include "viewer/report/explain_words.h"

namespace sidelight {
namespace {

// Bits of a set of terms, in the order of kCauseNames.
using Terms = unsigned;
constexpr Terms kNoTerms = 0, kAllTerms = 7;

// ---- What we would have got ----

glm::vec3 sum_of(const OurPictures& ours, std::size_t i, Terms terms) {
  glm::dvec3 sum(ours.rastered.color[i]);
  for (std::size_t t = 0; t < kCauseLayers.size(); ++t) {
    const double sign = kCauseLayers[t] == Layer::shadow ? -1 : 1;
    if (terms >> t & 1) sum += sign * glm::dvec3(ours.traced.layer(kCauseLayers[t])[i]);
  }
  return glm::vec3(sum);
}

Terms terms_present(const OurPictures& ours, std::size_t i) {
  Terms present = kNoTerms;
  for (std::size_t t = 0; t < kCauseLayers.size(); ++t)
    if (ours.traced.layer(kCauseLayers[t])[i] != glm::vec3(0)) present |= 1u << t;
  return present;
}

// How near is equal: one step where codes are compared; else 1e-3 of the greatest channel or of 1, which is
// twice what rounding to 16-bit floats does (2^-11). Never less than what passes for equal anyway.
double equality(const PicturePair& pair, const glm::vec3& value, double fail) {
  const double step = 1.01 / 255;
  return std::max(fail, pair.coded ? step : 1e-3 * double{std::max({1.0f, value.x, value.y, value.z})});
}

// Which terms must change in ours (out of the tracer's picture, or into the z-buffer's) to give their colour:
// the fewest, the nearest among equally few. Nothing if none do.
std::optional<Terms> change_that_fits(const OurPictures& ours, const PicturePair& pair, std::size_t i,
                                      double fail) {
  if (std::isinf(pair.differences[i])) return {};  // not finite: no sum gives it
  const Terms whole = ours.raster ? kNoTerms : kAllTerms, present = terms_present(ours, i);
  const glm::vec3 theirs = pair.value(pair.a.color[i]);
  for (int count = 0; count <= std::popcount(present); ++count) {
    std::optional<Terms> best;
    double nearest = equality(pair, theirs, fail);
    for (Terms change = kNoTerms; change <= kAllTerms; ++change) {
      if (std::popcount(change) != count || (change & ~present) != 0) continue;
      const double off = channel_difference(theirs, pair.value(sum_of(ours, i, whole ^ change)));
      if (off > nearest) continue;
      nearest = off;
      best = change;
    }
    if (best) return best;
  }
  return {};
}

// "ours without the shadow and the reflection"
std::string change_text(Terms change, bool raster, bool coded) {
  if (change == kNoTerms) return coded ? "ours within one 8-bit step" : "ours within a thousandth";
  std::vector<std::string> names;
  for (std::size_t t = 0; t < kCauseNames.size(); ++t)
    if (change >> t & 1) names.push_back(std::string("the ") + kCauseNames[t]);
  return fmt::format("ours {} {}", raster ? "with" : "without", fmt::join(names, " and "));
}

// ---- For people and programs ----

std::string triple(const glm::vec3& v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x, v.y, v.z); }

// The primitive that pixel i shows in ours; kNone for background.
std::uint32_t primitive_at(const OurPictures& ours, std::size_t i) {
  const std::uint32_t id = ours.traced.primitive_id[i];
  return id == 0 ? kNone : id - 1;
}

Json worst_json(const WorstPixel& pixel, const OurPictures& ours, const PicturePair& pair) {
  const std::size_t i = pixel.index;
  Json json{{"x", pair.x(i)},
            {"y", pair.y(i)},
            {"picture", triple_json(pair.value(pair.a.color[i]))},
            {"ours", triple_json(pair.value(ours.chosen().color[i]))},
            {"off", pair.differences[i]}};
  const std::uint32_t primitive = primitive_at(ours, i);
  for (const char* key : {"primitive", "object", "line", "material"}) json[key] = nullptr;
  if (primitive != kNone) {
    const Scene& scene = ours.job.scene;
    const std::uint32_t object = scene.primitive_object[primitive];
    json["primitive"] = primitive;
    json["object"] = object;
    json["line"] = scene.objects[object].where.line;
    json["material"] = printable(scene.materials[primitive_material(scene, primitive)].name, 1000);
  }
  for (std::size_t t = 0; t < kCauseLayers.size(); ++t)
    json[kCauseNames[t]] = triple_json(ours.traced.layer(kCauseLayers[t])[i]);
  json["equals"] = pixel.equals.empty() ? Json(nullptr) : Json(pixel.equals);
  json["explain"] = pixel.explain;
  return json;
}

std::string worst_text(const WorstPixel& pixel, const OurPictures& ours, const PicturePair& pair) {
  const std::size_t i = pixel.index;
  const std::uint32_t primitive = primitive_at(ours, i);
  std::string terms;
  for (std::size_t t = 0; t < kCauseLayers.size(); ++t)
    if (terms_present(ours, i) >> t & 1)
      terms += fmt::format("{}{} {}", terms.empty() ? ": " : ", ", kCauseNames[t],
                           triple(ours.traced.layer(kCauseLayers[t])[i]));
  return fmt::format("  {},{}: theirs {}, ours {}{}\n    {}{}\n    {}\n", pair.x(i), pair.y(i),
                     triple(pair.value(pair.a.color[i])), triple(pair.value(ours.chosen().color[i])),
                     pixel.equals.empty() ? "" : "; theirs equals " + pixel.equals,
                     primitive == kNone ? "background" : primitive_text(ours.job.scene, primitive), terms,
                     pixel.explain);
}

// Of ours, by its name; nothing where both are equally near.
std::optional<std::string> nearer(const Account& account) {
  if (account.rms_raster == account.rms_raytrace) return {};
  return account.rms_raster < account.rms_raytrace ? "raster" : "raytrace";
}

}  // namespace

Picture OurPictures::picture() const {
  return picture_of(chosen(), fmt::format("our {} picture of {}", raster ? "z-buffer's" : "ray tracer's",
                                          printable(job.flags.scene, 1000)));
}

OurPictures render_ours(const JobFlags& flags, const Picture& theirs, bool raster) {
  const Rect& part = theirs.window;
  const Rect whole{0, 0, theirs.full_width, theirs.full_height};
  if (part.x0 < 0 || part.y0 < 0 || part.x1 > whole.x1 || part.y1 > whole.y1)
    throw InputError({theirs.name, 0, 0},
                     "the stored part reaches beyond the picture; expected a part of it");
  OurPictures ours;
  ours.raster = raster;
  JobFlags fitted = flags;
  fitted.size = fmt::format("{}x{}", whole.x1, whole.y1);
  if (part != whole) fitted.crop = fmt::format("{},{},{},{}", part.x0, part.y0, part.x1, part.y1);
  ours.job = load_job(fitted);
  ours.job.options.layers = kRaytraceLayers;
  check_memory(ours.job);
  ours.rastered = render_all_layers(ours.job, *find_renderer("raster")).frame;
  ours.traced = render_all_layers(ours.job, *find_renderer("raytrace")).frame;
  return ours;
}

Account account_for(const OurPictures& ours, const PicturePair& pair, double fail) {
  Account account;
  const auto rms = [&](const Frame& frame) {
    return measure(pair.values(pair.a.color), pair.values(frame.color), frame.width(), frame.height()).rms;
  };
  account.rms_raster = rms(ours.rastered);
  account.rms_raytrace = rms(ours.traced);

  // Every pixel that is over, by the change of terms that explains it.
  std::map<Terms, std::uint64_t> pixels;
  for (std::size_t i = 0; i < pair.differences.size(); ++i) {
    if (!is_over(pair.differences[i], fail)) continue;
    if (const auto change = change_that_fits(ours, pair, i, fail))
      ++pixels[*change];
    else
      ++account.without_reason;
  }
  for (const auto& [change, count] : pixels)
    account.reasons.push_back({change_text(change, ours.raster, pair.coded), count});
  std::stable_sort(account.reasons.begin(), account.reasons.end(),
                   [](const Reason& a, const Reason& b) { return a.pixels > b.pixels; });

  constexpr std::size_t kShown = 5;
  const std::string explain = printable(command_line(ours.job, "explain"), 2000);
  const int apart = 1 + std::max(pair.window.width(), pair.window.height()) / 16;
  for (const std::size_t i : worst_pixels(pair.differences, pair.width(), fail, kShown, apart)) {
    const auto change = change_that_fits(ours, pair, i, fail);
    account.worst.push_back({i, change ? change_text(*change, ours.raster, pair.coded) : std::string(),
                             fmt::format("{} --pixel {},{}", explain, pair.x(i), pair.y(i))});
  }
  return account;
}

std::string account_text(const Account& account, const OurPictures& ours, const PicturePair& pair) {
  std::string text;
  if (const auto name = nearer(account))
    text += fmt::format("nearer to our {} picture (rms {:.3g}; the other {:.3g})\n", *name,
                        std::min(account.rms_raster, account.rms_raytrace),
                        std::max(account.rms_raster, account.rms_raytrace));
  for (const Reason& reason : account.reasons)
    text += fmt::format("  {} pixels equal {}\n", reason.pixels, reason.text);
  if (account.without_reason > 0)
    text += fmt::format(
        "  {} pixels equal no sum of our terms (what a mirror or glass shows belongs to its term)\n",
        account.without_reason);
  if (!account.worst.empty())
    text += fmt::format("the worst{}, and how to see what makes ours:\n",
                        pair.coded ? " (theirs and ours as codes / 255, terms linear)" : "");
  for (const WorstPixel& pixel : account.worst) text += worst_text(pixel, ours, pair);
  return text;
}

Json account_json(const Account& account, const OurPictures& ours, const PicturePair& pair) {
  Json json{{"renderer", ours.raster ? "raster" : "raytrace"},
            {"nearer", nullptr},
            {"rms", {{"raster", account.rms_raster}, {"raytrace", account.rms_raytrace}}},
            {"reasons", Json::array()},
            {"without_reason", account.without_reason},
            {"worst", Json::array()}};
  if (const auto name = nearer(account)) json["nearer"] = *name;
  for (const Reason& reason : account.reasons)
    json["reasons"].push_back({{"equals", reason.text}, {"pixels", reason.pixels}});
  for (const WorstPixel& pixel : account.worst) json["worst"].push_back(worst_json(pixel, ours, pair));
  return json;
}

}  // namespace sidelight
