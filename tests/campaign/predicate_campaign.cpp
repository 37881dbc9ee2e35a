// SPDX-License-Identifier: BSD-3-Clause
// A campaign against the predicates: any number of calls of every kind and stage, nearly degenerate by
// construction, against exact integers. Points are integers, of which most queries are put on a sphere or a
// hyperplane and moved by at most two units; then everything is multiplied by a power of two. Prints a table
// of calls, and fails if one of them is wrong. An interrupt ends it with the table so far.
//
// Usage: delone_predicate_campaign [--calls N] [--seconds S] [--seed N]
#include "geometry/central_geometry.hpp"
#include "geometry/delaunay_geometry.hpp"
#include "kernel/hull_stages.hpp"
#include "kernel/predicates.hpp"
#include "row_source.hpp"
#include "tally.hpp"
#include "truth.hpp"

#include "base/compiled_dimension.hpp"

#include <delone/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace delone::campaign {

using internal::StageCounts;

namespace {

using kernel::Flat;
using kernel::Grid;
using kernel::RowForm;

class Campaign : RowSource {
 public:
  explicit Campaign(std::uint64_t seed) : RowSource(seed) {}
  Tally& tally() { return tally_; }

  /// One simplex with its queries, in a dimension and a form that are drawn.
  void round() {
    static constexpr int of_draw[] = {1, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 6};
    int k = of_draw[random_.below(std::size(of_draw))];
    if (random_.below(60) == 0) k = 7 + static_cast<int>(random_.below(2));
    const bool wide = random_.below(12) == 0;
    internal::with_compiled_dimension<1>(static_cast<std::size_t>(k), [&](auto dimension) {
      if constexpr (dimension() > 0) {
        constexpr int K = dimension();
        switch (random_.below(8)) {
          case 0:
            return wide ? rays<K, test::Integer>() : rays<K, Int128>();
          case 1:
            return hyperplanes(K);
          default:
            return wide ? points<K, test::Integer>() : points<K, Int128>();
        }
      }
    });
  }

 private:
  template <int K, class Int>
  void points();
  template <int K, class Int>
  void spheres(const Simplex<Int>& truth, const std::vector<Row>& simplex, const std::vector<Row>& queries,
               const std::vector<std::vector<Int>>& integers, int ambient, RowForm form, int exponent);
  template <int K, class Int>
  void facets(const Simplex<Int>& truth, const std::vector<const double*>& simplex,
              const std::vector<const double*>& queries, const std::vector<std::vector<Int>>& integers,
              int ambient, const Grid& coarse, const Grid& fine);
  template <int K, class Int>
  void hull_filter(const Simplex<Int>& truth, const std::vector<const double*>& simplex,
                   const std::vector<const double*>& queries, const std::vector<std::vector<Int>>& integers);
  template <int K, class Int>
  void rays();
  void hyperplanes(int d);

