// SPDX-License-Identifier: BSD-3-Clause
// The coordinates of the rays of the double description method, in one kind of integers.
#pragma once

#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "polyhedra/arithmetic.hpp"
#include "polyhedra/ray_graph.hpp"
#include "polyhedra/sign_kernel.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace delone::polyhedra {

inline double rounded(std::int64_t x) { return static_cast<double>(x); }
inline double rounded(const Int128& x) { return static_cast<double>(x); }
inline double rounded(const Integer& x) {
  if (bit_length(x) > 1023)
    return x < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  return x.convert_to<double>();
}
inline Integer as_integer(std::int64_t x) { return Integer(x); }
inline Integer as_integer(const Int128& x) { return Integer(x); }
inline Integer as_integer(const Integer& x) { return x; }

/// Rows of `width` numbers each, in blocks: they stay where they are, so growth never needs twice the memory,
/// and pages are taken when they are written.
template <class T>
class NumberRows {
 public:
  /// Begins anew, without rows.
  void reset(std::size_t width) {
    blocks_.clear();
    width_ = width;
    size_ = 0;
  }
  /// New rows hold arbitrary numbers.
  void resize(std::size_t size) {
    while (blocks_.size() * rows_in_block < size)
      blocks_.push_back(std::unique_ptr<T[]>(new T[rows_in_block * width_]));
    size_ = size;
  }
  std::size_t size() const { return size_; }
  std::size_t width() const { return width_; }
  T* operator[](std::size_t row) { return blocks_[row / rows_in_block].get() + row % rows_in_block * width_; }
  const T* operator[](std::size_t row) const {
    return blocks_[row / rows_in_block].get() + row % rows_in_block * width_;
  }

 private:
  static constexpr std::size_t rows_in_block = 64;
  std::vector<std::unique_ptr<T[]>> blocks_;
  std::size_t width_ = 0, size_ = 0;
};

