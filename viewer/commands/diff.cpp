// SPDX-License-Identifier: MIT
// sidelight diff: whether two pictures are near enough, or somebody's picture of a scene to ours.
#include <fmt/format.h>

#include "viewer/commands/commands.h"
#include "viewer/commands/decimal.h"
#include "viewer/commands/diff_scene.h"
#include "viewer/commands/result_json.h"

namespace sidelight {
namespace {

struct DiffFlags {
  JobFlags job;
  std::string a, b, output, json, renderer = "raytrace";
  Tolerance tolerance;
  const CLI::App* scene_flags = nullptr;
};

bool with_scene(const DiffFlags& flags) { return flags.b.ends_with(".toml"); }

void check_flags(const DiffFlags& flags) {
  const Tolerance& tolerance = flags.tolerance;
  const auto check = [](const char* flag, double value) {  // NaN too
    if (!(value >= 0))
      throw UsageError(fmt::format("{} wants a number that is not negative; got {}", flag, value));
  };
  check("--fail", tolerance.fail);
  check("--failpercent", tolerance.fail_percent);
  check("--hardfail", tolerance.hard_fail);
  if (!flags.output.empty() && !flags.output.ends_with(".png"))
    throw UsageError("-o wants a file that ends in .png; got '" + flags.output + "'");
  check_apart("-o", flags.output, "--json", flags.json);
  for (const auto& [name, read] : {std::pair{"A", flags.a}, {"B", flags.b}}) {
    check_apart(name, read, "-o", flags.output);
    check_apart(name, read, "--json", flags.json);
  }
  if (flags.a.ends_with(".toml"))
    throw UsageError("the first of the two is a picture; got the scene '" + flags.a + "'");
  if (!with_scene(flags) && flags.scene_flags->count_all() > 0)
    throw UsageError("flags that say how a scene is rendered want a scene (.toml) as the second of the two");
}

Json findings_json(const PicturePair& pair, const Findings& found) {
  Json json{{"a", pair.a.name},
            {"b", pair.b.name},
            {"width", pair.window.width()},
            {"height", pair.window.height()}};
  const Picture& placed = pair.a.png ? pair.b : pair.a;
  add_crop(json, pair.window, placed.full_width, placed.full_height);
  json.update({{"values", pair.coded ? "srgb8" : "linear"},
               {"metrics", metrics_json(found.metrics)},
               {"over", found.excess.over},
               {"percent_over", found.excess.percent_over()},
               {"percent_covered_over", or_null(found.percent_covered_over)},
               {"non_finite", found.excess.non_finite},
               {"differing",
                {{"object", or_null(found.object_ids)},
                 {"primitive", or_null(found.primitive_ids)},
                 {"depth", or_null(found.depths)}}}});
  return json;
}

std::string findings_text(const PicturePair& pair, const Findings& found, const Tolerance& tolerance) {
  const Metrics& metrics = found.metrics;
  const Excess& excess = found.excess;
  std::string text = fmt::format("{} and {}, {}x{}, {}\n", pair.a.name, pair.b.name, pair.window.width(),
                                 pair.window.height(), pair.coded ? "as 8-bit sRGB codes / 255" : "linear");
  text += fmt::format("{}: {} of {} pixels ({:.3g} %) off by more than {:g}",
                      excess.within(tolerance) ? "near enough" : "too far apart", excess.over, excess.pixels,
                      excess.percent_over(), tolerance.fail);
  // What is not finite is over any limit, but has no distance.
  if (excess.hard > excess.non_finite)
    text += fmt::format(", {} by more than {:g}", excess.hard - excess.non_finite, tolerance.hard_fail);
  if (excess.non_finite > 0) text += fmt::format(", {} not finite", excess.non_finite);
  if (found.percent_covered_over)
    text += fmt::format("; {:.3g} % of those with an object", *found.percent_covered_over);
  text += fmt::format(
      "\n  {}greatest {:.4g} at {},{} in {} ({:.4g} and {:.4g}), mean {:.4g}, rms {:.4g}, psnr {}\n",
      excess.non_finite > 0 ? "of what is finite: " : "", metrics.max.value, metrics.max.x, metrics.max.y,
      "RGB"[metrics.max.channel], metrics.max.a, metrics.max.b, metrics.mean, metrics.rms,
      metrics.psnr ? fmt::format("{:.2f} dB", *metrics.psnr) : "infinite");
  const auto differing = [&](const char* what, const std::optional<std::uint64_t>& pixels) {
    if (pixels) text += fmt::format("  {} differs in {} pixels\n", what, *pixels);
  };
  differing("object id", found.object_ids);
  differing("primitive id", found.primitive_ids);
  differing("depth", found.depths);
  return text;
}

int run_diff(DiffFlags flags) {
  check_flags(flags);
  Picture theirs = read_picture(flags.a);
  std::optional<OurPictures> ours;
  if (with_scene(flags)) {
    flags.job.scene = flags.b;
    ours = render_ours(flags.job, theirs, flags.renderer == "raster");
    theirs.alpha.clear();  // ours have none
  }
  const PicturePair pair(std::move(theirs), ours ? ours->picture() : read_picture(flags.b));
  const Findings found = examine(pair, flags.tolerance);
  Json json = findings_json(pair, found);
  std::string text = findings_text(pair, found, flags.tolerance);
  if (ours) {
    const Account account = account_for(*ours, pair, flags.tolerance.fail);
    json.update(account_json(account, *ours, pair));
    text += account_text(account, *ours, pair);
  }

  if (!flags.output.empty())
    write_png(flags.output, to_image8(difference_picture(pair), pair.window.width(), pair.window.height()));
  if (!flags.json.empty()) write_json(flags.json, json);
  if (!flags.job.quiet) fmt::print(stderr, "{}", text);
  if (found.excess.non_finite > 0)
    throw NumericalFault(
        fmt::format("{}; {} such pixels in all", first_non_finite(pair), found.excess.non_finite));
  return found.excess.within(flags.tolerance) ? 0 : 1;
}

}  // namespace

void add_diff_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<DiffFlags>();
  CLI::App* verb = app.add_subcommand("diff", "two pictures, or a picture and a scene: near enough?");
  Tolerance& tolerance = flags->tolerance;
  verb->add_option("A", flags->a, "a picture: PNG or OpenEXR")->required();
  verb->add_option("B", flags->b, "another of the same size, or the scene (.toml) that A shows")->required();
  verb->add_option("-o,--output", flags->output, "write the difference as FILE.png");
  verb->add_option("--json", flags->json, "write the findings to FILE, - for standard output");
  verb->add_option("--fail", tolerance.fail, "a pixel is over if a channel is off by more than this (0)");
  verb->add_option("--failpercent", tolerance.fail_percent, "so many percent of the pixels may be over (0),");
  verb->add_option("--allow", tolerance.allow, "or so many pixels (0), whichever is more,")
      ->transform(decimal)
      ->check([](const std::string& text) {
        const bool whole = text.find_first_not_of("0123456789") == std::string::npos;
        return whole ? "" : fmt::format("wants a number of pixels, 0 or more; got '{}'", text);
      });
  verb->add_option("--hardfail", tolerance.hard_fail, "but none by more than this (inf)");
  add_quiet_flag(*verb, flags->job);
  CLI::App* scene_flags = verb->add_option_group("With a scene", "rendered at the size of A");
  scene_flags
      ->add_option("--renderer", flags->renderer, "compare A with our raster or raytrace picture (raytrace)")
      ->check(CLI::IsMember({"raster", "raytrace"}));
  add_render_flags(*scene_flags, flags->job);
  flags->scene_flags = scene_flags;
  verb->footer(
      "White is 1. OpenEXR and PNG are compared linear; one against the other, or a PNG\n"
      "against a scene, as 8-bit sRGB codes / 255: there --fail 0.004 lets one step pass.\n"
      "Exit code 1 if too many pixels are over, 4 if size or channels differ, 5 for NaN or infinity.\n"
      "Examples:\n"
      "  sidelight diff tests/images/06-shadows_raster.exr tests/images/06-shadows_raytrace.exr "
      "--failpercent 50\n"
      "  sidelight diff tests/images/06-shadows_raytrace.exr scenes/06-shadows.toml --spp 4 --fail 0.001");
  verb->callback([flags, &exit_code] { exit_code = run_diff(*flags); });
}

}  // namespace sidelight
