// SPDX-License-Identifier: BSD-3-Clause
// A periodic triangulation that Python holds.
#pragma once

#include "running.hpp"

#include <delone/periodic.hpp>
#include <delone/periodic_queries.hpp>

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace delone::python {

/// A triangulation that nothing changes any more.
class HeldPeriodic {
 public:
  using Held = std::shared_ptr<const PeriodicTriangulation>;

  HeldPeriodic(Held held, PeriodicOptions options, int threads)
      : held_(std::move(held)), options_(options), threads_(static_cast<unsigned>(threads)) {}

  const PeriodicTriangulation& get() const { return *held_; }
  const Held& owner() const { return held_; }
  const PeriodicOptions& options() const { return options_; }
  unsigned threads() const { return threads_; }
  int dimension() const { return held_->dimension(); }
  /// The answer of what may be made on first use.
  template <class Question>
  auto ask(Question question) const {
    Supervisor supervisor;
    return supervisor.run([&] { return question(*held_); });
  }
  /// Made on first use, without the GIL.
  const PeriodicPointLocator& locator() const {
    const std::lock_guard lock(lazy_->mutex);
    if (!lazy_->locator) lazy_->locator.emplace(*held_);
    return *lazy_->locator;
  }

 private:
  struct Lazy {
    std::mutex mutex;
    std::optional<PeriodicPointLocator> locator;
  };

  Held held_;
  std::shared_ptr<Lazy> lazy_ = std::make_shared<Lazy>();
  PeriodicOptions options_;
  unsigned threads_;
};

}  // namespace delone::python
