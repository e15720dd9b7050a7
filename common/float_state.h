// SPDX-License-Identifier: MIT
// The processor's floating-point state is the caller's: rounding mode, flushing of denormals. Pictures want one state,
// rounding to nearest with denormals kept, so what makes them takes it at entry and gives the caller's back. Threads
// started inside inherit it.
#pragma once

#include <cfenv>

namespace sidelight {

class StandardFloatState {
 public:
  StandardFloatState() {
    std::fegetenv(&callers_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~StandardFloatState() { std::fesetenv(&callers_); }
  StandardFloatState(const StandardFloatState&) = delete;
  StandardFloatState& operator=(const StandardFloatState&) = delete;

 private:
  std::fenv_t callers_;
};

}  // namespace sidelight
