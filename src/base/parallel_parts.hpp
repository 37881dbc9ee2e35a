// SPDX-License-Identifier: BSD-3-Clause
// Work in numbered parts that several threads share, and which ends as it does with one thread.
//
// Parts begin in the order of their numbers. When one throws, no further ones begin, those after it stop, and
// those before it, which have all begun, go on: of several exceptions the one of the first part is passed on,
// whatever the timing. What the calling thread, the only one that asks progress functions and limits of time
// and memory, hears from them ends all parts at once.
#pragma once

#include "base/parallel.hpp"
#include "base/progress_meter.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>

namespace delone::internal {

/// What a part calls now and then: throws if it is no longer wanted. A cancellation point, too.
class StopPoint {
 public:
  StopPoint(const std::atomic<std::size_t>& end, std::size_t part) : end_(end), part_(part) {}
  void operator()() const {
    if (part_ >= end_.load(std::memory_order_relaxed)) throw Stopped{};
    cancellation_point();
  }
  struct Stopped {};

 private:
  const std::atomic<std::size_t>& end_;
  std::size_t part_;
};

/// Whether an error of the calling thread is that of a progress function or a limit, and not of a part.
inline bool ends_all_parts(const Error& error) {
  return error.code() == Errc::cancelled || error.code() == Errc::time_limit ||
         error.code() == Errc::out_of_memory;
}

/// The state of such work.
class PartsOfWork {
 public:
  explicit PartsOfWork(std::size_t count) : count_(count) {}

  /// The next part, or `count` if no more are to begin.
  std::size_t take() {
    const std::size_t part = next_.fetch_add(1, std::memory_order_relaxed);
    return part < count_ && part < end_.load(std::memory_order_relaxed) ? part : count_;
  }
  StopPoint stop_point(std::size_t part) const { return {end_, part}; }
  /// Keeps the present exception, which ends the parts from `end` on, unless one of an earlier part is known.
  void fail(std::size_t end) {
    const std::lock_guard lock(mutex_);
    if (end >= end_.load(std::memory_order_relaxed)) return;
    failure_ = std::current_exception();
    end_.store(end, std::memory_order_relaxed);
  }
  void begin_worker() {
    const std::lock_guard lock(mutex_);
    ++active_;
  }
  void end_worker() {
    const std::lock_guard lock(mutex_);
    if (--active_ == 0) ended_.notify_one();
  }
  /// Waits until no other worker is active. A cancellation point.
  void wait() {
    std::unique_lock lock(mutex_);
    while (active_ > 0) {
      ended_.wait_for(lock, std::chrono::milliseconds(20));
      lock.unlock();
      cancellation_point();
      lock.lock();
    }
  }
  void finish() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const std::size_t count_;
  std::atomic<std::size_t> next_ = 0, end_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable ended_;
  unsigned active_ = 0;  // workers in other threads
};

/// How many threads shall do so many parts of work: each of these should take some 100 µs at least.
/// `requested`: as Options::threads.
inline unsigned threads_for_parts(unsigned requested, std::size_t parts) {
  if (requested == 1 || parts < (requested == 0 ? std::size_t{4} : std::size_t{2})) return 1;
  return static_cast<unsigned>(std::min<std::size_t>(threads_to_use(requested), parts));
}

/// Calls work(first, last, stop) for consecutive parts of 0 … size − 1, of `part` numbers each but the last,
/// in up to `threads` threads (Options::threads), each with its own work = make_work(). `stop` is a
/// StopPoint.
template <class MakeWork>
void work_in_parts(unsigned threads, std::size_t size, std::size_t part, MakeWork&& make_work) {
  if (size == 0) return;
  const std::size_t count = (size + part - 1) / part;
  const unsigned workers = threads_for_parts(threads, count);
  PartsOfWork parts(count);
  const auto last_of = [&](std::size_t p) { return std::min((p + 1) * part, size); };
  if (workers == 1) {
    auto work = make_work();
    for (std::size_t p = 0; p < count; ++p) work(p * part, last_of(p), parts.stop_point(p));
    return;
  }
  const auto do_parts = [&](bool is_caller) {
    std::size_t p = 0, end = 0;
    try {
      auto work = make_work();
      while ((p = parts.take()) < count) {
        end = p + 1;
        work(p * part, last_of(p), parts.stop_point(p));
      }
    } catch (const StopPoint::Stopped&) {
    } catch (const Error& error) {
      parts.fail(is_caller && ends_all_parts(error) ? 0 : end);
    } catch (...) {
      parts.fail(end);
    }
  };
  run_workers(workers, [&](unsigned worker) {
    if (worker > 0) {
      parts.begin_worker();
      do_parts(false);
      parts.end_worker();
      return;
    }
    do_parts(true);
    try {
      parts.wait();
    } catch (...) {
      parts.fail(0);
    }
  });
  parts.finish();
}

/// The same for work without memory of its own.
template <class Work>
void for_parts(unsigned threads, std::size_t size, std::size_t part, const Work& work) {
  work_in_parts(threads, size, part, [&] {
    return [&](std::size_t first, std::size_t last, const StopPoint& stop) { work(first, last, stop); };
  });
}

}  // namespace delone::internal
