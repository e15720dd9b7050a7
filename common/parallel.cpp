// SPDX-License-Identifier: MIT
#include "common/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace sidelight {

int thread_count(int requested) {
  if (requested > 0) return requested;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_for(int items, int threads, const std::function<void(int item, int thread)>& body) {
  const int workers = std::min(thread_count(threads), std::max(items, 1));
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;

  const auto work = [&](int thread) {
    for (int item = next++; item < items; item = next++) {
      try {
        body(item, thread);
      } catch (...) {
        next = items;
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
      }
    }
  };

  // The caller is worker 0, so one thread means no thread at all. Where the system has no more of them to give (a limit of
  // processes or of memory), those that there are share the work.
  std::vector<std::thread> pool;
  pool.reserve(static_cast<std::size_t>(workers - 1));
  try {
    for (int t = 1; t < workers; ++t) pool.emplace_back(work, t);
  } catch (const std::exception&) {
  }
  work(0);
  for (std::thread& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace sidelight
