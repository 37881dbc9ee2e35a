// SPDX-License-Identifier: BSD-3-Clause
#include "cost.hpp"

#include <sys/resource.h>

namespace delone::cli {

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void Cost::close(Clock::time_point start) {
  total = seconds_since(start);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  peak_rss_bytes = static_cast<std::size_t>(usage.ru_maxrss);
#else
  peak_rss_bytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
#endif
}

}  // namespace delone::cli
