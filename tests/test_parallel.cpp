// SPDX-License-Identifier: MIT
#include "common/parallel.h"

#include <doctest/doctest.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <vector>

using namespace sidelight;

namespace {

// While it lives no thread can be started: its stack would be as large as all of a process.
class NoMoreThreads {
 public:
  NoMoreThreads() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t huge;
    pthread_attr_init(&huge);
    pthread_attr_setstacksize(&huge, std::size_t{1} << 47);
    pthread_setattr_default_np(&huge);
  }
  ~NoMoreThreads() { pthread_setattr_default_np(&before_); }

 private:
  pthread_attr_t before_;
};

std::vector<int> times_done(int items, int threads) {
  std::vector<std::atomic<int>> times(static_cast<std::size_t>(items));
  parallel_for(items, threads, [&](int item, int thread) {
    CHECK((0 <= thread && thread < thread_count(threads)));
    ++times[static_cast<std::size_t>(item)];
  });
  return {times.begin(), times.end()};
}

}  // namespace

TEST_CASE("parallel: each item once, for any number of threads") {
  for (const int items : {0, 1, 3, 1000})
    for (const int threads : {0, 1, 2, 7})
      CHECK(times_done(items, threads) == std::vector<int>(static_cast<std::size_t>(items), 1));
}

TEST_CASE("parallel: where no thread can be started, the caller does it all") {
  const NoMoreThreads none;
  CHECK(times_done(1000, 4) == std::vector<int>(1000, 1));
}

TEST_CASE("parallel: the first exception comes back, and no further items start") {
  for (const int threads : {1, 4}) {
    std::atomic<int> started{0};
    const auto body = [&](int, int) {
      ++started;
      throw std::runtime_error("no");
    };
    CHECK_THROWS_WITH(parallel_for(1000, threads, body), "no");
    CHECK(started <= threads);
  }
}
