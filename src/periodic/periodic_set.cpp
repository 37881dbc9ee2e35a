// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/periodic_set.hpp"

#include "base/parallel_parts.hpp"
#include "base/require_finite.hpp"
#include "periodic/lattice_reduction.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace delone::periodic {

namespace {

using kernel::Integer;

/// The largest coefficient of a short vector in terms of the given ones.
constexpr int most_of_sums = 1 << 29;

[[noreturn]] void refuse(const std::string& message, std::vector<std::size_t> rows = {}) {
  throw Error(Errc::invalid_argument, message, std::move(rows));
}

[[noreturn]] void refuse_far(std::size_t row) {
  refuse("point " + std::to_string(row) + " is more than 2^29 periods away", {row});
}
[[noreturn]] void refuse_fine(std::size_t row) {
  refuse("the unit is too small: point " + std::to_string(row) + " is not below 2^53 units", {row});
}
[[noreturn]] void refuse_heavy(std::size_t row) {
  refuse("the weight of point " + std::to_string(row) + " is too large for the box", {row});
}

std::vector<double> nearest_doubles(std::span<const Integer> integers, int grid) {
  std::vector<double> numbers;
  for (const Integer& one : integers) numbers.push_back(kernel::nearest_double(one, 1, grid));
  return numbers;
}

class SetMaker {
 public:
  explicit SetMaker(const SetInput& input) : input_(input), d_(input.dimension) {
    check();
    set_.dimension = d_;
    set_.rank = r_;
    set_.weighted = input_.is_weighted;
    set_.unit = input_.unit;
    given_.assign(input_.lattice.begin(), input_.lattice.end());
    for (double& x : given_) x = number_of(x, "a lattice vector", set_.displacement);
    IntegerRows rows = integers_of(given_);
    require_independent(rows.entries);
    sums_ = reduce_lattice(rows.entries, r_);
    // Of a size near 1, so that squares are in range.
    double size = 0;
    for (const double x : r_ > 0 ? std::span<const double>(given_) : input_.points)
      size = std::max(size, std::abs(x));
    exponent_ = size > 0 ? std::ilogb(size) : 0;
    period_ = Period(nearest_doubles(rows.entries, rows.grid - exponent_), r_, d_);
    double codes = 1;
    for (std::size_t i = 0; i < r_; ++i) codes *= 2.0 * period_.reach(i) + 1;
    if (codes > 0x1p62) refuse("the lattice has too many dimensions, or is too flat");
  }

  /// In units of 2^exponent.
  std::vector<double> free_extent(const EachPoint& each_point) {
    std::vector<double> free(d_, 0.0), x(d_);
    if (r_ == d_) return free;
    double ignored = 0;  // points are not placed here
    each_point([&](const double* point) {
      for (std::size_t j = 0; j < d_; ++j)
        x[j] = std::ldexp(number_of(point[j], "a coordinate", ignored), -exponent_);
      for (std::size_t j = 0; j < d_; ++j) {
        double part = x[j];
        for (std::size_t i = 0; i < r_; ++i) part -= period_.fraction(i, x.data()) * period_.vector(i)[j];
        free[j] = std::max(free[j], std::abs(part));
      }
    });
    return free;
  }

  /// With the points of the input.
  PeriodicSet make() {
    return make(free_extent([&](const std::function<void(const double*)>& visit) {
      for (std::size_t at = 0; at < input_.points.size(); at += d_) visit(&input_.points[at]);
    }));
  }
  PeriodicSet make(std::span<const double> free) {
    choose_grid(free);
    snap_lattice();
    wrap_points();
    set_.grid = grid_;
    return std::move(set_);
  }

