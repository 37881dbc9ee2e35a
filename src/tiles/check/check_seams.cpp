// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/check/check_seams.hpp"

#include "base/progress_meter.hpp"
#include "tiles/equal_records.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace delone::tiles {

namespace {

std::string braces(std::span<const std::int64_t> rows) {
  return fmt::format("{{{}}}", fmt::join(rows, ", "));
}

/// Numbers of a record, and where each point begins among them.
std::vector<double> doubles_of(std::span<const std::int64_t> words) {
  std::vector<double> values;
  values.reserve(words.size());
  for (const std::int64_t word : words) values.push_back(std::bit_cast<double>(word));
  return values;
}
std::vector<const double*> points_of(const std::vector<double>& values, std::size_t row_size) {
  std::vector<const double*> points;
  for (std::size_t at = 0; at < values.size(); at += row_size) points.push_back(values.data() + at);
  return points;
}

std::vector<std::size_t> cells_of(std::initializer_list<std::int64_t> cells) {
  return {cells.begin(), cells.end()};
}

}  // namespace

// A record of a facet: its k rows, increasing; the cell, the neighbor that its part gives, and whether the
// order of the rows is odd; the row of the opposite vertex; then k+1 points, the opposite one last.
struct SeamChecker::Facet {
  std::span<const std::int64_t> rows;
  std::int64_t cell, given, odd, apex;
  std::vector<double> values;
  std::vector<const double*> points = {};  ///< in `values`
};

// A record of a ridge of the hull: its k−1 rows, increasing; the cell, and the row of the vertex of the hull
// facet opposite the ridge; then k+1 points: of the ridge, of that vertex, and of the vertex of the cell
// inside.
struct SeamChecker::Ridge {
  std::span<const std::int64_t> rows;
  std::int64_t cell, opposite;
  std::vector<double> values;
  std::vector<const double*> points = {};  ///< in `values`
};

SeamChecker::SeamChecker(const TilesIndex& index, const Reference& reference, std::string scratch,
                         std::uint64_t facets, std::uint64_t memory, bool canonical)
    : dimension_(index.dimension),
      k_(static_cast<std::size_t>(std::max(index.affine_dimension, 0))),
      row_size_(static_cast<std::size_t>(index.dimension) + (index.weighted ? 1 : 0)),
      facet_size_(k_ + 4 + (k_ + 1) * row_size_),
      ridge_size_((k_ == 0 ? 0 : k_ - 1) + 2 + (k_ + 1) * row_size_),
      reference_(reference),
      scratch_(std::move(scratch)),
      canonical_(canonical),
      facets_(std::make_unique<RecordBuckets>(scratch_ + "/facets",
                                              RecordBuckets::count_for(facets * facet_size_, memory))) {}

void SeamChecker::append(std::span<const double> values) {
  for (const double value : values) record_.push_back(std::bit_cast<std::int64_t>(value));
}

void SeamChecker::add(const CheckedPart& part) {
  const std::size_t corners = part.corners(), d = static_cast<std::size_t>(dimension_);
  std::vector<std::pair<std::int64_t, SignedIndex>> facet;  // row of the input, point of the part
  const auto append_point = [&](SignedIndex v) {
    append(std::span(part.data.points).subspan(static_cast<std::size_t>(v) * d, d));
    if (!part.data.weights.empty())
      append(std::span(part.data.weights).subspan(static_cast<std::size_t>(v), 1));
  };
  for (std::size_t at = 0; at < part.tile.neighbors.size(); ++at) {
    if (part.tile.neighbors[at] >= 0) continue;
    internal::cancellation_point();
    const std::size_t c = at / corners, i = at % corners;
    facet.clear();
    for (std::size_t j = 0; j < corners; ++j)
      if (const SignedIndex v = part.data.cells[c * corners + j]; j != i) facet.emplace_back(part.row(v), v);
    // Whether an odd permutation turns the cell into the facet as it is sorted, and then the vertex opposite.
    std::size_t exchanges = corners - 1 - i;
    for (std::size_t a = 1; a < facet.size(); ++a)
      for (std::size_t b = a; b > 0 && facet[b].first < facet[b - 1].first; --b, ++exchanges)
        std::swap(facet[b], facet[b - 1]);
    const SignedIndex apex = part.data.cells[at];
    record_.clear();
    for (const auto& [row, v] : facet) record_.push_back(row);
    const std::size_t bucket = bucket_of_key(record_, facets_->size());
    record_.insert(record_.end(), {part.first_cell + static_cast<std::int64_t>(c), part.given_neighbor(at),
                                   static_cast<std::int64_t>(exchanges % 2), part.row(apex)});
    for (const auto& [row, v] : facet) append_point(v);
    append_point(apex);
    facets_->append(bucket, record_);
  }
}

