// SPDX-License-Identifier: MIT
#include "viewer/report/bench_numbers.h"

namespace sidelight {
namespace {

const Html kUnknown{"–"};

Html number(std::uint64_t value) { return Html{grouped(value)}; }
Html error_cell(double error) { return html("{}", error_words(error)); }
Html kind_cell(const BenchPoint& point, std::size_t kind) {
  return point.by_kind[kind] ? error_cell(point.by_kind[kind]->whole.metrics.rms) : kUnknown;
}

const char* state(const BenchResult& result, const BenchPoint& point) {
  if (!point.failures.empty()) return "fails";
  if (!result.timed) return "valid";
  return point.on_front ? "front" : "dominated";
}

Html error_table(const BenchResult& result, const std::vector<std::size_t>& order) {
  Table table{"Errors",
              {"configuration", "state", "RMSE", "arithmetic", "model", "sampling", "greatest", "at pixel",
               "mismatches", "covered", "relMSE", "mean", "99.9 %", "PSNR in dB", "depth", "not finite",
               "fails what"},
              {},
              true,
              {1, 16}};
  for (const std::size_t i : order) {
    const BenchPoint& point = result.points[i];
    const ErrorMeasure& error = point.error.whole;
    const Metrics& m = error.metrics;
    table.rows.push_back({html("{}", config_name(point)), html("{}", state(result, point)), error_cell(m.rms),
                          kind_cell(point, 0), kind_cell(point, 1), kind_cell(point, 2),
                          error_cell(m.max.value), html("{},{}", m.max.x, m.max.y), number(point.mismatches),
                          error_cell(point.error.covered.metrics.rms), error_cell(error.relmse),
                          error_cell(m.mean), error_cell(error.p999),
                          m.psnr ? html("{:.1f}", *m.psnr) : html("equal"), error_cell(error.depth),
                          number(m.non_finite), html("{}", escaped(failure_words(point), 600))});
  }
  return html(
      R"(<p>Errors are measured in linear light against the reference image, and RMSE by kind too. Greatest is that of a
channel; covered: RMSE of the pixels that show a surface; 99.9 %: what all but a thousandth of the channels stay below;
depth: the greatest relative error of a depth; mismatches: samples that show another surface than the exact one.</p>
{})",
      table_html(table));
}

Html cost_table(const BenchResult& result, const std::vector<std::size_t>& order) {
  Table table{"Costs of a frame", {"configuration"}, {}, true};
  Html words;
  if (result.timed) {
    table.columns.insert(table.columns.end(), {"#", "frame ms", "as fast as", "processor ms", "build ms",
                                               "runs", "MB a frame", "MB to build"});
    words = html(
        R"(<p>Times are medians (least-greatest), fastest first. Two configurations differ in time only where their ranges do
not overlap: those whose numbers stand under “as fast as” do not differ from this one. MB: what the program came to hold
more than before, at most, during a frame and while the scene was prepared.</p>
)");
  }
  table.columns.insert(table.columns.end(), {"rays", "fragments", "tests", "tests a ray", "nodes a ray"});
  for (std::size_t k = 0; k < order.size(); ++k) {
    const BenchPoint& point = result.points[order[k]];
    std::vector<Html> row{html("{}", config_name(point))};
    if (result.timed)
      row.insert(row.end(),
                 {html("{}", k + 1), html("{}", spread_words(point.frame_ms)),
                  html("{}", same_time_as(result, order, k)), html("{}", spread_words(point.cpu_ms)),
                  html("{}", spread_words(point.build_ms)), html("{}", point.runs),
                  html("{:.1f}", point.frame_memory_mb), html("{:.1f}", point.build_memory_mb)});
    row.insert(row.end(), {number(point.rays), number(point.fragments), number(point.tests),
                           html("{:.1f}", point.tests_per_ray), html("{:.1f}", point.nodes_per_ray)});
    table.rows.push_back(row);
  }
  return words += table_html(table);
}

}  // namespace

Html numbers_html(const BenchResult& result, std::size_t scene) {
  const std::vector<std::size_t> order = finished_points(result, scene);
  Html out = html("<h3>The numbers</h3>\n");
  if (order.empty())
    out += html("<p>No configuration was finished.</p>\n");
  else
    for (const Html& table : {error_table(result, order), cost_table(result, order)}) out += table;
  Html names;
  for (const std::size_t i : unfinished_points(result, scene)) {
    const BenchPoint& point = result.points[i];
    if (point.left_out.empty())
      names += html("{}{}", names.empty() ? "" : ", ", config_name(point));
    else
      out += html("<p class=\"verdict\"><b>Left out:</b> {}, {}.</p>\n", config_name(point), point.left_out);
  }
  if (!names.empty()) out += html("<p class=\"verdict bad\"><b>Not finished:</b> {}.</p>\n", names);
  return html("<div class=\"numbers\">\n{}</div>\n", out);
}

Html facts_html(const std::string& caption, const std::vector<Fact>& facts) {
  if (facts.empty()) return {};
  Table table{caption, {}, {}};
  for (const Fact& fact : facts)
    table.rows.push_back({html("{}", fact.name), html("{}", escaped(fact.value, 600))});
  return html("<div class=\"facts\">{}</div>\n", table_html(table));
}

Html over_scenes_html(const BenchResult& result) {
  if (result.scenes.size() < 2) return {};
  Table table{"Each configuration's time and error divided by the default's: below 1 is better",
              {"configuration", "time", "worst", "in scene", "error", "worst", "in scene"},
              {},
              true,
              {3, 6}};
  const auto add = [&](std::vector<Html>& row, const std::optional<RatioOverScenes>& ratio) {
    if (!ratio) return void(row.insert(row.end(), 3, kUnknown));
    row.push_back(html("<b>{:.3g}</b>", ratio->geometric_mean));
    row.push_back(html("{:.3g}", ratio->worst));
    row.push_back(html("{}", escaped(scene_name(result.scenes[ratio->worst_scene]), 40)));
  };
  for (const ConfigOverScenes& each : result.over_scenes) {
    std::vector<Html>& row = table.rows.emplace_back();
    row.push_back(html("{}", config_name(result.points[each.config])));
    add(row, result.timed ? each.time : std::nullopt);
    add(row, each.error);
  }
  return html(R"(<section>
<h2>Over {} scenes</h2>
<p>Errors of different scenes mean different things, so none are averaged: only ratios are, by their geometric mean, and
the worst scene stands beside it.</p>
{}{}</section>
)",
              result.scenes.size(),
              facts_html("What the front gains over the default setting", facts_over_scenes(result)),
              table.rows.empty() ? Html{} : table_html(table));
}

}  // namespace sidelight