  Tally tally_;
};

std::vector<int> first_axes(int k) {
  std::vector<int> axes(static_cast<std::size_t>(k));
  for (int j = 0; j < k; ++j) axes[static_cast<std::size_t>(j)] = j;
  return axes;
}
std::vector<const double*> pointers_to(const std::vector<Row>& rows) {
  std::vector<const double*> result;
  for (const Row& row : rows) result.push_back(row.data());
  return result;
}
/// What a filter says: nothing within the threshold.
std::optional<Sign> beyond(double value, double threshold) {
  if (value > threshold) return Sign::positive;
  if (value < -threshold) return Sign::negative;
  return std::nullopt;
}
/// The stage that has answered, as it was counted.
Stage stage_of(const StageCounts& counts) {
  return counts.exact > 0 ? Stage::chain_to_exact : Stage::chain_to_direct;
}

template <int K, class Int>
void Campaign::points() {
  constexpr bool wide = std::is_same_v<Int, test::Integer>;
  // So many bits that 128 hold the determinant and its product with a lift: (k + 2)·(bits + 1) and the number
  // of the terms, in one coordinate more than there are and with weights.
  constexpr int bits_of_terms[] = {0, 2, 4, 7, 10, 13, 16, 19, 23};
  constexpr int most_bits = std::min(45, (122 - bits_of_terms[K]) / (K + 2) - 2);
  const int bits = 2 + static_cast<int>(random_.below(static_cast<std::uint64_t>(most_bits - 1)));
  const bool in_flat = !wide && bits > 3 && random_.below(8) == 0;
  const std::uint64_t draw = random_.below(4);
  const RowForm form = draw == 0   ? RowForm::weighted_point
                       : draw == 1 ? RowForm::furthest_point
                                   : RowForm::point;
  const int ambient = K + (in_flat ? 1 : 0);

  Rows rows = draw_points(K, in_flat ? bits - 2 : bits, wide);
  if (in_flat)  // the last coordinate is the difference of two, or their sum
    for (auto* list : {&rows.simplex, &rows.queries})
      for (Row& row : *list) row.push_back(K == 1 ? row[0] : row[0] - row[static_cast<std::size_t>(K - 1)]);
  const bool weighted = form == RowForm::weighted_point;
  const int weight_bits = std::min(2 * bits, 52);
  if (weighted)
    for (Row& row : rows.simplex) row.push_back(entry(weight_bits, wide));
  const Simplex<Int> truth(rows.simplex, K, static_cast<std::size_t>(ambient));
  if (weighted)
    for (Row& row : rows.queries) {
      double weight = entry(weight_bits, wide);
      if (truth.orientation() != Sign::zero && random_.below(4) != 0) {
        const double at = truth.weight_on_sphere(truth.integers(row));
        if (std::fabs(at) < std::ldexp(1.0, wide ? 180 : 2 * bits)) weight = std::nearbyint(at) + nudge();
      }
      row.push_back(weight);
    }
  std::vector<std::vector<Int>> integers;
  for (const Row& row : rows.queries) integers.push_back(truth.integers(row));
  const int exponent = random_.below(3) == 0 ? 0 : static_cast<int>(random_.below(500)) - 300;
  for (auto* list : {&rows.simplex, &rows.queries})
    for (Row& row : *list)
      for (std::size_t j = 0; j < row.size(); ++j)
        row[j] = std::ldexp(row[j], j < static_cast<std::size_t>(ambient) ? exponent : 2 * exponent);
  spheres<K>(truth, rows.simplex, rows.queries, integers, ambient, form, exponent);
}

template <int K, class Int>
void Campaign::spheres(const Simplex<Int>& truth, const std::vector<Row>& simplex,
                       const std::vector<Row>& queries, const std::vector<std::vector<Int>>& integers,
                       int ambient, RowForm form, int exponent) {
  const std::vector<int> axes = first_axes(K);
  const Flat flat{ambient, axes, form};
  const bool weighted = form == RowForm::weighted_point;
  const Kind kind = weighted                          ? Kind::weighted
                    : form == RowForm::furthest_point ? Kind::furthest
                                                      : Kind::sphere;
  Grid coarse(ambient, weighted), fine(ambient, weighted);
  Row low = simplex[0], high = low;
  for (const auto* list : {&simplex, &queries})
    for (const Row& row : *list) {
      coarse.include(row.data());
      fine.include(row.data());
      for (std::size_t j = 0; j < row.size(); ++j) {
        low[j] = std::min(low[j], row[j]);
        high[j] = std::max(high[j], row[j]);
      }
    }
  // A grid may be finer than the points need: it proves less.
  const Row speck(low.size(), std::ldexp(1.0, exponent - 30));
  fine.include(speck.data());

  std::vector<const double*> points = pointers_to(simplex);
  const std::vector<const double*> at = pointers_to(queries);
  tally_.check(Kind::orientation, Stage::chain_to_direct, kernel::orientation<K>(flat, points.data(), coarse),
               truth.orientation());
  tally_.check(Kind::orientation, Stage::exact, kernel::exact_orientation(flat, points.data() + 1, points[0]),
               truth.orientation());
  if (!weighted) facets<K>(truth, points, at, integers, ambient, coarse, fine);
  if (truth.orientation() == Sign::zero) return;
  if (truth.orientation() == Sign::negative) {
    std::swap(points[0], points[1]);
  }
  const Sign parity = K % 2 == 0 ? Sign::negative : Sign::positive;  // (−1)^(k+1)
  const Sign upward = form == RowForm::furthest_point ? Sign::negative : Sign::positive;

  // Stage filter: one cell, made of the points.
  cells::CellMemory<K> memory(K);
  memory.reserve(2);
  memory.prepare(2);
  std::vector<double> coordinates(low.size(), 0.0);  // of vertex 0
  for (const double* p : points) coordinates.insert(coordinates.end(), p, p + low.size());
  geometry::DelaunayGeometry<K> cells(memory, axes, ambient, coordinates, coarse,
                                      geometry::Frame(low, high, form));
  cells.keep_rows(K + 1);
  Index vertices[K + 1];
  for (int i = 0; i <= K; ++i) {
    vertices[i] = static_cast<Index>(i + 1);
    memory.layout().set_vertex(memory.links(0), i, vertices[i]);
  }
  cells.create(0, vertices, -1, 0);
  const Index cell[] = {0};
  std::vector<const double*> ties;

  for (std::size_t i = 0; i < at.size(); ++i) {
    const double* q = at[i];
    const Sign side = truth.side_of_sphere(integers[i]) * upward;
    const Sign determinant = side * parity * upward;  // of the lifted rows, as they are passed to the stages
    StageCounts counts, counts_of_fine;
    const Sign of_chain = kernel::in_sphere<K>(flat, points.data(), q, coarse, counts);
    tally_.check(kind, stage_of(counts), of_chain, side);
    if (K < 7 || i % 8 == 0) {
      const Sign of_run_time = kernel::in_sphere<0>(flat, points.data(), q, fine, counts_of_fine);
      tally_.check(kind, stage_of(counts_of_fine), of_run_time, side);
      tally_.check(kind, Stage::exact, kernel::exact_sphere(flat, points.data(), q), determinant);
      tally_.check(kind, Stage::double_double, kernel::double_double_sphere(flat, points.data(), q),
                   determinant);
    }
    if constexpr (kernel::tabulates_minors<K + 1>) {
      tally_.check(kind, Stage::binary64, kernel::detail::sphere_by_minors<K>(flat, points.data(), q, coarse),
                   determinant);
      tally_.check(kind, Stage::binary64, kernel::detail::sphere_by_minors<K>(flat, points.data(), q, fine),
                   determinant);
    }
    tally_.check(kind, Stage::binary64,
                 kernel::detail::sphere_by_elimination<K>(flat, points.data(), q, coarse), determinant);

    const auto query = cells.make_query(q);
    const double value = cells.value(0, query), threshold = cells.threshold(0);
    std::optional<Sign> of_filter = beyond(value, threshold);
    if (!of_filter && cells.proves_tie(0, value, query)) of_filter = Sign::zero;
    tally_.check(kind, Stage::filter, of_filter, side);
    double near_threshold;
    cells.thresholds_at(cell, query, &near_threshold);
    tally_.check(kind, Stage::filter, beyond(value, near_threshold), side);

    const bool is_vertex = std::any_of(points.begin(), points.end(), [&](const double* p) {
      return kernel::equal_points(p, q, flat.row_size());
    });
    if (side != Sign::zero || is_vertex) continue;
    const Sign perturbed = truth.perturbed(integers[i]);
    tally_.check(kind, Stage::perturbed, kernel::perturbed_in_sphere<K>(flat, points.data(), q, coarse),
                 perturbed);
    tally_.check(kind, Stage::perturbed, kernel::perturbed_in_sphere<0>(flat, points.data(), q, fine),
                 perturbed);
    const Index* const one[] = {vertices};
    Sign together;
    cells.perturbed_sides(one, query, &together, counts);
    tally_.check(kind, Stage::perturbed, together, perturbed);
  }
  // The public functions, which take no furthest points and no flats.
  if (form == RowForm::furthest_point || ambient != K) return;
  Row all, weights;
  for (const double* p : points) {
    all.insert(all.end(), p, p + K);
    if (weighted) weights.push_back(p[K]);
  }
  const std::size_t i = random_.below(at.size());
  const std::span<const double> q(at[i], static_cast<std::size_t>(K));
  const Side public_side = weighted ? in_power_sphere(all, weights, q, at[i][K], K) : in_sphere(all, q, K);
  tally_.check(kind, Stage::public_function, static_cast<Sign>(-static_cast<int>(public_side)),
               truth.side_of_sphere(integers[i]));
  tally_.check(Kind::dimension, Stage::public_function, static_cast<Sign>(affine_dimension(all, K) == K),
               Sign::positive);
}

template <int K, class Int>
void Campaign::facets(const Simplex<Int>& truth, const std::vector<const double*>& simplex,
                      const std::vector<const double*>& queries,
                      const std::vector<std::vector<Int>>& integers, int ambient, const Grid& coarse,
                      const Grid& fine) {
  const std::vector<int> axes = first_axes(K);
  const Flat flat{ambient, axes};
  std::vector<const double*> rows = simplex;
  const Sign parity = K % 2 == 0 ? Sign::positive : Sign::negative;  // of moving the base from first to last
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double* q = queries[i];
    const Sign side = truth.side_of_facet(integers[i]);
    const Sign from_query = side * parity;
    StageCounts counts, counts_of_fine;
    rows[K] = q;
    const Sign of_chain = kernel::orientation<K>(flat, rows.data(), coarse, counts);
    tally_.check(Kind::orientation, stage_of(counts), of_chain, side);
    tally_.check(Kind::orientation, Stage::binary64,
                 kernel::detail::orientation_by_elimination<K>(flat, simplex.data(), q, coarse), from_query);
    if constexpr (kernel::tabulates_minors<K>)
      tally_.check(Kind::orientation, Stage::binary64,
                   kernel::detail::orientation_by_minors<K>(flat, simplex.data(), q, fine), from_query);
    if (K < 7 || i % 8 == 0) {
      const Sign of_run_time = kernel::hull_side<0>(flat, simplex.data(), q, fine, counts_of_fine);
      tally_.check(Kind::hull, stage_of(counts_of_fine), of_run_time, from_query);
      tally_.check(Kind::orientation, Stage::exact, kernel::exact_orientation(flat, simplex.data(), q),
                   from_query);
      tally_.check(Kind::orientation, Stage::double_double,
                   kernel::double_double_orientation(flat, simplex.data(), q), from_query);
    }
    const bool is_vertex = std::any_of(simplex.begin(), simplex.end() - 1,
                                       [&](const double* p) { return kernel::equal_points(p, q, ambient); });
    if (side != Sign::zero || is_vertex || truth.orientation() == Sign::zero) continue;
    const Sign side_of_inner = truth.orientation() * parity;
    tally_.check(Kind::hull, Stage::perturbed,
                 kernel::perturbed_hull_side<K>(flat, simplex.data(), q, simplex[K], coarse, side_of_inner),
                 truth.perturbed_side_of_facet(integers[i]));
    const std::span<const double* const> facet(simplex.data(), K);
    tally_.check(Kind::hull, Stage::perturbed, kernel::hull_side_perturbed(flat, facet, simplex[K], q),
                 truth.perturbed_side_of_facet(integers[i]));
  }
  if (K > 1 && ambient == K && truth.orientation() != Sign::zero)
    hull_filter<K>(truth, simplex, queries, integers);
}