 private:
  void check() {
    if (d_ == 0 || input_.lattice.size() % d_ != 0)
      throw Error(Errc::bad_dimension, "the lattice has " + std::to_string(input_.lattice.size()) +
                                           " numbers, which are no vectors of " + std::to_string(d_));
    r_ = input_.lattice.size() / d_;
    if (r_ > d_)
      throw Error(Errc::bad_dimension,
                  std::to_string(r_) + " lattice vectors in " + std::to_string(d_) + " dimensions");
    const std::size_t n = input_.points.size() / d_;
    if (input_.is_weighted && input_.weights.size() != n)
      throw Error(Errc::bad_dimension,
                  std::to_string(input_.weights.size()) + " weights for " + std::to_string(n) + " points");
    internal::require_finite(input_.points, d_, "a coordinate");
    internal::require_finite(input_.weights, 1, "the weight");
    internal::require_finite(input_.lattice, d_, "a coordinate", "lattice vector");
    if (!(input_.unit >= 0 && std::isfinite(input_.unit)))
      refuse("the unit must be a finite number above 0, or 0 for none");
  }

  void require_independent(std::span<const Integer> rows) const {
    for (std::size_t i = 0; i < r_; ++i)
      if (std::all_of(rows.begin() + static_cast<std::ptrdiff_t>(i * d_),
                      rows.begin() + static_cast<std::ptrdiff_t>((i + 1) * d_),
                      [](const Integer& x) { return x == 0; }))
        refuse("lattice vector " + std::to_string(i) +
                   (input_.unit > 0 ? " is zero when rounded to multiples of the unit, which is too large"
                                    : " is zero"),
               {i});
    if (r_ > 0 && kernel::exact_determinant(gram_matrix(rows, r_), r_) == 0)
      refuse("the lattice is singular: its vectors are linearly dependent");
  }

  /// A number of the caller as it is, or as a multiple of the unit. `displacement`: the most that any has
  /// moved.
  double number_of(double x, const char* what, double& displacement) const {
    if (input_.unit == 0) return x;
    const double multiple = std::nearbyint(x / input_.unit);
    if (!(std::abs(multiple) <= 0x1p53))
      refuse(std::string("the unit is too small: ") + what + " is not below 2^53 units");
    // Decimal numbers and the product are rounded.
    const double moved = std::abs(x - multiple * input_.unit);
    if (moved > 0x1p-51 * std::abs(x)) displacement = std::max(displacement, moved);
    return multiple;
  }

  /// What coordinates of images are below, and the grid.
  void choose_grid(std::span<const double> free) {
    set_.largest.assign(d_, 0.0);
    for (std::size_t i = 0; i < r_; ++i)
      for (std::size_t j = 0; j < d_; ++j)
        set_.largest[j] += (period_.reach(i) + 1) * std::abs(period_.vector(i)[j]);
    for (std::size_t j = 0; j < d_; ++j) set_.largest[j] += free[j] * (1 + 0x1p-20);
    const double bound = *std::max_element(set_.largest.begin(), set_.largest.end());
    int e = 0;
    std::frexp(bound * (1 + 0x1p-20), &e);
    e += exponent_;
    if (!std::isfinite(bound) || e > std::numeric_limits<double>::max_exponent)
      refuse("the box is too large: images of its points are not finite");
    if (input_.unit > 0 && e > 53) refuse("the unit is too small: the box has more than 2^53 units");
    grid_ = input_.unit > 0 ? 0 : e - 53;
    // Products of many coordinates stay far from the ends of the range.
    constexpr int moderate = 100;
    if (input_.unit == 0 && std::abs(e) > moderate) set_.scale = e;
    for (double& x : set_.largest) x = std::ldexp(x, exponent_ - set_.scale);
    set_.query_grid = e - 53 - set_.scale;
    to_grid_ = PowerOfTwo(-grid_);
    from_grid_ = PowerOfTwo(grid_);
    to_set_ = PowerOfTwo(grid_ - set_.scale);
  }

  /// The nearest multiple of u, in the numbers of the set.
  double snapped(double x, double& displacement) const {
    const double multiple = std::nearbyint(to_grid_(x));
    if (!std::isfinite(multiple)) return multiple;
    const double back = from_grid_(multiple);
    if (back != x)
      displacement = std::max(displacement, std::abs(x - back) * (input_.unit > 0 ? input_.unit : 1));
    return to_set_(multiple);
  }

