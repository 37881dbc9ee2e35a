// SPDX-License-Identifier: BSD-3-Clause
// The certified stage of Orthospheres: smallest orthospheres in binary64, T: a double, or a SIMD vector with
// one simplex per lane. With edges a_i = p_i − p_0, the rows of A, G = A·Aᵀ and b_i = |a_i|² − (w_i − w_0),
// the center is p_0 + x, x = Aᵀλ with 2Gλ = b, and the squared radius is |x|² − w_0. The proof is in
// docs/predicates.md, "Smallest orthospheres". Included once for each instruction set, after hwy/highway.h.
#if defined(DELONE_FACES_ORTHOSPHERE_SOLVER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef DELONE_FACES_ORTHOSPHERE_SOLVER_INL
#undef DELONE_FACES_ORTHOSPHERE_SOLVER_INL
#else
#define DELONE_FACES_ORTHOSPHERE_SOLVER_INL
#endif

#include "faces/orthosphere_kernel.hpp"
#include "kernel/buffer.hpp"
#include "solve/linear_system-inl.hpp"

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace delone::internal {
namespace HWY_NAMESPACE {

using namespace solve::HWY_NAMESPACE;
using solve::HWY_NAMESPACE::select;  // not that of base

/// The least double that is not below a number within `error` of x, where that is settled.
template <class T>
struct RoundedUp {
  T value;
  Mask<T> is_settled;
};
template <class T>
HWY_INLINE RoundedUp<T> round_up(const Pair<T>& x, T error) {
  const Pair<T> sum = two_sum(x.high, x.low);
  // The doubles beside that, which is normal where anything is settled.
  const T larger = number_of<T>(bits_of(sum.high) + bits<T>(1)),
          smaller = number_of<T>(bits_of(sum.high) - bits<T>(1));
  const Mask<T> is_positive = sum.high > 0;
  const T next = select(is_positive, larger, smaller), previous = select(is_positive, smaller, larger);
  const T top = sum.low + error, bottom = sum.low - error;
  const Mask<T> is_below = top <= 0;
  const Mask<T> settled =
      either(both(is_below, bottom > previous - sum.high), both(bottom > 0, top <= next - sum.high));
  return {select(is_below, sum.high, next), both(settled, abs(sum.high) > 1e-280)};
}

/// One simplex with N edges from p_0 in D dimensions; 0: chosen at run time, N only for doubles.
template <class T, int N, int D>
class OrthosphereSolver {
  static constexpr int most = is_one_lane<T> || D > 0 ? D : static_cast<int>(most_orthosphere_dimension);

 public:
  /// `vertex(i, j)`: coordinate j of p_i, its weight for j = dimension.
  template <class Vertex>
  HWY_INLINE OrthosphereSolver(std::size_t edges, std::size_t dimension, bool weighted, Vertex vertex)
      : high(edges * dimension),
        low(edges * dimension),
        gram(edges * edges),
        right(edges),
        weight(edges),
        num_edges_(edges),
        dimension_(dimension),
        inverse_(edges * edges),
        lambda_(edges),
        x_(dimension) {
    const std::size_t n = num_edges(), d = this->dimension();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < d; ++j) {
        const Pair<T> edge = two_sum(vertex(i + 1, j), minus(vertex(0, j)));
        high[i * d + j] = edge.high;
        low[i * d + j] = edge.low;
        largest = max(largest, abs(edge.high));
      }
    if (weighted) first_weight = vertex(0, d);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t m = 0; m <= i; ++m) {
        T dot = high[i * d] * high[m * d];
        for (std::size_t j = 1; j < d; ++j) dot = dot + high[i * d + j] * high[m * d + j];
        gram[i * n + m] = gram[m * n + i] = dot;
      }
    for (std::size_t i = 0; i < n; ++i) {
      weight[i] = {number<T>(0), number<T>(0)};
      if (weighted) weight[i] = two_sum(vertex(i + 1, d), minus(first_weight));
      heaviest = max(heaviest, abs(weight[i].high));
      right[i] = gram[i * n + i] - weight[i].high;
    }
  }

  std::size_t num_edges() const { return N > 0 ? static_cast<std::size_t>(N) : num_edges_; }
  std::size_t dimension() const { return D > 0 ? static_cast<std::size_t>(D) : dimension_; }

  /// Steps 1 and 2 of the proof. Returns where bounds hold: nothing is certain elsewhere.
  HWY_INLINE Mask<T> solve() {
    const std::size_t size = num_edges();
    const auto n = static_cast<double>(size), d = static_cast<double>(dimension());
    Mask<T> certain =
        both(both(largest > 0x1p-150, largest < 0x1p150), max(heaviest, abs(first_weight)) < 0x1p300);
    T largest_right = number<T>(0);
    for (std::size_t i = 0; i < size; ++i) {
      square_ = max(square_, gram[i * size + i]);
      largest_right = max(largest_right, gram[i * size + i] + abs(weight[i].high));
    }
    if (!invert<N>(gram.data(), inverse_.data(), size)) return both(certain, largest < 0);
    T defect = number<T>(0);
    for (std::size_t i = 0; i < size; ++i) {
      T row = number<T>(0), rest = number<T>(0);
      for (std::size_t j = 0; j < size; ++j) {
        row = row + abs(inverse_[i * size + j]);
        T entry = number<T>(i == j ? 1 : 0);
        for (std::size_t m = 0; m < size; ++m) entry = entry - inverse_[i * size + m] * gram[m * size + j];
        rest = rest + abs(entry);
      }
      norm_ = max(norm_, row);
      defect = max(defect, rest);
      certain = both(certain, rest <= 0.5);  // not NaN
    }
    const T alpha = defect + (1.1 * n * (n + d + 6) * u) * (norm_ * square_ + 1.0);
    certain = both(certain, alpha <= 0.5);
    for (std::size_t i = 0; i < size; ++i) {
      T sum = number<T>(0);
      for (std::size_t m = 0; m < size; ++m) sum = sum + inverse_[i * size + m] * right[m];
      lambda_[i] = 0.5 * sum;
      largest_lambda_ = max(largest_lambda_, abs(lambda_[i]));
    }
    const T e = (0.52 * (n + d + 6) * u) * (norm_ * largest_right) + 1e-290;
    error_ = 1.01 * (e + (2 * alpha) * (largest_lambda_ + e));
    return both(certain, error_ < 1e300);
  }

  /// The signs of λ: bit i is set if the center is beyond the facet opposite vertex i. Returns where they are
  /// certain, after solve().
  HWY_INLINE Mask<T> find_beyond(Bits<T>& beyond) const {
    const auto n = static_cast<double>(num_edges());
    T first = number<T>(1);
    Mask<T> certain = first > 0;
    beyond = bits<T>(0);
    for (std::size_t i = 0; i < num_edges(); ++i) {
      first = first - lambda_[i];
      beyond = beyond | bits_where<T>(lambda_[i] < minus(error_), std::uint64_t{2} << i);
      certain = both(certain, abs(lambda_[i]) > error_);
    }
    const T error_of_first = 1.01 * (n * error_ + (n * u) * (n * largest_lambda_ + 1.0));
    beyond = beyond | bits_where<T>(first < minus(error_of_first), 1);
    return both(certain, abs(first) > error_of_first);
  }

  /// Step 3, after solve(): the squared radius, and a bound on its error.
  struct Square {
    T value, error;
  };
  HWY_INLINE Square approximate_square() {
    const auto n = static_cast<double>(num_edges()), d = static_cast<double>(dimension());
    const T length = 1.01 * root(square_);
    rounding_of_x_ = (1.1 * n * (n + 1) * u) * (largest_lambda_ * length);
    error_of_x_ = (1.01 * n) * (error_ * length) + rounding_of_x_;
    square_of_x_ = number<T>(0);
    for (std::size_t j = 0; j < dimension(); ++j) {
      x_[j] = lambda_[0] * high[j];
      for (std::size_t i = 1; i < num_edges(); ++i) x_[j] = x_[j] + lambda_[i] * high[i * dimension() + j];
      square_of_x_ = square_of_x_ + x_[j] * x_[j];
    }
    const T length_of_x = 1.01 * root(square_of_x_), value = square_of_x_ - first_weight;
    const T error = (d * u) * square_of_x_ + error_of_x_ * (2 * length_of_x + error_of_x_);
    return {value, 1.01 * (error + (3 * u) * abs(value)) + 1e-290};
  }

  /// Step 4, after approximate_square(): rounded up.
  HWY_INLINE RoundedUp<T> square_above() const {
    const std::size_t size = num_edges();
    const auto n = static_cast<double>(size), d = static_cast<double>(dimension());
    kernel::Buffer<T, most> twice_x(dimension());
    Pair<T> sum{number<T>(0), number<T>(0)};
    const auto add = [&sum](T term, T rest) {
      const Pair<T> next = two_sum(sum.high, term);
      sum = {next.high, sum.low + (next.low + rest)};
    };
    for (std::size_t j = 0; j < dimension(); ++j) {
      const Pair<T> product = two_product(x_[j], x_[j]);
      add(product.high, product.low);
      twice_x[j] = 2 * x_[j];
    }
    T correction = number<T>(0), error = number<T>(0), largest_residual = number<T>(0);
    for (std::size_t i = 0; i < size; ++i) {
      const Residual<T> residual = sphere_residual(dimension(), high.data() + i * dimension(),
                                                   low.data() + i * dimension(), twice_x.data(), weight[i]);
      correction = correction + lambda_[i] * residual.value;
      largest_residual = max(largest_residual, abs(residual.value) + residual.error);
      error = error + abs(lambda_[i]) * (residual.error + ((n + 1) * u) * abs(residual.value));
    }
    const T span = root((0.5 * n) * norm_) * largest_residual;
    const T error_of_x = min(error_of_x_, 1.01 * span + rounding_of_x_);
    add(correction, number<T>(0));
    add(minus(first_weight), number<T>(0));
    const T magnitude = (square_of_x_ + abs(first_weight)) + abs(correction);
    error = error + error_of_x * (error_of_x + 2 * rounding_of_x_);
    error = error + (16 * (d + 3) * (d + 3) * u * u) * magnitude;
    return round_up(sum, 1.01 * error + 1e-290);
  }

  kernel::Buffer<T, N * most> high, low;  ///< the edges, exactly high + low
  kernel::Buffer<T, N * N> gram;          ///< products of `high`, rounded
  kernel::Buffer<T, N> right;             ///< b, rounded
  kernel::Buffer<Pair<T>, N> weight;      ///< w_i − w_0
  T largest = number<T>(0), heaviest = number<T>(0),
    first_weight = number<T>(0);  ///< of |high|, of |weight|; w_0

 private:
  static constexpr double u = kernel::unit_roundoff;
  std::size_t num_edges_, dimension_;
  kernel::Buffer<T, N * N> inverse_;
  kernel::Buffer<T, N> lambda_;
  kernel::Buffer<T, most> x_;
  T norm_ = number<T>(0), square_ = number<T>(0), largest_lambda_ = number<T>(0), error_;  // ‖R‖, g, ‖λ̃‖, E
  T rounding_of_x_, error_of_x_, square_of_x_;  // η̂, ε̂, |x̃|²
};

}  // namespace HWY_NAMESPACE
}  // namespace delone::internal
HWY_AFTER_NAMESPACE();

#endif
