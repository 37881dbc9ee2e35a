// SPDX-License-Identifier: BSD-3-Clause
// A simplex with vertices p_0 … p_n and weights w_i: a_i = p_i − p_0 are the rows of A, G = A·Aᵀ, and
// b_i = |a_i|² − (w_i − w_0). The center of its smallest orthosphere is p_0 + x, x = Aᵀλ with 2Gλ = b, and
// the squared radius is |x|² − w_0. The coordinates λ_1 … λ_n and λ_0 = 1 − Σλ_i of the center are negative
// at the vertices from which it is separated by their facet. That is so if and only if the vertex is strictly
// inside the smallest orthosphere of that facet.
//
// Certified stage. Everything is computed in binary64, u = 2⁻⁵³, from the doubles h_i nearest to a_i, and a
// tilde marks what was computed. Let g = max G_ii, ℓ = √g, and B = max(G_ii + |w_i − w_0|). Norms of matrices
// and of vectors of coordinates λ are those of row sums and largest entries, others are Euclidean; factors
// like 1.02 cover terms of higher order.
//
// 1. |G̃_ij − G_ij| ≤ 1.02(d+3)·u·g, as entries h have errors of u|h|, and d products and sums follow.
//    R is an approximate inverse of G̃. The defect of R is computed, with an error below
//    1.01(n+2)·u·n(1 + ‖R‖g), so ‖I − RG‖ ≤ α = defect + 1.1·n(n+d+6)·u·(1 + ‖R‖g). Let α ≤ 1/2.
// 2. λ̃ = ½R·b̃. The errors of b̃ are below 1.01(d+4)·u·B, and those of the sums of n products below
//    1.01(n+1)·u·‖R‖B, so |λ̃ − ½Rb| ≤ e = 0.52(n+d+6)·u·‖R‖B. As ½Rb − λ = (RG − I)λ, ‖λ‖ ≤ 2(‖λ̃‖+e), and
//    |λ̃ − λ| ≤ E = 1.01(e + 2α(‖λ̃‖+e)). The error of λ̃_0 is below 1.01(nE + nu(1 + n‖λ̃‖)).
// 3. x̃ = Σλ̃_i·h_i is off Aᵀλ̃ by η, |η| ≤ η̂ = 1.1·n(n+1)·u·‖λ̃‖ℓ, so ε = x̃ − x has
//    |ε| ≤ ε̂ = 1.01·nEℓ + η̂. So |x̃|² is off |x|² by at most ε̂(2|x̃| + ε̂): enough to compare the squared
//    radius with most numbers.
// 4. To round it up, let ρ_i = a_i·(a_i − 2x̃) − (w_i − w_0) = b_i − 2a_i·x̃, so ρ = −2Aε. Then
//    |x̃|² + Σλ̃_i·ρ_i = |x|² + 2x·ε + |ε|² − 2(Aᵀλ̃)·ε = |x|² − |ε|² − 2η·ε, as Aᵀλ̃ = x + ε − (x̃ − Aᵀλ̃).
//    So an error of |ε|² + 2η̂|ε| remains, which is of second order. Besides |ε| ≤ ε̂, the part of ε in the flat
//    is at most ½|ρ|·√‖G⁻¹‖ ≤ √(½n‖R‖)·max|ρ_i| as ‖G⁻¹‖ ≤ 2‖R‖, and the rest of it is a part of η. ρ_i is
//    computed as the residual in voronoi/cell_center.cpp, with an error of e_i = u|ρ̃_i| + 5.1(d+3)²u²·M, where
//    M = 1.01(g + 2ℓ|x̃| + |w_i − w_0|) ≥ Σ_j|h_ij|(|h_ij| + 2|x̃_j|) + |w_i − w_0| by Cauchy–Schwarz. |x̃|² is
//    summed in pairs of doubles, with errors of 6u² per sum (kernel/double_double.hpp).
//
// The path gives up unless the largest |h| is between 2⁻¹⁵⁰ and 2¹⁵⁰ and weights are below 2³⁰⁰, so that only
// terms that are smaller than the bounds by more than u can underflow; 10⁻²⁹⁰ covers them.
//
// Small lattices. Let all |h| be at most 2^m units, and weights at most 4^m squares of units. Then g, b_i and
// w_0 are integers of at most γ = (d+2)·4^m squared units. For n = 2, 3 the entries of the adjugate adj G are
// at most 2γ^(n−1), det G is at most n!·γⁿ, (adj G)·b at most 2nγⁿ, bᵀ(adj G)·b at most 2n²γ^(n+1) and
// 4·det G·w_0 at most 4n!·γ^(n+1); for n = 1, adj G = 1, the last two are at most γ² and 4γ². For d ≤ 8 and
// m = 11, 6, 4 (n = 1, 2, 3) these two together stay below 2⁵³ squared units to the power n+1, so nothing is
// rounded: the signs of λ are those of (adj G)·b and 2·det G − Σ((adj G)·b)_i, and the squared radius is a
// quotient of integers, whose rounding is settled by an exact product. With units from 2⁻¹⁰⁰ to 2¹⁰⁰ all of
// these are doubles: they are multiples of 2^(−200·4), and below 2^(200·4 + 53). So is the low part of the
// product: the quotient, if not 0, is at least 2^(−200 − 53), so its last bit is at least 2^(−200 − 106), and
// the denominator is a multiple of 2^(−200·3).
#include "faces/orthosphere.hpp"

