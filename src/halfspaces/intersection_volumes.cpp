// SPDX-License-Identifier: BSD-3-Clause
// Volumes of intersections of hulls, pair by pair. Of two hulls A and B, facets of B that have all vertices
// of A behind them are left out: they contain A, and with it the intersection.
#include <delone/convex_hulls.hpp>
#include <delone/halfspaces.hpp>

#include "base/guarded.hpp"
#include "base/parallel_parts.hpp"

#include <delone/error.hpp>
#include <delone/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace delone {
namespace {

class Overlap : public HalfspaceIntersectionBase {
 public:
  using HalfspaceIntersectionBase::volume_of_faces;
  Overlap(std::span<const double> rows, int dimension)
      : HalfspaceIntersectionBase(rows, dimension, Options{}) {}
  Overlap(std::span<const double> rows, int dimension, std::span<const double> inside)
      : HalfspaceIntersectionBase(rows, dimension, inside, Options{}) {}
};

/// The intersections of one thread.
class Intersector {
 public:
  Intersector(std::span<const double> points, const ConvexHulls& hulls)
      : points_(points), hulls_(hulls), d_(static_cast<std::size_t>(hulls.dimension)) {}

  double volume(std::size_t a, std::size_t b) {
    if (a == b) return hulls_.volumes[a];
    if (hulls_.affine_dimensions[a] < hulls_.dimension || hulls_.affine_dimensions[b] < hulls_.dimension)
      return 0;
    if (!have_common_box(a, b)) return 0;
    is_separated_ = false;
    std::vector<double> of_a = cutting(a, b), of_b = cutting(b, a);
    if (is_separated_) return 0;
    if (of_a.empty()) return hulls_.volumes[b];
    if (of_b.empty()) return hulls_.volumes[a];
    if (of_a.size() > of_b.size()) {
      std::swap(a, b);
      std::swap(of_a, of_b);
    }
    // Only one of the hulls may lose facets: those of the other may be what makes them redundant.
    rows_.assign(equations(b).begin(), equations(b).end());
    rows_.insert(rows_.end(), of_a.begin(), of_a.end());
    if (const auto inside = find_inside(a, b))
      return Overlap(rows_, hulls_.dimension, *inside).volume_of_faces();
    return Overlap(rows_, hulls_.dimension).volume_of_faces();
  }

 private:
  const double* vertex(std::size_t i) const {
    return points_.data() + static_cast<std::size_t>(hulls_.vertices[i]) * d_;
  }
  std::span<const double> equations(std::size_t hull) const {
    const std::size_t first = hulls_.cell_offsets[hull], last = hulls_.cell_offsets[hull + 1];
    return std::span(hulls_.equations).subspan(first * (d_ + 1), (last - first) * (d_ + 1));
  }
  double height(const double* row, const double* x) const {
    double sum = row[d_];
    for (std::size_t j = 0; j < d_; ++j) sum += row[j] * x[j];
    return sum;
  }

  bool have_common_box(std::size_t a, std::size_t b) const {
    for (std::size_t j = 0; j < d_; ++j) {
      const auto [low_a, high_a] = range(a, j);
      const auto [low_b, high_b] = range(b, j);
      if (!(std::max(low_a, low_b) < std::min(high_a, high_b))) return false;
    }
    return true;
  }
  std::pair<double, double> range(std::size_t hull, std::size_t axis) const {
    double low = vertex(hulls_.vertex_offsets[hull])[axis], high = low;
    for (std::size_t i = hulls_.vertex_offsets[hull]; i < hulls_.vertex_offsets[hull + 1]; ++i) {
      low = std::min(low, vertex(i)[axis]);
      high = std::max(high, vertex(i)[axis]);
    }
    return {low, high};
  }

