// SPDX-License-Identifier: BSD-3-Clause
// Signal handlers. They set flags, lower a resource limit or end the process, all of which a handler may do.
#include "interrupt.hpp"

#include "memory_limit.hpp"

#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <exception>

namespace delone::cli {
namespace {

std::atomic<int> signal_caught{0};
std::atomic<Stage> stage_now{Stage::plain};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<Stage>::is_always_lock_free);

/// The time that the progress callback has to stop the library.
constexpr long grace_microseconds = 800000;

/// Makes every further write to a regular file fail with EFBIG (SIGXFSZ is ignored). The writer then handles
/// it like a full disk and removes the temporary file.
void refuse_writes() {
  rlimit limit{};
  if (getrlimit(RLIMIT_FSIZE, &limit) != 0) return;
  limit.rlim_cur = 0;
  setrlimit(RLIMIT_FSIZE, &limit);
}

extern "C" void on_interrupt(int signal) {
  const int saved_errno = errno;
  int none = 0;
  signal_caught.compare_exchange_strong(none, signal);
  switch (stage_now.load()) {
    case Stage::plain:
      _exit(128 + signal);
    case Stage::writing:
      refuse_writes();
      break;
    case Stage::building:
    case Stage::tiling:
      break;
  }
  itimerval timer{};
  timer.it_value.tv_usec = grace_microseconds;
  setitimer(ITIMER_REAL, &timer, nullptr);
  errno = saved_errno;
}

extern "C" void on_grace_over(int) {
  const Stage stage = stage_now.load();
  if (stage == Stage::writing) return;
  if (stage == Stage::tiling) {
    constexpr char text[] = "delone: interrupted; the same command goes on with the folder\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, sizeof text - 1);
  }
  _exit(128 + signal_caught.load());
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

void end_if_caught() {
  if (const int signal = caught_signal(); signal != 0) _exit(128 + signal);
}

}  // namespace

void install_interrupt_handlers() {
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction present {};
    sigaction(signal, nullptr, &present);
    if (present.sa_handler != SIG_IGN) handle(signal, on_interrupt);
  }
  handle(SIGALRM, on_grace_over);
  std::signal(SIGXFSZ, SIG_IGN);
}

int caught_signal() { return signal_caught.load(); }

StageGuard::StageGuard(Stage stage)
    : scope_([](double) { return caught_signal() == 0 && memory_suffices(); }) {
  stage_now = stage;
  end_if_caught();
}

StageGuard::~StageGuard() {
  // The build finished before the signal could stop it. A file that was finished is kept.
  const Stage stage = stage_now.exchange(Stage::plain);
  if ((stage == Stage::building || stage == Stage::tiling) && std::uncaught_exceptions() == 0)
    end_if_caught();
}

}  // namespace delone::cli