#include "base/infinity.hpp"
#include "base/quick_rounds.hpp"
#include "faces/certified_gram.hpp"
#include "faces/orthosphere_kernel.hpp"
#include "faces/square_in_pairs.hpp"
#include "kernel/buffer.hpp"
#include "kernel/double_double.hpp"
#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace delone::internal {
namespace {

using kernel::DoubleDouble;
using kernel::two_product;
using kernel::two_sum;
constexpr double u = kernel::unit_roundoff;

/// The least double that is not below a number within `error` of x, if that settles it.
bool round_up(const DoubleDouble& x, double error, double& rounded) {
  const DoubleDouble sum = two_sum(x.high, x.low);
  const double next = std::nextafter(sum.high, infinity), previous = std::nextafter(sum.high, -infinity);
  rounded = sum.low + error <= 0 ? sum.high : next;
  return sum.low + error <= 0 ? sum.low - error > previous - sum.high
                              : sum.low - error > 0 && sum.low + error <= next - sum.high;
}

/// One simplex with N edges from p_0 in D dimensions; 0: chosen at run time.
template <int N, int D>
class Solver {
 public:
  Solver(const double* const* points, std::size_t corners, std::size_t dimension, bool weighted)
      : edges_(points, corners, dimension), n_(edges_.n), d_(edges_.d), right_(n_), weight_(n_), lambda_(n_) {
    if (weighted) first_weight_ = points[0][d_];
    for (std::size_t i = 0; i < n_; ++i) {
      weight_[i] = weighted ? two_sum(points[i + 1][d_], -first_weight_) : DoubleDouble{0, 0};
      heaviest_ = std::max(heaviest_, std::fabs(weight_[i].high));
      right_[i] = edges_.gram[i * n_ + i] - weight_[i].high;
    }
  }

