// SPDX-License-Identifier: BSD-3-Clause
// Volumes of the parts into which the Voronoi region of an inserted point is divided by the regions of its
// neighbors, by exterior products up the face lattice of the cells that an insertion replaces and creates.
//
// Let Z be the conflict zone of q, a ball of k-simplices, and S the sphere that consists of the cells of Z
// and of those that join q to the facets on its boundary, S = Z − q∗∂Z as oriented chains. Let x_T be the
// center of a cell T of S, q the origin. The part that q takes from a neighbor p is a convex polytope; its
// faces are dual to the faces of S that contain p, and its corners are the x_T. The facet dual to an edge e
// of S has a k-vector W(e), which is k! times the signed volume of its cone from q. These follow by
// recursion: with incidence numbers [s':s],
//
//     W(T) = ±x_T for the orientation of T,    W(s) = x_s ∧ Σ_{s' ⊃ s} [s':s]·W(s'),
//
// where x_s is the center of any cell that contains s. It is a corner of the face dual to s, and the sum is
// the boundary of that face: this is its decomposition into cones. The volume of the part of p, times k!, is
// Σ_{e ∋ p} [e:p]·W(e). Nothing depends on the shape of faces: flat ones, and corners that coincide, count 0.
//
// Moments. M(s) is W of each simplex of the decomposition times the sum of its corners, for faces that
// contain q: M(T) = W(T) ⊗ x_T, and M(s) = x_s ∧ Σ [s':s]·M(s') + W(s) ⊗ x_s. For an edge qp, M/(k·W) is the
// centroid of the facet between q and p.
//
// Error bounds. Let Y = Σ [s':s]·W(s'), of Euclidean norm n and with an error of norm e, and m and δ the
// norms of x_s and its error. As |x ∧ Y| ≤ |x|·|Y|, their product is off by at most m·e + δ·(n + e) from the
// data. An entry of a product of grade g is a sum of g products of magnitudes, off by g·u times their sum; of
// these sums the norm is at most √g·m·n. A sum of c terms is off by c·u times the sum of their norms. The
// factor 1.01 covers second-order terms and the rounding of the bounds. For integers only δ counts, and sums
// of magnitudes replace norms.
#pragma once

#include "base/progress_meter.hpp"
#include "base/stamped_table.hpp"
#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

namespace delone::queries {

/// The sphere S: cells of k+1 increasing numbers of vertices, number 0 for q, with their orientations.
struct ZoneSphere {
  std::size_t k = 0, num_vertices = 0;
  std::vector<std::uint32_t> cells;
  std::vector<signed char> signs;

  std::size_t num_cells() const { return signs.size(); }
};

template <class Number>
class DualVolumes {
 public:
  /// `x`: d coordinates of the center of each cell; those on the k `axes` make the volumes, and the vector of
  /// these is off by at most `delta`. `with_moments`: moments are computed, in d coordinates.
  void compute(const ZoneSphere& sphere, std::span<const int> axes, std::size_t d, const Number* x,
               const Number& delta, bool with_moments);

  /// By vertex: k! times the volume of its part, up to a common sign; for q minus the sum of all.
  std::vector<Number> volumes;
  /// By vertex: what its volume may be off by.
  std::vector<Number> errors;
  /// By vertex: d numbers M, with the same sign.
  std::vector<Number> moments;

 private:
  static constexpr bool is_exact = std::is_same_v<Number, kernel::Integer>;
  static Number magnitude(const Number& x) { return x < 0 ? Number(-x) : x; }
  /// At least |x| for the vector of `count` entries, entry i being x[at(i)].
  template <class At>
  static Number norm(const Number* x, std::size_t count, At at) {
    Number sum(0);
    for (std::size_t i = 0; i < count; ++i)
      if constexpr (is_exact)
        sum += magnitude(x[at(i)]);
      else
        sum += x[at(i)] * x[at(i)];
    if constexpr (is_exact)
      return sum;
    else
      return std::sqrt(sum) + 1e-150;  // covers squares that underflow
  }
  static Number norm(const Number* x, std::size_t count) {
    return norm(x, count, [](std::size_t i) { return i; });
  }
  /// A bound that only the terms from the data enter, or those from rounding, too.
  static Number bound(const Number& data, [[maybe_unused]] const Number& rounding) {
    if constexpr (is_exact)
      return data;
    else
      return 1.01 * (data + 0x1p-53 * rounding) + 1e-290;
  }