  void snap_lattice() {
    for (const double x : given_) set_.lattice.push_back(snapped(x, set_.displacement));
    const IntegerRows rows = integers_of(set_.lattice);
    std::vector<Integer> reduced(r_ * d_);
    for (std::size_t i = 0; i < r_; ++i)
      for (std::size_t l = 0; l < r_; ++l) {
        const Integer& factor = sums_[i * r_ + l];
        if (factor > most_of_sums || factor < -most_of_sums)
          refuse("the lattice vectors are too skewed: beyond 2^29 of the shortest ones");
        set_.sums.push_back(static_cast<std::int64_t>(factor));
        for (std::size_t j = 0; j < d_; ++j) reduced[i * d_ + j] += factor * rows.entries[l * d_ + j];
      }
    if (r_ > 0 && kernel::exact_determinant(gram_matrix(reduced, r_), r_) == 0)
      refuse("the lattice is singular on the grid of its coordinates");
    set_.period = Period(nearest_doubles(reduced, rows.grid), r_, d_);
    if (input_.is_exact && set_.displacement > 0)
      refuse("the lattice is not on the grid of " + step_of_grid() + ", and exact input was required");
  }

  /// What there is to say of some rows.
  struct PartOfRows {
    double displacement = 0;
    std::vector<std::size_t> outside, displaced;  // only where they are refused
  };

  void wrap_points() {
    const std::size_t n = input_.points.size() / d_;
    set_.rows.resize(n * set_.row_size());
    set_.wraps.assign(n * r_, 0);
    constexpr std::size_t rows_in_part = 4096;
    std::vector<PartOfRows> parts((n + rows_in_part - 1) / rows_in_part);
    internal::for_parts(input_.threads, n, rows_in_part,
                        [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                          for (std::size_t row = first; row < last; ++row) {
                            if (row % 64 == 0) stop();
                            wrap_point(row, parts[first / rows_in_part]);
                          }
                        });
    std::vector<std::size_t> outside, displaced;
    for (const PartOfRows& part : parts) {
      set_.displacement = std::max(set_.displacement, part.displacement);
      outside.insert(outside.end(), part.outside.begin(), part.outside.end());
      displaced.insert(displaced.end(), part.displaced.begin(), part.displaced.end());
    }
    if (!outside.empty())
      refuse("point " + std::to_string(outside.front()) + " is outside of the box" +
                 internal::and_of_more(outside),
             outside);
    if (!displaced.empty())
      refuse("point " + std::to_string(displaced.front()) + " is not on the grid of " + step_of_grid() +
                 ", and exact input was required" + internal::and_of_more(displaced),
             displaced);
  }

  void wrap_point(std::size_t row, PartOfRows& part) {
    double* const x = set_.rows.data() + row * set_.row_size();
    double displacement = 0;
    for (std::size_t j = 0; j < d_; ++j)
      x[j] = snapped(number_of(input_.points[row * d_ + j], "a coordinate", displacement), displacement);
    if (input_.is_exact && displacement > 0) part.displaced.push_back(row);
    part.displacement = std::max(part.displacement, displacement);
    std::int32_t* const wraps = set_.wraps.data() + row * r_;
    if (!set_.period.wrap(grid_ - set_.scale, x, wraps)) refuse_far(row);
    if (!input_.wraps && std::any_of(wraps, wraps + r_, [](std::int32_t k) { return k != 0; }))
      part.outside.push_back(row);
    for (std::size_t j = 0; j < d_; ++j) x[j] += 0.0;
    if (set_.weighted) x[d_] = weight(row);
  }

  std::string step_of_grid() const { return input_.unit > 0 ? "the unit" : "2^" + std::to_string(grid_); }

  double weight(std::size_t row) const {
    const double w = set_.inner_weight(input_.weights[row]);
    if (!std::isfinite(w)) refuse_heavy(row);
    return w;
  }