  /// Whether nothing above was rounded, and nothing of the following will be.
  bool is_small(double small, double small_square) const {
    return edges_.largest <= small && heaviest_ <= small_square && std::fabs(first_weight_) <= small_square;
  }
  /// Both answers. REQUIRES is_small() and N = 1, 2 or 3.
  Orthospheres::Answer find_small() const {
    double numerators[3] = {0, 0, 0}, determinant = 0;
    const auto& G = edges_.gram;
    if constexpr (N == 1) {
      determinant = G[0];
      numerators[0] = right_[0];
    } else if constexpr (N == 2) {
      determinant = G[0] * G[3] - G[1] * G[1];
      numerators[0] = G[3] * right_[0] - G[1] * right_[1];
      numerators[1] = G[0] * right_[1] - G[1] * right_[0];
    } else if constexpr (N == 3) {
      const double c00 = G[4] * G[8] - G[5] * G[5], c01 = G[2] * G[5] - G[1] * G[8],
                   c02 = G[1] * G[5] - G[2] * G[4], c11 = G[0] * G[8] - G[2] * G[2],
                   c12 = G[1] * G[2] - G[0] * G[5], c22 = G[0] * G[4] - G[1] * G[1];
      determinant = G[0] * c00 + G[1] * c01 + G[2] * c02;
      numerators[0] = c00 * right_[0] + c01 * right_[1] + c02 * right_[2];
      numerators[1] = c01 * right_[0] + c11 * right_[1] + c12 * right_[2];
      numerators[2] = c02 * right_[0] + c12 * right_[1] + c22 * right_[2];
    }
    Orthospheres::Answer answer;
    if (determinant == 0) {
      answer.square = std::numeric_limits<double>::quiet_NaN();
      return answer;
    }
    double rest = 2 * determinant, product = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (numerators[i] < 0) answer.beyond |= std::uint64_t{2} << i;
      rest -= numerators[i];
      product += right_[i] * numerators[i];
    }
    if (rest < 0) answer.beyond |= 1;
    const double numerator = product - 4 * determinant * first_weight_, denominator = 4 * determinant;
    answer.square = numerator / denominator;
    const DoubleDouble back = two_product(answer.square, denominator);
    if (back.high < numerator || (back.high == numerator && back.low < 0))
      answer.square = std::nextafter(answer.square, infinity) + 0.0;
    return answer;
  }

