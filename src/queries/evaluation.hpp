// SPDX-License-Identifier: BSD-3-Clause
// What interpolators share: values by vertex, sizes of arrays, progress, and answers outside.
#pragma once

#include "base/progress_meter.hpp"

#include <delone/error.hpp>
#include <delone/interpolation.hpp>
#include <delone/point_locator.hpp>
#include <delone/triangulation.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <limits>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace delone::queries {

inline void require_size(std::size_t size, std::size_t wanted, const char* what) {
  if (size != wanted)
    throw Error(Errc::bad_dimension,
                std::string(what) + ": " + std::to_string(size) + " numbers, not " + std::to_string(wanted));
}

/// Rows of `width` numbers, one for each input row, as one row for each vertex id. Never empty.
inline std::vector<double> by_vertex(const Triangulation& triangulation, std::span<const double> rows,
                                     std::size_t width) {
  const Complex complex = triangulation.complex();
  std::vector<double> result(std::max<std::size_t>(complex.num_vertex_slots(), 1) * width);
  for (const VertexId v : complex.finite_vertices())
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(triangulation.row_of(v) * width), width,
                result.begin() + static_cast<std::ptrdiff_t>(index(v) * width));
  return result;
}

/// How many steps all threads have done. The thread that makes it tells `progress`, at its cancellation
/// points.
class Progress {
 public:
  explicit Progress(const std::function<bool(std::size_t)>& progress)
      : ask_(progress ? std::function<bool(double)>([&](double) { return progress(done_); }) : nullptr),
        meter_(ask_) {}

  bool is_wanted() const { return ask_ != nullptr; }
  void add(std::size_t steps) {
    done_.fetch_add(steps, std::memory_order_relaxed);
    internal::cancellation_point();
  }

 private:
  std::atomic<std::size_t> done_ = 0;
  std::function<bool(double)> ask_;
  internal::ProgressMeter meter_;
};

/// Counts the steps of one thread and tells of every 256 of them.
class Meter {
 public:
  explicit Meter(Progress& progress) : progress_(&progress) {}
  void operator()() {
    if (++done_ % 256 == 0 && progress_->is_wanted()) progress_->add(256);
  }

 private:
  Progress* progress_;
  std::size_t done_ = 0;
};

inline LocateOptions locate_options(const EvaluateOptions& options) {
  return {.tolerance = options.tolerance,
          .project = options.outside == Outside::project,
          .threads = options.threads};
}

/// The answers of queries that location leaves outside, `width` numbers each. Several threads may call
/// value() and gradient().
class OutsideAnswers {
 public:
  /// `queries`: of d coordinates each.
  OutsideAnswers(const EvaluateOptions& options, std::span<const double> queries, std::size_t d,
                 std::size_t width)
      : options_(options), queries_(queries), d_(d), width_(width) {}

  void value(std::size_t query, double* at) {
    refuse(query);
    if (options_.outside == Outside::nearest) {
      const std::lock_guard lock(mutex_);
      beyond_.push_back(query);
      const double* const q = queries_.data() + query * d_;
      coordinates_.insert(coordinates_.end(), q, q + d_);
    }
    if (options_.fill.empty())
      std::fill_n(at, width_, std::numeric_limits<double>::quiet_NaN());
    else
      std::copy_n(options_.fill.begin(), width_, at);
  }
  void gradient(std::size_t query, double* at) const {
    refuse(query);
    std::fill_n(at, width_,
                options_.outside == Outside::nearest ? 0.0 : std::numeric_limits<double>::quiet_NaN());
  }
  /// Replaces the values of those that get the one at the nearest vertex. `values`: by vertex id.
  void finish(const PointLocator& locator, std::span<const double> values, std::span<double> result,
              Progress& progress) const {
    if (beyond_.empty()) return;
    std::atomic<std::size_t> done = 0;
    locator.nearest(
        coordinates_,
        [&](std::size_t i, VertexId v) {
          if (v != invalid_vertex)
            std::copy_n(values.data() + index(v) * width_, width_, result.data() + beyond_[i] * width_);
          if (progress.is_wanted() && done.fetch_add(1, std::memory_order_relaxed) % 256 == 255)
            progress.add(256);
        },
        options_.threads);
  }

 private:
  void refuse(std::size_t query) const {
    if (options_.outside != Outside::error) return;
    throw Error(Errc::invalid_argument,
                "query " + std::to_string(query) + " is outside the convex hull of the points", {query});
  }

  const EvaluateOptions& options_;
  std::span<const double> queries_;
  std::size_t d_, width_;
  std::mutex mutex_;
  std::vector<std::size_t> beyond_;
  std::vector<double> coordinates_;
};

}  // namespace delone::queries
