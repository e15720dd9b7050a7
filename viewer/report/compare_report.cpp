// SPDX-License-Identifier: MIT
#include "viewer/report/compare_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/picture/signed_difference.h"
#include "viewer/report/embedded_picture.h"

namespace sidelight {
namespace {

using Picture = std::vector<glm::vec3>;

Html color_swatch(const glm::vec3& linear) {
  return html("<span class=\"swatch\" style=\"background:#{:02x}{:02x}{:02x}\"></span>",
              encode_srgb8(linear.x), encode_srgb8(linear.y), encode_srgb8(linear.z));
}

// One of the three terms of the ledger.
struct Term {
  Layer layer;
  const char* symbol;  // with its sign
  const char* name;
  const char* sum;   // the sum so far, with it
  const char* what;  // it is
  const Cause& cause;
  glm::vec3 hue;
};

std::array<Term, 3> terms(const Comparison& result) {
  return {{{Layer::shadow, "− S", "shadow", "R − S",
            "Light that the z-buffer gave and another object holds off", result.shadow, kCauseHues[0]},
           {Layer::reflection, "+ M", "reflection", "R − S + M", "What mirrors bring from other objects",
            result.reflection, kCauseHues[1]},
           {Layer::refraction, "+ G", "refraction", "R − S + M + G", "What glass and water let through",
            result.refraction, kCauseHues[2]}}};
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
  return fmt::format("{:.1f} %", 100 * static_cast<double>(part) / static_cast<double>(whole));
}

Html head(const CompareReport& report) {
  const Scene& scene = report.scene;
  return html("<p class=\"over\">sidelight: one scene, two renderers</p>\n<h1 dir=\"auto\">{}</h1>\n{}{}",
              scene.title.empty() ? scene.file : scene.title, lesson_html(scene.lesson),
              verdict_html(report));
}

Html two_pictures(const CompareReport& report) {
  const std::string words = traced_words(report.scene.trace);
  const Figure left{
      embedded_picture(report.rastered.color, report.rastered), "The z-buffer's picture of the scene",
      html("<b>Z-buffer.</b> Each object lit as if it were alone: ambient, diffuse and specular light.")};
  const Figure right{embedded_picture(report.traced.color, report.traced),
                     "The ray tracer's picture of the scene",
                     html("<b>Ray tracer.</b> The same surfaces and the same local light, {}.",
                          words.empty() ? "and nothing besides" : "with " + words)};
  Html note;
  if (const int factor = embedding_reduction(report.traced); factor > 1)
    note = html(
        R"(<p class="quiet">All pictures of this page are reduced: {0}×{0} pixels became one. The folder it was
written to holds them whole.</p>
)",
        factor);
  return html("<section>\n<h2>The two pictures</h2>\n{}{}</section>\n", note, pair_html("pair", left, right));
}

// Over the scale: a bar for each bin, all as one path.
Html histogram_svg(const DifferenceHistogram& histogram) {
  constexpr double kTall = 100;
  Html bars = html("M0,{}", kTall);
  for (std::size_t bin = 0; bin < histogram.pixels.size(); ++bin)
    bars += html(" V{:.1f} H{}", kTall * (1 - histogram.height(bin)), bin + 1);
  return html(R"(<svg class="histogram" viewBox="0 0 {} {}" preserveAspectRatio="none" role="img"
aria-label="How many pixels have which difference"><path d="{} V{} Z"/></svg>
)",
              histogram.pixels.size(), kTall, bars, kTall);
}

// How many pixels have which difference, and the colours of signed_difference from -1 to 1, in the same strengths as the
// picture has, with what they stand for.
Html difference_scale(const DifferenceHistogram& histogram) {
  constexpr int kSteps = 256;
  Picture ramp;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const double strength = static_cast<double>(i) / kSteps;
    ramp.push_back(signed_difference_color(strength * std::abs(strength)));
  }
  const Image8 image = to_image8(ramp, static_cast<int>(ramp.size()), 1);
  return html(R"(<div class="scale">
{}<img alt="Scale from violet, darker by 1, over grey, equal, to yellow, brighter by 1" src="data:image/png;base64,{}">
<div><span>−1</span><span>−¼</span><span>0</span><span>+¼</span><span>+1</span></div>
</div>
<p class="quiet">Darker: {} pixels, equal: {}, brighter: {}. The height of a bar is the logarithm of its pixels, {} where it is
tallest.</p>
)",
              histogram_svg(histogram), Html{base64(encode_png(image))}, Html{grouped(histogram.darker())},
              Html{grouped(histogram.equal)}, Html{grouped(histogram.brighter())},
              Html{grouped(histogram.most())});
}

