// SPDX-License-Identifier: MIT
// The Pareto front and what is read off it, on points made by hand.
#include <cmath>

#include "tests/support/approx.h"
#include "viewer/bench/front.h"

using namespace sidelight;

namespace {

// Runs of nearly one duration, unless a range is given.
TimeAndError point(double time, double error, bool valid = true) {
  return {{time, time, time}, error, valid};
}
TimeAndError ranged(double min, double median, double max, double error) {
  return {{min, median, max}, error};
}

using Flags = std::vector<bool>;

}  // namespace

TEST_CASE("front: a staircase of what nothing beats in both time and error") {
  CHECK(pareto_front(std::vector{point(1, 4), point(2, 2), point(3, 3), point(4, 1)}) ==
        Flags{true, true, false, true});
  CHECK(pareto_front(std::vector{point(1, 1), point(2, 2)}) == Flags{true, false});
  CHECK(pareto_front({}).empty());
}

TEST_CASE("front: a point that fails a gate neither stands on it nor pushes another off") {
  CHECK(pareto_front(std::vector{point(1, 1, false), point(2, 2)}) == Flags{false, true});
  CHECK(pareto_front(std::vector{point(1, 1, false)}) == Flags{false});
  CHECK(pareto_front(std::vector{point(1, std::nan("")), point(2, 2)}) == Flags{false, true});
}

TEST_CASE("front: times whose ranges overlap are one time") {
  // Surely faster, so worth its greater error; not surely, so not.
  CHECK(pareto_front(std::vector{ranged(10, 11, 12, 1), ranged(7, 8, 9, 2)}) == Flags{true, true});
  CHECK(pareto_front(std::vector{ranged(10, 11, 12, 1), ranged(7, 8, 10, 2)}) == Flags{true, false});
  // Equal errors: only a surely faster one beats the other.
  CHECK(pareto_front(std::vector{ranged(8, 9, 11, 1), ranged(10, 11, 12, 1)}) == Flags{true, true});
  CHECK(pareto_front(std::vector{ranged(8, 9, 9.5, 1), ranged(10, 11, 12, 1)}) == Flags{true, false});
  // What is not on the front keeps nothing off it: the third is surely faster than the first, if not than the second.
  CHECK(pareto_front(std::vector{ranged(10, 11, 12, 1), ranged(8, 9, 11, 2), ranged(7, 8, 9, 3)}) ==
        Flags{true, false, true});
}

TEST_CASE("front: between its points lines in log-log, beyond them nothing") {
  const std::vector front{point(1, 16), point(4, 4), point(64, 1)};
  CHECK(*time_at_error(front, 8) == doctest::Approx(2).epsilon(1e-12));  // half way, in logarithm
  CHECK(*error_at_time(front, 16) == doctest::Approx(2).epsilon(1e-12));
  CHECK(*time_at_error(front, 16) == 1);  // at a point the point itself
  CHECK(*error_at_time(front, 64) == 1);
  CHECK_FALSE(time_at_error(front, 17).has_value());
  CHECK_FALSE(time_at_error(front, 0.5).has_value());
  CHECK_FALSE(error_at_time(front, 0.9).has_value());
  CHECK_FALSE(error_at_time({}, 1).has_value());
  // An exact zero is a point, but no line leads to it.
  const std::vector exact{point(1, 1), point(2, 0)};
  CHECK(*time_at_error(exact, 0) == 2);
  CHECK_FALSE(time_at_error(exact, 0.5).has_value());
}

TEST_CASE("ratios over scenes: the geometric mean, and the worst by name") {
  using Ratios = std::vector<std::optional<double>>;
  const auto slow = ratio_over_scenes(Ratios{2, {}, 8, 4}, false);
  REQUIRE(slow.has_value());
  CHECK(slow->geometric_mean == doctest::Approx(4).epsilon(1e-12));
  CHECK(slow->worst == 8);
  CHECK(slow->worst_scene == 2);
  CHECK(ratio_over_scenes(Ratios{2, {}, 8, 4}, true)->worst_scene == 0);
  CHECK_FALSE(ratio_over_scenes(Ratios{{}, {}}, true).has_value());
}

