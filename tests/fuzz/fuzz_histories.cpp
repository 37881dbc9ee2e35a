// SPDX-License-Identifier: BSD-3-Clause
// Bytes → the history of a triangulation: points one by one and in batches, duplicates, batches that are
// cancelled, copies, compaction, queries. In the end it must be the triangulation of all points at once, by
// the engine for any dimension too, pass every exact check, be that of the definition if it is small, and
// have a diagram that passes its checks. In 7 and 8 dimensions, where batches with so many rows are wrapped,
// it is what insertion makes.
#include "brute_force.hpp"
#include "history.hpp"

#include <delone/delone.hpp>

#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using namespace delone;
using fuzz::Bytes;
using fuzz::require;
using Row = std::vector<double>;

/// One kind of triangulation: rows of d coordinates, and a weight.
struct OfDelaunay {
  using Product = Delaunay<>;
  static constexpr bool has_weights = false;
  static void insert(Product& product, const Row& row, double, std::optional<CellId> hint) {
    product.insert(row, hint);
  }
  static void insert_range(Product& product, const Row& rows, const Row&) { product.insert_range(rows); }
  static auto zone(const Product& product, const Row& row, double) { return product.conflict_zone(row); }
  static void check_diagram(const Product& product) {
    fuzz::require_checked(Voronoi<>(product).to_data(), "Voronoi diagram:");
  }
};
struct OfRegular {
  using Product = Regular<>;
  static constexpr bool has_weights = true;
  static void insert(Product& product, const Row& row, double weight, std::optional<CellId> hint) {
    product.insert(row, weight, hint);
  }
  static void insert_range(Product& product, const Row& rows, const Row& weights) {
    product.insert_range(rows, weights);
  }
  static auto zone(const Product& product, const Row& row, double weight) {
    return product.conflict_zone(row, weight);
  }
  static void check_diagram(const Product& product) {
    fuzz::require_checked(PowerDiagram<>(product).to_data(), "power diagram:");
  }
};
struct OfFurthestSite {
  using Product = FurthestSite<>;
  static constexpr bool has_weights = false;
  static void insert(Product& product, const Row& row, double, std::optional<CellId> hint) {
    product.insert(row, hint);
  }
  static void insert_range(Product& product, const Row& rows, const Row&) { product.insert_range(rows); }
  static auto zone(const Product& product, const Row& row, double) { return product.conflict_zone(row); }
  static void check_diagram(const Product&) {}
};

void append(Row& rows, const Row& more) { rows.insert(rows.end(), more.begin(), more.end()); }

/// Locations and conflict zones say of each row what the triangulation says.
template <class Kind>
void query(const typename Kind::Product& product, const Row& rows, const Row& weights) {
  const auto d = static_cast<std::size_t>(product.dimension());
  for (std::size_t row = 0; row < product.num_rows(); ++row) {
    const Row point(rows.begin() + static_cast<std::ptrdiff_t>(row * d),
                    rows.begin() + static_cast<std::ptrdiff_t>((row + 1) * d));
    if (product.affine_dimension() < 1) continue;
    const Location where = product.locate(point);
    if (product.kind() == TriangulationKind::delaunay || !product.is_hidden(row)) {
      require(where.kind == Location::Kind::on_vertex && where.face.front() == product.vertex_at(row),
              "a vertex is not located at itself");
    } else {
      require(where.kind != Location::Kind::outside_hull && where.kind != Location::Kind::outside_affine_hull,
              "a hidden point is outside");
    }
    require(Kind::zone(product, point, Kind::has_weights ? weights[row] : 0.0).empty(),
            "a row is in conflict with a cell");
  }
}

