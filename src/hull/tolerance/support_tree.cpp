// SPDX-License-Identifier: BSD-3-Clause
// A slab holds points w = c + α·m + t with |α| ≤ A and |t| ≤ T, where m is about a unit vector across the
// points and t about orthogonal to it. With β = n·m, n·t = (n − β·m)·t + β·(m·t), so
//   n·(q − w) ≥ n·(q − c) − |β|·A − |n − β·m|·T − |β|·|m·t|,
// and |m·t| is a few roundings of |w − c|. Points of a boundary are nearly flat: A is of the order of T². A
// box along the axes would stick out by the order of T. All roundings together, those of a computed n·(q − w)
// included, are at most some multiple of d + 4 times u·‖n‖·(‖q − c‖ + R), R the sum of A and T, in sum norms.
//
// A computed n·(q − w) is off by at most γ(d+1) of the sum of the absolute products.
#include "hull/tolerance/support_tree.hpp"

#include "base/infinity.hpp"
#include "kernel/determinant.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

namespace delone::hull {

namespace {

constexpr int num_squarings = 6;
constexpr double least = 0x1p-500;

/// About the unit vector in which some vectors of at most 1 extend least: the dominant one of a power of
/// trace − covariance, found by squaring. `covariance` is used up.
void find_thin_direction(std::vector<double>& covariance, std::size_t d, double* direction) {
  double trace = 0;
  for (std::size_t j = 0; j < d; ++j) trace += covariance[j * d + j];
  for (double& x : covariance) x = -x;
  for (std::size_t j = 0; j < d; ++j) covariance[j * d + j] += trace;
  std::vector<double> squared(d * d);
  for (int round = 0; round < num_squarings; ++round) {
    double largest = 0;
    for (std::size_t r = 0; r < d; ++r)
      for (std::size_t c = 0; c < d; ++c) {
        double sum = 0;
        for (std::size_t j = 0; j < d; ++j) sum += covariance[r * d + j] * covariance[j * d + c];
        squared[r * d + c] = sum;
        largest = std::max(largest, std::fabs(sum));
      }
    for (std::size_t i = 0; i < d * d; ++i) covariance[i] = squared[i] / largest;
  }
  std::size_t best = 0;
  for (std::size_t j = 1; j < d; ++j)
    if (covariance[j * d + j] > covariance[best * d + best]) best = j;
  double square = 0;
  for (std::size_t j = 0; j < d; ++j) square += covariance[best * d + j] * covariance[best * d + j];
  for (std::size_t j = 0; j < d; ++j) {
    const double x = covariance[best * d + j] / std::sqrt(square);
    direction[j] = std::isfinite(x) ? x : 0;
  }
}

}  // namespace

SupportTree::SupportTree(std::span<const double* const> points, int dimension, std::vector<Index> members)
    : points_(points.begin(), points.end()),
      d_(static_cast<std::size_t>(dimension)),
      order_(std::move(members)),
      leaf_of_(points.size(), 0),
      is_in_(points.size(), 0) {
  nodes_.push_back({0, static_cast<Index>(order_.size())});
  slabs_.resize(slab_size());
  for (Index node = 0; node < nodes_.size(); ++node) divide(node);
}

/// Sets the slab of a node. Returns the axis along which its points extend most.
std::size_t SupportTree::measure(Index node) {
  const auto members = std::span(order_).subspan(nodes_[node].begin, nodes_[node].end - nodes_[node].begin);
  std::vector<double> low(points_[members[0]], points_[members[0]] + d_), high = low, v(d_);
  for (const Index p : members)
    for (std::size_t j = 0; j < d_; ++j) {
      low[j] = std::min(low[j], points_[p][j]);
      high[j] = std::max(high[j], points_[p][j]);
    }
  double* const center = slabs_.data() + node * slab_size();
  double* const across = center + d_;
  std::size_t axis = 0;
  double extent = 0;
  for (std::size_t j = 0; j < d_; ++j) {
    center[j] = low[j] / 2 + high[j] / 2;
    if (high[j] / 2 - low[j] / 2 > extent) axis = j, extent = high[j] / 2 - low[j] / 2;
  }
  std::vector<double> covariance(d_ * d_, 0.0);
  for (const Index p : members)
    for (std::size_t j = 0; j < d_; ++j) {
      v[j] = (points_[p][j] - center[j]) / extent;
      for (std::size_t i = 0; i <= j; ++i) covariance[j * d_ + i] += v[i] * v[j];
    }
  for (std::size_t j = 0; j < d_; ++j)
    for (std::size_t i = 0; i < j; ++i) covariance[i * d_ + j] = covariance[j * d_ + i];
  find_thin_direction(covariance, d_, across);
  double thickness = 0, radius = 0;
  for (const Index p : members) {
    double height = 0, square = 0;
    for (std::size_t j = 0; j < d_; ++j) height += across[j] * (points_[p][j] - center[j]);
    for (std::size_t j = 0; j < d_; ++j) {
      const double x = points_[p][j] - center[j] - height * across[j];
      square += x * x;
    }
    thickness = std::max(thickness, std::fabs(height));
    radius = std::max(radius, std::sqrt(square) + least);  // what underflows is less
  }
  across[d_] = thickness;
  across[d_ + 1] = radius;
  return axis;
}

/// A lower bound on n·(q − w), and on what is computed for it, for the points of a node; or no number.
double SupportTree::bound(Index node, const double* q, std::span<const double> n) const {
  const double* const center = slabs_.data() + node * slab_size();
  const double* const across = center + d_;
  const double thickness = across[d_], radius = across[d_ + 1];
  double product = 0, part = 0, size = 0, distance = 0, square = 0;
  for (std::size_t j = 0; j < d_; ++j) {
    product += n[j] * (q[j] - center[j]);
    part += n[j] * across[j];
    size += std::fabs(n[j]);
    distance += std::fabs(q[j] - center[j]);
  }
  for (std::size_t j = 0; j < d_; ++j) {
    const double x = n[j] - part * across[j];
    square += x * x;
  }
  const double rounding = 32 * static_cast<double>(d_ + 4) * kernel::unit_roundoff;
  return product - std::fabs(part) * thickness - std::sqrt(square) * radius -
         rounding * size * (distance + thickness + radius);
}

void SupportTree::divide(Index node) {
  const std::size_t axis = measure(node);
  const auto [begin, end] = std::pair(nodes_[node].begin, nodes_[node].end);
  if (end - begin <= most_listed) {
    for (Index i = begin; i < end; ++i) leaf_of_[order_[i]] = node;
    return;
  }
  const Index half = begin + (end - begin) / 2;
  const auto at = [&](Index i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(half), at(end), [&](Index a, Index b) {
    return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
  });
  for (const auto& [first, last, child] : {std::tuple(begin, half, &Node::left), {half, end, &Node::right}}) {
    nodes_[node].*child = static_cast<Index>(nodes_.size());
    nodes_.push_back({first, last, 0, 0, node});
  }
  slabs_.resize(slab_size() * nodes_.size());
}

void SupportTree::insert(Index p) {
  is_in_[p] = 1;
  for (Index at = leaf_of_[p];; at = nodes_[at].parent) {
    Node& node = nodes_[at];
    if (node.num_in < most_listed) node.listed[node.num_in] = p;
    ++node.num_in;
    if (at == 0) return;
  }
}

void SupportTree::erase(Index p) {
  is_in_[p] = 0;
  for (Index at = leaf_of_[p];; at = nodes_[at].parent) {
    Node& node = nodes_[at];
    --node.num_in;
    if (node.num_in <= most_listed) list(node);
    if (at == 0) return;
  }
}

/// Lists the points that are in, from those of the children.
void SupportTree::list(Node& node) const {
  Index count = 0;
  if (node.left == 0) {
    for (Index i = node.begin; i < node.end; ++i)
      if (is_in_[order_[i]] != 0) node.listed[count++] = order_[i];
    return;
  }
  for (const Index child : {node.left, node.right})
    for (Index i = 0; i < nodes_[child].num_in; ++i) node.listed[count++] = nodes_[child].listed[i];
}

SupportTree::Support SupportTree::support(const double* q, std::span<const double> n,
                                          std::span<const Index> guess) const {
  const double rounding = 1.01 * static_cast<double>(d_ + 2) * kernel::unit_roundoff;
  Support result{internal::infinity, internal::infinity, invalid_index};
  const auto include = [&](Index w) {
    double product = 0, parts = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      const double term = n[j] * (q[j] - points_[w][j]);
      product += term;
      parts += std::fabs(term);
    }
    if (product < result.least || (product == result.least && w < result.point) ||
        result.point == invalid_index)
      result.least = product, result.point = w;
    const double certain = std::isfinite(parts) ? product - rounding * parts : -internal::infinity;
    result.certain = std::min(result.certain, certain);
  };
  for (const Index w : guess) include(w);
  // A path holds at most one sibling per level, and halving makes less than 64 levels.
  Index stack[64];
  double bounds[64];
  std::size_t size = 0;
  bounds[size] = -internal::infinity;
  stack[size++] = 0;
  while (size > 0) {
    const Index at = stack[--size];
    const Node& node = nodes_[at];
    if (node.num_in == 0) continue;
    if (bounds[size] > result.least && bounds[size] >= result.certain) continue;
    if (node.num_in <= most_listed) {
      for (Index i = 0; i < node.num_in; ++i) include(node.listed[i]);
      continue;
    }
    const double left = nodes_[node.left].num_in == 0 ? internal::infinity : bound(node.left, q, n);
    const double right = nodes_[node.right].num_in == 0 ? internal::infinity : bound(node.right, q, n);
    const bool left_first = left <= right;
    bounds[size] = left_first ? right : left;
    stack[size++] = left_first ? node.right : node.left;
    bounds[size] = left_first ? left : right;
    stack[size++] = left_first ? node.left : node.right;
  }
  return result;
}

}  // namespace delone::hull
