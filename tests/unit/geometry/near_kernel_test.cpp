// SPDX-License-Identifier: BSD-3-Clause
// Certificates by edges hold in exact rational arithmetic in the worst case: functionals have the largest
// errors allowed, with signs at the vertices such that they add up at a query.
#include "geometry/near_kernel.hpp"

#include "base/random.hpp"
#include "cells/cell_memory.hpp"
#include "geometry/certificate.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace delone::geometry {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Vector = std::vector<Rational>;
template <int K>
using Point = std::array<double, K>;

/// The inverse and the determinant of a matrix, by elimination.
struct Inverse {
  explicit Inverse(std::vector<Vector> a) : rows(a.size(), Vector(a.size())) {
    const std::size_t n = a.size();
    for (std::size_t i = 0; i < n; ++i) rows[i][i] = 1;
    for (std::size_t s = 0; s < n; ++s) {
      std::size_t pivot = s;
      while (pivot < n && a[pivot][s] == 0) ++pivot;
      if (pivot == n) {
        determinant = 0;
        return;
      }
      if (pivot != s) determinant = -determinant;
      std::swap(a[s], a[pivot]);
      std::swap(rows[s], rows[pivot]);
      const Rational by = a[s][s];
      determinant *= by;
      for (std::size_t j = 0; j < n; ++j) {
        a[s][j] /= by;
        rows[s][j] /= by;
      }
      for (std::size_t i = 0; i < n; ++i) {
        if (i == s || a[i][s] == 0) continue;
        const Rational times = a[i][s];
        for (std::size_t j = 0; j < n; ++j) {
          a[i][j] -= times * a[s][j];
          rows[i][j] -= times * rows[s][j];
        }
      }
    }
  }
  std::vector<Vector> rows;
  Rational determinant = 1;
};

/// An affine function, the constant last, and a lift with weight 1 or none.
struct Function {
  template <class P>
  Rational at(const P& x) const {
    Rational sum = coefficients.back();
    for (std::size_t r = 0; r + 1 < coefficients.size(); ++r)
      sum += coefficients[r] * Rational(x[r]) + (is_lifted ? Rational(x[r]) * Rational(x[r]) : Rational(0));
    return sum;
  }
  Vector coefficients;
  bool is_lifted;
};

constexpr double unit_roundoff = 0x1p-53;
template <int K>
constexpr double evaluation_error = 1.01 * (2 * K + 8) * unit_roundoff;
template <int K>
constexpr double bend = 4.01 * K;

/// A simplex, its functional with errors, and the point where they add up. Functionals of infinite cells have
/// the last coefficient 1, and so may be the opposite of what the order of vertices demands.
template <int K>
struct Cell {
  std::vector<Point<K>> vertices;  ///< finite ones, the apex first
  Function exact, cached;
  Rational determinant;
  Point<K> worst;

  bool is_infinite() const { return vertices.size() == K; }
};

/// Coordinates are multiples of 2^-40, so that images are exact.
double rounded(double x) { return std::nearbyint(std::ldexp(x, 40)) * 0x1p-40; }