template <int K, class Int>
void Campaign::hull_filter(const Simplex<Int>& truth, const std::vector<const double*>& simplex,
                           const std::vector<const double*>& queries,
                           const std::vector<std::vector<Int>>& integers) {
  if constexpr (K > 1) {
    const std::vector<int> axes = first_axes(K);
    Grid grid(K);
    std::vector<double> coordinates, center(K, 0.0), low(simplex[0], simplex[0] + K), high = low;
    const auto include = [&](const double* p) {
      grid.include(p);
      for (std::size_t j = 0; j < K; ++j) {
        low[j] = std::min(low[j], p[j]);
        high[j] = std::max(high[j], p[j]);
      }
    };
    std::vector<Index> inner;
    for (const double* p : simplex) {
      include(p);
      coordinates.insert(coordinates.end(), p, p + K);
      for (std::size_t j = 0; j < K; ++j) center[j] += p[j] / (K + 1);
      inner.push_back(static_cast<Index>(inner.size() + 1));
    }
    for (const double* q : queries) include(q);
    include(center.data());
    bool is_inside = true;
    for (std::size_t i = 0; i <= K && is_inside; ++i) {
      std::vector<const double*> moved = simplex;
      moved[i] = center.data();
      is_inside = kernel::orientation(Flat{K, axes}, moved) == truth.orientation();
    }
    if (!is_inside) return;
    cells::CellMemory<K - 1> memory(K - 1);
    memory.reserve(1);
    memory.prepare(1);
    sites::BoundarySites sites(K);
    sites.coordinates = coordinates;
    sites.axes = axes;
    geometry::CentralView view(grid);
    view.center = center;
    view.is_inside = true;
    view.low = low;
    view.high = high;
    geometry::CentralGeometry<K - 1> cells(memory, sites, view, inner);
    cells.update_box();
    // det(v_i − o) is that of the simplex, with the base moved to the end, for any o inside.
    const Sign inside = truth.orientation() * (K % 2 == 0 ? Sign::positive : Sign::negative);
    Index vertices[K];
    for (int i = 0; i < K; ++i) vertices[i] = static_cast<Index>(i + 1);
    if (inside == Sign::negative) std::swap(vertices[0], vertices[1]);
    for (int i = 0; i < K; ++i) memory.layout().set_vertex(memory.links(0), i, vertices[i]);
    cells.create(0, vertices, -1, 0);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const auto query = cells.make_query(queries[i]);
      const auto evaluator = cells.evaluator(query);
      const double value = evaluator.value(0);
      std::optional<Sign> of_filter = beyond(value, evaluator.threshold(0));
      if (!of_filter && cells.proves_tie(0, value, query)) of_filter = Sign::zero;
      tally_.check(Kind::hull, Stage::filter, of_filter,
                   truth.side_of_facet(integers[i]) * truth.orientation());
    }
  }
}

