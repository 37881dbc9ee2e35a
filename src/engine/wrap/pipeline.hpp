// SPDX-License-Identifier: BSD-3-Clause
// Work in blocks, which the calling thread prepares and finishes one after the other, so that what they are
// made of stays in its cache; their parts are done in between by several threads. Two blocks are under way:
// while one is finished, the parts of the other are done. What happens in what order to the state that blocks
// are prepared from is the same for every number of threads.
#pragma once

#include "base/parallel.hpp"

#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>

namespace delone::engine {

/// Work on blocks 0 and 1, over and over. Functions that return false end the whole.
template <class W>
concept BlockWork = requires(W work, unsigned block, unsigned worker, std::uint32_t part) {
  /// Fills a block, and returns how many parts it has; 0 if there is nothing to do for now.
  { work.prepare(block) } -> std::same_as<std::uint32_t>;
  /// Does a part of a block, at the same time as others and as finish() of the other block.
  { work.do_part(block, part, worker) } -> std::same_as<bool>;
  /// After all parts. Not called for a block without parts.
  { work.finish(block) } -> std::same_as<bool>;
  /// Called by the calling thread now and then; may throw.
  work.tick();
};

/// Runs such work in up to `threads` threads until both blocks have nothing to do. Returns false if some
/// function did. Of exceptions, that of the calling thread is passed on if it has one, or else any.
template <BlockWork W>
class Pipeline {
 public:
  explicit Pipeline(W& work) : work_(work) {}

  bool run(unsigned threads) {
    publish(0, work_.prepare(0));
    publish(1, work_.prepare(1));
    if (threads <= 1)
      run_alone();
    else
      internal::run_workers(threads, [this](unsigned worker) { run_worker(worker); });
    if (failure_) std::rethrow_exception(failure_);
    return !has_failed_;
  }

 private:
  /// The parts that nobody has taken, and those that have not been done.
  struct alignas(64) Progress {
    std::atomic<std::uint32_t> left = 0, undone = 0;
    bool has_parts = false;
  };

  void publish(unsigned block, std::uint32_t parts) {
    Progress& progress = progress_[block];
    progress.has_parts = parts != 0;
    progress.undone.store(parts, std::memory_order_relaxed);
    progress.left.store(parts, std::memory_order_release);
  }

  void run_alone() {
    for (unsigned block = 0; !has_failed_ && (progress_[0].has_parts || progress_[1].has_parts);
         block = 1 - block) {
      for (std::uint32_t part = progress_[block].undone; part-- > 0 && !has_failed_;) {
        work_.tick();
        has_failed_ = !work_.do_part(block, part, 0);
      }
      if (!has_failed_) finish_next();
    }
  }

  void run_worker(unsigned worker) {
    try {
      for (;;) {
        const std::uint32_t before = events_.load(std::memory_order_acquire);
        if (is_over_.load(std::memory_order_acquire)) return;
        if (worker == 0) {
          work_.tick();
          if (is_ready()) {
            finish_next();
            notify();
            continue;
          }
        }
        if (!try_to_do_part(worker)) events_.wait(before, std::memory_order_acquire);
      }
    } catch (...) {
      const std::lock_guard lock(failing_);
      if (!failure_ || worker == 0) failure_ = std::current_exception();
      end();
    }
  }

  bool is_ready() const {
    return progress_[next_.load(std::memory_order_relaxed)].undone.load(std::memory_order_acquire) == 0;
  }

  /// Takes a part of the block that is to be finished next, or else of the other, and does it.
  bool try_to_do_part(unsigned worker) {
    const unsigned next = next_.load(std::memory_order_acquire);
    for (const unsigned block : {next, 1 - next}) {
      Progress& progress = progress_[block];
      std::uint32_t left = progress.left.load(std::memory_order_relaxed);
      while (left > 0 && !progress.left.compare_exchange_weak(left, left - 1, std::memory_order_acquire,
                                                              std::memory_order_relaxed)) {
      }
      if (left == 0) continue;
      if (!work_.do_part(block, left - 1, worker)) fail();
      if (progress.undone.fetch_sub(1, std::memory_order_acq_rel) == 1) notify();
      return true;
    }
    return false;
  }

  void finish_next() {
    const unsigned block = next_.load(std::memory_order_relaxed);
    if (progress_[block].has_parts && !work_.finish(block)) return fail();
    publish(block, work_.prepare(block));
    next_.store(1 - block, std::memory_order_release);
    if (!progress_[0].has_parts && !progress_[1].has_parts) end();
  }

  void fail() {
    has_failed_.store(true, std::memory_order_relaxed);
    end();
  }
  void end() {
    is_over_.store(true, std::memory_order_release);
    notify();
  }
  void notify() {
    events_.fetch_add(1, std::memory_order_acq_rel);
    events_.notify_all();
  }

  W& work_;
  std::array<Progress, 2> progress_;
  alignas(64) std::atomic<unsigned> next_ = 0;  // the block to be finished
  std::atomic<bool> has_failed_ = false, is_over_ = false;
  std::mutex failing_;
  std::exception_ptr failure_;
  alignas(64) std::atomic<std::uint32_t> events_ = 0;  // waiting threads are woken by a change
};

}  // namespace delone::engine
