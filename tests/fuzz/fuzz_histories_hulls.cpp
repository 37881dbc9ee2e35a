// SPDX-License-Identifier: BSD-3-Clause
// Bytes → the history of a convex hull, of a lower hull, or of an intersection of halfspaces. In the end it
// must be that of all rows at once, pass every exact check, and agree with the definition if it is small. A
// lower hull must be the lower part of the hull: no point below a cell, a cell over every composition.
#include "halfspace_brute_force.hpp"
#include "history.hpp"
#include "hull_brute_force.hpp"

#include <delone/delone.hpp>

#include <span>
#include <utility>
#include <vector>

namespace {

using namespace delone;
using fuzz::Bytes;
using fuzz::require;
using Row = std::vector<double>;

void append(Row& rows, const Row& more) { rows.insert(rows.end(), more.begin(), more.end()); }
Row row_of(const Row& rows, std::size_t row, std::size_t size) {
  return {rows.begin() + static_cast<std::ptrdiff_t>(row * size),
          rows.begin() + static_cast<std::ptrdiff_t>((row + 1) * size)};
}

/// Sizes from which histories of more dimensions would take too long.
std::size_t most_rows(std::size_t d) { return d <= 3 ? 24 : d <= 5 ? 16 : 12; }

void run_hull(int dimension, Bytes& bytes) {
  const auto d = static_cast<std::size_t>(dimension);
  const auto style = static_cast<Bytes::Style>(bytes.below(Bytes::num_styles));
  bool is_cancelled = false;
  Options options;
  options.force_runtime_dimension = bytes.below(3) == 0;
  options.progress = [&](double) { return !is_cancelled; };
  ConvexHull<> history(dimension, options);
  Row rows;
  while (!bytes.empty() && rows.size() / d < most_rows(d)) {
    switch (bytes.below(6)) {
      case 0: {
        Row batch;
        for (std::size_t n = bytes.below(8); n > 0; --n) append(batch, bytes.row(d, style));
        const CanonicalHash before = history.hash();
        is_cancelled = bytes.below(4) == 0;
        const bool refused = fuzz::is_refused([&] { history.insert_range(batch); });
        require(!refused || (is_cancelled && history.hash() == before),
                "a cancelled batch has left something");
        if (!refused) append(rows, batch);
        is_cancelled = false;
        break;
      }
      case 1: {
        ConvexHull<> copy = history.clone();
        require(copy.hash() == history.hash(), "a copy is different");
        history = std::move(copy);
        break;
      }
      case 2: {
        const Row q = bytes.row(d, style);
        require(history.contains(q) == (history.locate(q).kind <= Containment::Kind::on_boundary),
                "contains() is not locate()");
        if (history.affine_dimension() == dimension)
          require(history.contains(q) == history.visible_facets(q).empty(), "outside, no facet is visible");
        break;
      }
      default:
        append(rows, bytes.row(d, style));
        history.insert(row_of(rows, rows.size() / d - 1, d));
    }
  }
  const std::size_t n = rows.size() / d;
  fuzz::require_checked(history.to_data(), "check of a hull:");
  Options of_batch;
  of_batch.force_runtime_dimension = !options.force_runtime_dimension;
  const ConvexHull<> batch(rows, dimension, of_batch);
  require(batch.hash() == history.hash(), "the history is not the batch");
  require(batch.f_vector() == history.f_vector(), "another number of faces");
  for (std::size_t row = 0; row < n; ++row) {
    require(batch.kind(row) == history.kind(row), "a point of another kind");
    require(history.contains(row_of(rows, row, d)), "a point is outside of its hull");
  }
  if (d > 3 || n > 9 || n == 0) return;
  const test::HullBruteForce truth(rows, dimension);
  require(truth.affine_dimension() == history.affine_dimension(), "another affine dimension");
  for (std::size_t row = 0; row < n; ++row)
    require(truth.kind(static_cast<SignedIndex>(row)) == history.kind(row),
            "a point is not of the kind that the definition says");
  if (history.affine_dimension() >= 1) {
    require(truth.facets().size() == history.num_facets(), "not the facets of the definition");
    require(truth.f_vector() == history.f_vector(), "not the faces of the definition");
  }
}

void run_lower_hull(int dimension, Bytes& bytes) {
  const auto d = static_cast<std::size_t>(dimension);
  const auto style = static_cast<Bytes::Style>(bytes.below(Bytes::num_styles));
  const HullSide side = bytes.below(2) == 0 ? HullSide::lower : HullSide::upper;
  Row rows;
  while (!bytes.empty() && rows.size() / d < most_rows(d)) append(rows, bytes.row(d, style));
  const std::size_t n = rows.size() / d;
  if (n == 0) return;
  const LowerHull<> hull(rows, dimension, side);
  const LowerHull<> copy = hull.clone();
  require(std::vector(copy.cells().begin(), copy.cells().end()) ==
              std::vector(hull.cells().begin(), hull.cells().end()),
          "a copy is different");
  const ConvexHull<> whole(rows, dimension);
  for (const SignedIndex row : hull.vertices())
    require(whole.kind(static_cast<std::size_t>(row)) != PointKind::interior,
            "a vertex is inside of the hull");
  for (std::size_t row = 0; row < n; ++row) {
    Row composition = row_of(rows, row, d);
    composition.pop_back();
    const bool found = hull.find_cell(composition).has_value();
    require(found || hull.composition_dimension() < 1, "no cell over a composition");
  }
  const auto heights = hull.height_above(rows);
  for (const double height : heights)
    require(!((side == HullSide::lower ? height : -height) < 0), "a point beyond its lower hull");
  const auto c = static_cast<std::size_t>(std::max(hull.composition_dimension(), 0));
  if (c + 1 != d) return;
  // No point below the hyperplane of a cell: exact signs, independent of how cells were made.
  const auto cells = hull.cells();
  for (std::size_t cell = 0; cell < hull.num_cells(); ++cell) {
    Row compositions, simplex;
    for (std::size_t i = 0; i < d; ++i) {
      const Row vertex = row_of(rows, static_cast<std::size_t>(cells[cell * d + i]), d);
      append(simplex, vertex);
      append(compositions, Row(vertex.begin(), vertex.end() - 1));
    }
    const Sign base = d == 1 ? Sign::positive : orientation(compositions, dimension - 1);
    require(base != Sign::zero, "a vertical cell");
    // det(p_i − p_0; q − p_0) has the sign of the base times that of the height of q over the cell.
    for (std::size_t row = 0; row < n; ++row) {
      Row all = simplex;
      append(all, row_of(rows, row, d));
      const Sign height = orientation(all, dimension) * base;
      require(height == Sign::zero || (height == Sign::positive) == (side == HullSide::lower),
              "a point beyond a cell");
    }
  }
}

/// What does not depend on the order in which halfspaces came.
void require_same(const IntersectionData& one, const IntersectionData& other) {
  require(one.state == other.state, "another state");
  if (one.state != IntersectionState::full) return;
  require(one.rank == other.rank && one.bounded == other.bounded, "another rank, or not bounded alike");
  require(one.kinds == other.kinds, "a halfspace of another kind");
  require(one.num_vertices() == other.num_vertices() && one.num_facets() == other.num_facets() &&
              one.num_directions() == other.num_directions() && one.num_edges() == other.num_edges() &&
              one.num_rays() == other.num_rays(),
          "another number of faces");
}

void run_halfspaces(int dimension, Bytes& bytes) {
  const auto width = static_cast<std::size_t>(dimension) + 1;
  const auto style = static_cast<Bytes::Style>(bytes.below(Bytes::num_styles));
  const bool is_given = bytes.below(2) == 0;  // the origin is inside of all
  const auto new_row = [&] {
    Row row = bytes.row(width, style);
    const std::uint8_t signs = bytes.next();
    for (std::size_t j = 0; j < width; ++j)
      if ((signs >> (j % 8) & 1) != 0) row[j] = -row[j];
    if (is_given) row.back() = -1 - std::fabs(row.back());
    return row;
  };
  Options options;
  options.force_runtime_dimension = bytes.below(3) == 0;
  Row rows;
  for (std::size_t n = bytes.below(6); n > 0; --n) append(rows, new_row());
  const Row origin(static_cast<std::size_t>(dimension), 0.0);
  auto history = is_given ? HalfspaceIntersection<>(rows, dimension, origin, options)
                          : HalfspaceIntersection<>(rows, dimension, options);
  // Rows that the interior point is not strictly inside of are refused as a whole.
  const auto insert = [&](const Row& more) {
    if (!fuzz::is_refused([&] { history.insert_range(more); })) return append(rows, more);
    require(history.num_halfspaces() == rows.size() / width, "a refused batch has left something");
  };
  while (!bytes.empty() && rows.size() / width < most_rows(width)) {
    switch (bytes.below(4)) {
      case 0: {
        Row batch;
        for (std::size_t n = bytes.below(5); n > 0; --n) append(batch, new_row());
        insert(batch);
        break;
      }
      case 1: {
        HalfspaceIntersection<> copy = history.clone();
        history = std::move(copy);
        break;
      }
      default:
        insert(new_row());
    }
  }
  fuzz::require_checked(history.to_data(), "check of halfspaces:");
  Options of_batch;
  of_batch.force_runtime_dimension = !options.force_runtime_dimension;
  const auto batch = HalfspaceIntersection<>(rows, dimension, of_batch);
  require_same(history.data(), batch.data());
  const std::size_t n = rows.size() / width;
  if (dimension > 3 || n > 7) return;
  test::HalfspaceBruteForce truth(rows, dimension);
  const IntersectionData& data = history.data();
  require(data.state == truth.state(), "not the state of the definition");
  if (data.state != IntersectionState::full) {
    require(test::HalfspaceBruteForce::has_no_interior(rows, dimension, data.witness),
            "a witness proves nothing");
    return;
  }
  require(static_cast<std::size_t>(data.rank) == truth.rank(), "not the rank of the definition");
  if (data.rank == 0) return;
  truth.solve(data.axes);
  require(data.num_vertices() == truth.vertices.size() && data.num_directions() == truth.directions.size(),
          "not the vertices of the definition");
  for (std::size_t row = 0; row < n; ++row)
    require(data.kinds[row] == truth.kind(row), "not the kind that the definition says");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const int dimension = 1 + static_cast<int>(bytes.below(6));
  switch (bytes.below(3)) {
    case 0:
      run_hull(dimension, bytes);
      break;
    case 1:
      run_lower_hull(std::max(dimension, 2), bytes);
      break;
    default:
      run_halfspaces(std::min(dimension, 5), bytes);
  }
  return 0;
}