  /// Steps 1 and 2; false if no bound holds.
  bool solve() {
    if (!(heaviest_ < 0x1p300 && std::fabs(first_weight_) < 0x1p300) || !edges_.invert()) return false;
    const auto n = static_cast<double>(n_), d = static_cast<double>(d_);
    double largest_right = 0;
    for (std::size_t i = 0; i < n_; ++i)
      largest_right = std::max(largest_right, edges_.gram[i * n_ + i] + std::fabs(weight_[i].high));
    square_ = edges_.square;
    for (std::size_t i = 0; i < n_; ++i) {
      double sum = 0;
      for (std::size_t m = 0; m < n_; ++m) sum += edges_.inverse[i * n_ + m] * right_[m];
      lambda_[i] = 0.5 * sum;
      largest_lambda_ = std::max(largest_lambda_, std::fabs(lambda_[i]));
    }
    const double e = 0.52 * (n + d + 6) * u * edges_.norm * largest_right + 1e-290;
    error_ = 1.01 * (e + 2 * edges_.alpha * (largest_lambda_ + e));
    return std::isfinite(error_);
  }
  /// The signs of λ; false if they are not certain.
  bool find_beyond(std::uint64_t& beyond) const {
    const auto n = static_cast<double>(n_);
    double first = 1;
    beyond = 0;
    bool is_certain = true;
    for (std::size_t i = 0; i < n_; ++i) {
      first -= lambda_[i];
      if (lambda_[i] < -error_) beyond |= std::uint64_t{2} << i;
      is_certain = is_certain && std::fabs(lambda_[i]) > error_;
    }
    const double error_of_first = 1.01 * (n * error_ + n * u * (1 + n * largest_lambda_));
    if (first < -error_of_first) beyond |= 1;
    return is_certain && std::fabs(first) > error_of_first;
  }
  /// Step 3: the squared radius, and a bound on its error.
  std::pair<double, double> approximate_square() {
    const auto n = static_cast<double>(n_), d = static_cast<double>(d_);
    const double length = 1.01 * std::sqrt(square_);
    rounding_of_x_ = 1.1 * n * (n + 1) * u * largest_lambda_ * length;
    error_of_x_ = 1.01 * n * error_ * length + rounding_of_x_;
    double sum = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      const double x = center(j);
      sum += x * x;
    }
    length_of_x_ = 1.01 * std::sqrt(sum);
    const double result = sum - first_weight_;
    return {result, 1.01 * (d * u * sum + error_of_x_ * (2 * length_of_x_ + error_of_x_) +
                            3 * u * std::fabs(result)) +
                        1e-290};
  }
  /// Step 4, after step 3. False if the rounding is not settled.
  bool find_square_above(double& rounded) const {
    const auto n = static_cast<double>(n_), d = static_cast<double>(d_);
    kernel::Buffer<double, D> x(d_);
    DoubleDouble result{0, 0};
    double magnitude = std::fabs(first_weight_);
    for (std::size_t j = 0; j < d_; ++j) {
      x[j] = center(j);
      const DoubleDouble square = two_product(x[j], x[j]);
      result = result + square;
      magnitude += square.high;
    }
    const double length = 1.01 * std::sqrt(square_), second_order = 5.1 * (d + 3) * (d + 3) * u * u;
    double correction = 0, error = 0, largest_residual = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      double sum = -weight_[i].high, rest = -weight_[i].low;
      for (std::size_t j = 0; j < d_; ++j) {
        const double a = edges_.high[i * d_ + j], a_low = edges_.low[i * d_ + j];
        const DoubleDouble factor = two_sum(a, -2 * x[j]);
        const double factor_low = factor.low + a_low;
        const DoubleDouble product = two_product(a, factor.high), next = two_sum(sum, product.high);
        sum = next.high;
        rest += (next.low + product.low) + (a * factor_low + a_low * factor.high);
      }
      const double residual = sum + rest;
      const double m = 1.01 * (square_ + 2 * length * length_of_x_ + std::fabs(weight_[i].high));
      correction += lambda_[i] * residual;
      const double error_of_residual = u * std::fabs(residual) + second_order * m + 1e-290;
      largest_residual = std::max(largest_residual, std::fabs(residual) + error_of_residual);
      // The last term: rounding of the correction, by n products and sums.
      error += std::fabs(lambda_[i]) * (error_of_residual + (n + 1) * u * std::fabs(residual));
    }
    const double error_of_x =
        std::min(error_of_x_, 1.01 * std::sqrt(0.5 * n * edges_.norm) * largest_residual + rounding_of_x_);
    magnitude += std::fabs(correction);
    result = (result + DoubleDouble{correction, 0}) - DoubleDouble{first_weight_, 0};
    error += error_of_x * (error_of_x + 2 * rounding_of_x_) + 8 * (d + 3) * u * u * magnitude;
    return round_up(result, 1.01 * error + 1e-290, rounded);
  }

 private:
  double center(std::size_t j) const {
    double x = 0;
    for (std::size_t i = 0; i < n_; ++i) x += lambda_[i] * edges_.high[i * d_ + j];
    return x;
  }

  CertifiedGram<N, D> edges_;
  const std::size_t n_, d_;
  kernel::Buffer<double, N> right_;
  kernel::Buffer<DoubleDouble, N> weight_;  // w_i − w_0
  kernel::Buffer<double, N> lambda_;
  double first_weight_ = 0, heaviest_ = 0;
  double square_ = 0, largest_lambda_ = 0, error_ = 0;           // g, ‖λ̃‖, E
  double rounding_of_x_ = 0, error_of_x_ = 0, length_of_x_ = 0;  // η̂, ε̂, and a bound on |x̃|
};

/// m of the proof.
int bits_of_small_lattices(std::size_t n, std::size_t d) {
  return d > 8 ? 0 : n == 1 ? 11 : n == 2 ? 6 : n == 3 ? 4 : 0;
}

}  // namespace

int unit_of(std::span<const double> coordinates, std::size_t width) {
  int unit = std::numeric_limits<int>::max();
  QuickRounds round;
  for (std::size_t i = 0; i < coordinates.size() && unit >= -largest_lattice_exponent; ++i) {
    round();
    const bool is_weight = width > 0 && i % (width + 1) == width;
    const double x = coordinates[i];
    unit = std::min(unit, is_weight ? kernel::square_exponent(x) : kernel::trailing_exponent(x));
  }
  return unit;
}