template <int K, class Int>
void Campaign::rays() {
  constexpr bool wide = std::is_same_v<Int, test::Integer>;
  constexpr std::size_t n = K + 1;
  constexpr int bits_of_terms[] = {0, 1, 3, 5, 7, 10, 13, 16, 19};
  constexpr int most_bits = std::min(50, (124 - bits_of_terms[K]) / static_cast<int>(n) - 1);
  const int bits = 2 + static_cast<int>(random_.below(static_cast<std::uint64_t>(most_bits - 1)));
  std::vector<Row> rows(n, Row(n)), queries;
  for (Row& row : rows)
    for (double& x : row) x = entry(bits - 2, wide);
  const double largest = std::ldexp(1.0, wide ? 100 : bits);
  while (queries.size() < num_queries) {
    Row row(n);
    for (std::size_t i = 0; i < K; ++i) {
      const double factor = integer_below(1);
      for (std::size_t j = 0; j < n; ++j) row[j] += factor * rows[i][j];
    }
    if (!wide) row[random_.below(n)] += nudge();
    if (random_.below(8) == 0)
      for (double& x : row) x = entry(bits, wide);
    if (std::all_of(row.begin(), row.end(), [&](double x) { return std::fabs(x) <= largest; }))
      queries.push_back(row);
    if (random_.below(16) == 0) queries.push_back(rows[random_.below(K)]);
  }
  std::vector<Int> matrix;
  for (std::size_t i = 0; i < K; ++i)
    for (const double x : rows[i]) matrix.push_back(integer_of<Int>(x));
  const std::vector<Int> plane = vanishing_on(matrix, n);
  const auto stretch = [&](Row& row) {
    const int exponent = random_.coin() ? 0 : static_cast<int>(random_.below(800)) - 400;
    for (double& x : row) x = std::ldexp(x, exponent);
  };
  std::vector<Sign> truth;
  for (Row& row : queries) {
    std::vector<Int> integers;
    for (const double x : row) integers.push_back(integer_of<Int>(x));
    truth.push_back(sign_of(value_at(plane, integers)));
    stretch(row);
  }
  for (Row& row : rows) stretch(row);
  const std::vector<int> axes = first_axes(K + 1);
  const Flat flat{K + 1, axes, RowForm::homogeneous};
  std::vector<const double*> pointers = pointers_to(rows);
  const Grid none(K + 1);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    StageCounts counts, counts_of_run_time;
    pointers[K] = queries[i].data();
    const Sign of_chain = kernel::homogeneous_orientation<K>(flat, pointers.data(), counts);
    tally_.check(Kind::rays, stage_of(counts), of_chain, truth[i]);
    if (K >= 7 && i % 8 != 0) continue;
    const Sign of_run_time =
        kernel::hull_side<0>(flat, pointers.data(), queries[i].data(), none, counts_of_run_time);
    tally_.check(Kind::rays, stage_of(counts_of_run_time), of_run_time, truth[i]);
    tally_.check(Kind::rays, Stage::binary64, kernel::direct_determinant<K + 1>(axes, pointers.data()),
                 truth[i]);
    tally_.check(Kind::rays, Stage::exact, kernel::exact_determinant(axes, pointers.data()), truth[i]);
  }
  Row all;
  for (const double* p : pointers) all.insert(all.end(), p, p + n);
  tally_.check(Kind::rays, Stage::public_function, homogeneous_orientation(all, K), truth.back());
}

