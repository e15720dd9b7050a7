// SPDX-License-Identifier: MIT
#include "viewer/report/bench_report.h"

#include <algorithm>
#include <array>

#include "viewer/report/bench_numbers.h"
#include "viewer/report/bench_pictures.h"
#include "viewer/report/bench_plot.h"
#include "viewer/report/bench_words.h"
#include "viewer/report/html.h"

namespace sidelight {
namespace {

struct Page {
  const BenchResult& result;
  BenchPictures pictures;
};

// "1 plane", "2 planes".
Html counted(std::uint64_t count, const char* what) {
  return html("{} {}{}", Html{grouped(count)}, what, count == 1 ? "" : "s");
}

Html head(const Page& page) {
  const BenchResult& result = page.result;
  Html out = html("<p class=\"over\">sidelight bench</p>\n<h1>Speed against error</h1>\n");
  if (result.interrupted)
    out += html(R"(<p class="verdict bad"><strong>The sweep was interrupted.</strong><br>
What had been finished stands here; what had not is listed with its scene.</p>
)");
  if (!result.timed)
    out += html(
        "<p class=\"verdict\">This bench was made without times: errors only, no plots and no front.</p>\n");
  return out;
}

Html explore(const Page& page, std::size_t scene) {
  if (finished_points(page.result, scene).empty()) return {};
  return html(R"(<h3>Time against error</h3>
<div class="explore">
<figure>{}<figcaption>Left is faster, low is more accurate. A mark is the median of the runs, its bar reaches from the
least to the greatest. <b>Filled</b> marks stand on the front, drawn as a staircase. <b>Grey</b> ones do not: something at
least as accurate is faster, or is not slower by more than the runs differ. <b>Hollow</b> ones fail a test, named beside
them, and cannot stand on the front however fast they are. Dotted lines join the values of one knob.</figcaption></figure>
<aside class="pointed" hidden aria-live="polite"><p></p><div class="columns"></div></aside>
</div>
)",
              scatter_svg(total_scatter(page.result, scene)));
}

// By ErrorKind.
constexpr std::array<const char*, kErrorKinds> kKindWords{
    "<b>Arithmetic</b>: rounding, with the same samples and the same model.",
    "<b>Model</b>: what the configuration leaves out, such as rays or curvature.",
    "<b>Sampling</b>: too few samples a pixel."};

Html kinds(const Page& page, std::size_t scene) {
  Html plots;
  for (const auto& [kind, plot] : small_kind_scatters(page.result, scene))
    plots += html("<figure><figcaption>{}</figcaption>{}</figure>\n",
                  Html{kKindWords[static_cast<std::size_t>(kind)]}, scatter_svg(plot));
  if (plots.empty()) return {};
  return html(R"(<h3>The kinds of error, kept apart</h3>
<p>On the same axes: the renderers' default settings, and the configurations that move a kind of error by more than a
quarter of what their renderer's default has.</p>
<div class="small kinds">
{}</div>
)",
              plots);
}

std::string picture_alt(const BenchPoint& point) { return "Picture of " + config_name(point); }

// Any two configurations; at first the default setting and the most accurate one.
Html swipe(const Page& page, std::size_t scene) {
  const BenchResult& result = page.result;
  PairChoices choices;
  std::vector<std::size_t> shown;  // the points of the choices
  const auto picture = [&](std::size_t i) -> const Image8& {
    return page.pictures.points[page.pictures.points[i].picture_as].picture;
  };
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const BenchPoint& point = result.points[i];
    if (point.scene != scene || !point.finished || picture(i).rgb.empty()) continue;
    choices.all.push_back(
        {config_name(point), fmt::format("picture-{}", page.pictures.points[i].picture_as)});
    shown.push_back(i);
  }
  if (shown.empty()) return {};
  const auto index_of = [&](const std::optional<std::size_t>& point, std::size_t otherwise) {
    const auto at = point ? std::find(shown.begin(), shown.end(), *point) : shown.end();
    return at == shown.end() ? otherwise : static_cast<std::size_t>(at - shown.begin());
  };
  const SceneSummary summary = scene < result.summaries.size() ? result.summaries[scene] : SceneSummary{};
  choices.left = index_of(summary.standard, 0);
  choices.right = index_of(summary.most_accurate, shown.size() - 1);
  if (choices.left == choices.right) choices.right = choices.left == 0 ? shown.size() - 1 : 0;
  const auto figure = [&](std::size_t choice) {
    const BenchPoint& point = result.points[shown[choice]];
    return Figure{picture(shown[choice]), picture_alt(point), html("{}", config_name(point)), {}};
  };
  return html("<h3>Two configurations</h3>\n{}",
              pair_html(fmt::format("pair-{}", scene), figure(choices.left), figure(choices.right), choices));
}