Orthospheres::Orthospheres(int dimension, bool weighted, int unit, std::size_t corners)
    : dimension_(static_cast<std::size_t>(dimension)), corners_(corners), weighted_(weighted) {
  if (corners == 1) {
    find_ = &Orthospheres::find_of_vertex;
    is_within_ = &Orthospheres::is_within_of_vertex;
    return;
  }
  const auto choose = [this](auto n, auto d) {
    find_ = &Orthospheres::find_by_stages<n(), d()>;
    is_within_ = &Orthospheres::is_within_by_stages<n(), d()>;
  };
  constexpr std::integral_constant<int, 0> any;
  constexpr std::integral_constant<int, 1> one;
  constexpr std::integral_constant<int, 2> two;
  constexpr std::integral_constant<int, 3> three;
  const std::size_t n = corners - 1;
  if (dimension == 3 && n <= 3)
    n == 1 ? choose(one, three) : n == 2 ? choose(two, three) : choose(three, three);
  else if (dimension == 2)
    n == 1 ? choose(one, two) : choose(two, two);
  else
    n == 1 ? choose(one, any) : n == 2 ? choose(two, any) : n == 3 ? choose(three, any) : choose(any, any);
  if (n <= most_orthosphere_edges && dimension_ <= most_orthosphere_dimension)
    lanes_.resize(corners * (dimension_ + 1) * orthosphere_block, 0.0);
  const int bits = bits_of_small_lattices(n, dimension_);
  if (bits == 0 || unit < -largest_lattice_exponent || unit > largest_lattice_exponent) return;
  small_ = std::ldexp(1.0, unit + bits);
  small_square_ = std::ldexp(1.0, 2 * (unit + bits));
}

/// Writes a block to its lanes, the last simplex also to those that are left. False if each simplex is better
/// off alone: on small lattices, and where there is no such code.
bool Orthospheres::fills_lanes(std::size_t count, const double* const* points) {
  if (lanes_.empty()) return false;
  if (small_ > 0) {
    double largest = 0;
    for (std::size_t i = 1; i < corners_; ++i)
      for (std::size_t j = 0; j < dimension_; ++j)
        largest = std::max(largest, std::fabs(points[i][j] - points[0][j]));
    if (largest <= small_) return false;
  }
  const std::size_t width = dimension_ + (weighted_ ? 1 : 0);
  for (std::size_t lane = 0; lane < orthosphere_block; ++lane) {
    const double* const* const of_simplex = points + std::min(lane, count - 1) * corners_;
    double* to = lanes_.data() + lane;
    for (std::size_t i = 0; i < corners_; ++i, to += (dimension_ + 1) * orthosphere_block) {
      const double* const p = of_simplex[i];
      if (width == 3) {
        to[0] = p[0];
        to[orthosphere_block] = p[1];
        to[2 * orthosphere_block] = p[2];
      } else {
        for (std::size_t j = 0; j < width; ++j) to[j * orthosphere_block] = p[j];
      }
    }
  }
  return true;
}

void Orthospheres::find_block(std::size_t count, const double* const* points, Want want, Answer* answers) {
  if (!fills_lanes(count, points)) {
    for (std::size_t i = 0; i < count; ++i) answers[i] = find(points + i * corners_, want);
    return;
  }
  OrthosphereBlock found;
  find_orthospheres_in_lanes(corners_ - 1, dimension_, weighted_, want != Want::beyond, lanes_.data(), found);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_certain = (want == Want::square || found.beyond_is_certain[i] != 0) &&
                            (want == Want::beyond || found.square_is_certain[i] != 0);
    answers[i] = is_certain ? Answer{want == Want::beyond ? 0.0 : found.square[i], found.beyond[i]}
                            : find(points + i * corners_, want);
  }
}

