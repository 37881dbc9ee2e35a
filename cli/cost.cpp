// SPDX-License-Identifier: BSD-3-Clause
#include "cost.hpp"

#include "system.hpp"

namespace delone::cli {

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void Cost::close(Clock::time_point start) {
  total = seconds_since(start);
  peak_rss_bytes = system::peak_memory();
}

}  // namespace delone::cli
