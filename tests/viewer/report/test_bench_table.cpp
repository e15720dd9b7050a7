// SPDX-License-Identifier: MIT
// What a bench found out as text: the terminal's table and the CSV.
#include "viewer/report/bench_report.h"

#include "tests/support/program.h"
#include "tests/support/text.h"
#include "tests/viewer/report/bench_results.h"
#include "viewer/report/bench_words.h"

using namespace sidelight;
using namespace sidelight::test;
using test::contains;

namespace {

// The first line that holds a text; empty if none does.
std::string line_with(const std::string& text, const std::string& part) {
  for (const std::string& line : lines(text))
    if (contains(line, part)) return line;
  return {};
}

// The records of RFC 4180: fields, quoted or not, separated by commas, records by CR LF.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
  std::vector<std::vector<std::string>> records;
  std::vector<std::string> record{""};
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quoted && text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"')
      record.back() += text[++i];
    else if (text[i] == '"')
      quoted = !quoted;
    else if (!quoted && text[i] == ',')
      record.emplace_back();
    else if (!quoted && text.compare(i, 2, "\r\n") == 0) {
      records.push_back(record);
      record.assign(1, "");
      ++i;
    } else
      record.back() += text[i];
  }
  CHECK_FALSE(quoted);
  CHECK(record == std::vector<std::string>{""});  // the last record ends in CR LF too
  return records;
}

std::string field(const std::vector<std::vector<std::string>>& csv, std::size_t record,
                  const std::string& column) {
  const auto at = std::find(csv[0].begin(), csv[0].end(), column);
  REQUIRE(at != csv[0].end());
  return csv[record][static_cast<std::size_t>(at - csv[0].begin())];
}

BenchResult timed(const std::vector<Spread>& times) {
  BenchResult result;
  result.scenes.emplace_back();
  for (const Spread& time : times) {
    result.points.push_back(bench_point("raytrace", "", "", 1, 1));
    result.points.back().frame_ms = time;
  }
  return result;
}

}  // namespace

TEST_CASE("bench table: numbers have three digits, errors of zero are 0") {
  CHECK(time_words(1234.5) == "1234");
  CHECK(time_words(99.96) == "100");
  CHECK(time_words(12.34) == "12.3");
  CHECK(time_words(9.996) == "10.0");
  CHECK(time_words(1.234) == "1.23");
  CHECK(time_words(0.01234) == "0.0123");
  CHECK(error_words(0) == "0");
  CHECK(error_words(1.234e-7) == "1.23e-07");
  CHECK(spread_words({1, 2, 30}) == "2.00 (1.00-30.0)");
}

TEST_CASE("bench table: times do not differ where their ranges overlap, which need not be neighbours") {
  const BenchResult result = timed({{1, 2, 3}, {3, 4, 5}, {5.5, 6, 7}, {2.5, 8, 9}, {10, 11, 12}});
  const std::vector<std::size_t> order = finished_points(result, 0);
  CHECK(order == std::vector<std::size_t>{0, 1, 2, 3, 4});
  CHECK(same_time_as(result, order, 0) == "2, 4");  // touching counts
  CHECK(same_time_as(result, order, 1) == "1, 4");
  CHECK(same_time_as(result, order, 2) == "4");
  CHECK(same_time_as(result, order, 3) == "1-3");
  CHECK(same_time_as(result, order, 4) == "");
}

TEST_CASE("bench table: a configuration is named by its renderer and what was varied") {
  BenchPoint point = bench_point("raytrace", "depth", "2", 1, 1);
  CHECK(config_name(point) == "raytrace depth=2");
  CHECK(mark_name(point) == "depth 2");
  point.varied = "samples, depth";
  CHECK(config_name(point) == "raytrace samples=1 depth=2");
  CHECK(mark_name(point) == "samples 1, depth 2");
  point.varied = "";
  CHECK(config_name(point) == "raytrace");
  CHECK(mark_name(point) == "default");
  CHECK(knob_value(point, "precision") == "exact");
  CHECK(knob_value(point, "none such") == "");
}

TEST_CASE("bench table: rows by time, with what they fail, the reference image and the summary") {
  const std::string table = bench_table(bench_result());
  CHECK(contains(table, "Scene a (64x48)\n"));
  const std::vector<std::string> all = lines(table);
  CHECK(contains(all[2], "configuration"));
  CHECK(contains(all[3], " 1  raster precision=float "));
  CHECK(contains(all[3], "  9.00e-02  9.00e-01  "));  // RMSE and the greatest error
  CHECK(contains(all[3], "fails: 12 samples show another surface"));
  CHECK(contains(all[10], " 8  raytrace samples=16 "));
  CHECK(contains(all[10], "  0         0           0  front"));                       // exactly zero
  CHECK(all[3].find("5.00 (4.50-5.50)") + 16 == all[10].find("610 (549-671)") + 13);  // aligned at the right
  CHECK(contains(table, "they do not"));
  CHECK(contains(table, "8x8 samples a pixel"));
  CHECK(contains(table, "4.00e-02 (n = 1 to 2)"));
  CHECK(contains(table, "1.95e-03"));
  CHECK_FALSE(contains(table, "It took"));  // from the cache
  CHECK(contains(line_with(table, "default setting"), "raytrace: RMSE 2.00e-02, 40.0 (36.0-44.0) ms"));
  CHECK(contains(line_with(table, "fastest exact"), "raster: "));
  CHECK(contains(line_with(table, "most accurate"), "raytrace samples=16: RMSE 0"));
  CHECK(contains(line_with(table, "equal-error"), "1.5: "));
  CHECK(contains(line_with(table, "equal-time"), "0.5: "));
  CHECK_FALSE(contains(table, "Over "));
}

