// SPDX-License-Identifier: BSD-3-Clause
// NaturalNeighborCoordinates and NaturalNeighborInterpolator: where a query is, its coordinates, and sums.
//
// The smooth interpolant at q (Sibson 1981), with r_i = p_i − q, s_i = |r_i|, coordinates λ_i, values z_i and
// gradients g_i:
//
//     Z = (α·Σ λ_i z_i + β·ξ) / (α + β),    ξ = Σ c_i·(z_i − g_i·r_i) / Σ c_i,    c_i = λ_i/s_i,
//     α = Σ λ_i s_i / Σ c_i,    β = Σ λ_i s_i².
//
// Its gradient follows from those of the coordinates, ∇s_i = −r_i/s_i and the rules for sums, products and
// quotients. All lengths are in units of the largest distance, rounded to a power of two.
#include <delone/natural_neighbors.hpp>

#include "queries/natural_search.hpp"
#include "queries/site_gradients.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <utility>

namespace delone {

using internal::NaturalCenters;
using internal::NaturalSearch;

struct NaturalNeighborCoordinates::Impl {
  explicit Impl(const Triangulation& t) : centers(t, true), locator(t) {}
  NaturalCenters centers;
  PointLocator locator;
};

NaturalNeighborCoordinates::NaturalNeighborCoordinates(const Triangulation& triangulation) {
  try {
    impl_ = std::make_unique<Impl>(triangulation);
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, "not enough memory for the centers of the cells");
  }
}
NaturalNeighborCoordinates::NaturalNeighborCoordinates(NaturalNeighborCoordinates&&) noexcept = default;
NaturalNeighborCoordinates& NaturalNeighborCoordinates::operator=(NaturalNeighborCoordinates&&) noexcept =
    default;
NaturalNeighborCoordinates::~NaturalNeighborCoordinates() = default;

void NaturalNeighborCoordinates::find(std::span<const double> queries, const Visit& visit,
                                      bool with_gradients) const {
  const NaturalCenters& centers = impl_->centers;
  const std::size_t d = centers.dimension();
  NaturalSearch search(centers);
  impl_->locator.locate(queries, [&](std::size_t query, const LocatedPoint& where) {
    NaturalNeighbors found;
    found.kind = where.kind;
    VertexId vertex;
    const double one = 1;
    if (where.kind == Location::Kind::on_vertex) {
      const auto at =
          std::find_if(where.barycentric.begin(), where.barycentric.end(), [](double b) { return b > 0; });
      vertex = centers.complex().vertex(where.cell, static_cast<int>(at - where.barycentric.begin()));
      found.vertices = {&vertex, 1};
      found.weights = {&one, 1};
    } else if (!where.barycentric.empty()) {
      search.find(queries.data() + query * d, where.cell, with_gradients);
      found.vertices = search.vertices;
      found.weights = search.weights;
      found.gradients = search.gradients;
    }
    visit(query, found);
  });
}

namespace {

void require_size(std::size_t size, std::size_t wanted, const char* what) {
  if (size != wanted)
    throw Error(Errc::bad_dimension,
                std::string(what) + ": " + std::to_string(size) + " numbers, not " + std::to_string(wanted));
}

/// Calls `progress` every 256 steps.
class Steps {
 public:
  explicit Steps(const NaturalNeighborInterpolator::Progress& progress) : progress_(progress) {}
  void operator()() {
    if (++done_ % 256 == 0 && progress_ && !progress_(done_))
      throw Error(Errc::cancelled, "cancelled by the progress callback");
  }

 private:
  const NaturalNeighborInterpolator::Progress& progress_;
  std::size_t done_ = 0;
};

[[noreturn]] void refuse(std::size_t query) {
  throw Error(Errc::invalid_argument,
              "query " + std::to_string(query) + " is outside the convex hull of the points", {query});
}

/// Sums over the natural neighbors of a query, and their derivatives.
class Interpolant {
 public:
  Interpolant(const Triangulation& triangulation, std::span<const double> values, std::size_t columns,
              std::span<const double> site_gradients)
      : triangulation_(triangulation),
        values_(values),
        columns_(columns),
        site_gradients_(site_gradients),
        d_(static_cast<std::size_t>(triangulation.dimension())) {}

