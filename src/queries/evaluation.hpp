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

/// How many of the queries all threads have answered. The thread that makes it tells the progress function.
class Progress {
 public:
  Progress(const std::function<bool(double)>& progress, std::size_t num_queries)
      : meter_(progress, num_queries), is_wanted_(internal::current_meter != nullptr) {}

  bool is_wanted() const { return is_wanted_; }
  void add(std::size_t queries) {
    const std::size_t done = done_.fetch_add(queries, std::memory_order_relaxed) + queries;
    if (internal::current_meter != nullptr) meter_(done);  // no other thread has one
  }

 private:
  std::atomic<std::size_t> done_ = 0;
  internal::ProgressMeter meter_;
  bool is_wanted_;
};

/// Counts the queries of one thread and tells of every 256 of them.
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
  return {.tolerance = options.tolerance, .project = options.outside == Outside::project};
}

/// Throws if queries outside are errors.
inline void refuse_outside(const EvaluateOptions& options, std::size_t query) {
  if (options.outside == Outside::error)
    throw Error(Errc::invalid_argument,
                "query " + std::to_string(query) + " is outside the convex hull of the points", {query});
}

/// The answers to some queries, `width` numbers each, and those outside. Several threads may put answers.
class Answers {
 public:
  /// `queries`: of d coordinates each. Throws unless `result` has room for the answers and no more.
  Answers(std::span<const double> queries, std::size_t d, std::span<double> result, std::size_t width,
          const EvaluateOptions& options, const Execution& how)
      : options_(options),
        queries_(queries),
        result_(result),
        d_(d),
        width_(width),
        progress_(how.progress, queries.size() / d) {
    require_size(result.size(), queries.size() / d * width, "the result");
  }

  double* at(std::size_t query) const { return result_.data() + query * width_; }
  /// For one thread.
  Meter meter() { return Meter(progress_); }

  /// REQUIRES answers that are values.
  void put_value_outside(std::size_t query) {
    refuse_outside(options_, query);
    if (options_.outside == Outside::nearest) {
      const std::lock_guard lock(mutex_);
      beyond_.push_back(query);
      const double* const q = queries_.data() + query * d_;
      coordinates_.insert(coordinates_.end(), q, q + d_);
    }
    if (options_.fill.empty())
      std::fill_n(at(query), width_, std::numeric_limits<double>::quiet_NaN());
    else
      std::copy_n(options_.fill.begin(), width_, at(query));
  }
  void put_gradient_outside(std::size_t query) const {
    refuse_outside(options_, query);
    std::fill_n(at(query), width_,
                options_.outside == Outside::nearest ? 0.0 : std::numeric_limits<double>::quiet_NaN());
  }
  /// Replaces the values of those that get the one at the nearest vertex. `values`: by vertex id.
  void finish(const PointLocator& locator, std::span<const double> values, unsigned threads) const {
    if (beyond_.empty()) return;
    locator.nearest(coordinates_,
                    [&](std::size_t i, VertexId v) {
                      if (v != invalid_vertex)
                        std::copy_n(values.data() + index(v) * width_, width_, at(beyond_[i]));
                    },
                    {.threads = threads});
  }

 private:
  const EvaluateOptions& options_;
  std::span<const double> queries_;
  std::span<double> result_;
  std::size_t d_, width_;
  Progress progress_;
  std::mutex mutex_;
  std::vector<std::size_t> beyond_;
  std::vector<double> coordinates_;
};

}  // namespace delone::queries