  /// The faces of one size.
  struct Level {
    std::size_t size = 0, entries = 0, stride = 0;  // vertices of a face, entries of its value, room for them
    std::vector<std::uint32_t> vertices, cell;
    std::vector<Number> value, moment;
    std::vector<Number> error, parts, terms;  // of the sums; then `error` of the value
    std::size_t count() const { return cell.size(); }
    void clear(std::size_t new_size, std::size_t new_entries, std::size_t new_stride) {
      size = new_size;
      entries = new_entries;
      stride = new_stride;
      for (auto* list : {&vertices, &cell}) list->clear();
      for (auto* list : {&value, &moment, &error, &parts, &terms}) list->clear();
    }
  };
  /// Entry `target` of a product of grade g gets ±x[axis]·Y[source] for g products.
  struct Product {
    std::size_t axis, source;
    bool negative;
  };

  void prepare_products(std::size_t k);
  std::uint32_t face(Level& level, const std::uint32_t* vertices, std::size_t without, std::uint32_t cell);
  void sum_boundary(const Level& upper, Level& lower);
  void multiply(Level& level);

  std::size_t k_ = 0, d_ = 0, entries_k_ = std::numeric_limits<std::size_t>::max();
  std::span<const int> axes_;
  const Number* x_ = nullptr;
  Number delta_{};
  bool with_moments_ = false;
  unsigned bits_ = 0;
  std::vector<std::vector<Product>> products_;  // by grade
  Level levels_[2];
  internal::StampedTable faces_, prefixes_;
  std::vector<Number> scratch_;
};

template <class Number>
void DualVolumes<Number>::prepare_products(std::size_t k) {
  if (entries_k_ == k) return;
  entries_k_ = k;
  products_.assign(k + 1, {});
  std::vector<std::vector<std::uint64_t>> sets(k + 1);  // the axes of each entry, by grade
  std::vector<std::size_t> number(std::size_t{1} << k);
  for (std::uint64_t set = 0; set < number.size(); ++set) {
    auto& of_grade = sets[static_cast<std::size_t>(std::popcount(set))];
    number[set] = of_grade.size();
    of_grade.push_back(set);
  }
  for (std::size_t grade = 1; grade <= k; ++grade)
    for (const std::uint64_t set : sets[grade]) {
      bool negative = false;
      for (std::size_t axis = 0; axis < k; ++axis) {
        const std::uint64_t bit = std::uint64_t{1} << axis;
        if ((set & bit) == 0) continue;
        products_[grade].push_back({axis, number[set ^ bit], negative});
        negative = !negative;
      }
    }
}

/// The number of a face of the level: `vertices` without one of them.
template <class Number>
std::uint32_t DualVolumes<Number>::face(Level& level, const std::uint32_t* vertices, std::size_t without,
                                        std::uint32_t cell) {
  std::uint64_t key = 0;
  const bool fits = bits_ * level.size <= 64;
  for (std::size_t i = 0; i <= level.size; ++i) {
    if (i == without) continue;
    if (fits)
      key = key << bits_ | vertices[i];
    else  // the number of the vertices so far, followed by the next
      key = prefixes_.insert(key << 32 | vertices[i], static_cast<std::uint32_t>(prefixes_.size() + 1)).first;
  }
  const auto [number, is_new] = faces_.insert(key, static_cast<std::uint32_t>(level.count()));
  if (!is_new) return number;
  for (std::size_t i = 0; i <= level.size; ++i)
    if (i != without) level.vertices.push_back(vertices[i]);
  level.cell.push_back(cell);
  level.value.resize(level.value.size() + level.stride, Number(0));
  if (with_moments_) level.moment.resize(level.moment.size() + level.stride * d_, Number(0));
  for (auto* list : {&level.error, &level.parts, &level.terms}) list->push_back(Number(0));
  return number;
}

template <class Number>
void DualVolumes<Number>::sum_boundary(const Level& upper, Level& lower) {
  faces_.clear();
  prefixes_.clear();
  for (std::size_t s = 0; s < upper.count(); ++s) {
    internal::cancellation_point();
    const std::uint32_t* const vertices = upper.vertices.data() + s * upper.size;
    const Number* const value = upper.value.data() + s * upper.stride;
    const Number length = norm(value, upper.entries);
    for (std::size_t i = 0; i < upper.size; ++i) {
      const std::size_t to = face(lower, vertices, i, upper.cell[s]);
      Number* const sum = lower.value.data() + to * lower.stride;
      for (std::size_t j = 0; j < upper.entries; ++j)
        if (i % 2 == 0)
          sum[j] += value[j];
        else
          sum[j] -= value[j];
      lower.error[to] += upper.error[s];
      lower.parts[to] += length;
      lower.terms[to] += 1;
      if (!with_moments_ || vertices[0] != 0 || i == 0) continue;
      const Number* const moment = upper.moment.data() + s * upper.stride * d_;
      Number* const moment_sum = lower.moment.data() + to * lower.stride * d_;
      for (std::size_t j = 0; j < upper.entries * d_; ++j)
        if (i % 2 == 0)
          moment_sum[j] += moment[j];
        else
          moment_sum[j] -= moment[j];
    }
  }
}

/// Replaces the sums of a level by their products with a corner of each face.
template <class Number>
void DualVolumes<Number>::multiply(Level& level) {
  const std::size_t grade = k_ + 2 - level.size;
  const std::vector<Product>& products = products_[grade];
  const std::size_t entries = products.size() / grade;
  const Number g(static_cast<int>(grade));
  for (std::size_t s = 0; s < level.count(); ++s) {
    internal::cancellation_point();
    const Number* const x = x_ + level.cell[s] * d_;
    Number* const value = level.value.data() + s * level.stride;
    const Number m = norm(x, k_, [&](std::size_t j) { return static_cast<std::size_t>(axes_[j]); });
    const Number n = norm(value, level.entries);
    scratch_.assign(entries, Number(0));
    for (std::size_t p = 0; p < products.size(); ++p) {
      const Number term = x[static_cast<std::size_t>(axes_[products[p].axis])] * value[products[p].source];
      if (products[p].negative)
        scratch_[p / grade] -= term;
      else
        scratch_[p / grade] += term;
    }
    if (with_moments_ && level.vertices[s * level.size] == 0) {
      Number* const moment = level.moment.data() + s * level.stride * d_;
      std::vector<Number> product(entries * d_, Number(0));
      for (std::size_t p = 0; p < products.size(); ++p)
        for (std::size_t j = 0; j < d_; ++j) {
          const Number term =
              x[static_cast<std::size_t>(axes_[products[p].axis])] * moment[products[p].source * d_ + j];
          if (products[p].negative)
            product[p / grade * d_ + j] -= term;
          else
            product[p / grade * d_ + j] += term;
        }
      for (std::size_t i = 0; i < entries; ++i)
        for (std::size_t j = 0; j < d_; ++j) moment[i * d_ + j] = product[i * d_ + j] + scratch_[i] * x[j];
    }
    for (std::size_t i = 0; i < entries; ++i) value[i] = scratch_[i];
    const Number error_of_sum = bound(level.error[s], level.terms[s] * level.parts[s]);
    level.error[s] = bound(m * error_of_sum + delta_ * (n + error_of_sum), g * g * m * n);
  }
  level.entries = entries;
}

template <class Number>
void DualVolumes<Number>::compute(const ZoneSphere& sphere, std::span<const int> axes, std::size_t d,
                                  const Number* x, const Number& delta, bool with_moments) {
  k_ = sphere.k;
  d_ = d;
  axes_ = axes;
  x_ = x;
  delta_ = delta;
  with_moments_ = with_moments;
  bits_ = static_cast<unsigned>(std::bit_width(sphere.num_vertices));
  prepare_products(k_);
  const auto entries = [&](std::size_t grade) { return products_[grade].size() / grade; };

  Level *upper = &levels_[0], *lower = &levels_[1];
  upper->clear(k_ + 1, k_, k_);
  upper->vertices = sphere.cells;
  for (std::size_t t = 0; t < sphere.num_cells(); ++t) {
    const Number* const at = x + t * d;
    const Number sign(sphere.signs[t]);
    upper->cell.push_back(static_cast<std::uint32_t>(t));
    for (std::size_t i = 0; i < k_; ++i) upper->value.push_back(sign * at[static_cast<std::size_t>(axes[i])]);
    upper->error.push_back(delta);
    if (with_moments)
      for (std::size_t i = 0; i < k_; ++i)
        for (std::size_t j = 0; j < d; ++j) upper->moment.push_back(upper->value[t * k_ + i] * at[j]);
  }
  for (std::size_t size = k_; size >= 2; --size) {
    const std::size_t grade = k_ + 2 - size;
    lower->clear(size, entries(grade - 1), std::max(entries(grade - 1), entries(grade)));
    sum_boundary(*upper, *lower);
    multiply(*lower);
    std::swap(upper, lower);
  }

  volumes.assign(sphere.num_vertices, Number(0));
  errors.assign(sphere.num_vertices, Number(0));
  moments.assign(with_moments ? sphere.num_vertices * d : 0, Number(0));
  std::vector<Number> parts(sphere.num_vertices, Number(0)), terms(sphere.num_vertices, Number(0));
  for (std::size_t e = 0; e < upper->count(); ++e) {
    const Number& value = upper->value[e * upper->stride];
    const std::size_t a = upper->vertices[2 * e], b = upper->vertices[2 * e + 1];
    volumes[b] += value;
    volumes[a] -= value;
    for (const std::size_t v : {a, b}) {
      errors[v] += upper->error[e];
      parts[v] += magnitude(value);
      terms[v] += 1;
    }
    if (with_moments && a == 0)
      for (std::size_t j = 0; j < d; ++j) moments[b * d + j] = upper->moment[e * upper->stride * d + j];
  }
  for (std::size_t v = 0; v < sphere.num_vertices; ++v) errors[v] = bound(errors[v], terms[v] * parts[v]);
}

}  // namespace delone::queries
