// SPDX-License-Identifier: MIT
// What work costs: time and memory of this process.
#pragma once

namespace sidelight {

// Milliseconds of wall time, and of processor time of all threads, since some fixed moment.
double wall_ms();
double cpu_ms();

// Splits wall time into laps.
class LapClock {
 public:
  // Since the last lap, or since it was made.
  double lap_ms() {
    const double now = wall_ms(), lap = now - last_;
    last_ = now;
    return lap;
  }

 private:
  double last_ = wall_ms();
};

// The greatest resident size since the process began or, where the system lets us, since the last reset.
double peak_memory_mb();
void reset_peak_memory();

}  // namespace sidelight
