// SPDX-License-Identifier: BSD-3-Clause
// The progress bar: the fraction done, and the time left, extrapolated from the time so far.
#include "progress_bar.hpp"

#include "interrupt.hpp"
#include "output.hpp"
#include "system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace delone::cli {

ProgressBar::ProgressBar(bool quiet)
    : enabled_(!quiet && system::is_terminal()), start_(Clock::now()), last_(start_) {}

std::function<bool(double)> ProgressBar::callback() {
  return [this](double fraction) {
    if (caught_signal() != 0) return false;
    if (enabled_) draw(fraction);
    return true;
  };
}

void ProgressBar::draw(double fraction) {
  const auto now = Clock::now();
  using namespace std::chrono_literals;
  if (now - start_ < 500ms || now - last_ < 100ms) return;
  last_ = now;
  constexpr int width = 40;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const int full = static_cast<int>(fraction * width);
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const std::string left = fraction > 0.01 ? fmt::format("{:.0f} s left", seconds / fraction - seconds) : "";
  print_note(fmt::format("\r[{:=<{}}{: <{}}] {:3.0f} %  {}\x1b[K", "", full, "", width - full, 100 * fraction,
                         left));
  drawn_ = true;
}

void ProgressBar::clear() {
  if (drawn_) print_note("\r\x1b[K");
  drawn_ = false;
}

void ProgressBar::restart() {
  clear();
  start_ = last_ = Clock::now();
}

}  // namespace delone::cli