SeamChecker::Facet SeamChecker::facet_at(std::span<const std::int64_t> words) const {
  Facet facet{words.first(k_), words[k_],     words[k_ + 1],
              words[k_ + 2],   words[k_ + 3], doubles_of(words.subspan(k_ + 4))};
  facet.points = points_of(facet.values, row_size_);
  return facet;
}

void SeamChecker::match(const Facet& a, const Facet& b, Findings& findings) {
  for (std::size_t i = 0; i < k_; ++i)
    if (!std::equal(a.points[i], a.points[i] + row_size_, b.points[i]))
      return findings.add(
          2, {fmt::format("the parts of the cells {} and {} have different coordinates for point {}", a.cell,
                          b.cell, a.rows[i]),
              cells_of({a.cell, b.cell}), cells_of({a.rows[i]})});
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
    if (one->given != other->cell)
      return findings.add(
          2, {fmt::format("cell {} shares the facet {} with cell {}, but has {} for its neighbor there",
                          one->cell, braces(one->rows), other->cell,
                          one->given < 0 ? "none" : fmt::format("{}", one->given)),
              cells_of({one->cell, other->cell})});
  if (a.odd == b.odd)
    return findings.add(2, {fmt::format("the cells {} and {} with the facet {} are not oriented coherently",
                                        a.cell, b.cell, braces(a.rows)),
                            cells_of({a.cell, b.cell})});
  if (k_ == 0 || reference_.is_flat || !findings.wanted(4)) return;

  const kernel::Flat flat = reference_.flat(dimension_);
  const Sign side_a = orientation_of(flat, a.points), side_b = orientation_of(flat, b.points);
  if (side_a == Sign::zero || side_b != -side_a)
    return findings.add(4, {fmt::format("the cells {} and {} do not lie on different sides of their facet {}",
                                        a.cell, b.cell, braces(a.rows)),
                            cells_of({a.cell, b.cell})});
  if (!findings.wanted(5)) return;
  const double* apex = b.points[k_];
  const auto refuse = [&](const char* how) {
    findings.add(
        5, {fmt::format("the vertex {} of cell {} is {} the sphere of cell {}", b.apex, b.cell, how, a.cell),
            cells_of({a.cell, b.cell}), cells_of({b.apex})});
  };
  const Sign sign = kernel::in_sphere(flat, a.points, side_a, apex);
  if (sign == Sign::negative) return refuse("inside");
  if (sign == Sign::positive) return;
  ++ties_;
  if (canonical_ && kernel::in_sphere_perturbed(flat, a.points, side_a, apex) != Sign::positive)
    refuse("on, and when ties are perturbed inside,");
}

void SeamChecker::add_hull_facet(const Facet& facet, Findings& findings) {
  ++num_hull_facets_;
  if (facet.given >= 0)
    return findings.add(
        2, {fmt::format("the neighbor of cell {} at the facet {} is cell {}, which does not share it",
                        facet.cell, braces(facet.rows), facet.given),
            cells_of({facet.cell, facet.given})});
  if (k_ == 0 || !findings.wanted(3)) return;
  if (!reference_.is_flat && findings.wanted(5)) {
    const kernel::Flat flat = reference_.flat(dimension_);
    std::vector<const double*> points = facet.points;
    const Sign inside = orientation_of(flat, points);
    if (inside != Sign::zero && side_of_reference(flat, reference_, points, k_) != inside)
      findings.add(5,
                   {fmt::format("the hull is not convex: cell {} is not behind the hull facet {} of cell {}",
                                reference_.cell, braces(facet.rows), facet.cell),
                    cells_of({reference_.cell, facet.cell})});
  }
  for (std::size_t j = 0; j < k_; ++j) {
    record_.clear();
    for (std::size_t i = 0; i < k_; ++i)
      if (i != j) record_.push_back(facet.rows[i]);
    const std::size_t bucket = bucket_of_key(record_, ridges_->size());
    record_.insert(record_.end(), {facet.cell, facet.rows[j]});
    for (std::size_t i = 0; i < k_; ++i)
      if (i != j) append({facet.points[i], row_size_});
    append({facet.points[j], row_size_});
    append({facet.points[k_], row_size_});
    ridges_->append(bucket, record_);
  }
}

