// SPDX-License-Identifier: BSD-3-Clause
// Work for several threads. Threads are those of oneTBB, which all objects of a process share, so that there
// are never more of them at work than cores, whoever asks. Without oneTBB the calling thread does all.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <optional>
#include <string_view>

namespace delone::internal {

/// How many cores this process may use: those of its affinity mask, or fewer if its control group has a
/// quota.
unsigned num_cores();

/// How many threads there will be if so many are asked for; 0 asks for as many as there are cores. 1 if the
/// library was built without oneTBB, and in a child of a process that had threads when it forked: they are
/// not in the child.
unsigned threads_to_use(unsigned requested);

/// The cores in a quota of a control group, in the format of cpu.max: "<microseconds> <period>". Rounded
/// down, at least 1; nothing if there is no limit.
std::optional<unsigned> cores_of_quota(std::string_view cpu_max);

/// Runs work(context, 0), …, work(context, n − 1), each once: the first in this thread, the others in other
/// threads, at most as many as there are cores, or in this one after the first where no thread can be had; so
/// none may wait for another. Returns when all have ended. If some throw, one exception is passed on then.
/// Nothing is started if n is 1. Throws std::bad_alloc before anything has begun.
void run_workers(unsigned n, void (*work)(void* context, unsigned worker), void* context);

/// The same for a callable.
template <class Work>
void run_workers(unsigned n, Work&& work) {
  run_workers(
      n, [](void* context, unsigned worker) { (*static_cast<Work*>(context))(worker); }, &work);
}

/// Calls work(first, last) for consecutive parts of 0 … size − 1, of `part` numbers each but the last, in up
/// to `threads` threads. After an exception no further parts begin.
template <class Work>
void parallel_for(unsigned threads, std::size_t size, std::size_t part, Work&& work) {
  const std::size_t num_parts = (size + part - 1) / part;
  std::atomic<std::size_t> next = 0;
  run_workers(static_cast<unsigned>(std::clamp<std::size_t>(num_parts, 1, std::max(threads, 1u))),
              [&](unsigned) {
                for (;;) {
                  const std::size_t p = next.fetch_add(1, std::memory_order_relaxed);
                  if (p >= num_parts) return;
                  try {
                    work(p * part, std::min((p + 1) * part, size));
                  } catch (...) {
                    next.store(num_parts, std::memory_order_relaxed);
                    throw;
                  }
                }
              });
}

}  // namespace delone::internal