TEST_CASE("spread: least, median and greatest of runs in any order") {
  const Spread odd = spread_of({3, 1, 2});
  CHECK((odd.min == 1 && odd.median == 2 && odd.max == 3));
  CHECK(spread_of({4, 1, 2, 3}).median == 2.5);
  CHECK(spread_of({}).max == 0);
}

// Two scenes, four configurations: the standard, one of half the time and twice the error, one that dominates the
// standard, and one with a gate failed that would beat all.
TEST_CASE("judge: fills fronts, summaries and ratios of a result") {
  BenchResult result;
  result.scenes.resize(2);
  result.configs = 4;
  for (std::size_t scene = 0; scene < 2; ++scene)
    for (const auto& [time, error] :
         {std::pair{8.0, 4.0}, {4.0, 8.0}, {8.0 - 4.0 * static_cast<double>(scene), 2.0}, {1.0, 1.0}}) {
      BenchPoint& added = result.points.emplace_back();
      added.scene = scene;
      added.finished = true;
      added.frame_ms = {time, time, time};
      added.error.whole.metrics.rms = error;
    }
  result.points[3].failures = result.points[7].failures = {"a gate"};
  judge(result);

  CHECK_FALSE(result.points[0].on_front);  // as fast as the third, with more error
  CHECK(result.points[1].on_front);
  CHECK(result.points[2].on_front);
  CHECK_FALSE(result.points[3].on_front);
  const SceneSummary& first = result.summaries[0];
  CHECK(*first.standard == 0);
  CHECK(*first.fastest_exact == 1);
  CHECK(*first.most_accurate == 2);
  // On the line from (4, 8) to (8, 2): at error 4, half way, the time is 4 sqrt 2; at time 8 the error is 2.
  CHECK(*first.equal_error_speedup == doctest::Approx(std::sqrt(2)).epsilon(1e-12));
  CHECK(*first.equal_time_error == doctest::Approx(0.5).epsilon(1e-12));
  // In the second scene (4, 2) beats (4, 8): a front of one point, which spans nothing.
  CHECK(*result.summaries[1].fastest_exact == 5);
  CHECK_FALSE(result.summaries[1].equal_error_speedup.has_value());
  CHECK(result.equal_error_speedup->worst_scene == 0);

  REQUIRE(result.over_scenes.size() == 4);
  CHECK(result.over_scenes[0].time->geometric_mean == 1);
  CHECK(result.over_scenes[1].error->geometric_mean == doctest::Approx(2).epsilon(1e-12));
  CHECK(result.over_scenes[2].time->geometric_mean == doctest::Approx(std::sqrt(0.5)).epsilon(1e-12));
  CHECK(result.over_scenes[2].time->worst_scene == 0);

  // With a front from (4, 8) to (6, 2) the second scene's speed-up is the greater one.
  result.points[6].frame_ms = {6, 6, 6};
  judge(result);
  CHECK(*result.summaries[1].equal_error_speedup == doctest::Approx(8 / std::sqrt(24)).epsilon(1e-12));
  CHECK(result.equal_error_speedup->worst_scene == 0);
}

TEST_CASE("judge: what is not finished or not timed is on no front") {
  BenchResult result;
  result.scenes.resize(1);
  result.configs = 2;
  result.points.resize(2);
  result.points[1].finished = true;
  judge(result);
  CHECK(result.points[1].on_front);
  CHECK_FALSE(result.summaries[0].standard.has_value());
  result.timed = false;
  judge(result);
  CHECK_FALSE(result.points[1].on_front);
  CHECK_FALSE(result.summaries[0].fastest_exact.has_value());
}

TEST_CASE("judge: without times nothing is said of equal times") {
  BenchResult result;
  result.scenes.resize(1);
  result.configs = 2;
  result.points.resize(2);
  for (BenchPoint& point : result.points) point.finished = true;
  result.points[0].error.whole.metrics.rms = 0.5;
  result.points[1].error.whole.metrics.rms = 0.25;
  result.timed = false;
  judge(result);
  REQUIRE(result.summaries[0].standard.has_value());
  CHECK(result.summaries[0].most_accurate == std::size_t{1});
  CHECK_FALSE(result.summaries[0].equal_time_error.has_value());
  CHECK_FALSE(result.summaries[0].equal_error_speedup.has_value());
}