TEST_CASE("bench table: the worst scene comes first, and only ratios are averaged") {
  BenchResult result = bench_result(3);
  result.equal_error_speedup = RatioOverScenes{2.5, 1.5, 2};
  const std::string table = bench_table(result);
  CHECK(table.rfind("Scene c (", 0) == 0);
  CHECK(table.find("Scene a (") < table.find("Scene b ("));
  CHECK(contains(line_with(table, "2.5 (worst"), "equal-error speed-up"));
  CHECK(contains(table, "2.5 (worst 1.5: Scene c)"));
}

TEST_CASE("bench table: what was not finished is said, and a bench without times has none") {
  BenchResult result = bench_result();
  result.interrupted = true;
  result.points[3].finished = false;
  result.scenes[0].reference = {};
  const std::string cut = bench_table(result);
  CHECK(contains(cut, "unfinished: raytrace samples=16\n"));
  CHECK(contains(cut, "Interrupted"));
  CHECK(contains(cut, "before the reference image was finished"));

  result = bench_result();
  result.timed = false;
  const std::string untimed = bench_table(result);
  CHECK_FALSE(contains(untimed, " ms"));
  CHECK_FALSE(contains(untimed, "as fast as"));
  CHECK(contains(untimed, "9.00e-02"));

  CHECK(contains(bench_table({}), "No scene"));
  result.points.clear();
  CHECK(contains(bench_table(result), "No configuration was finished."));
}

TEST_CASE("bench table: nothing of a scene steers the terminal") {
  BenchResult result = bench_result(2);
  result.scenes[0].title = "\x1b[2J\xff\u202E";
  result.points[7].failures = {"\x1b]0;taken\x07"};
  result.points[1].config[0].value = "\u0085\n";
  result.equal_error_speedup = RatioOverScenes{2, 2, 0};
  const std::string table = bench_table(result);
  for (const char* harm : {"\x1b", "\x07", "\xff", "\u202E", "\u0085"}) CHECK_FALSE(contains(table, harm));
  CHECK(lines(table).size() ==
        lines(bench_table(bench_result(2))).size() + 4);  // the facts over scenes alone
}

TEST_CASE("bench csv: every field comes back, whatever is in it") {
  BenchResult result = bench_result();
  result.scenes[0].path = "a,\"b\"\r\nc.toml";
  result.points[1].error.whole.metrics.rms = 0.1 + 0.2;
  result.points[1].error.whole.p999 = 0.5;
  result.points[1].cpu_ms.median = 7;
  const auto csv = parse_csv(bench_csv(result));
  REQUIRE(csv.size() == 1 + result.points.size());
  for (const auto& record : csv) CHECK(record.size() == csv[0].size());
  CHECK(field(csv, 1, "scene") == result.scenes[0].path);
  CHECK(field(csv, 3, "samples") == "4");
  CHECK(std::stod(field(csv, 2, "whole_rmse")) == 0.1 + 0.2);
  CHECK(field(csv, 2, "whole_p999") == "0.5");
  CHECK(field(csv, 2, "frame_cpu_ms_median") == "7");
  CHECK(field(csv, 8, "failures") == "12 samples show another surface");
  CHECK(field(csv, 8, "valid") == "0");
  CHECK(field(csv, 1, "on_front") == "1");
  CHECK(field(csv, 1, "frame_ms_median") == "40");
  CHECK(field(csv, 2, "model_rmse") == "0.08");
  CHECK(field(csv, 4, "model_rmse") == "");  // not known
}

TEST_CASE("bench csv: what is not known is empty") {
  BenchResult result = bench_result();
  result.points[2].finished = false;
  const auto cut = parse_csv(bench_csv(result));
  CHECK(field(cut, 3, "samples") == "4");
  CHECK(field(cut, 3, "finished") == "0");
  for (const char* column : {"valid", "whole_rmse", "frame_ms_min", "sampling_rmse"})
    CHECK(field(cut, 3, column) == "");

  result = bench_result();
  result.timed = false;
  const auto untimed = parse_csv(bench_csv(result));
  CHECK(untimed[0] == cut[0]);
  for (const char* column :
       {"frame_ms_median", "build_ms_max", "frame_cpu_ms_min", "frame_memory_mb", "runs"})
    CHECK(field(untimed, 1, column) == "");
  CHECK(field(untimed, 1, "whole_rmse") == "0.02");

  CHECK(parse_csv(bench_csv({})).size() == 1);  // the heading alone
}