/// The more `flat`, the nearer the vertices are to a plane, by powers of two; `reach`: how far they are from
/// each other.
template <int K>
Cell<K> random_cell(random::Generator& generator, const Point<K>& apex, bool infinite, int flat,
                    double reach) {
  const auto in = [&](double low, double high) { return rounded(low + (high - low) * generator.uniform()); };
  for (;;) {
    Cell<K> cell;
    cell.vertices = {apex};
    const auto on_surface = [&](Point<K>& x) {
      double height = apex[K - 1];
      for (int r = 0; r + 1 < K; ++r) height += std::ldexp((x[r] - apex[r]) * (x[r] - apex[r]), -flat);
      x[K - 1] = rounded(height);
    };
    while (cell.vertices.size() < (infinite ? K : K + 1)) {
      Point<K> x;
      for (int r = 0; r < K; ++r) x[r] = in(std::max(-1.0, apex[r] - reach), std::min(1.0, apex[r] + reach));
      if (flat > 0) on_surface(x);
      cell.vertices.push_back(x);
    }
    // The functional is determined in all coordinates, or in all but the last, in which it has the
    // coefficient 1.
    const std::size_t n = cell.vertices.size() - 1;
    std::vector<Vector> edges, rows;
    Vector values;
    for (const Point<K>& x : cell.vertices) {
      Vector row(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n)), edge = row;
      for (std::size_t r = 0; r < n; ++r) edge[r] -= Rational(apex[r]);
      if (&x != &cell.vertices[0]) edges.push_back(edge);
      row.push_back(1);
      rows.push_back(row);
      Rational value = infinite ? Rational(x[K - 1]) : Rational(0);
      if (!infinite)
        for (const double t : x) value += Rational(t) * Rational(t);
      values.push_back(-value);
    }
    cell.determinant = Inverse(edges).determinant;
    if (cell.determinant == 0) continue;
    const Inverse barycentric(rows);  // column i is coordinate i
    const auto interpolate = [&](const Vector& at_vertices) {
      Vector coefficients;
      for (std::size_t r = 0; r <= n; ++r) {
        Rational sum = 0;
        for (std::size_t i = 0; i <= n; ++i) sum += barycentric.rows[r][i] * at_vertices[i];
        coefficients.push_back(sum);
      }
      if (infinite) coefficients.insert(coefficients.end() - 1, Rational(0));
      return coefficients;
    };
    cell.exact = {interpolate(values), !infinite};
    if (infinite) {
      cell.exact.coefficients[K - 1] = 1;
      for (int r = 0; r + 1 < K; ++r)
        if (abs(cell.exact.coefficients[static_cast<std::size_t>(r)]) >= 1) cell.determinant = 0;
      if (cell.determinant == 0) continue;
    }

    for (double& x : cell.worst) x = in(-1, 1);
    if (generator.coin()) {  // near the plane or the sphere
      for (int step = 0; step < 3; ++step) {
        const double value = static_cast<double>(cell.exact.at(cell.worst));
        const double slope =
            static_cast<double>(cell.exact.coefficients[K - 1]) + (infinite ? 0 : 2 * cell.worst[K - 1]);
        const double moved = cell.worst[K - 1] - value / slope;
        if (std::fabs(moved) <= 1) cell.worst[K - 1] = moved;
      }
    }
    Rational magnitude = infinite ? 0 : K;
    for (const Rational& c : cell.exact.coefficients) magnitude += abs(c);
    const Rational error = 8 * Rational(evaluation_error<K>) * magnitude;
    Vector errors;
    for (std::size_t i = 0; i <= n; ++i) {
      Rational coordinate = barycentric.rows[n][i];
      for (std::size_t r = 0; r < n; ++r) coordinate += barycentric.rows[r][i] * Rational(cell.worst[r]);
      errors.push_back(coordinate < 0 ? Rational(-error) : error);
    }
    const Vector change = interpolate(errors);
    cell.cached = cell.exact;
    for (std::size_t r = 0; r <= K; ++r)
      cell.cached.coefficients[r] =
          Rational(static_cast<double>(Rational(cell.exact.coefficients[r] + change[r])));
    return cell;
  }
}

/// Whether an infinite cell is positively oriented with a point far above in the place of the infinite
/// vertex.
template <int K>
bool is_positive_above(const std::vector<Index>& vertices, const std::vector<double>& rows) {
  std::vector<Vector> edges;
  const auto coordinate = [&](Index v, int r) {
    return v == index(infinite_vertex) ? Rational(r == K - 1 ? 0x1p80 : 0)
                                       : Rational(rows[v * (K + 1) + static_cast<std::size_t>(r)]);
  };
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    edges.emplace_back();
    for (int r = 0; r < K; ++r)
      edges.back().push_back(coordinate(vertices[i], r) - coordinate(vertices[0], r));
  }
  return Inverse(edges).determinant > 0;
}