  /// The facets of `of` that have vertices of `other` before them. Notes whether one of them has all.
  std::vector<double> cutting(std::size_t of, std::size_t other) {
    const std::size_t first = hulls_.vertex_offsets[other], last = hulls_.vertex_offsets[other + 1];
    std::vector<double> found;
    const std::span<const double> all = equations(of);
    for (std::size_t r = 0; r < all.size(); r += d_ + 1) {
      double lowest = height(&all[r], vertex(first)), highest = lowest;
      for (std::size_t i = first + 1; i < last; ++i) {
        const double h = height(&all[r], vertex(i));
        lowest = std::min(lowest, h);
        highest = std::max(highest, h);
      }
      if (lowest >= 0) is_separated_ = true;
      const bool is_repeated = r > 0 && std::equal(&all[r], &all[r] + d_ + 1, &all[r] - d_ - 1);
      if (highest > 0 && !is_repeated) found.insert(found.end(), &all[r], &all[r] + d_ + 1);
    }
    return found;
  }

  /// A point strictly inside all rows, if one is soon found: from the middle of the vertices it moves away
  /// from the row that it is least behind. Any such point serves; the result does not depend on it.
  std::optional<std::vector<double>> find_inside(std::size_t a, std::size_t b) const {
    std::vector<double> x(d_, 0.0);
    double size = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      const auto [low_a, high_a] = range(a, j);
      const auto [low_b, high_b] = range(b, j);
      const double low = std::max(low_a, low_b), high = std::min(high_a, high_b);
      x[j] = low / 2 + high / 2;
      size = std::max(size, high - low);
    }
    for (double margin = size / 8; margin > size / 2048; margin /= 2) {
      for (int step = 0; step < 60; ++step) {
        const auto [worst, highest] = least_behind(x);
        if (highest <= -margin / 2) {
          if (is_strictly_inside(x)) return x;
          break;
        }
        for (std::size_t j = 0; j < d_; ++j) x[j] -= (highest + margin) * rows_[worst + j];
      }
    }
    return std::nullopt;
  }
  std::pair<std::size_t, double> least_behind(const std::vector<double>& x) const {
    std::size_t worst = 0;
    double highest = height(&rows_[0], x.data());
    for (std::size_t r = d_ + 1; r < rows_.size(); r += d_ + 1)
      if (const double h = height(&rows_[r], x.data()); h > highest) {
        worst = r;
        highest = h;
      }
    return {worst, highest};
  }
  bool is_strictly_inside(const std::vector<double>& x) const {
    for (const double coordinate : x)
      if (!std::isfinite(coordinate)) return false;
    for (std::size_t r = 0; r < rows_.size(); r += d_ + 1)
      if (side_of_hyperplane(std::span(rows_).subspan(r, d_ + 1), x, hulls_.dimension) != Side::inside)
        return false;
    return true;
  }

  std::span<const double> points_;
  const ConvexHulls& hulls_;
  std::size_t d_;
  bool is_separated_ = false;
  std::vector<double> rows_;
};

}  // namespace

std::vector<double> intersection_volumes(const AnyPoints<>& points, const ConvexHulls& hulls,
                                         std::span<const std::size_t> pairs, const Execution& how) {
  if (hulls.size() > 0) points.require_dimension(hulls.dimension);
  if (pairs.size() % 2 != 0) throw Error(Errc::invalid_argument, "the last pair has one hull only");
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i] >= hulls.size())
      throw Error(Errc::invalid_argument,
                  "pair " + std::to_string(i / 2) + ": there is no hull " + std::to_string(pairs[i]),
                  {i / 2});
  const auto last = std::max_element(hulls.vertices.begin(), hulls.vertices.end());
  if (last != hulls.vertices.end() &&
      static_cast<std::size_t>(*last) >=
          points.coordinates().size() / static_cast<std::size_t>(hulls.dimension))
    throw Error(Errc::invalid_argument,
                "the hulls are not of these points: there is no row " + std::to_string(*last));
  return internal::guarded("the intersections", [&] {
    const internal::ProgressMeter meter(how.progress);
    std::vector<double> volumes(pairs.size() / 2);
    internal::work_in_parts(how.threads, volumes.size(), 4, [&] {
      return [&, intersector = Intersector(points.coordinates(), hulls)](std::size_t first, std::size_t last,
                                                                         const auto& stop) mutable {
        for (std::size_t i = first; i < last; ++i) {
          stop();
          volumes[i] = intersector.volume(pairs[2 * i], pairs[2 * i + 1]);
        }
      };
    });
    return volumes;
  });
}

}  // namespace delone
