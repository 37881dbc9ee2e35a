// SPDX-License-Identifier: BSD-3-Clause
// A progress bar on standard error, and the progress callback that stops the library on Ctrl-C.
#pragma once

#include <chrono>
#include <functional>

namespace delone::cli {

/// Draws only if standard error is a terminal, --quiet is not set and the work takes more than half a second.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar() { clear(); }

  /// For Options::progress; refers to this bar. Returns false once a signal was caught.
  std::function<bool(double)> callback();
  /// Removes the bar from the terminal.
  void clear();
  /// Removes it, and begins with other work.
  void restart();

 private:
  using Clock = std::chrono::steady_clock;
  void draw(double fraction);

  bool enabled_;
  bool drawn_ = false;
  Clock::time_point start_, last_;
};

}  // namespace delone::cli