/// Cells with one apex, vertex 1, as the engine keeps them, before anything is known of them.
template <int K>
class Store {
 public:
  Store(const Point<K>& apex, std::size_t count)
      : memory_(K, count % 2 == 0 ? cells::VertexIds::narrow : cells::VertexIds::wide) {
    append(apex);
    memory_.reserve(count);
    memory_.prepare(count);
  }
  Index append(const Point<K>& x) {
    double lift = 0;
    for (const double t : x) {
      rows_.push_back(t);
      lift += t * t;
    }
    rows_.push_back(lift);
    return static_cast<Index>(rows_.size() / (K + 1) - 1);
  }
  /// A cell with these vertices, the apex first, in a random order. Returns the order.
  std::vector<Index> add(random::Generator& generator, const std::vector<Point<K>>& vertices,
                         const Vector& functional) {
    const auto id = static_cast<Index>(ids_.size());
    ids_.push_back(id);
    is_infinite_.push_back(vertices.size() == K);
    for (std::size_t r = 0; r <= K; ++r)
      memory_.records().functional(id)[r] = static_cast<double>(functional[r]);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    certify(id, infinity, infinity, 0);
    std::vector<Index> order = {1};
    for (std::size_t i = 1; i < vertices.size(); ++i) order.push_back(append(vertices[i]));
    if (is_infinite_[id]) order.push_back(index(infinite_vertex));
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[generator.below(i)]);
    for (std::size_t i = 0; i < order.size(); ++i)
      memory_.layout().set_vertex(memory_.links(id), static_cast<int>(i), order[i]);
    return order;
  }
  void certify(Index id, double threshold, double error, double determinant) {
    *memory_.records().certificate(id) =
        std::bit_cast<double>(certificate::pack(threshold, error, determinant, is_infinite_[id]));
  }
  double threshold(Index id) const {
    return certificate::threshold(std::bit_cast<std::uint64_t>(*memory_.records().certificate(id)));
  }
  const std::vector<double>& rows() const { return rows_; }
  NearTask task_at(Index vertex) const {
    const auto records = memory_.records();
    return NearTask{K,
                    ids_,
                    records.functional(0),
                    records.certificate(0),
                    memory_.links(0),
                    memory_.layout().vertex_ids(),
                    rows_.data(),
                    rows_.data() + vertex * (K + 1),
                    evaluation_error<K>,
                    K,
                    2.1 * (K + 3) * std::sqrt(static_cast<double>(K)) * unit_roundoff,
                    bend<K>,
                    lift_weight_.data()};
  }
  std::vector<EdgeCertificate> certify_by_edges() const {
    std::vector<EdgeCertificate> certificates(ids_.size());
    geometry::certify_by_edges(task_at(1), 1, certificates.data());
    return certificates;
  }

 private:
  std::vector<double> rows_ = std::vector<double>(K + 1);
  cells::CellMemory<K> memory_;
  std::vector<Index> ids_;
  std::vector<bool> is_infinite_;
  std::vector<double> lift_weight_ = std::vector<double>(K, 1.0);
};

/// Up to near_lanes cells with one apex.
template <int K>
void expect_proofs(std::uint64_t seed, double& sharpest, double& sharpest_near, std::size_t& num_proved) {
  SCOPED_TRACE(std::to_string(K) + " dimensions, seed " + std::to_string(seed));
  random::Generator generator(seed);
  Point<K> apex;
  for (double& x : apex) x = rounded(generator.uniform() - 0.5);
  const std::size_t count = 1 + generator.below(near_lanes);
  std::vector<Cell<K>> cells;
  for (std::size_t i = 0; i < count; ++i) {
    constexpr int flats[] = {0, 4, 10, 16};
    constexpr double reaches[] = {0x1p-6, 0.5, 2};
    cells.push_back(random_cell<K>(generator, apex, generator.below(3) == 0, flats[generator.below(4)],
                                   reaches[generator.below(3)]));
  }

  Store<K> store(apex, count);
  std::vector<bool> is_opposite;
  for (const Cell<K>& cell : cells) {
    const std::vector<Index> order = store.add(generator, cell.vertices, cell.cached.coefficients);
    is_opposite.push_back(cell.is_infinite() && is_positive_above<K>(order, store.rows()));
  }
  const std::vector<EdgeCertificate> certificates = store.certify_by_edges();

  const auto share = [](const Rational& part, double whole) {
    return static_cast<double>(Rational(part / Rational(whole)));
  };
  for (Index id = 0; id < count; ++id) {
    const Cell<K>& cell = cells[id];
    const EdgeCertificate& proved = certificates[id];
    ASSERT_EQ(proved.determinant > 0, std::isfinite(proved.threshold));
    if (!(proved.determinant > 0)) continue;
    ASSERT_TRUE(proved.is_final);
    ASSERT_FALSE(is_opposite[id]) << "cell " << id;
    ++num_proved;
    ASSERT_LE(Rational(proved.determinant), abs(cell.determinant));
    for (const Point<K>& x : cell.vertices) ASSERT_LE(abs(cell.cached.at(x)), Rational(proved.error));
    for (const Cell<K>& other : cells) {
      const Rational value = cell.cached.at(other.worst),
                     error = abs(Rational(value - cell.exact.at(other.worst)));
      const double growth = 1 + (cell.is_infinite() ? 0 : std::fabs(static_cast<double>(value)) / bend<K>);
      ASSERT_LE(error, Rational(proved.threshold) * Rational(growth)) << "cell " << id;
      sharpest = std::max(sharpest, share(error, proved.threshold * growth));
    }
    store.certify(id, proved.threshold, proved.error, proved.determinant);
  }
  for (const Cell<K>& at : cells) {
    std::vector<double> thresholds(count);
    find_thresholds(store.task_at(store.append(at.worst)), thresholds.data());
    for (Index id = 0; id < count; ++id) {
      const Cell<K>& cell = cells[id];
      if (!(certificates[id].determinant > 0)) continue;
      const double cached = store.threshold(id);
      ASSERT_LE(thresholds[id], cached);
      if (thresholds[id] == cached) continue;
      const Rational error = abs(Rational(cell.cached.at(at.worst) - cell.exact.at(at.worst)));
      ASSERT_LE(error, Rational(thresholds[id])) << "cell " << id;
      sharpest_near = std::max(sharpest_near, share(error, thresholds[id]));
    }
  }
}