  /// Σ λ z in `value`, `columns` numbers; if there are gradients of the λ, Σ ∇λ·z in `gradient`.
  void plain(const NaturalNeighbors& found, double* value, double* gradient) const {
    std::fill_n(value, columns_, 0.0);
    if (gradient != nullptr) std::fill_n(gradient, columns_ * d_, 0.0);
    for (std::size_t i = 0; i < found.vertices.size(); ++i)
      for (std::size_t c = 0; c < columns_; ++c) {
        const double z = values_[index(found.vertices[i]) * columns_ + c];
        value[c] += found.weights[i] * z;
        for (std::size_t j = 0; gradient != nullptr && j < d_; ++j)
          gradient[c * d_ + j] += found.gradients[i * d_ + j] * z;
      }
  }

  /// The smooth interpolant; its gradient unless `gradient` is null.
  void smooth(const double* q, const NaturalNeighbors& found, double* value, double* gradient) {
    const std::size_t n = found.vertices.size(), d = d_;
    plain(found, value, gradient);
    if (n == 1) return;
    double largest = 0;
    r_.resize(n * d);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < d; ++j) {
        r_[i * d + j] = triangulation_.point(found.vertices[i])[j] - q[j];
        largest = std::max(largest, std::fabs(r_[i * d + j]));
      }
    const double unit = std::ldexp(1.0, std::ilogb(largest));
    s_.resize(n);
    double sum_c = 0, sum_s = 0, beta = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double square = 0;
      for (std::size_t j = 0; j < d; ++j) {
        r_[i * d + j] /= unit;
        square += r_[i * d + j] * r_[i * d + j];
      }
      s_[i] = std::sqrt(square);
      sum_c += found.weights[i] / s_[i];
      sum_s += found.weights[i] * s_[i];
      beta += found.weights[i] * square;
    }
    const double alpha = sum_s / sum_c;
    // By axis: the gradients of Σ c, of α and of β.
    std::vector<double> of_c(d, 0.0), of_alpha(d, 0.0), of_beta(d, 0.0);
    for (std::size_t i = 0; gradient != nullptr && i < n; ++i)
      for (std::size_t j = 0; j < d; ++j) {
        const double r = r_[i * d + j], s = s_[i], weight = found.weights[i],
                     of_weight = found.gradients[i * d + j] * unit;
        of_c[j] += of_weight / s + weight * r / (s * s * s);
        of_alpha[j] += of_weight * s - weight * r / s;
        of_beta[j] += of_weight * s * s - 2 * weight * r;
      }
    for (std::size_t j = 0; j < d; ++j) of_alpha[j] = (of_alpha[j] - alpha * of_c[j]) / sum_c;
    std::vector<double> of_xi(d);
    for (std::size_t c = 0; c < columns_; ++c) {
      double xi = 0;
      std::fill(of_xi.begin(), of_xi.end(), 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t at = index(found.vertices[i]) * columns_ + c;
        const double* const g = site_gradients_.data() + at * d;
        double extended = values_[at];
        for (std::size_t j = 0; j < d; ++j) extended -= g[j] * unit * r_[i * d + j];
        const double s = s_[i], weight = found.weights[i];
        xi += weight / s * extended;
        for (std::size_t j = 0; gradient != nullptr && j < d; ++j)
          of_xi[j] +=
              (found.gradients[i * d + j] * unit / s + weight * r_[i * d + j] / (s * s * s)) * extended +
              weight / s * g[j] * unit;
      }
      xi /= sum_c;
      const double z = (alpha * value[c] + beta * xi) / (alpha + beta);
      for (std::size_t j = 0; gradient != nullptr && j < d; ++j) {
        double& result = gradient[c * d + j];
        result = (of_alpha[j] * value[c] + alpha * result * unit + of_beta[j] * xi +
                  beta * (of_xi[j] - xi * of_c[j]) / sum_c - z * (of_alpha[j] + of_beta[j])) /
                 (alpha + beta) / unit;
      }
      value[c] = z;
    }
  }

 private:
  const Triangulation& triangulation_;
  std::span<const double> values_;
  std::size_t columns_;
  std::span<const double> site_gradients_;
  std::size_t d_;
  std::vector<double> r_, s_;
};

}  // namespace