Html differences(const CompareReport& report) {
  const Comparison& result = report.result;
  Table causes{
      "What each cause does. A pixel may count for several; energy is the mean of |term| over pixels and "
      "channels.",
      {"cause", "pixels", "of the picture", "energy"},
      {}};
  Html legend;
  for (const Term& term : terms(result)) {
    causes.rows.push_back({html("{}{}", color_swatch(term.hue), term.name), Html{grouped(term.cause.pixels)},
                           html("{}", percent(term.cause.pixels, report.traced.pixels())),
                           html("{:.4g}", term.cause.energy)});
    legend += html(" {}{}", color_swatch(term.hue), term.name);
  }
  const Figure signed_picture{
      embedded_picture(signed_difference(report.rastered, report.traced), report.traced),
      "The signed difference of the two pictures",
      html(
          R"(<b>Signed difference,</b> ray tracer minus z-buffer, in linear luminance: yellow where the ray tracer is
brighter, violet where it is darker, grey where both are equal. Half the colour stands for ¼, the full colour for 1 and
more.)")};
  const Figure cause_picture{
      embedded_picture(cause_map(report.rastered, report.traced), report.traced),
      "The cause map: for each pixel that differs, its main cause",
      html(
          R"(<b>Cause map.</b>{}: the hue is the cause that weighs most, the brightness is how much the pictures differ.
Black where they are equal in every bit.{})",
          legend,
          result.spoiled > 0 || result.unexplained > 0
              ? html(" White where they differ without a cause: unexplained, or spoiled by a fault on "
                     "purpose.")
              : Html{})};
  return html(R"(<section>
<h2>What differs, and why</h2>
{}<div class="columns">
<div>{}{}</div>
<div>{}</div>
</div>
</section>
)",
              table_html(causes), figure_html(signed_picture),
              difference_scale(difference_histogram(report.rastered, report.traced)),
              figure_html(cause_picture));
}

// What stands left (the term) and right (the sum so far) of one step.
Html step(const Html& left, const Figure& sum) {
  return html("<div class=\"step\"><div>{}</div>\n<div>{}</div></div>", left, figure_html(sum));
}

Html rastered_step(const CompareReport& report) {
  Html parts;
  for (const Layer layer : {Layer::ambient, Layer::diffuse, Layer::specular}) {
    const std::string name(kLayerNames[static_cast<std::size_t>(layer)]);
    parts += figure_html({embedded_picture(report.rastered.layer(layer), report.rastered),
                          "The " + name + " part of R", html("{}", name)});
  }
  return step(html("<h3>R</h3><p>The z-buffer's picture, itself a sum: R = ambient + diffuse + specular.</p>"
                   "<div class=\"terms\">{}</div>",
                   parts),
              {embedded_picture(report.rastered.color, report.rastered), "R, the z-buffer's picture",
               html("<b>R</b>, the z-buffer's picture: where the account begins.")});
}

// The term, and the sum with it.
Html term_step(const CompareReport& report, const Term& term, std::span<const glm::vec3> sum) {
  const bool last = term.layer == Layer::refraction;
  const Html caption = !last ? html("<b>{}</b>, so far.", term.sum)
                       : report.result.spoiled > 0
                           ? html("<b>{}</b>, spoiled as R is.", term.sum)
                           : html("<b>{}</b>, and this is the ray tracer's picture.", term.sum);
  Html shown = html("<h3>{}, {}</h3>", term.symbol, term.name);
  if (term.cause.pixels == 0)
    shown += html("<p>Zero in every pixel of this picture: nothing changes.</p>");
  else
    shown += figure_html({embedded_picture(report.traced.layer(term.layer), report.traced),
                          fmt::format("The {} term alone", term.name),
                          html("{}. {} pixels, energy {:.4g}.", term.what, Html{grouped(term.cause.pixels)},
                               term.cause.energy)});
  return step(shown, {embedded_picture(sum, report.traced), fmt::format("The sum {}", term.sum), caption});
}

