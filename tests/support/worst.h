// SPDX-License-Identifier: MIT
// The largest of many errors. std::max loses a NaN; here one stays, and no bound holds for it.
#pragma once

#include "tests/support/wide.h"

namespace sidelight::test {

class Worst {
 public:
  void add(double error) {
    if (!(error <= value_) && value_ == value_) value_ = error;
  }
  void add(const Quad& error) { add(static_cast<double>(error)); }
  operator double() const { return value_; }

 private:
  double value_ = 0;
};

}  // namespace sidelight::test
