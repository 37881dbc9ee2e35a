// SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C (SIGINT) and SIGTERM: work stops within a second and leaves no partial file.
#pragma once

#include <delone/progress.hpp>

namespace delone::cli {

/// What a signal does depends on what it interrupts.
enum class Stage : int {
  plain,     ///< nothing to clean up: the process ends at once
  building,  ///< the progress callback stops the library; if that takes too long, the process ends
  tiling,    ///< the same, and what is there can be gone on with, which is said
  writing,   ///< to a regular file: further writes fail, and the writer removes its temporary file
};

/// The exit status is 128 + the number of the signal: 130 or 143. A signal that was ignored when the process
/// started stays ignored.
void install_interrupt_handlers();

/// The signal caught so far, or 0.
int caught_signal();

/// Enters a stage for the life of the object, then returns to `plain`. Meanwhile a signal stops whatever the
/// library does. If it came before, or too late for that, the process ends here.
class StageGuard {
 public:
  explicit StageGuard(Stage stage);
  StageGuard(const StageGuard&) = delete;
  StageGuard& operator=(const StageGuard&) = delete;
  ~StageGuard();

 private:
  ProgressScope scope_;
};

}  // namespace delone::cli
