// SPDX-License-Identifier: MIT
// One hard case of catalogue.txt: what its criterion asks and what was measured, checked here and written as rows of
// the results table (hardcases.tsv in the build folder), which table.sh prints beside the catalogue.
//
//   HardCase triangles("TRI-1");
//   triangles.none("rays leaked", leaked, rays);
//   triangles.at_most("relative error of t in units of its bound", worst, 1);
#pragma once

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

namespace sidelight::test {

class HardCase {
 public:
  // `id` as in the catalogue. Several tests may serve one case: their rows stand together in the table.
  explicit HardCase(std::string id) : id_(std::move(id)) {}

  // Not one of `of` may be bad; `of` must not be 0, or nothing was looked at.
  void none(const std::string& what, std::uint64_t bad, std::uint64_t of) const {
    row(what + ": 0", count(bad) + " of " + count(of), bad == 0 && of > 0);
  }
  // At most `bound`; a NaN is not.
  void at_most(const std::string& what, double measured, double bound) const {
    row(what + " <= " + number(bound), number(measured), measured <= bound);
  }
  void at_least(const std::string& what, double measured, double bound) const {
    row(what + " >= " + number(bound), number(measured), measured >= bound);
  }
  void holds(const std::string& what, bool truth) const { row(what, truth ? "yes" : "no", truth); }
  // What this run did not try; a case with nothing but that still lacks a result.
  void skipped(const std::string& what, const std::string& why) const { write(what, why, "skipped"); }

 private:
  static std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
  }
  static std::string count(std::uint64_t value) {
    return value < 1'000'000 ? std::to_string(value) : number(static_cast<double>(value));
  }

  void row(const std::string& criterion, const std::string& measured, bool passed) const {
    CHECK_MESSAGE(passed, id_, ": ", criterion, "; measured ", measured);
    write(criterion, measured, passed ? "pass" : "FAIL");
  }

  // One write to a file opened for appending: rows of tests that run side by side do not mix.
  void write(const std::string& criterion, const std::string& measured, const std::string& verdict) const {
    const std::string line = id_ + '\t' + criterion + '\t' + measured + '\t' + verdict + '\n';
    const int file = ::open(SIDELIGHT_BUILD_DIR "/hardcases.tsv", O_WRONLY | O_APPEND | O_CREAT, 0644);
    REQUIRE(file >= 0);
    const auto written = ::write(file, line.data(), line.size());
    ::close(file);
    REQUIRE(written == static_cast<ssize_t>(line.size()));
  }

  std::string id_;
};

}  // namespace sidelight::test
