// SPDX-License-Identifier: BSD-3-Clause
#include "base/parallel.hpp"

#include "base/platform.hpp"
#include "base/progress_meter.hpp"

#include <delone/arithmetic.hpp>

#include <charconv>
#include <exception>
#include <fstream>
#include <mutex>
#include <new>
#include <string>
#include <thread>
#include <utility>
#include <vector>

// ThreadSanitizer does not see how oneTBB, which is not compiled for it, passes work from one thread to
// another.
#if defined(__SANITIZE_THREAD__)
#define DELONE_PLAIN_THREADS 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define DELONE_PLAIN_THREADS 1
#endif
#endif

#if DELONE_WITH_TBB
#include <tbb/task_arena.h>
#include <tbb/task_group.h>
#endif
#if DELONE_LINUX
#include <sched.h>
#endif
#if DELONE_POSIX
#include <pthread.h>
#endif

namespace delone::internal {
namespace {

unsigned cores_of_affinity_mask() {
#if DELONE_LINUX
  cpu_set_t mask;
  if (sched_getaffinity(0, sizeof mask, &mask) == 0)
    return static_cast<unsigned>(std::max(CPU_COUNT(&mask), 1));
#endif
  return std::max(std::thread::hardware_concurrency(), 1u);
}

/// The first line of a file, or nothing.
[[maybe_unused]] std::string first_line(const std::string& path) {
  std::string line;
  std::ifstream file(path);
  std::getline(file, line);
  return line;
}

/// The smallest quota of the control groups that the process is in, from its own to the root: of version 2,
/// and of version 1 where its own group is mounted as the root, as it is in containers.
std::optional<unsigned> cores_of_control_groups() {
  std::optional<unsigned> least;
  [[maybe_unused]] const auto limit = [&](std::string_view cpu_max) {
    if (const auto cores = cores_of_quota(cpu_max)) least = std::min(least.value_or(*cores), *cores);
  };
#if DELONE_LINUX
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::")) continue;
    for (std::string group = line.substr(3); group.starts_with('/'); group.resize(group.rfind('/')))
      limit(first_line("/sys/fs/cgroup" + group + "/cpu.max"));
  }
  limit(first_line("/sys/fs/cgroup/cpu.max"));
  limit(first_line("/sys/fs/cgroup/cpu/cpu.cfs_quota_us") + " " +
        first_line("/sys/fs/cgroup/cpu/cpu.cfs_period_us"));
#endif
  return least;
}

#if DELONE_WITH_TBB
std::atomic<bool> has_threads = false;       // of this process
std::atomic<bool> has_lost_threads = false;  // in a child that was forked off

void note_threads() {
#if DELONE_POSIX
  static std::once_flag once;
  std::call_once(once,
                 [] { pthread_atfork(nullptr, nullptr, [] { has_lost_threads = has_threads.load(); }); });
#endif
  has_threads = true;
}

#if !DELONE_PLAIN_THREADS
/// Whether the system lets this process have as many threads as it has cores; oneTBB ends the process if one
/// of its threads cannot start another. Tried once.
bool can_start_threads() {
  static const bool can = [] {
    std::atomic<bool> may_end = false;
    std::vector<std::thread> threads;
    bool all = true;
    try {
      for (unsigned i = 1; i < num_cores(); ++i) threads.emplace_back([&] { may_end.wait(false); });
    } catch (const std::exception&) {
      all = false;
    }
    may_end = true;
    may_end.notify_all();
    for (std::thread& thread : threads) thread.join();
    return all;
  }();
  return can;
}
#endif
#endif

}  // namespace

unsigned num_cores() {
  const unsigned cores = cores_of_affinity_mask();
  static const std::optional<unsigned> quota = cores_of_control_groups();  // files that are slow to read
  return quota ? std::min(*quota, cores) : cores;
}

unsigned threads_to_use([[maybe_unused]] unsigned requested) {
#if DELONE_WITH_TBB
  if (!has_lost_threads) return requested == 0 ? num_cores() : requested;
#endif
  return 1;
}

std::optional<unsigned> cores_of_quota(std::string_view cpu_max) {
  long long quota = 0, period = 0;
  const char* const end = cpu_max.data() + cpu_max.size();
  const auto after_quota = std::from_chars(cpu_max.data(), end, quota);
  if (after_quota.ec != std::errc() || after_quota.ptr == end) return std::nullopt;
  if (std::from_chars(after_quota.ptr + 1, end, period).ec != std::errc()) return std::nullopt;
  if (quota <= 0 || period <= 0) return std::nullopt;
  return static_cast<unsigned>(std::clamp<long long>(quota / period, 1, 1 << 20));
}

void run_workers(unsigned n, void (*work)(void* context, unsigned worker), void* context) {
  if (n == 1) return work(context, 0);
  std::exception_ptr failure;
  std::mutex mutex;
  std::vector<std::atomic<bool>> has_begun(n);
  const auto run = [&](unsigned worker) noexcept {
    if (has_begun[worker].exchange(true)) return;
    // A thread that helps while it waits has a progress function of its own call, which is not for this work.
    ProgressMeter* const meter = std::exchange(current_meter, worker == 0 ? current_meter : nullptr);
    const ArithmeticScope arithmetic;
    try {
      work(context, worker);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
    current_meter = meter;
  };
#if DELONE_PLAIN_THREADS && DELONE_WITH_TBB
  {
    note_threads();
    std::vector<std::thread> others;
    for (unsigned worker = 1; worker < n; ++worker) others.emplace_back(run, worker);
    run(0);
    for (std::thread& other : others) other.join();
  }
#elif DELONE_WITH_TBB
  if (!has_lost_threads && can_start_threads()) {
    try {
      note_threads();
      const auto cores = static_cast<unsigned>(tbb::this_task_arena::max_concurrency());
      tbb::task_arena arena(static_cast<int>(std::min(n, std::max(cores, 1u))));
      arena.execute([&] {
        tbb::task_group others;
        try {
          for (unsigned worker = 1; worker < n; ++worker) others.run([&run, worker] { run(worker); });
        } catch (const std::exception&) {  // no memory, or no thread
        }
        run(0);
        others.wait();
      });
    } catch (const std::exception&) {
    }
  }
#endif
  for (unsigned worker = 0; worker < n; ++worker) run(worker);  // those that have not begun
  if (failure) std::rethrow_exception(failure);
}

}  // namespace delone::internal
