// SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C (SIGINT) and SIGTERM: work stops within a second and leaves no partial file.
#pragma once

namespace delone::cli {

/// What a signal does depends on what it would interrupt.
enum class Stage : int {
  plain,     ///< nothing to clean up: the process ends at once
  building,  ///< the progress callback stops the library; if that takes too long the process ends
  writing,   ///< a regular file is being written: every further write fails, so that the writer removes its
             ///< temporary file
};

/// Exit statuses are 128 + the number of the signal: 130 and 143. A signal that was ignored at the start
/// stays ignored.
void install_interrupt_handlers();

/// The signal caught so far, or 0.
int caught_signal();

/// Enters a stage for the life of the object, back to `plain` after it. A signal that came in before, or too
/// late for the progress callback, ends the process here.
class StageGuard {
 public:
  explicit StageGuard(Stage stage);
  StageGuard(const StageGuard&) = delete;
  StageGuard& operator=(const StageGuard&) = delete;
  ~StageGuard();
};

}  // namespace delone::cli