/// n·p + c with a c that is about −n·p.
void Campaign::hyperplanes(int d) {
  const auto size = static_cast<std::size_t>(d);
  const int bits = 2 + static_cast<int>(random_.below(50));
  Row normal(size);
  for (double& x : normal) x = integer_below(bits);
  for (std::size_t i = 0; i < num_queries; ++i) {
    Row p(size), row = normal;
    Int128 sum = 0;
    for (std::size_t j = 0; j < size; ++j) {
      p[j] = integer_below(bits);
      sum += static_cast<Int128>(normal[j]) * static_cast<Int128>(p[j]);
    }
    const double offset = static_cast<double>(-sum) + nudge();
    const Sign truth = sign_of(sum + integer_of<Int128>(offset));
    row.push_back(offset);
    const int of_row = static_cast<int>(random_.below(300)) - 150,
              of_p = static_cast<int>(random_.below(300)) - 150;
    for (std::size_t j = 0; j < size; ++j) {
      row[j] = std::ldexp(row[j], of_row);
      p[j] = std::ldexp(p[j], of_p);
    }
    row[size] = std::ldexp(row[size], of_row + of_p);
    StageCounts counts;
    const Sign of_chain = kernel::side_of_hyperplane(row.data(), p.data(), d, counts);
    tally_.check(Kind::hyperplane, stage_of(counts), of_chain, truth);
    tally_.check(Kind::hyperplane, Stage::binary64, kernel::direct_affine_form(row.data(), p.data(), d),
                 truth);
    tally_.check(Kind::hyperplane, Stage::exact, kernel::exact_affine_form(row.data(), p.data(), d), truth);
    if (i == 0)
      tally_.check(Kind::hyperplane, Stage::public_function,
                   static_cast<Sign>(-static_cast<int>(side_of_hyperplane(row, p, d))), truth);
  }
}

volatile std::sig_atomic_t is_interrupted = 0;

}  // namespace
}  // namespace delone::campaign

int main(int argc, char** argv) {
  std::uint64_t calls = 1'000'000, seconds = 0, seed = 1;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::uint64_t value = std::stoull(argv[i + 1]);
    if (std::strcmp(argv[i], "--calls") == 0) calls = value;
    if (std::strcmp(argv[i], "--seconds") == 0) seconds = value;
    if (std::strcmp(argv[i], "--seed") == 0) seed = value;
  }
  const auto interrupt = [](int) { delone::campaign::is_interrupted = 1; };
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  delone::campaign::Campaign campaign(seed);
  delone::campaign::Tally& tally = campaign.tally();
  while (delone::campaign::is_interrupted == 0 && tally.calls() < calls && tally.wrong() < 20 &&
         (seconds == 0 || tally.seconds() < static_cast<double>(seconds)))
    campaign.round();
  tally.print(seed);
  return tally.wrong() == 0 ? 0 : 1;
}
