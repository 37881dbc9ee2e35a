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
#include <delone/arithmetic.hpp>
#include <delone/natural_neighbors.hpp>

#include "base/length.hpp"
#include "base/progress_meter.hpp"
#include "queries/barycentric.hpp"
#include "queries/evaluation.hpp"
#include "queries/natural_search.hpp"
#include "queries/point_locator_impl.hpp"
#include "queries/site_gradients.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <new>
#include <utility>

namespace delone {

using queries::NaturalCenters;
using queries::NaturalSearch;
using queries::require_size;

struct NaturalNeighborCoordinates::Impl {
  explicit Impl(const Triangulation& t) : centers(t, true), locator(t) {}
  NaturalCenters centers;
  PointLocator locator;
};

NaturalNeighborCoordinates::NaturalNeighborCoordinates(const Triangulation& triangulation,
                                                       const Execution& how) {
  const ArithmeticScope arithmetic;
  const internal::ProgressMeter meter(how.progress);
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

namespace {

/// The point that answers for a query that the location has moved to x', a point of the boundary of a cell or
/// of a flat. x' is no vector of doubles in general; what is wanted is one in the hull.
class InnerPoint {
 public:
  InnerPoint(const NaturalCenters& centers, const LocateOptions& options)
      : centers_(centers), options_(options) {}

  /// Finds a point x' + t·(c − x') in the hull, rounded, where c is the centroid of the cell. Returns false
  /// if there is none near enough: rounding leaves the flat of the points, or the cell is as thin as a
  /// rounding.
  ///
  /// Without a tolerance t is as small as can be, 0 if that will do. With one it is 2⁻³⁰, or less so that the
  /// point stays within τ if x' is: a natural neighbor of a point at depth δ under an edge of length a is at
  /// most a²/δ away across it, so that slivers on the other side with larger spheres take no part.
  bool find(const LocatedPoint& where) {
    const std::size_t d = centers_.dimension(), size = where.barycentric.size();
    centers_.corners(where.cell, corners_);
    std::vector<double> to_centroid(d, 0.0);
    start_.assign(corners_[0], corners_[0] + d);
    for (std::size_t i = 1; i < size; ++i)
      for (std::size_t j = 0; j < d; ++j) {
        const double edge = corners_[i][j] - corners_[0][j];  // 0 on an axis along which all points agree
        start_[j] += where.barycentric[i] * edge;
        to_centroid[j] += edge / static_cast<double>(size);
      }
    double largest = 0;
    for (std::size_t j = 0; j < d; ++j) {
      to_centroid[j] -= start_[j] - corners_[0][j];
      largest = std::max(largest, std::fabs(start_[j]));
    }
    const double length = internal::length_of(d, [&](std::size_t j) { return to_centroid[j]; });
    double t = 0, farthest = 0x1p-20 * length;
    if (options_.tolerance > 0) {
      t = 0x1p-30;
      const double room = options_.tolerance - where.distance;
      if (room >= 0) {
        if (t * length > room) t = room / length;
        farthest = std::max(room, 0x1p-48 * largest);
      }
    }
    point.resize(d);
    for (; t == 0 || t * length <= farthest; t = std::max(2 * t, 0x1p-53)) {
      for (std::size_t j = 0; j < d; ++j) point[j] = start_[j] + t * to_centroid[j];
      location = centers_.triangulation().locate(point, where.cell);
      if (location.kind == Location::Kind::outside_affine_hull) break;
      if (location.kind != Location::Kind::outside_hull) return true;
    }
    point = start_;
    return false;
  }

  /// The coordinates and gradients in the cell itself.
  void find_in_cell(const LocatedPoint& where, bool with_gradients) {
    const std::size_t size = where.barycentric.size();
    vertices.clear();
    weights.clear();
    gradients.clear();
    std::vector<double> all;
    if (with_gradients) {
      std::vector<double> unit(size * size, 0.0);
      for (std::size_t i = 0; i < size; ++i) unit[i * size + i] = 1;
      queries::gradients(corners_, unit, static_cast<int>(size), static_cast<int>(centers_.dimension()), all);
    }
    for (std::size_t i = 0; i < size; ++i) {
      if (where.barycentric[i] == 0) continue;
      vertices.push_back(centers_.complex().vertex(where.cell, static_cast<int>(i)));
      weights.push_back(where.barycentric[i]);
      if (!with_gradients) continue;
      const std::size_t d = centers_.dimension();
      gradients.insert(gradients.end(), all.begin() + static_cast<std::ptrdiff_t>(i * d),
                       all.begin() + static_cast<std::ptrdiff_t>((i + 1) * d));
    }
  }

  std::vector<double> point;
  Location location;
  std::vector<VertexId> vertices;
  std::vector<double> weights, gradients;

 private:
  const NaturalCenters& centers_;
  LocateOptions options_;
  std::vector<const double*> corners_;
  std::vector<double> start_;
};

}  // namespace

void NaturalNeighborCoordinates::find(std::span<const double> queries, const Visit& visit,
                                      bool with_gradients, const Execution& how) const {
  find(queries, {}, visit, with_gradients, how);
}

void NaturalNeighborCoordinates::find(std::span<const double> queries, const LocateOptions& options,
                                      const Visit& visit, bool with_gradients, const Execution& how) const {
  const internal::ProgressMeter meter(how.progress);
  find_by_threads(
      queries, options, [&] { return Visit(std::cref(visit)); }, with_gradients, how.threads);
}

void NaturalNeighborCoordinates::find_by_threads(std::span<const double> queries,
                                                 const LocateOptions& options,
                                                 const std::function<Visit()>& make_visit,
                                                 bool with_gradients, unsigned threads) const {
  const ArithmeticScope arithmetic;
  const NaturalCenters& centers = impl_->centers;
  const std::size_t d = centers.dimension();
  struct Searching {
    NaturalSearch search;
    InnerPoint inner;
    Visit visit;
  };
  const auto answer = [&](Searching& own, std::size_t query, const LocatedPoint& where) {
    auto& [search, inner, visit] = own;
    NaturalNeighbors found;
    found.kind = where.kind;
    found.point = queries.subspan(query * d, d);
    VertexId vertex;
    const double one = 1;
    const auto take = [&](const auto& from) {
      found.vertices = from.vertices;
      found.weights = from.weights;
      found.gradients = from.gradients;
    };
    const auto at_vertex = [&](VertexId v) {
      vertex = v;
      found.kind = Location::Kind::on_vertex;
      found.point = {centers.point(v), d};
      found.vertices = {&vertex, 1};
      found.weights = {&one, 1};
    };
    if (where.kind == Location::Kind::on_vertex) {
      const auto at =
          std::find_if(where.barycentric.begin(), where.barycentric.end(), [](double b) { return b > 0; });
      at_vertex(centers.complex().vertex(where.cell, static_cast<int>(at - where.barycentric.begin())));
    } else if (where.distance > 0) {
      const bool is_in_hull = inner.find(where);
      found.point = inner.point;
      if (!is_in_hull) {
        inner.find_in_cell(where, with_gradients);
        take(inner);
      } else if (inner.location.kind == Location::Kind::on_vertex) {
        at_vertex(inner.location.face.front());
      } else {
        found.kind = inner.location.kind;
        search.find(inner.point.data(), inner.location.cell, with_gradients);
        take(search);
      }
    } else if (!where.barycentric.empty()) {
      search.find(found.point.data(), where.cell, with_gradients);
      take(search);
    }
    visit(query, found);
  };
  const auto make = [&]() -> PointLocator::Visit {
    const auto own = std::shared_ptr<Searching>(
        new Searching{NaturalSearch(centers), InnerPoint(centers, options), make_visit()});
    return [&, own](std::size_t query, const LocatedPoint& where) { answer(*own, query, where); };
  };
  impl_->locator.impl_->locate(queries, options, {.threads = threads, .least_part = 64}, {.make = make});
}

namespace {

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
                                                         const Execution& how)
    : triangulation_(triangulation), coordinates_(triangulation, how), columns_(columns), smooth_(smooth) {
  const ArithmeticScope arithmetic;
  const auto d = static_cast<std::size_t>(triangulation.dimension());
  require_size(values.size(), triangulation.num_rows() * columns, "values");
  if (!site_gradients.empty())
    require_size(site_gradients.size(), triangulation.num_rows() * columns * d,
                 "the gradients at the points");
  values_ = queries::by_vertex(triangulation, values, columns);
  if (!site_gradients.empty()) {
    site_gradients_ = queries::by_vertex(triangulation, site_gradients, columns * d);
  } else if (smooth) {
    const std::vector<VertexId> vertices = triangulation.complex().finite_vertices();
    internal::ProgressMeter meter(how.progress, vertices.size());
    std::vector<double> estimated(values_.size() * d);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      meter(i);
      queries::estimate_gradients(coordinates_.impl_->centers, vertices[i], values_, columns,
                                  estimated.data() + index(vertices[i]) * columns * d);
    }
    site_gradients_ = std::move(estimated);
  }
}

void NaturalNeighborInterpolator::site_gradient(VertexId v, std::span<double> result) const {
  const ArithmeticScope arithmetic;
  const std::size_t width = columns_ * static_cast<std::size_t>(triangulation_.dimension());
  require_size(result.size(), width, "the result");
  triangulation_.point(v);  // throws unless it is a finite vertex
  if (site_gradients_.empty())
    queries::estimate_gradients(coordinates_.impl_->centers, v, values_, columns_, result.data());
  else
    std::copy_n(site_gradients_.data() + index(v) * width, width, result.data());
}

void NaturalNeighborInterpolator::evaluate(std::span<const double> queries, std::span<double> result,
                                           const EvaluateOptions& options, const Execution& how) const {
  const ArithmeticScope arithmetic;
  const auto d = static_cast<std::size_t>(triangulation_.dimension());
  queries::Answers answers(queries, d, result, columns_, options, how);
  if (!options.fill.empty()) require_size(options.fill.size(), columns_, "the constants outside");
  const auto make_visit = [&]() -> NaturalNeighborCoordinates::Visit {
    return [&, meter = answers.meter(),
            interpolant = Interpolant(triangulation_, values_, columns_, site_gradients_)](
               std::size_t query, const NaturalNeighbors& found) mutable {
      meter();
      double* const at = answers.at(query);
      if (found.vertices.empty())
        answers.put_value_outside(query);
      else if (smooth_)
        interpolant.smooth(found.point.data(), found, at, nullptr);
      else
        interpolant.plain(found, at, nullptr);
    };
  };
  coordinates_.find_by_threads(queries, queries::locate_options(options), make_visit, false, how.threads);
  answers.finish(coordinates_.impl_->locator, values_, how.threads);
}

void NaturalNeighborInterpolator::gradients(std::span<const double> queries, std::span<double> result,
                                            const EvaluateOptions& options, const Execution& how) const {
  const ArithmeticScope arithmetic;
  const auto d = static_cast<std::size_t>(triangulation_.dimension());
  const std::size_t width = columns_ * d;
  queries::Answers answers(queries, d, result, width, options, how);
  const auto make_visit = [&]() -> NaturalNeighborCoordinates::Visit {
    return [&, meter = answers.meter(), value = std::vector<double>(columns_),
            interpolant = Interpolant(triangulation_, values_, columns_, site_gradients_)](
               std::size_t query, const NaturalNeighbors& found) mutable {
      meter();
      double* const at = answers.at(query);
      if (found.vertices.empty())
        answers.put_gradient_outside(query);
      else if (found.kind == Location::Kind::on_vertex)
        site_gradient(found.vertices[0], {at, width});
      else if (smooth_)
        interpolant.smooth(found.point.data(), found, value.data(), at);
      else
        interpolant.plain(found, value.data(), at);
    };
  };
  coordinates_.find_by_threads(queries, queries::locate_options(options), make_visit, true, how.threads);
}

}  // namespace delone