template <int K>
void expect_sharp_proofs() {
  double sharpest = 0, sharpest_near = 0;
  std::size_t num_proved = 0;
  const std::size_t rounds = test::scaled_count(60);
  for (std::uint64_t seed = 0; seed < rounds; ++seed)
    ASSERT_NO_FATAL_FAILURE(expect_proofs<K>(seed, sharpest, sharpest_near, num_proved));
  // No bound could be much smaller.
  EXPECT_GT(num_proved, 2 * rounds);
  EXPECT_GT(sharpest, 0.1);
  EXPECT_GT(sharpest_near, 0.5);
}

TEST(NearKernel, ProofsHoldForTheWorstErrors) {
  expect_sharp_proofs<2>();
  expect_sharp_proofs<3>();
  expect_sharp_proofs<4>();
  expect_sharp_proofs<5>();
  expect_sharp_proofs<6>();
}

/// Every other cell has its vertices at heights of 2^-70 over a plane, where no rounded determinant shows a
/// volume. The other functionals are wrong.
template <int K>
void expect_flat_cells_to_be_final() {
  random::Generator generator(K);
  const Point<K> apex{};
  Store<K> store(apex, near_lanes);
  std::vector<Cell<K>> cells(near_lanes);
  for (std::size_t id = 0; id < near_lanes; ++id) {
    Cell<K>& cell = cells[id];
    const bool is_flat = id % 2 == 0;
    cell.vertices = {apex};
    while (cell.vertices.size() <= K) {
      Point<K> x;
      for (double& t : x) t = rounded(generator.uniform() - 0.5);
      if (is_flat) x[K - 1] = std::ldexp(generator.uniform(), -70);
      cell.vertices.push_back(x);
    }
    cell.cached = {{}, true};
    for (int r = 0; r <= K; ++r)
      cell.cached.coefficients.push_back(std::ldexp(generator.uniform(), is_flat ? 65 : 0));
    store.add(generator, cell.vertices, cell.cached.coefficients);
  }
  const std::vector<EdgeCertificate> certificates = store.certify_by_edges();
  for (std::size_t id = 0; id < near_lanes; ++id) {
    const EdgeCertificate& proved = certificates[id];
    EXPECT_EQ(proved.is_final, id % 2 == 0) << "cell " << id;
    EXPECT_EQ(proved.determinant, 0);
    EXPECT_EQ(proved.threshold, std::numeric_limits<double>::infinity());
    for (const Point<K>& x : cells[id].vertices)
      EXPECT_LE(abs(cells[id].cached.at(x)), Rational(proved.error));
  }
}

TEST(NearKernel, NothingMoreIsAskedOfFlatCells) {
  expect_flat_cells_to_be_final<2>();
  expect_flat_cells_to_be_final<3>();
  expect_flat_cells_to_be_final<4>();
  expect_flat_cells_to_be_final<5>();
  expect_flat_cells_to_be_final<6>();
}

}  // namespace
}  // namespace delone::geometry
