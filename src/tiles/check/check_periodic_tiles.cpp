// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/check/check_periodic_tiles.hpp"

#include "base/quick_rounds.hpp"
#include "check/check_periodic.hpp"
#include "check/levels.hpp"
#include "periodic/periodic_hash.hpp"
#include "periodic/periodic_set.hpp"
#include "tiles/check/check_rows.hpp"
#include "tiles/making/periodic_part.hpp"
#include "tiles/part_file.hpp"

#include <delone/data.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace delone::tiles {

namespace {

using internal::Violation;

/// All parts of a folder.
class Whole {
 public:
  Whole(const std::string& folder, const TilesIndex& index) : index_(index) {
    constexpr std::int64_t most = std::numeric_limits<SignedIndex>::max();
    if (index.num_cells > most || index.num_points > most)
      throw Error(Errc::too_many,
                  "tiles of a periodic set are checked in one piece, which has at most 2^31 points "
                  "and cells");
    for (std::size_t i = 0; i < index.parts.size(); ++i) parts_.push_back(read_tile_of(folder, index, i));
  }

  /// The triangulation of the vertices, numbered in the order of their rows. Throws a Violation of level 2.
  ComplexData merge() {
    ComplexData data;
    data.dimension = index_.dimension;
    data.affine_dimension = index_.affine_dimension;
    data.kind = index_.weighted ? DataKind::periodic_regular : DataKind::periodic_delaunay;
    data.lattice = index_.lattice.vectors;
    data.unit = index_.unit;
    number_vertices();
    merge_points(data);
    for (std::size_t i = 0; i < parts_.size(); ++i) merge_cells(i, data);
    return data;
  }
  std::size_t row(std::size_t point) const { return static_cast<std::size_t>(rows_[point]); }

  /// Throws a Violation of level 6. `data`: what merge() has returned.
  void compare_with_index(const ComplexData& data) const {
    check_rows();
    std::int64_t outer = std::count(data.neighbors.begin(), data.neighbors.end(), -1);
    if (data.affine_dimension == 0) outer = index_.num_hull_facets;
    tiles::compare_with_index("hull facets", outer, index_.num_hull_facets);
    tiles::compare_with_index(hash(data), index_);
  }

 private:
  void number_vertices() {
    number_.assign(static_cast<std::size_t>(index_.num_points), -1);
    for (const TileData& part : parts_)
      for (const std::int64_t row : part.rows) number_[static_cast<std::size_t>(row)] = 0;
    for (std::size_t row = 0; row < number_.size(); ++row) {
      if (number_[row] < 0) continue;
      number_[row] = static_cast<SignedIndex>(rows_.size());
      rows_.push_back(static_cast<std::int64_t>(row));
    }
  }
  void merge_points(ComplexData& data) const {
    const auto d = static_cast<std::size_t>(index_.dimension);
    data.points.resize(rows_.size() * d);
    data.weights.resize(index_.weighted ? rows_.size() : 0);
    std::vector<bool> is_known(rows_.size(), false);
    for (const TileData& part : parts_)
      for (std::size_t i = 0; i < part.rows.size(); ++i) {
        const auto number = static_cast<std::size_t>(number_[static_cast<std::size_t>(part.rows[i])]);
        const auto from = part.points.begin() + static_cast<std::ptrdiff_t>(i * d);
        const auto to = data.points.begin() + static_cast<std::ptrdiff_t>(number * d);
        const double weight = index_.weighted ? part.weights[i] : 0;
        if (is_known[number] && (!std::equal(from, from + static_cast<std::ptrdiff_t>(d), to) ||
                                 (index_.weighted && data.weights[number] != weight)))
          throw Violation{fmt::format("parts have different coordinates for point {}", part.rows[i]),
                          {},
                          {static_cast<std::size_t>(part.rows[i])}};
        std::copy_n(from, d, to);
        if (index_.weighted) data.weights[number] = weight;
        is_known[number] = true;
      }
  }
  void merge_cells(std::size_t i, ComplexData& data) const {
    const TileData& part = parts_[i];
    const auto r = static_cast<std::size_t>(part.rank);
    const auto first = static_cast<SignedIndex>(index_.parts[i].first_cell);
    internal::QuickRounds round;
    for (std::size_t at = 0; at < part.cells.size(); ++at) {
      round();
      data.cells.push_back(
          number_[static_cast<std::size_t>(part.rows[static_cast<std::size_t>(part.cells[at])])]);
      const std::int32_t neighbor = part.neighbors[at];
      if (neighbor >= -1) {
        data.neighbors.push_back(neighbor < 0 ? -1 : first + neighbor);
        data.neighbor_offsets.resize(data.neighbor_offsets.size() + r, 0);
        continue;
      }
      const auto seam = static_cast<std::size_t>(-2 - std::int64_t{neighbor});
      data.neighbors.push_back(static_cast<SignedIndex>(part.seams[seam]));
      const auto offset = part.seam_offsets.begin() + static_cast<std::ptrdiff_t>(seam * r);
      data.neighbor_offsets.insert(data.neighbor_offsets.end(), offset,
                                   offset + static_cast<std::ptrdiff_t>(r));
    }
    data.cell_offsets.insert(data.cell_offsets.end(), part.cell_offsets.begin(), part.cell_offsets.end());
  }

