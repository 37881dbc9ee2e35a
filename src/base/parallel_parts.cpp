// SPDX-License-Identifier: BSD-3-Clause
#include "base/parallel_parts.hpp"

#include <delone/error.hpp>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>

namespace delone::internal {
namespace {

/// Whether an error of the calling thread is that of a progress function or a limit, and not of a part.
bool ends_all_parts(const Error& error) {
  return error.code() == Errc::cancelled || error.code() == Errc::time_limit ||
         error.code() == Errc::out_of_memory;
}

/// The state of such work.
class PartsOfWork {
 public:
  PartsOfWork(std::size_t size, std::size_t part) : size_(size), part_(part) {}

  TakenParts parts() { return {next_, end_, size_, part_}; }
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
  const std::size_t size_, part_;
  std::atomic<std::size_t> next_ = 0, end_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable ended_;
  unsigned active_ = 0;  // workers in other threads
};

}  // namespace

void work_in_parts(unsigned threads, std::size_t size, std::size_t part,
                   void (*work)(void* context, TakenParts& parts), void* context) {
  if (size == 0) return;
  const unsigned workers = threads_for_parts(threads, (size + part - 1) / part);
  PartsOfWork all(size, part);
  if (workers == 1) {
    TakenParts parts = all.parts();
    return work(context, parts);
  }
  const auto do_parts = [&](bool is_caller) {
    TakenParts parts = all.parts();
    try {
      work(context, parts);
    } catch (const StopPoint::Stopped&) {
    } catch (const Error& error) {
      all.fail(is_caller && ends_all_parts(error) ? 0 : parts.num_begun());
    } catch (...) {
      all.fail(parts.num_begun());
    }
  };
  run_workers(workers, [&](unsigned worker) {
    if (worker > 0) {
      all.begin_worker();
      do_parts(false);
      all.end_worker();
      return;
    }
    do_parts(true);
    try {
      all.wait();
    } catch (...) {
      all.fail(0);
    }
  });
  all.finish();
}

}  // namespace delone::internal