Html ledger(const CompareReport& report) {
  std::vector<StepPage> pages{{"R", rastered_step(report)}};
  const auto sums = ledger_sums(report.rastered, report.traced);
  const std::uint64_t spoiled = report.result.spoiled;
  const std::array<Term, 3> added = terms(report.result);
  for (std::size_t k = 0; k < added.size(); ++k)
    pages.push_back({added[k].symbol, term_step(report, added[k], sums[k + 1])});
  return html(R"(<section>
<h2>From the left picture to the right one</h2>
<p class="formula">traced = R − S + M + G</p>
<p>The tracer keeps these three terms as it computes them; none is made by subtracting pictures. Added up in linear
light, they turn the z-buffer's picture into its own, pixel by pixel, to the last rounding{}.</p>
{}</section>
)",
              spoiled > 0 ? html(": all but the {} pixels that faults put in on purpose spoil",
                                 Html{grouped(spoiled)})
                          : Html{},
              steps_html("ledger", pages));
}

Html numbers(const CompareReport& report) {
  constexpr std::array<const char*, 3> kChannels{"red", "green", "blue"};
  const Comparison& result = report.result;
  const Metrics& m = result.metrics;
  const auto count = [](std::uint64_t number) { return Html{grouped(number)}; };
  Table account{
      "The account, as in compare.json",
      {},
      {{html("size"), html("{}×{}", result.width, result.height)},
       {html("pixels that show an object"), count(result.covered)},
       {html("visibility mismatches"), count(result.visibility_mismatches)},
       {html("unexplained pixels"), count(result.unexplained)},
       {html("largest residual of the ledger"), html("{:.3g}", result.ledger_max_residual)},
       {html("greatest difference"),
        html("{:.4g} ({} at {},{}: {:.4g} left, {:.4g} right)", m.max.value,
             kChannels[static_cast<std::size_t>(m.max.channel)], m.max.x, m.max.y, m.max.a, m.max.b)},
       {html("mean difference"), html("{:.4g}", m.mean)},
       {html("root mean square"), html("{:.4g}", m.rms)},
       {html("PSNR of the 8-bit pictures"), m.psnr ? html("{:.2f} dB", *m.psnr) : html("identical")}}};
  for (const auto& [name, pixels] : report.faults)
    account.rows.push_back({html("pixels that the fault {} spoils", name), count(pixels)});
  Table settings{"What was rendered", {}, {}};
  for (const auto& [name, value] : report.settings) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    if (!value.empty()) settings.rows.push_back({html("{}", words), html("{}", value)});
  }
  Html out = html("<section>\n<h2>The numbers</h2>\n<div class=\"columns\">\n<div>{}", table_html(account));
  if (report.raster_times && report.traced_times) {
    const auto row = [](const char* name, const Times& times) {
      return std::vector<Html>{html("{}", name), html("{:.1f} ms", times.build_ms),
                               html("{:.1f} ms", times.frame_ms)};
    };
    out += table_html({"Times: what depends on the scene only, and one picture",
                       {"renderer", "build", "frame"},
                       {row("z-buffer", *report.raster_times), row("ray tracer", *report.traced_times)}});
  }
  return out += html("</div>\n<div>{}</div>\n</div>\n</section>\n", table_html(settings));
}

Html how_to_go_on(const CompareReport& report) {
  const Metrics::Max& max = report.result.metrics.max;
  const Html where = max.value > 0 ? html("The pictures differ most at pixel {},{}.", max.x, max.y)
                                   : html("The pictures are equal.");
  return html(R"(<section>
<h2>How to go on</h2>
<p>{} Why a pixel has its colour, in both renderers{}, term by term:</p>
<pre><code>{}</code></pre>
<p>The same pictures side by side in a window:</p>
<pre><code>{}</code></pre>
</section>
)",
              where, report.faults.empty() ? "" : " as they are without faults",
              escaped(report.explain_command, 2000), escaped(report.view_command, 2000));
}

}  // namespace

std::string traced_words(const TraceSettings& trace) {
  const std::vector<std::string> terms = traced_terms(trace);
  std::string out;
  for (std::size_t i = 0; i < terms.size(); ++i)
    out += (i == 0 ? "" : i + 1 < terms.size() ? ", " : " and ") + terms[i];
  return out;
}

std::string compare_report(const CompareReport& report) {
  Html body = head(report);
  for (const Html& section : {two_pictures(report), differences(report), ledger(report),
                              highlights_html(report.scene.materials), numbers(report), how_to_go_on(report)})
    body += section;
  const std::string& title = report.scene.title;
  return page_html(title.empty() ? report.scene.file : title, body);
}

}  // namespace sidelight
