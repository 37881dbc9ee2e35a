// SPDX-License-Identifier: BSD-3-Clause
// LinearInterpolator: values at the vertices, weighted sums over the vertices of the cell that contains a
// query.
#include <delone/interpolation.hpp>

#include "queries/barycentric.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace delone {
namespace {

/// Counts queries and calls `progress` every 1024 of them.
class Meter {
 public:
  explicit Meter(const LinearInterpolator::Progress& progress) : progress_(progress) {}
  void operator()() {
    if (++done_ % 1024 == 0 && progress_ && !progress_(done_))
      throw Error(Errc::cancelled, "cancelled by the progress callback");
  }

 private:
  const LinearInterpolator::Progress& progress_;
  std::size_t done_ = 0;
};

void require_size(std::size_t size, std::size_t wanted, const char* what) {
  if (size != wanted)
    throw Error(Errc::bad_dimension,
                std::string(what) + ": " + std::to_string(size) + " numbers, not " + std::to_string(wanted));
}

/// Queries outside the hull, which no cell answers.
struct Leftover {
  std::vector<std::size_t> queries;
  std::vector<double> coordinates;

  void add(std::size_t query, const double* q, std::size_t d) {
    queries.push_back(query);
    coordinates.insert(coordinates.end(), q, q + d);
  }
};

LocateOptions how(const EvaluateOptions& options) {
  return {.tolerance = options.tolerance, .project = options.outside == Outside::project};
}

[[noreturn]] void refuse(std::size_t query) {
  throw Error(Errc::invalid_argument,
              "query " + std::to_string(query) + " is outside the convex hull of the points", {query});
}

}  // namespace

LinearInterpolator::LinearInterpolator(const Triangulation& triangulation, std::span<const double> values,
                                       std::size_t columns)
    : triangulation_(triangulation), locator_(triangulation), columns_(columns) {
  require_size(values.size(), triangulation.num_rows() * columns, "values");
  const Complex complex = triangulation.complex();
  values_.resize(std::max<std::size_t>(complex.num_vertex_slots(), 1) * columns);
  for (const VertexId v : complex.finite_vertices())
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(triangulation.row_of(v) * columns), columns,
                values_.begin() + static_cast<std::ptrdiff_t>(index(v) * columns));
}

void LinearInterpolator::evaluate(std::span<const double> queries, std::span<double> result,
                                  const EvaluateOptions& options) const {
  const Outside outside = options.outside;
  const std::span<const double> fill = options.fill;
  const auto d = static_cast<std::size_t>(triangulation_.dimension());
  require_size(result.size(), queries.size() / d * columns_, "the result");
  if (!fill.empty()) require_size(fill.size(), columns_, "the constants outside");
  const Complex complex = triangulation_.complex();
  Meter meter(options.progress);
  Leftover beyond;
  locator_.locate(queries, how(options), [&](std::size_t query, const LocatedPoint& where) {
    meter();
    double* const at = result.data() + query * columns_;
    if (where.barycentric.empty()) {
      if (outside == Outside::error) refuse(query);
      if (outside == Outside::nearest) beyond.add(query, queries.data() + query * d, d);
      if (fill.empty())
        std::fill_n(at, columns_, std::numeric_limits<double>::quiet_NaN());
      else
        std::copy_n(fill.begin(), columns_, at);
      return;
    }
    std::fill_n(at, columns_, 0.0);
    for (std::size_t i = 0; i < where.barycentric.size(); ++i) {
      const double weight = where.barycentric[i];
      if (weight == 0) continue;  // a NaN at a vertex outside the face of the query does not count
      const double* const value =
          values_.data() + index(complex.vertex(where.cell, static_cast<int>(i))) * columns_;
      for (std::size_t c = 0; c < columns_; ++c) at[c] += weight * value[c];
    }
  });
  if (beyond.queries.empty()) return;
  locator_.nearest(beyond.coordinates, [&](std::size_t i, VertexId v) {
    meter();
    if (v != invalid_vertex)
      std::copy_n(values_.data() + index(v) * columns_, columns_,
                  result.data() + beyond.queries[i] * columns_);
  });
}

void LinearInterpolator::gradients(std::span<const double> queries, std::span<double> result,
                                   const EvaluateOptions& options) const {
  const auto d = static_cast<std::size_t>(triangulation_.dimension());
  const std::size_t width = columns_ * d;
  require_size(result.size(), queries.size() / d * width, "the result");
  const Complex complex = triangulation_.complex();
  Meter meter(options.progress);
  CellId last = invalid_cell;
  std::vector<const double*> points;
  std::vector<double> values, gradient;
  locator_.locate(queries, how(options), [&](std::size_t query, const LocatedPoint& where) {
    meter();
    double* const at = result.data() + query * width;
    if (where.barycentric.empty()) {
      if (options.outside == Outside::error) refuse(query);
      std::fill_n(at, width,
                  options.outside == Outside::nearest ? 0.0 : std::numeric_limits<double>::quiet_NaN());
      return;
    }
    if (where.cell != last) {
      last = where.cell;
      points.clear();
      values.clear();
      for (const VertexId v : complex.vertices(last)) {
        points.push_back(triangulation_.point(v).data());
        const double* const value = values_.data() + index(v) * columns_;
        values.insert(values.end(), value, value + columns_);
      }
      internal::gradients(points, values, static_cast<int>(columns_), static_cast<int>(d), gradient);
    }
    std::copy(gradient.begin(), gradient.end(), at);
  });
}

}  // namespace delone
