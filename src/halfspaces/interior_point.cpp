// SPDX-License-Identifier: BSD-3-Clause
#include "halfspaces/interior_point.hpp"

#include "base/progress_meter.hpp"
#include "kernel/hull_stages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace delone::halfspaces {
namespace {

/// The program in the d+1 variables (x, t). Constraints are numbered: the given rows, then t ≤ T, then x_j =
/// 0 for j < d. The last d start in the basis with multiplier zero, and each leaves as soon as a row can
/// replace it.
class InteriorProgram {
 public:
  InteriorProgram(std::span<const double> halfspaces, int dimension, std::span<const std::size_t> rows)
      : halfspaces_(halfspaces), d_(static_cast<std::size_t>(dimension)), rows_(rows) {
    int top = std::numeric_limits<int>::min();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      double largest = 0;
      for (std::size_t j = 0; j < d_; ++j) largest = std::max(largest, std::abs(row(i)[j]));
      weight_exponent_.push_back(std::ilogb(largest) + 1);
      if (row(i)[d_] != 0) top = std::max(top, std::ilogb(row(i)[d_]) - weight_exponent_.back());
    }
    cap_exponent_ = top == std::numeric_limits<int>::min() ? 0 : top + 2;
    basis_.push_back(rows.size());
    for (std::size_t j = 0; j < d_; ++j) basis_.push_back(rows.size() + 1 + j);
  }

  void run() {
    const std::size_t impatient = 100 + 20 * d_;
    for (std::size_t step = 0;; ++step) {
      find_point();
      const auto entering = find_violated(step >= impatient);
      if (!entering) return;
      exchange(*entering);
    }
  }

  const kernel::Fractions& point() const { return point_; }  ///< x and t
  /// The rows of the basis with nonzero multipliers, in increasing order: they bound t.
  std::vector<std::size_t> supporting_rows() const {
    const kernel::Fractions multipliers = solve_transposed(objective());
    std::vector<std::size_t> found;
    for (std::size_t b = 0; b <= d_; ++b)
      if (basis_[b] < rows_.size() && multipliers.numerators[b] != 0) found.push_back(rows_[basis_[b]]);
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  const double* row(std::size_t i) const { return halfspaces_.data() + rows_[i] * (d_ + 1); }

  /// A constraint in integers, up to a positive factor: the coefficients of x and t, then the right-hand
  /// side.
  std::vector<kernel::Integer> constraint(std::size_t i) const {
    std::vector<kernel::Integer> result(d_ + 2, kernel::Integer(0));
    if (i < rows_.size()) {
      std::vector<kernel::Integer> entries = integer_row(row(i), d_ + 1);
      result[d_] = kernel::Integer(1) << (weight_exponent_[i] - common_exponent({row(i), d_ + 1}));
      result[d_ + 1] = -entries[d_];
      std::move(entries.begin(), entries.end() - 1, result.begin());
    } else if (i == rows_.size()) {
      result[d_] = kernel::Integer(1) << std::max(-cap_exponent_, 0);
      result[d_ + 1] = kernel::Integer(1) << std::max(cap_exponent_, 0);
    } else {
      result[i - rows_.size() - 1] = 1;
    }
    return result;
  }
  std::vector<kernel::Integer> objective() const {
    std::vector<kernel::Integer> result(d_ + 1, kernel::Integer(0));
    result[d_] = 1;
    return result;
  }

  void find_point() {
    std::vector<kernel::Integer> system;
    for (const std::size_t b : basis_) {
      const std::vector<kernel::Integer> entries = constraint(b);
      system.insert(system.end(), entries.begin(), entries.end());
    }
    point_ = kernel::solve_exactly(std::move(system), d_ + 1);
    if (point_.denominator < 0) {
      point_.denominator = -point_.denominator;
      for (kernel::Integer& x : point_.numerators) x = -x;
    }
    rounded_.clear();
    for (const kernel::Integer& x : point_.numerators)
      rounded_.push_back(kernel::nearest_double(x, point_.denominator, 0));
  }

  /// The coefficients of `target` as a linear combination of the rows of the basis.
  kernel::Fractions solve_transposed(const std::vector<kernel::Integer>& target) const {
    const std::size_t n = d_ + 1;
    std::vector<kernel::Integer> system(n * (n + 1));
    for (std::size_t b = 0; b < n; ++b) {
      const std::vector<kernel::Integer> entries = constraint(basis_[b]);
      for (std::size_t j = 0; j < n; ++j) system[j * (n + 1) + b] = entries[j];
    }
    for (std::size_t j = 0; j < n; ++j) system[j * (n + 1) + n] = target[j];
    return kernel::solve_exactly(std::move(system), n);
  }

  /// A row that the point violates: the first one, or the one with the largest violation as far as binary64
  /// can tell.
  std::optional<std::size_t> find_violated(bool first) const {
    std::optional<std::size_t> worst;
    double largest = -1;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      // The violation is n·x + c + w·t, measured in units of w. Each coordinate of the point is off by one
      // rounding or, below the normal numbers, by half of the smallest double, times its factor. Products and
      // sums are rounded. If the bound overflows, nothing is certain.
      internal::cancellation_point();
      const double* r = row(i);
      const double weight = std::ldexp(1.0, weight_exponent_[i]);
      double sum = r[d_] + weight * rounded_[d_],
             magnitude = std::abs(r[d_]) + std::abs(weight * rounded_[d_]);
      double factors = weight;
      for (std::size_t j = 0; j < d_; ++j) {
        const double term = r[j] * rounded_[j];
        sum += term;
        magnitude += std::abs(term);
        factors += std::abs(r[j]);
      }
      const double error =
          1.01 * (static_cast<double>(d_ + 6) * 0x1p-53 * magnitude + factors * 0x1p-1074) + 1e-300;
      const bool is_bounded = error < std::numeric_limits<double>::infinity();
      if (is_bounded && sum <= -error) continue;
      const bool is_certain = is_bounded && sum >= error;
      const double violation = is_certain ? sum / weight : 0;
      if (violation <= largest || (!is_certain && !is_violated(i))) continue;
      worst = i;
      largest = violation;
      if (first) return worst;
    }
    return worst;
  }
  bool is_violated(std::size_t i) const {
    if (std::find(basis_.begin(), basis_.end(), i) != basis_.end()) return false;
    const std::vector<kernel::Integer> entries = constraint(i);
    kernel::Integer sum = -entries[d_ + 1] * point_.denominator;
    for (std::size_t j = 0; j <= d_; ++j) sum += entries[j] * point_.numerators[j];
    return sum > 0;
  }

