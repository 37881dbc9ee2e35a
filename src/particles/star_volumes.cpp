// SPDX-License-Identifier: BSD-3-Clause
// Volumes of cells are determinants in the k axes onto which the flat of the sites projects one-to-one, over
// k!. Binary64 with a bound finds them; where that is too much for a star of the cell, integers do.
//
// Bound. A determinant is a sum of products of k differences of coordinates. Expanded by subsets of columns,
// a product goes through one rounding of each factor, k − 1 multiplications, and at most k(k−1)/2 additions.
// So with c = 2k − 1 + k(k−1)/2 and u = 2⁻⁵³ the result is off by at most (1 + u)^c − 1 times the permanent
// of the absolute values. The permanent is computed in the same way, hence known up to that factor, too; for
// k ≤ 12 twice the spare u below covers it and the quotient by k!. Where all differences are below 2^a, a ≤
// 900/k, and the largest is at least 2^−900/k, nothing overflows. Every underflow is off by at most 2⁻¹⁰⁷⁵,
// later multiplied by at most 2^(a·(k−2)), and there are fewer than 2^16 of them.
#include "particles/star_volumes.hpp"

#include "base/compensated_sum.hpp"
#include "base/compiled_dimension.hpp"
#include "base/parallel_parts.hpp"
#include "kernel/fractions.hpp"
#include "particles/pass/exact_sums.hpp"
#include "solve/integer_edges.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace delone::particles {
namespace {

constexpr std::size_t part_size = 4096;
constexpr double unknown = std::numeric_limits<double>::infinity();

double factorial(std::size_t k) { return k < 2 ? 1.0 : static_cast<double>(k) * factorial(k - 1); }

/// The sum of terms that are at least 0, the same for any order of them.
double sum_of(std::vector<double>& terms) {
  if (const double largest = largest_magnitude(terms); largest >= 0x1p-900 && largest < 0x1p900)
    return exact_sum(terms);
  std::sort(terms.begin(), terms.end());
  internal::CompensatedSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

struct Volume {
  double value, error;
};

/// The volumes of single cells, K-dimensional; K = 0: of any dimension up to 12. Vertices are taken in the
/// lexicographic order of their coordinates, so that the order in which a cell has them does not matter.
template <int K>
class CellVolume {
 public:
  explicit CellVolume(const std::vector<int>& axes)
      : axes_(axes),
        edges_(axes.size() * axes.size()),
        minors_(std::size_t{1} << axes.size()),
        corners_(axes.size() + 1),
        factorial_(factorial(axes.size())) {
    const auto n = static_cast<double>(axes.size());
    range_ = std::exp2(900 / n);
    share_ = 0x1p-53 * (2 * n - 1 + n * (n - 1) / 2 + 2);
  }

  template <class PointOf>
  void set(const VerticesOfCell& vertices, const PointOf& point_of) {
    for (std::size_t i = 0; i <= k(); ++i) corners_[i] = point_of(vertices[i]);
    std::sort(corners_.begin(), corners_.end(), [&](const double* p, const double* q) {
      for (std::size_t j = 0; j < k(); ++j)
        if (p[axis(j)] != q[axis(j)]) return p[axis(j)] < q[axis(j)];
      return false;
    });
  }

  Volume find() {
    double largest = 0;
    for (std::size_t i = 0; i < k(); ++i)
      for (std::size_t j = 0; j < k(); ++j) {
        edges_[i * k() + j] = corners_[i + 1][axis(j)] - corners_[0][axis(j)];
        largest = std::max(largest, std::abs(edges_[i * k() + j]));
      }
    if (!(largest < range_ && largest * range_ >= 1)) return {0, unknown};
    minors_[0] = {1, 1};
    for (unsigned columns = 1; columns < 1U << k(); ++columns) {
      // The last row of the minor, its columns from the last one on.
      const double* const row = edges_.data() + (static_cast<std::size_t>(std::popcount(columns)) - 1) * k();
      double sum = 0, absolute = 0, sign = 1;
      for (std::size_t j = k(); j-- > 0;) {
        if ((columns >> j & 1U) == 0) continue;
        const Minor& rest = minors_[columns ^ 1U << j];
        sum += sign * row[j] * rest.value;
        absolute += std::abs(row[j]) * rest.permanent;
        sign = -sign;
      }
      minors_[columns] = {sum, absolute};
    }
    const Minor& whole = minors_[(std::size_t{1} << k()) - 1];
    double power = 1;
    for (std::size_t i = 1; i < k(); ++i) power *= largest;
    return {std::abs(whole.value) / factorial_,
            (share_ * whole.permanent + 0x1p-1050 * std::max(1.0, power)) / factorial_};
  }

  /// The double nearest to it.
  double find_exactly() const {
    std::vector<double> projected;
    std::vector<const double*> at;
    for (const double* const p : corners_)
      for (std::size_t j = 0; j < k(); ++j) projected.push_back(p[axis(j)]);
    for (std::size_t i = 0; i <= k(); ++i) at.push_back(projected.data() + i * k());
    const solve::IntegerEdges exact(at, {}, k());
    return kernel::nearest_double(abs(kernel::exact_determinant(exact.edges, k())),
                                  kernel::Integer(static_cast<std::int64_t>(factorial_)),
                                  exact.grid * static_cast<int>(k()));
  }

  /// The k-volume of the cell in R^d over that of its projection, which is the same for all cells of a flat;
  /// rounded up.
  double slope(std::size_t dimension) const {
    const solve::IntegerEdges exact(corners_, {}, dimension);
    std::vector<kernel::Integer> projected;
    for (std::size_t i = 0; i < k(); ++i)
      for (std::size_t j = 0; j < k(); ++j)
        projected.push_back(exact.edges[i * dimension + static_cast<std::size_t>(axis(j))]);
    const kernel::Integer of_projection = kernel::exact_determinant(std::move(projected), k());
    return kernel::root_above(kernel::exact_determinant(exact.gram(), k()), of_projection * of_projection, 0);
  }

 private:
  struct Minor {
    double value, permanent;
  };
  std::size_t k() const { return K > 0 ? static_cast<std::size_t>(K) : axes_.size(); }
  int axis(std::size_t j) const { return axes_[j]; }

  const std::vector<int>& axes_;
  std::vector<double> edges_;
  std::vector<Minor> minors_;
  std::vector<const double*> corners_;
  double factorial_;  // of k
  double range_;      // differences in (1/range, range) do no harm
  double share_;      // of the permanent, by which a determinant may be off
};

class StarVolumes {
 public:
  StarVolumes(const Triangulation& triangulation, const Stars& stars, unsigned threads)
      : complex_(stars.complex()),
        stars_(stars),
        threads_(threads),
        dimension_(static_cast<std::size_t>(triangulation.dimension())),
        points_(triangulation::StoredPoints::of(triangulation)),
        axes_(triangulation.axes()),
        cells_(complex_.num_cell_slots()),
        errors_(complex_.num_cell_slots()),
        volumes_(complex_.num_vertex_slots()) {}

  template <int K>
  std::vector<double> run() {
    const auto point_of = [&](VertexId v) { return points_.point(index(v)); };
    for_cells<K>([&](std::size_t c, const VerticesOfCell& vertices, CellVolume<K>& cell) {
      cell.set(vertices, point_of);
      const Volume found = cell.find();
      cells_[c] = found.value;
      errors_[c] = found.error;
    });
    add();
    std::atomic<bool> is_changed = false;
    for_cells<K>([&](std::size_t c, const VerticesOfCell& vertices, CellVolume<K>& cell) {
      double least = unknown;
      for (const VertexId v : vertices)
        if (stars_.is_wanted(index(v))) least = std::min(least, volumes_[index(v)]);
      if (errors_[c] <= 0x1p-50 * least) return;
      cell.set(vertices, point_of);
      cells_[c] = cell.find_exactly();
      is_changed = true;
    });
    if (is_changed) add();
    if (axes_.size() < dimension_) incline<K>();
    return std::move(volumes_);
  }

 private:
  /// Calls visit(slot, vertices, volume) for all finite cells of stars; volumes are those of a thread.
  template <int K, class Visit>
  void for_cells(const Visit& visit) {
    internal::work_in_parts(threads_, cells_.size(), part_size, [&] {
      return [&, cell = CellVolume<K>(axes_)](std::size_t first, std::size_t last,
                                              const internal::StopPoint& stop) mutable {
        for (std::size_t c = first; c < last; ++c) {
          stop();
          const CellId id{static_cast<Index>(c)};
          if (!complex_.is_cell(id) || complex_.is_infinite(id) || !stars_.has(id)) continue;
          visit(c, complex_.vertices(id), cell);
        }
      };
    });
  }

  /// The sums by vertex.
  void add() {
    internal::work_in_parts(threads_, volumes_.size(), part_size, [&] {
      return [&, terms = std::vector<double>()](std::size_t first, std::size_t last,
                                                const internal::StopPoint& stop) mutable {
        for (std::size_t v = first; v < last; ++v) {
          stop();
          if (!complex_.is_vertex(VertexId{static_cast<Index>(v)}) ||
              !stars_.is_wanted(static_cast<Index>(v)))
            continue;
          terms.clear();
          for (const CellId c : stars_.cells_at(static_cast<Index>(v))) terms.push_back(cells_[index(c)]);
          volumes_[v] = sum_of(terms);
        }
      };
    });
  }

  template <int K>
  void incline() {
    CellVolume<K> any(axes_);
    any.set(complex_.vertices(*complex_.finite_cells().begin()),
            [&](VertexId v) { return points_.point(index(v)); });
    const double slope = any.slope(dimension_);
    for (double& volume : volumes_) volume *= slope;
  }

  const Complex& complex_;
  const Stars& stars_;
  unsigned threads_;
  std::size_t dimension_;
  const sites::VertexPoints& points_;
  std::vector<int> axes_;
  std::vector<double> cells_, errors_;  // by cell; 0 for those that are infinite or not wanted
  std::vector<double> volumes_;         // by vertex
};

}  // namespace

std::vector<double> star_volumes(const Triangulation& triangulation, const Stars& stars, unsigned threads) {
  StarVolumes volumes(triangulation, stars, threads);
  return internal::with_compiled_dimension<2, 4>(stars.dimension(),
                                                 [&](auto k) { return volumes.run<k()>(); });
}

}  // namespace delone::particles