  const SetInput& input_;
  const std::size_t d_;
  std::size_t r_ = 0;
  std::vector<double> given_;  // the lattice as numbers
  Period period_;              // reduced, in units of 2^exponent, nearly
  int exponent_ = 0, grid_ = 0;
  PowerOfTwo to_grid_{0}, from_grid_{0}, to_set_{0};  // from numbers in steps of the grid
  std::vector<Integer> sums_;
  PeriodicSet set_;
};

}  // namespace

void PeriodicSet::to_given_basis(std::span<const std::int64_t> k, std::int32_t* given) const {
  for (std::size_t j = 0; j < rank; ++j) {
    std::int64_t sum = 0;  // of products below 2^61
    for (std::size_t i = 0; i < rank; ++i) sum += k[i] * sums[i * rank + j];
    if (sum != static_cast<std::int32_t>(sum))
      throw Error(Errc::unsupported, "offsets of cells do not fit into 32 bits");
    given[j] = static_cast<std::int32_t>(sum);
  }
}

std::vector<double> PeriodicSet::given_points(std::span<const double> given, unsigned threads) const {
  const PowerOfTwo to_grid(-grid), from_grid(grid);
  std::vector<double> points(given.size());
  constexpr std::size_t numbers_in_part = 1 << 14;
  internal::for_parts(threads, given.size(), numbers_in_part,
                      [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                        stop();
                        for (std::size_t i = first; i < last; ++i)
                          points[i] = unit > 0 ? std::nearbyint(given[i] / unit) * unit
                                               : from_grid(std::nearbyint(to_grid(given[i])));
                      });
  return points;
}

double PeriodicSet::snapped_query(double x) const {
  double y = std::ldexp(x, -scale);
  if (unit > 0) {
    const double multiple = std::nearbyint(x / unit);
    if (std::abs(x - multiple * unit) <= 0x1p-51 * std::abs(x)) return multiple;
    y = x / unit;
  }
  const double steps = std::ldexp(y, -query_grid);
  return std::abs(steps) < 0x1p53 ? std::ldexp(std::nearbyint(steps), query_grid) : y;
}

double PeriodicSet::outer_weight(double w) const {
  if (unit == 0) return std::ldexp(w, 2 * scale);
  // Four roundings, half a unit in the last place each, are between this and what the number was made of.
  const double near = w * unit * unit, infinity = std::numeric_limits<double>::infinity();
  double below = near, above = near;
  constexpr int most_steps = 8;
  for (int step = 0; step < most_steps; ++step) {
    if (inner_weight(below) == w) return below;
    if (inner_weight(above) == w) return above;
    below = std::nextafter(below, -infinity);
    above = std::nextafter(above, infinity);
  }
  return near;
}

void PeriodicSet::place(std::size_t row, double* point) const {
  for (std::size_t j = 0; j < dimension; ++j) {
    if (unit == 0) {
      point[j] = std::ldexp(std::nearbyint(std::ldexp(point[j], -grid)), grid - scale);
      continue;
    }
    point[j] = std::nearbyint(point[j] / unit);
    if (!(std::abs(point[j]) <= 0x1p53)) refuse_fine(row);
  }
  std::vector<std::int32_t> wraps(rank, 0);
  if (!period.wrap(grid - scale, point, wraps.data())) refuse_far(row);
  for (std::size_t j = 0; j < dimension; ++j) point[j] += 0.0;
  if (!weighted) return;
  point[dimension] = inner_weight(point[dimension]);
  if (!std::isfinite(point[dimension])) refuse_heavy(row);
}

PeriodicSet make_periodic_set(const SetInput& input) { return SetMaker(input).make(); }

std::vector<double> free_extent(const SetInput& input, const EachPoint& each_point) {
  return SetMaker(input).free_extent(each_point);
}

PeriodicSet make_set_without_rows(const SetInput& input, std::span<const double> free) {
  return SetMaker(input).make(free);
}

}  // namespace delone::periodic