template <class Kind>
void run(int dimension, Bytes& bytes) {
  using Product = typename Kind::Product;
  const auto d = static_cast<std::size_t>(dimension);
  const auto style = static_cast<Bytes::Style>(bytes.below(Bytes::num_styles));
  const std::size_t most = d <= 3 ? 24 : d <= 5 ? 16 : 12;
  bool is_cancelled = false;
  Options options;
  options.force_runtime_dimension = bytes.below(3) == 0;
  options.progress = [&](double) { return !is_cancelled; };
  Product history(dimension, options);
  Row rows, weights;
  const auto new_row = [&] {
    if (!weights.empty() && bytes.below(6) == 0) {  // one that is there
      const std::size_t row = bytes.below(weights.size());
      return Row(rows.begin() + static_cast<std::ptrdiff_t>(row * d),
                 rows.begin() + static_cast<std::ptrdiff_t>((row + 1) * d));
    }
    return bytes.row(d, style);
  };
  const auto new_weight = [&] { return Kind::has_weights ? bytes.coordinate(style) : 0.0; };
  std::optional<CellId> hint;
  while (!bytes.empty() && weights.size() < most) {
    switch (bytes.below(8)) {
      case 0: {
        Row batch, of_batch;
        for (std::size_t n = bytes.below(8); n > 0; --n) {
          append(batch, new_row());
          of_batch.push_back(new_weight());
        }
        if (bytes.below(4) == 0) {
          const CanonicalHash before = history.hash();
          const std::size_t num_rows = history.num_rows();
          is_cancelled = true;
          const bool refused = fuzz::is_refused([&] { Kind::insert_range(history, batch, of_batch); });
          is_cancelled = false;
          if (refused) {
            require(history.hash() == before && history.num_rows() == num_rows,
                    "a cancelled batch has left something");
            hint.reset();
            break;
          }
        } else {
          Kind::insert_range(history, batch, of_batch);
        }
        append(rows, batch);
        append(weights, of_batch);
        hint.reset();
        break;
      }
      case 1: {
        Product copy = history.clone();
        require(copy.hash() == history.hash(), "a copy is different");
        history = std::move(copy);
        hint.reset();
        break;
      }
      case 2:
        history.compact();
        hint.reset();
        break;
      case 3:
        query<Kind>(history, rows, weights);
        break;
      case 4:  // a point that is refused
        require(fuzz::is_refused([&] { Kind::insert(history, Row(d, std::nan("")), 0, {}); }),
                "NaN was taken");
        break;
      default: {
        const Row row = new_row();
        const double weight = new_weight();
        Kind::insert(history, row, weight, hint);
        append(rows, row);
        weights.push_back(weight);
        if (history.affine_dimension() > 0) hint = *history.all_cells().begin();
      }
    }
  }
  const ComplexData data = history.to_data();
  CheckOptions check_options;
  check_options.furthest_site = history.kind() == TriangulationKind::furthest_site;
  fuzz::require_checked(data, "check:", check_options);
  query<Kind>(history, rows, weights);
  Options of_batch;
  of_batch.force_runtime_dimension = !options.force_runtime_dimension;
  Product batch(dimension, of_batch);
  Kind::insert_range(batch, rows, weights);
  require(batch.hash() == history.hash(), "the history is not the batch");
  require(batch.num_hidden() == history.num_hidden() && batch.num_duplicates() == history.num_duplicates(),
          "other points are hidden or duplicates");
  if (d <= 3 && weights.size() <= 9) {
    const test::BruteForce truth(
        rows, dimension, {}, Kind::has_weights ? std::span<const double>(weights) : std::span<const double>(),
        check_options.furthest_site);
    require(canonical_hash(truth.to_data()) == history.hash(), "the history is not what the definition says");
  }
  Kind::check_diagram(history);
}

/// So many rows that they are wrapped, though few are distinct.
void wrap(int dimension, Bytes& bytes) {
  const auto d = static_cast<std::size_t>(dimension);
  const auto style = static_cast<Bytes::Style>(bytes.below(Bytes::num_styles));
  const std::size_t num_distinct = d + 1 + bytes.below(8), num_rows = 204;
  Row rows;
  for (std::size_t row = 0; row < num_distinct; ++row) append(rows, bytes.row(d, style));
  for (std::size_t row = num_distinct; row < num_rows; ++row)
    for (std::size_t j = 0; j < d; ++j) rows.push_back(rows[row % num_distinct * d + j]);
  const Delaunay<> wrapped(rows, dimension);
  fuzz::require_checked(wrapped.to_data(), "check of a wrapped batch:");
  Delaunay<> inserted(dimension);
  for (std::size_t row = 0; row < num_rows; ++row)
    inserted.insert(std::span<const double>(rows).subspan(row * d, d));
  require(inserted.hash() == wrapped.hash(), "wrapping is not insertion");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const int dimension = 1 + static_cast<int>(bytes.below(8));
  switch (bytes.below(4)) {
    case 0:
      run<OfDelaunay>(dimension, bytes);
      break;
    case 1:
      run<OfRegular>(dimension, bytes);
      break;
    case 2:
      run<OfFurthestSite>(dimension, bytes);
      break;
    default:
      wrap(7 + dimension % 2, bytes);
  }
  return 0;
}
