// SPDX-License-Identifier: BSD-3-Clause
// The kernel's counters for the calling thread: processor time, context switches, page faults.
#pragma once

#include <sys/resource.h>

#include <ctime>

namespace benchmarks {

/// Processor time of the calling thread in seconds, to the nanosecond.
inline double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct ThreadUsage {
  double user = 0, system = 0;  ///< seconds, in steps of some milliseconds
  long interruptions = 0, fresh_pages = 0;

  static ThreadUsage now() {
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return {seconds(usage.ru_utime), seconds(usage.ru_stime), usage.ru_nivcsw + usage.ru_nvcsw,
            usage.ru_minflt};
  }
  friend ThreadUsage operator-(const ThreadUsage& a, const ThreadUsage& b) {
    return {a.user - b.user, a.system - b.system, a.interruptions - b.interruptions,
            a.fresh_pages - b.fresh_pages};
  }
};

}  // namespace benchmarks
