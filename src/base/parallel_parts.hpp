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

#include <algorithm>
#include <atomic>
#include <cstddef>

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

/// The parts that one worker takes, one after the other.
class TakenParts {
 public:
  TakenParts(std::atomic<std::size_t>& next, const std::atomic<std::size_t>& end, std::size_t size,
             std::size_t part)
      : next_(next), end_(end), size_(size), part_(part) {}

  /// Goes on to the next part. Returns false if no more are to begin.
  bool take() {
    const std::size_t number = next_.fetch_add(1, std::memory_order_relaxed);
    if (number >= end_.load(std::memory_order_relaxed) || number * part_ >= size_) return false;
    number_ = number;
    num_begun_ = number + 1;
    return true;
  }
  /// The numbers first() … last() − 1 of this part.
  std::size_t first() const { return number_ * part_; }
  std::size_t last() const { return std::min((number_ + 1) * part_, size_); }
  StopPoint stop_point() const { return {end_, number_}; }
  /// This part and those before it; 0 before take().
  std::size_t num_begun() const { return num_begun_; }

 private:
  std::atomic<std::size_t>& next_;
  const std::atomic<std::size_t>& end_;
  const std::size_t size_, part_;
  std::size_t number_ = 0, num_begun_ = 0;
};

/// How many threads shall do so many parts of work: each of these should take some 100 µs at least.
/// `requested`: as Options::threads.
inline unsigned threads_for_parts(unsigned requested, std::size_t parts) {
  if (requested == 1 || parts < (requested == 0 ? std::size_t{4} : std::size_t{2})) return 1;
  return static_cast<unsigned>(std::min<std::size_t>(threads_to_use(requested), parts));
}

/// Calls work(context, parts), which takes parts while there are any, once in each of up to `threads` threads
/// (Options::threads): parts of 0 … size − 1, of `part` numbers each but the last.
void work_in_parts(unsigned threads, std::size_t size, std::size_t part,
                   void (*work)(void* context, TakenParts& parts), void* context);

/// Calls work(first, last, stop) for consecutive parts of 0 … size − 1, of `part` numbers each but the last,
/// in up to `threads` threads (Options::threads), each with its own work = make_work(). `stop` is a
/// StopPoint.
template <class MakeWork>
void work_in_parts(unsigned threads, std::size_t size, std::size_t part, MakeWork&& make_work) {
  auto take_parts = [&](TakenParts& parts) {
    auto work = make_work();
    while (parts.take()) work(parts.first(), parts.last(), parts.stop_point());
  };
  using TakeParts = decltype(take_parts);
  work_in_parts(
      threads, size, part,
      [](void* context, TakenParts& parts) { (*static_cast<TakeParts*>(context))(parts); }, &take_parts);
}

/// The same for work without memory of its own.
template <class Work>
void for_parts(unsigned threads, std::size_t size, std::size_t part, const Work& work) {
  work_in_parts(threads, size, part, [&] {
    return [&](std::size_t first, std::size_t last, const StopPoint& stop) { work(first, last, stop); };
  });
}

}  // namespace delone::internal
