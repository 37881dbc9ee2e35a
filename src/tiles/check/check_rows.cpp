// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/check/check_rows.hpp"

#include "base/progress_meter.hpp"
#include "tiles/part_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

namespace delone::tiles {

namespace {

std::vector<std::size_t> rows_of(std::initializer_list<std::int64_t> rows) {
  return {rows.begin(), rows.end()};
}

constexpr std::int64_t in_no_part = -2;  // in place of a vertex

std::int64_t rows_in_bucket(std::int64_t rows, std::uint64_t words, std::uint64_t memory) {
  const auto buckets = static_cast<std::int64_t>(RecordBuckets::count_for(words, memory));
  return std::max<std::int64_t>((rows + buckets - 1) / buckets, 1);
}

}  // namespace

void compare_with_index(const char* what, std::int64_t found, std::int64_t expected) {
  if (found != expected)
    throw Violation{fmt::format("there are {} {}, but index.json says {}", found, what, expected)};
}

void compare_with_index(const CanonicalHash& found, const TilesIndex& index) {
  if (found != index.hash)
    throw Violation{fmt::format("the hash is {}, but index.json says {}", found.hex(), index.hash.hex())};
}

void RoleCounts::compare_with_index(const TilesIndex& index) const {
  tiles::compare_with_index("vertices", vertices, index.num_vertices);
  tiles::compare_with_index("duplicates", duplicates, index.num_duplicates);
  tiles::compare_with_index("hidden points", hidden, index.num_hidden);
}

RowRoles::RowRoles(std::int64_t first, std::int64_t last)
    : first_(first),
      vertices_(static_cast<std::size_t>(last - first), in_no_part),
      parts_(vertices_.size()) {}

void RowRoles::add(std::int64_t row, std::int64_t vertex, std::size_t part) {
  if (vertices_[at(row)] != in_no_part)
    throw Violation{
        fmt::format("point {} is in {} and in {}", row, part_name(parts_[at(row)]), part_name(part)),
        {},
        rows_of({row})};
  vertices_[at(row)] = vertex;
  parts_[at(row)] = part;
}

std::int64_t RowRoles::vertex_of(std::int64_t row, bool has_cell) const {
  const std::int64_t vertex = vertices_[at(row)];
  const auto refuse = [&](const char* what) {
    throw Violation{fmt::format("point {} {}", row, what), {}, rows_of({row})};
  };
  if (vertex == in_no_part) refuse("is in no part");
  if (vertex == row && !has_cell) refuse("is its own vertex, but no cell has it");
  if (vertex != row && has_cell)
    refuse(vertex < 0 ? "is a vertex of a cell, but hidden"
                      : "is a vertex of a cell, but merged into another");
  return vertex;
}

void RowRoles::require_earlier_vertex(std::int64_t row, std::int64_t vertex) const {
  const bool is_vertex = vertices_[at(vertex)] == vertex;
  if (is_vertex && vertex < row) return;
  throw Violation{fmt::format("point {} was merged into point {}, which is {}", row, vertex,
                              is_vertex ? "a later one" : "no vertex"),
                  {},
                  rows_of({row, vertex})};
}

RowChecker::RowChecker(const TilesIndex& index, const std::string& scratch, std::uint64_t words,
                       std::uint64_t memory, const double* input)
    : index_(index),
      input_(input),
      row_size_(static_cast<std::size_t>(index.dimension) + (index.weighted ? 1 : 0)),
      rows_per_bucket_(rows_in_bucket(index.num_points, words, memory)),
      owned_(scratch + "/owned", bucket_of(std::max<std::int64_t>(index.num_points - 1, 0)) + 1),
      seen_(scratch + "/seen", owned_.size()),
      merged_(scratch + "/merged", owned_.size()) {}

void RowChecker::add(const CheckedPart& part, Findings& findings) {
  if (!findings.wanted(6)) return;
  const TileData& tile = part.tile;
  const auto number = static_cast<std::int64_t>(part.number);
  std::int64_t vertices = 0;
  for (std::size_t i = 0; i < tile.own_rows.size(); ++i) {
    const std::int64_t row = tile.own_rows[i], vertex = tile.vertex_of_row[i];
    owned_.append(bucket_of(row), std::array{row, number, vertex});
    vertices += vertex == row ? 1 : 0;
    if (vertex >= 0 && vertex != row) merged_.append(bucket_of(vertex), std::array{vertex, row});
  }
  if (vertices != index_.parts[part.number].num_vertices)
    findings.add(6, {fmt::format("{} has {} vertices of its own, but index.json says {}",
                                 part_name(part.number), vertices, index_.parts[part.number].num_vertices)});

  // A tag of a cell is the sum of those of its vertices.
  const std::size_t d = static_cast<std::size_t>(index_.dimension), v = tile.rows.size();
  std::vector<complex::PointTag> tags(v), weighted_tags(index_.weighted ? v : 0);
  std::vector<double> point(row_size_);
  std::vector<std::int64_t> record(2 + row_size_);
  for (std::size_t i = 0; i < v; ++i) {
    std::copy_n(part.data.points.begin() + static_cast<std::ptrdiff_t>(i * d), d, point.begin());
    if (index_.weighted) {
      point[d] = part.data.weights[i];
      weighted_tags[i] = complex::point_tag(point.data(), index_.dimension + 1);
    }
    tags[i] = complex::point_tag(point.data(), index_.dimension);
    record[0] = tile.rows[i];
    record[1] = number;
    for (std::size_t j = 0; j < row_size_; ++j) record[2 + j] = std::bit_cast<std::int64_t>(point[j]);
    seen_.append(bucket_of(tile.rows[i]), record);
  }
  std::vector<bool> is_used(v, false);
  for (std::size_t c = 0; c < part.data.num_cells(); ++c) {
    internal::cancellation_point();
    complex::PointTag sum, weighted_sum;
    for (std::size_t i = 0; i < part.corners(); ++i) {
      const auto vertex = static_cast<std::size_t>(part.data.cells[c * part.corners() + i]);
      is_used[vertex] = true;
      sum += tags[vertex];
      if (index_.weighted) weighted_sum += weighted_tags[vertex];
    }
    hash_.add_cell(sum);
    weighted_hash_.add_cell(weighted_sum);
  }
  if (const auto unused = std::find(is_used.begin(), is_used.end(), false); unused != is_used.end()) {
    const std::int64_t row = tile.rows[static_cast<std::size_t>(unused - is_used.begin())];
    findings.add(6, {fmt::format("{} has point {}, but no cell with it", part_name(part.number), row),
                     {},
                     rows_of({row})});
  }
}

void RowChecker::match(Findings& findings) {
  if (!findings.wanted(6)) return;
  try {
    for (std::size_t bucket = 0; bucket < owned_.size(); ++bucket) match_bucket(bucket);
    compare_with_index();
  } catch (Violation& violation) {
    findings.add(6, std::move(violation));
  }
}

void RowChecker::match_bucket(std::size_t bucket) {
  const std::int64_t first = static_cast<std::int64_t>(bucket) * rows_per_bucket_,
                     last = std::min(first + rows_per_bucket_, index_.num_points);
  RowRoles roles(first, last);
  const std::vector<std::int64_t> owned = owned_.take(bucket);
  for (std::size_t i = 0; i < owned.size(); i += 3)
    roles.add(owned[i], owned[i + 2], static_cast<std::size_t>(owned[i + 1]));
  internal::cancellation_point();
  const std::vector<std::int64_t> seen = seen_.take(bucket);
  const std::size_t record = 2 + row_size_, none = seen.size();
  std::vector<std::size_t> place(static_cast<std::size_t>(last - first), none);  // a row's first record
  std::vector<double> point(row_size_);
  const auto get_point = [&](std::size_t at) {
    for (std::size_t i = 0; i < row_size_; ++i) point[i] = std::bit_cast<double>(seen[at + 2 + i]);
  };
  const auto agree = [&](std::size_t a, std::size_t b) {
    for (std::size_t i = 2; i < record; ++i)
      if (std::bit_cast<double>(seen[a + i]) != std::bit_cast<double>(seen[b + i])) return false;
    return true;
  };
  for (std::size_t i = 0; i < seen.size(); i += record) {
    const auto at = static_cast<std::size_t>(seen[i] - first);
    if (place[at] == none) {
      place[at] = i;
    } else if (!agree(i, place[at])) {
      throw Violation{fmt::format("{} and {} have different coordinates for point {}",
                                  part_name(static_cast<std::size_t>(seen[place[at] + 1])),
                                  part_name(static_cast<std::size_t>(seen[i + 1])), seen[i]),
                      {},
                      rows_of({seen[i]})};
    }
  }
  for (std::int64_t row = first; row < last; ++row) {
    internal::cancellation_point();
    const std::size_t at = place[static_cast<std::size_t>(row - first)];
    const std::int64_t vertex = roles.vertex_of(row, at != none);
    counts_.add(row, vertex);
    if (vertex != row) continue;
    get_point(at);
    if (input_ != nullptr && !std::equal(point.begin(), point.end(), input_of(row)))
      throw Violation{fmt::format("point {} has other coordinates in the input", row), {}, rows_of({row})};
    hash_.add_vertex(complex::point_tag(point.data(), index_.dimension));
    if (!index_.weighted) continue;
    weighted_hash_.add_vertex(complex::point_tag(point.data(), index_.dimension + 1));
    least_weight_ = std::min(least_weight_, point.back());
    largest_weight_ = std::max(largest_weight_, point.back());
  }
  const std::vector<std::int64_t> merged = merged_.take(bucket);
  for (std::size_t i = 0; i < merged.size(); i += 2) {
    const std::int64_t vertex = merged[i], row = merged[i + 1];
    roles.require_earlier_vertex(row, vertex);
    if (input_ != nullptr && !std::equal(input_of(vertex), input_of(vertex) + row_size_, input_of(row)))
      throw Violation{fmt::format("point {} was merged into point {}, but they are not equal", row, vertex),
                      {},
                      rows_of({row, vertex})};
  }
}

void RowChecker::compare_with_index() const {
  counts_.compare_with_index(index_);
  const bool weights_differ = least_weight_ < largest_weight_;
  tiles::compare_with_index(
      (weights_differ ? weighted_hash_ : hash_).finish(index_.dimension, index_.affine_dimension), index_);
}

}  // namespace delone::tiles