/// Functions that begin with try_ return false if a number is too large for T; what is there stays.
template <class T>
class RayNumbers {
 public:
  bool try_set_rows(const Rows& rows) {
    dimension_ = rows.front().size();
    if (dimension_ > Arithmetic<T>::largest_dimension) return false;
    rows_.clear();
    rows_.reserve(rows.size() * dimension_);
    int bits = 0;
    T entry;
    for (const Row& row : rows)
      for (const Integer& x : row) {
        bits = std::max(bits, bit_length(x));
        if (bits > Arithmetic<T>::most_bits_of_rows || !Arithmetic<T>::try_convert(x, entry)) return false;
        rows_.push_back(entry);
      }
    scratch_.arithmetic.set_rows(bits, dimension_);
    rounded_rows_ = RoundedRows(rows.size(), dimension_, [&](std::size_t row, std::size_t column) {
      return rounded(rows_[row * dimension_ + column]);
    });
    scratch_.rounded_ray.resize(dimension_);
    scratch_.open.resize(words_for(rows.size()));
    return true;
  }
  bool has_rows() const { return !rows_.empty(); }
  /// Takes over the rays of a smaller kind of integers, which must all fit.
  template <class Smaller>
  void take(const RayNumbers<Smaller>& other) {
    rays_.reset(other.rays().width());
    rays_.resize(other.rays().size());
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      internal::cancellation_point();
      const Smaller* const from = other.rays()[i];
      for (std::size_t c = 0; c < rays_.width(); ++c) rays_[i][c] = T(from[c]);
    }
  }
  void clear_rays() { rays_.reset(dimension_); }
  bool try_add_ray(const Row& ray) {
    rays_.resize(rays_.size() + 1);
    T* entry = rays_[rays_.size() - 1];
    for (const Integer& x : ray)
      if (!Arithmetic<T>::try_convert(x, *entry++)) return false;
    return true;
  }

  const NumberRows<T>& rays() const { return rays_; }
  /// Primitive.
  Row ray(RayId id) const {
    std::vector<T> entries(of(id), of(id) + dimension_);
    Arithmetic<T>::make_primitive(entries.data(), dimension_);
    Row row;
    row.reserve(dimension_);
    for (const T& x : entries) row.push_back(as_integer(x));
    return row;
  }
  std::uint32_t find_signs_of(RayId id, std::size_t first, Bits zeros) {
    return find_signs_at(of(id), first, zeros, scratch_);
  }

  /// Computes where a row meets the edges that it cuts, with what is known of the new rays then, in up to
  /// `threads` threads (Options::threads).
  bool try_cut(std::size_t row, const RayGraph& graph, NewRays& made, unsigned threads) {
    made.zeros = BitRows(made.edges.size(), graph.num_rows());
    made.first_negative.resize(made.edges.size());
    if (new_rays_.width() != dimension_) new_rays_.reset(dimension_);
    new_rays_.resize(made.edges.size());
    std::atomic<bool> fit = true;
    constexpr std::size_t part = 256;
    internal::work_in_parts(threads, made.edges.size(), part, [&] {
      return [&, scratch = scratch_](std::size_t first, std::size_t last, const auto& stop) mutable {
        for (std::size_t i = first; i < last && fit.load(std::memory_order_relaxed); ++i) {
          stop();
          if (!try_cut_edge(row, graph, i, made, scratch)) fit.store(false, std::memory_order_relaxed);
        }
      };
    });
    return fit;
  }
  /// After the last step: frees what only steps need.
  void end_steps() { new_rays_.reset(dimension_); }
  void commit(const RayGraph& graph, const std::vector<RayId>& ids) {
    rays_.resize(graph.capacity());
    for (std::size_t i = 0; i < ids.size(); ++i)
      std::move(new_rays_[i], new_rays_[i] + dimension_, rays_[ids[i]]);
  }

 private:
  /// What one thread works with.
  struct Scratch {
    Arithmetic<T> arithmetic;
    std::vector<double> rounded_ray;
    std::vector<std::uint64_t> open;
  };

  bool try_cut_edge(std::size_t row, const RayGraph& graph, std::size_t i, NewRays& made, Scratch& scratch) {
    const std::size_t d = dimension_, words = row / 64 + 1;
    Arithmetic<T>& arithmetic = scratch.arithmetic;
    const auto [positive, negative] = made.edges[i];
    typename Arithmetic<T>::Product at_positive, at_negative;
    if (!arithmetic.try_product(row_at(row), of(positive), d, at_positive) ||
        !arithmetic.try_product(row_at(row), of(negative), d, at_negative) ||
        !arithmetic.try_combine(of(positive), of(negative), at_positive,
                                typename Arithmetic<T>::Product(-at_negative),
                                divisor_of(graph, positive, negative, words, arithmetic), d, new_rays_[i]))
      return false;
    // All rays are on the inner side of earlier rows: a sum of two lies on those that both lie on.
    const Bits zeros = made.zeros[i];
    const ConstBits a = graph.zeros(positive), b = graph.zeros(negative);
    for (std::size_t w = 0; w < words; ++w) zeros[w] = a[w] & b[w];
    zeros[words - 1] &= bit(row) - 1;
    insert(zeros, row);
    made.first_negative[i] = find_signs_at(new_rays_[i], row + 1, zeros, scratch);
    return true;
  }
  const T* of(RayId id) const { return rays_[id]; }
  const T* row_at(std::size_t row) const { return rows_.data() + row * dimension_; }

  /// The first row from `first` on that the ray is beyond; inserts those before that it lies on.
  std::uint32_t find_signs_at(const T* ray, std::size_t first, Bits zeros, Scratch& scratch) const {
    for (std::size_t i = 0; i < dimension_; ++i) scratch.rounded_ray[i] = rounded(ray[i]);
    std::vector<std::uint64_t>& open = scratch.open;
    std::fill(open.begin() + static_cast<std::ptrdiff_t>(first / 64), open.end(), 0);
    std::size_t end = find_signs(rounded_rows_, scratch.rounded_ray, first, zeros, open);
    for (std::size_t w = first / 64; 64 * w < end && w < open.size(); ++w)
      for (std::uint64_t word = open[w]; word != 0; word &= word - 1) {
        const std::size_t row = 64 * w + static_cast<std::size_t>(std::countr_zero(word));
        const int sign = scratch.arithmetic.sign_of_open(row_at(row), ray, dimension_);
        if (sign == 0) insert(zeros, row);
        if (sign < 0) {
          forget_from(row, zeros);
          return static_cast<std::uint32_t>(row);
        }
      }
    return end == rounded_rows_.size() ? RayGraph::none : static_cast<std::uint32_t>(end);
  }
  /// A number that probably divides the combination of two rays; 0 if there is none. Let both be simple, on
  /// rows Z and one more, a and b, and let the entries of a ray be the minors of its rows. Then, by Plücker's
  /// relation, the combination that lies on row k is b·p times the minors of Z and k, and b·p = a·n.
  typename Arithmetic<T>::Product divisor_of(const RayGraph& graph, RayId p, RayId n, std::size_t words,
                                             const Arithmetic<T>& arithmetic) const {
    typename Arithmetic<T>::Product at_p = product_with_other(graph, p, n, words, arithmetic),
                                    at_n = product_with_other(graph, n, p, words, arithmetic);
    return at_p < at_n ? at_p : at_n;
  }
  /// The product of a ray and the first row on which the other ray lies and this one does not; 0 if it is too
  /// large.
  typename Arithmetic<T>::Product product_with_other(const RayGraph& graph, RayId ray, RayId other,
                                                     std::size_t words,
                                                     const Arithmetic<T>& arithmetic) const {
    const ConstBits a = graph.zeros(ray), b = graph.zeros(other);
    typename Arithmetic<T>::Product product = 0;
    for (std::size_t w = 0; w < words; ++w) {
      if ((b[w] & ~a[w]) == 0) continue;
      const std::size_t row = 64 * w + static_cast<std::size_t>(std::countr_zero(b[w] & ~a[w]));
      if (!arithmetic.try_product(row_at(row), of(ray), dimension_, product)) product = 0;
      break;
    }
    return product;
  }
  static void forget_from(std::size_t row, Bits zeros) {
    zeros[row / 64] &= bit(row) - 1;
    for (std::size_t w = row / 64 + 1; w < zeros.size(); ++w) zeros[w] = 0;
  }

  Scratch scratch_;
  std::size_t dimension_ = 0;
  std::vector<T> rows_;
  NumberRows<T> rays_, new_rays_;
  RoundedRows rounded_rows_;
};

}  // namespace delone::polyhedra