NaturalNeighborInterpolator::NaturalNeighborInterpolator(const Triangulation& triangulation,
                                                         std::span<const double> values, std::size_t columns,
                                                         bool smooth, std::span<const double> site_gradients,
                                                         const Progress& progress)
    : triangulation_(triangulation), coordinates_(triangulation), columns_(columns), smooth_(smooth) {
  const auto d = static_cast<std::size_t>(triangulation.dimension());
  require_size(values.size(), triangulation.num_rows() * columns, "values");
  if (!site_gradients.empty())
    require_size(site_gradients.size(), triangulation.num_rows() * columns * d,
                 "the gradients at the points");
  const Complex complex = triangulation.complex();
  const std::size_t slots = std::max<std::size_t>(complex.num_vertex_slots(), 1);
  const auto by_vertex = [&](std::span<const double> rows, std::size_t width) {
    std::vector<double> result(slots * width);
    for (const VertexId v : complex.finite_vertices())
      std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(triangulation.row_of(v) * width), width,
                  result.begin() + static_cast<std::ptrdiff_t>(index(v) * width));
    return result;
  };
  values_ = by_vertex(values, columns);
  if (!site_gradients.empty()) {
    site_gradients_ = by_vertex(site_gradients, columns * d);
  } else if (smooth) {
    Steps step(progress);
    std::vector<double> estimated(slots * columns * d);
    for (const VertexId v : complex.finite_vertices()) {
      step();
      internal::estimate_gradients(coordinates_.impl_->centers, v, values_, columns,
                                   estimated.data() + index(v) * columns * d);
    }
    site_gradients_ = std::move(estimated);
  }
}

void NaturalNeighborInterpolator::site_gradient(VertexId v, std::span<double> result) const {
  const std::size_t width = columns_ * static_cast<std::size_t>(triangulation_.dimension());
  require_size(result.size(), width, "the result");
  triangulation_.point(v);  // throws unless it is a finite vertex
  if (site_gradients_.empty())
    internal::estimate_gradients(coordinates_.impl_->centers, v, values_, columns_, result.data());
  else
    std::copy_n(site_gradients_.data() + index(v) * width, width, result.data());
}

void NaturalNeighborInterpolator::evaluate(std::span<const double> queries, std::span<double> result,
                                           Outside outside, std::span<const double> fill,
                                           const Progress& progress) const {
  const auto d = static_cast<std::size_t>(triangulation_.dimension());
  require_size(result.size(), queries.size() / d * columns_, "the result");
  if (!fill.empty()) require_size(fill.size(), columns_, "the constants outside");
  Steps step(progress);
  Interpolant interpolant(triangulation_, values_, columns_, site_gradients_);
  std::vector<std::size_t> beyond;
  std::vector<double> beyond_at;
  coordinates_.find(queries, [&](std::size_t query, const NaturalNeighbors& found) {
    step();
    double* const at = result.data() + query * columns_;
    const double* const q = queries.data() + query * d;
    if (!found.vertices.empty()) {
      if (smooth_)
        interpolant.smooth(q, found, at, nullptr);
      else
        interpolant.plain(found, at, nullptr);
      return;
    }
    if (outside == Outside::error) refuse(query);
    if (outside == Outside::nearest) {
      beyond.push_back(query);
      beyond_at.insert(beyond_at.end(), q, q + d);
    }
    for (std::size_t c = 0; c < columns_; ++c)
      at[c] = fill.empty() ? std::numeric_limits<double>::quiet_NaN() : fill[c];
  });
  if (beyond.empty()) return;
  coordinates_.impl_->locator.nearest(beyond_at, [&](std::size_t i, VertexId v) {
    step();
    if (v != invalid_vertex)
      std::copy_n(values_.data() + index(v) * columns_, columns_, result.data() + beyond[i] * columns_);
  });
}

void NaturalNeighborInterpolator::gradients(std::span<const double> queries, std::span<double> result,
                                            Outside outside, const Progress& progress) const {
  const auto d = static_cast<std::size_t>(triangulation_.dimension());
  const std::size_t width = columns_ * d;
  require_size(result.size(), queries.size() / d * width, "the result");
  Steps step(progress);
  Interpolant interpolant(triangulation_, values_, columns_, site_gradients_);
  std::vector<double> value(columns_);
  coordinates_.find(
      queries,
      [&](std::size_t query, const NaturalNeighbors& found) {
        step();
        double* const at = result.data() + query * width;
        if (found.vertices.empty()) {
          if (outside == Outside::error) refuse(query);
          std::fill_n(at, width,
                      outside == Outside::nearest ? 0.0 : std::numeric_limits<double>::quiet_NaN());
        } else if (found.kind == Location::Kind::on_vertex) {
          site_gradient(found.vertices[0], {at, width});
        } else if (smooth_) {
          interpolant.smooth(queries.data() + query * d, found, value.data(), at);
        } else {
          interpolant.plain(found, value.data(), at);
        }
      },
      true);
}

}  // namespace delone