void Orthospheres::is_within_block(std::size_t count, const double* const* points, const SquareBound& bound,
                                   bool* is_within) {
  std::uint64_t beyond[orthosphere_block];
  bool beyond_is_known[orthosphere_block];
  is_within_block(count, points, bound, is_within, beyond, beyond_is_known);
}

void Orthospheres::is_within_block(std::size_t count, const double* const* points, const SquareBound& bound,
                                   bool* is_within, std::uint64_t* beyond, bool* beyond_is_known) {
  std::fill_n(beyond_is_known, count, false);
  if (!std::isfinite(bound.below()) || !fills_lanes(count, points)) {
    for (std::size_t i = 0; i < count; ++i) is_within[i] = this->is_within(points + i * corners_, bound);
    return;
  }
  OrthosphereBlock found;
  find_orthospheres_in_lanes(corners_ - 1, dimension_, weighted_, false, lanes_.data(), found);
  for (std::size_t i = 0; i < count; ++i) {
    beyond[i] = found.beyond[i];
    beyond_is_known[i] = found.beyond_is_certain[i] != 0;
    const bool is_certain = found.range_is_certain[i] != 0;
    is_within[i] = is_certain && found.most[i] <= bound.below() ? true
                   : is_certain && found.least[i] > bound.above()
                       ? false
                       : this->is_within(points + i * corners_, bound);
  }
}

template <int N, int D>
Orthospheres::Answer Orthospheres::find_by_stages(const double* const* points, Want want) {
  Solver<N, D> solver(points, corners_, dimension_, weighted_);
  if constexpr (N > 0) {
    if (solver.is_small(small_, small_square_)) return solver.find_small();
  }
  Answer answer;
  bool is_certain = solver.solve();
  if (is_certain && want != Want::square) is_certain = solver.find_beyond(answer.beyond);
  if (is_certain && want != Want::beyond) {
    solver.approximate_square();
    is_certain = solver.find_square_above(answer.square);
  }
  if (is_certain) return answer;
  if (want == Want::square && !weighted_)
    if (const auto square = square_in_pairs(points, corners_, dimension_)) {
      if (round_up(square->value, square->error, answer.square)) return answer;
      // Within 2⁻⁸⁰ of a double.
      answer.square = square->value.high + square->value.low;
      if (is_nearest_enough_) return answer;
    }
  ++num_exact_;
  const ExactOrthosphere exact(points, corners_, dimension_, weighted_);
  if (want != Want::square) answer.beyond = exact.beyond();
  if (want != Want::beyond) answer.square = exact.square_above();
  return answer;
}

template <int N, int D>
bool Orthospheres::is_within_by_stages(const double* const* points, const SquareBound& bound) {
  if (!std::isfinite(bound.below()) && bound.below() == bound.above()) return bound.above() > 0;
  Solver<N, D> solver(points, corners_, dimension_, weighted_);
  double rounded = 0;
  bool is_known = false;
  if constexpr (N > 0) {
    is_known = solver.is_small(small_, small_square_);
    if (is_known) rounded = solver.find_small().square;
  }
  if (!is_known && solver.solve()) {
    const auto [square, error] = solver.approximate_square();
    // Both ends are rounded, by less than the bound is generous.
    if (square + error <= bound.below()) return true;
    if (square - error > bound.above()) return false;
    is_known = solver.find_square_above(rounded);
  }
  if (is_known)
    if (const auto answer = bound.admits(rounded); answer != SquareBound::Answer::unsure)
      return answer == SquareBound::Answer::yes;
  ++num_exact_;
  return ExactOrthosphere(points, corners_, dimension_, weighted_).is_within(bound);
}

Orthospheres::Answer Orthospheres::find_of_vertex(const double* const* points, Want) {
  return {weighted_ ? 0 - points[0][dimension_] : 0.0, 0};
}

bool Orthospheres::is_within_of_vertex(const double* const* points, const SquareBound& bound) {
  return find_of_vertex(points, Want::square).square <= bound.below();
}

}  // namespace delone::internal
