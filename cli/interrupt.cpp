// SPDX-License-Identifier: BSD-3-Clause
// What signals do: they set flags, lower a resource limit or end the process, all of which a handler may do.
#include "interrupt.hpp"

#include "memory_limit.hpp"
#include "system.hpp"

#include <atomic>
#include <cstdlib>
#include <exception>

namespace delone::cli {
namespace {

std::atomic<int> signal_caught{0};
std::atomic<Stage> stage_now{Stage::plain};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<Stage>::is_always_lock_free);

void on_signal(int signal) {
  int none = 0;
  signal_caught.compare_exchange_strong(none, signal);
  switch (stage_now.load()) {
    case Stage::plain:
      std::_Exit(128 + signal);
    case Stage::writing:
      system::refuse_writes();
      break;
    case Stage::building:
    case Stage::tiling:
      break;
  }
}

/// The progress callback has not stopped the library in time.
void on_grace_over() {
  const Stage stage = stage_now.load();
  if (stage == Stage::writing) return;
  if (stage == Stage::tiling)
    system::write_error("delone: interrupted; the same command continues with the folder\n");
  std::_Exit(128 + signal_caught.load());
}

void end_if_caught() {
  if (const int signal = caught_signal(); signal != 0) std::_Exit(128 + signal);
}

}  // namespace

void install_interrupt_handlers() { system::watch_signals(on_signal, on_grace_over); }

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