void SeamChecker::match_facets(Findings& findings) {
  // At most as many ridges as all facets could have.
  ridges_ =
      std::make_unique<RecordBuckets>(scratch_ + "/ridges", facets_->size() * std::max<std::size_t>(k_, 1));
  for (std::size_t bucket = 0; bucket < facets_->size(); ++bucket) {
    const std::vector<std::int64_t> words = facets_->take(bucket);
    const auto facet = [&](std::size_t record) {
      return facet_at(std::span(words).subspan(record * facet_size_, facet_size_));
    };
    for_equal_records(words, facet_size_, k_, [&](std::span<const std::size_t> equal) {
      internal::cancellation_point();
      if (!findings.wanted(2)) return;
      const Facet first = facet(equal[0]);
      if (equal.size() == 1) return add_hull_facet(first, findings);
      const Facet second = facet(equal[1]);
      if (equal.size() == 2) return match(first, second, findings);
      const std::int64_t third = facet(equal[2]).cell;
      findings.add(2, {fmt::format("the cells {}, {} and {} share the facet {}", first.cell, second.cell,
                                   third, braces(first.rows)),
                       cells_of({first.cell, second.cell, third})});
    });
  }
}

void SeamChecker::match_ridges(Findings& findings) {
  if (num_hull_facets_ == 0) {
    if (reference_.cell >= 0) findings.add(3, {"there is no hull: every facet is shared by two cells"});
    return;
  }
  if (k_ == 0) {
    if (num_hull_facets_ > 1) findings.add(3, {"an affine dimension of 0 allows one cell only"});
    return;
  }
  const std::size_t key = k_ - 1;
  const kernel::Flat flat = reference_.flat(dimension_);
  for (std::size_t bucket = 0; bucket < ridges_->size(); ++bucket) {
    const std::vector<std::int64_t> words = ridges_->take(bucket);
    const auto ridge = [&](std::size_t record) {
      const auto all = std::span(words).subspan(record * ridge_size_, ridge_size_);
      Ridge found{all.first(key), all[key], all[key + 1], doubles_of(all.subspan(key + 2))};
      found.points = points_of(found.values, row_size_);
      return found;
    };
    for_equal_records(words, ridge_size_, key, [&](std::span<const std::size_t> equal) {
      internal::cancellation_point();
      if (!findings.wanted(3)) return;
      const Ridge a = ridge(equal[0]);
      if (equal.size() != 2)
        return findings.add(
            3, {fmt::format("the hull is not closed: {} of its facets, one of cell {}, have the ridge {}",
                            equal.size(), a.cell, braces(a.rows)),
                cells_of({a.cell})});
      const Ridge b = ridge(equal[1]);
      for (std::size_t i = 0; i < key; ++i)
        if (!std::equal(a.points[i], a.points[i] + row_size_, b.points[i]))
          return findings.add(
              3, {fmt::format("the parts of the cells {} and {} have different coordinates for point {}",
                              a.cell, b.cell, a.rows[i]),
                  cells_of({a.cell, b.cell}), cells_of({a.rows[i]})});
      if (reference_.is_flat || !findings.wanted(5)) return;
      std::vector<const double*> points = a.points;
      const Sign inside = orientation_of(flat, points);
      points[k_] = b.points[k_ - 1];
      if (inside != Sign::zero && orientation_of(flat, points) == -inside)
        findings.add(
            5,
            {fmt::format("the hull is not convex: the vertex {} of cell {} is beyond a hull facet of cell {}",
                         b.opposite, b.cell, a.cell),
             cells_of({a.cell, b.cell}), cells_of({b.opposite})});
    });
  }
}

}  // namespace delone::tiles