// A picture, or that it is the one shown with another point.
Html gallery_picture(const Page& page, const Image8& image, std::size_t shown_as, std::size_t i,
                     const char* kind, const std::string& alt) {
  if (shown_as != i)
    return html("<p class=\"same\">the {} of {}, pixel for pixel</p>", kind,
                config_name(page.result.points[shown_as]));
  if (image.rgb.empty()) return {};
  return image_html({image, alt, {}, fmt::format("{}-{}", kind, i)});
}

Html gallery(const Page& page, std::size_t scene) {
  const BenchResult& result = page.result;
  Html figures;
  for (const std::size_t i : finished_points(result, scene)) {
    const BenchPoint& point = result.points[i];
    const BenchPictures::Entry& entry = page.pictures.points[i];
    const std::string name = config_name(point);
    figures += html(
        R"(<figure id="point-{}" data-picture="picture-{}" data-difference="difference-{}">{}{}
<figcaption><b>{}</b><br>RMSE {}, difference ×{:g}</figcaption></figure>
)",
        i, entry.picture_as, entry.difference_as,
        gallery_picture(page, entry.picture, entry.picture_as, i, "picture", picture_alt(point)),
        gallery_picture(
            page, entry.difference, entry.difference_as, i, "difference",
            fmt::format("Difference from the reference image, times {:g}", point.difference_gain)),
        name, error_words(point.error.whole.metrics.rms), point.difference_gain);
  }
  if (figures.empty()) return {};
  return html(
      R"(<h3>Every picture, and its difference from the reference image</h3>
<div class="gallery" style="--ratio:{}/{}">
{}</div>
)",
      result.scenes[scene].width, result.scenes[scene].height, figures);
}

Html reference(const Page& page, std::size_t scene) {
  const ReferenceImage& reference = page.result.scenes[scene].reference;
  Html picture;
  if (const Image8& image = page.pictures.references[scene]; !image.rgb.empty())
    picture = figure_html({image, "The reference image", html("The reference image"), {}});
  return html("<h3>What errors are measured against</h3>\n<div class=\"columns\">\n{}<p>{}</p>\n</div>\n",
              picture, escaped(reference_words(reference), 2000));
}

Html reduction_note(const Page& page, std::size_t scene) {
  const int width = page.result.scenes[scene].width;
  for (const BenchPictures::Entry& entry : page.pictures.points)
    if (page.pictures.reduction > 1 && !entry.picture.rgb.empty())
      return html(R"(<p class="quiet">Rendered and measured at {}×{}; shown reduced, {}×{} pixels as one.</p>
)",
                  width, page.result.scenes[scene].height, page.pictures.reduction, page.pictures.reduction);
  return {};
}

Html scene_section(const Page& page, std::size_t index) {
  const BenchResult& result = page.result;
  const BenchScene& scene = result.scenes[index];
  Html out =
      html(R"(<section class="bench">
<h2 dir="auto">{}</h2>
<p class="quiet">{}, {}×{}: {}, {}, {})",
           scene_name(scene), scene.path, scene.width, scene.height, counted(scene.triangles, "triangle"),
           counted(scene.spheres, "sphere"), counted(scene.planes, "plane"));
  if (result.timed) out += html("; loaded in {} ms", spread_words(scene.load_ms));
  out += html(".</p>\n{}", facts_html("In short", summary_facts(result, index)));
  if (result.timed)
    for (const Html& part : {explore(page, index), kinds(page, index)}) out += part;
  for (const Html& part : {swipe(page, index), reduction_note(page, index), numbers_html(result, index),
                           gallery(page, index), reference(page, index)})
    out += part;
  return out += html("</section>\n");
}

Html how_measured(const BenchResult& result) {
  Html times;
  if (result.timed)
    times = html(
        "<p>Times are of whole frames, from the scene to the finished picture in float, after a warm-up, the "
        "configurations in turn. Machine: {}.</p>\n",
        result.machine);
  return html(
      "<section>\n<h2>How it was measured</h2>\n{}<p>By sidelight "
      "{}:</p>\n<pre><code>{}</code></pre>\n</section>\n",
      times, result.version, escaped(result.command, 2000));
}

}  // namespace

std::string bench_report(const BenchResult& result) {
  const Page page{result, bench_pictures(result)};
  Html body = head(page);
  body += over_scenes_html(result);
  for (const std::size_t scene : scenes_worst_first(result)) body += scene_section(page, scene);
  body += how_measured(result);
  const std::string what = result.scenes.size() == 1 ? scene_name(result.scenes[0]) : "";
  return page_html(what.empty() ? "Speed against error" : "Speed against error: " + what, body);
}

}  // namespace sidelight