  /// Lets a row enter the basis: its multiplier grows until that of another row becomes zero, and that row
  /// leaves.
  void exchange(std::size_t entering) {
    std::vector<kernel::Integer> target = constraint(entering);
    target.pop_back();
    kernel::Fractions share = solve_transposed(target);
    const kernel::Fractions multipliers = solve_transposed(objective());
    // Both solutions have the denominator det B. Its sign cancels in ratios, but shares need it.
    if (share.denominator < 0)
      for (kernel::Integer& x : share.numerators) x = -x;
    std::optional<std::size_t> leaving;
    const auto multiplier = [&](std::size_t b) -> kernel::Integer {
      return multipliers.denominator < 0 ? kernel::Integer(-multipliers.numerators[b])
                                         : multipliers.numerators[b];
    };
    for (std::size_t b = 0; b <= d_; ++b) {
      if (basis_[b] > rows_.size()) {  // x_j = 0
        if (share.numerators[b] == 0) continue;
        leaving = b;
        break;
      }
      if (share.numerators[b] <= 0) continue;
      if (leaving) {
        const kernel::Integer here = multiplier(b) * share.numerators[*leaving],
                              best = multiplier(*leaving) * share.numerators[b];
        if (here > best || (here == best && basis_[b] > basis_[*leaving])) continue;
      }
      leaving = b;
    }
    // Every row is satisfied for t → −∞, so the program is feasible and some row leaves.
    basis_[*leaving] = entering;
  }

  std::span<const double> halfspaces_;
  std::size_t d_;
  std::span<const std::size_t> rows_;
  std::vector<int> weight_exponent_;
  int cap_exponent_ = 0;
  std::vector<std::size_t> basis_;
  kernel::Fractions point_;
  std::vector<double> rounded_;
};

}  // namespace

InteriorSearch find_interior_point(std::span<const double> halfspaces, int dimension,
                                   std::span<const std::size_t> rows) {
  const auto d = static_cast<std::size_t>(dimension);
  InteriorSearch result;
  result.point.rounded.assign(d, 0.0);
  if (rows.empty()) return result;
  InteriorProgram program(halfspaces, dimension, rows);
  program.run();
  const kernel::Fractions& found = program.point();
  if (found.numerators[d] <= 0) {
    result.state = found.numerators[d] == 0 ? IntersectionState::flat : IntersectionState::empty;
    result.witness = program.supporting_rows();
    return result;
  }
  InteriorPoint& p = result.point;
  for (std::size_t j = 0; j < d; ++j)
    p.rounded[j] = kernel::nearest_double(found.numerators[j], found.denominator, 0);
  internal::StageCounts uncounted;
  const bool rounding_stays_inside =
      std::all_of(p.rounded.begin(), p.rounded.end(), [](double x) { return std::isfinite(x); }) &&
      std::all_of(rows.begin(), rows.end(), [&](std::size_t r) {
        return kernel::side_of_hyperplane(halfspaces.data() + r * (d + 1), p.rounded.data(), dimension,
                                          uncounted) == Sign::negative;
      });
  if (rounding_stays_inside) return result;
  p.numerators.assign(found.numerators.begin(), found.numerators.begin() + dimension);
  p.denominator = found.denominator;
  return result;
}

}  // namespace delone::halfspaces