  void check_rows() const {
    RowRoles roles(0, index_.num_points);
    for (std::size_t i = 0; i < parts_.size(); ++i)
      for (std::size_t j = 0; j < parts_[i].own_rows.size(); ++j)
        roles.add(parts_[i].own_rows[j], parts_[i].vertex_of_row[j], i);
    RoleCounts counts;
    for (std::int64_t row = 0; row < index_.num_points; ++row) {
      const std::int64_t vertex = roles.vertex_of(row, number_[static_cast<std::size_t>(row)] >= 0);
      counts.add(row, vertex);
      if (vertex >= 0 && vertex != row) roles.require_earlier_vertex(row, vertex);
    }
    counts.compare_with_index(index_);
  }

  CanonicalHash hash(const ComplexData& data) const {
    periodic::SetInput input{data.points, data.weights, data.lattice,
                             static_cast<std::size_t>(data.dimension), index_.weighted};
    input.unit = index_.unit;
    const periodic::PeriodicSet set = make_periodic_set(input);
    const bool with_weights = std::any_of(data.weights.begin(), data.weights.end(),
                                          [&](double weight) { return weight != data.weights.front(); });
    int finest = periodic::finest_bit(set.period);
    for (std::size_t i = 0; i < parts_.size(); ++i)
      finest = std::min(finest, finest_bit_of_part(set, parts_[i], index_.parts[i].num_vertices));
    complex::HashAccumulator sum = lattice_hash(set, finest);
    for (std::size_t i = 0; i < parts_.size(); ++i)
      sum.add(hash_of_part(set, finest, parts_[i], index_.parts[i].num_vertices, with_weights));
    return sum.finish(data.dimension, data.affine_dimension);
  }

  const TilesIndex& index_;
  std::vector<TileData> parts_;
  std::vector<SignedIndex> number_;  // by row; −1: no vertex
  std::vector<std::int64_t> rows_;   // of the vertices
};

CheckReport violation_at(int level, Violation violation) {
  CheckReport report;
  report.reached = check_levels(DataKind::periodic_delaunay)[static_cast<std::size_t>(level - 1)];
  report.violation = std::move(violation.message);
  report.cells = std::move(violation.cells);
  report.points = std::move(violation.points);
  return report;
}

}  // namespace

CheckReport check_periodic_tiles(const std::string& folder, const TilesIndex& index,
                                 const CheckOptions& options) {
  try {
    Whole whole(folder, index);
    CheckReport report;
    try {
      const ComplexData data = whole.merge();
      report = internal::check_periodic(data, options);
      for (std::size_t& point : report.points) point = whole.row(point);
      if (report.ok && options.up_to >= 6) whole.compare_with_index(data);
    } catch (Violation& violation) {
      report = violation_at(report.ok ? 6 : 2, std::move(violation));
    }
    return report;
  } catch (const Error& error) {
    if (error.code() != Errc::bad_format && error.code() != Errc::cannot_open) throw;
    return violation_at(1, {error.what()});
  }
}

}  // namespace delone::tiles
