// SPDX-License-Identifier: MIT
// A process of its own that answers questions. What a process can be only once, pinned to some cores and with as many
// threads in Mesa, can so be several things in one run, frame by frame in turn.
#pragma once

#include <sched.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

namespace sidelight::bench {

// How many cores this process may run on.
inline int cores() {
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0)
    throw std::system_error(errno, std::generic_category());
  return CPU_COUNT(&allowed);
}

// Leaves this process, and the threads it will start, the last `count` of its cores.
inline void keep_cores(int count) {
  cpu_set_t allowed, kept;
  CPU_ZERO(&kept);
  ::sched_getaffinity(0, sizeof allowed, &allowed);
  for (int core = CPU_SETSIZE - 1; core >= 0 && CPU_COUNT(&kept) < count; --core)
    if (CPU_ISSET(core, &allowed)) CPU_SET(core, &kept);
  if (::sched_setaffinity(0, sizeof kept, &kept) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot choose cores");
}

template <class Question, class Answer>
class Worker {
  static_assert(std::is_trivially_copyable_v<Question> && std::is_trivially_copyable_v<Answer>);

 public:
  using Serve = std::function<Answer(const Question&)>;

  // `start` runs in the new process, which begins as a copy of this one, and returns what answers. No other thread may
  // be running. What either throws ends the process with a line on standard error.
  explicit Worker(const std::function<Serve()>& start) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
      throw std::system_error(errno, std::generic_category());
    std::fflush(nullptr);
    process_ = ::fork();
    if (process_ < 0) throw std::system_error(errno, std::generic_category(), "cannot start a process");
    ::close(ends[process_ == 0 ? 0 : 1]);
    socket_ = ends[process_ == 0 ? 1 : 0];
    if (process_ == 0) ::_exit(serve(start));
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    ::shutdown(socket_, SHUT_RDWR);  // not close alone: a later worker holds a copy of this end
    ::close(socket_);
    ::waitpid(process_, nullptr, 0);
  }

  // Throws std::runtime_error where the worker is gone.
  Answer ask(const Question& question) {
    Answer answer;
    if (!put(question) || !take(answer)) throw std::runtime_error("a worker has failed");
    return answer;
  }

 private:
  int serve(const std::function<Serve()>& start) {
    try {
      const Serve answer = start();
      for (Question question; take(question);)
        if (!put(answer(question))) return EXIT_FAILURE;
      return EXIT_SUCCESS;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "worker: %s\n", error.what());
      return EXIT_FAILURE;
    }
  }

  template <class T>
  bool put(const T& value) {
    return ::send(socket_, &value, sizeof value, MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof value);
  }
  template <class T>
  bool take(T& value) {
    return ::recv(socket_, &value, sizeof value, MSG_WAITALL) == static_cast<ssize_t>(sizeof value);
  }

  pid_t process_ = -1;
  int socket_ = -1;
};

}  // namespace sidelight::bench
