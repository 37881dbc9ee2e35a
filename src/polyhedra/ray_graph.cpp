// SPDX-License-Identifier: BSD-3-Clause
#include "polyhedra/ray_graph.hpp"

#include <algorithm>

namespace delone::polyhedra {

RayGraph::RayGraph(const Rows& rows)
    : rows_(&rows),
      dimension_(rows.front().size()),
      zeros_(0, rows.size()),
      used_(words_for(rows.size()), 0),
      edges_(rows.size()),
      removed_by_(rows.size()) {
  for (std::size_t row = 0; row < dimension_; ++row) polyhedra::insert(used_, row);
}

RayId RayGraph::new_id() {
  if (!free_ids_.empty()) {
    const RayId id = free_ids_.back();
    free_ids_.pop_back();
    return id;
  }
  if (capacity() == none) throw Error(Errc::too_many, "there are more than 4·10^9 rays");
  zeros_.resize(capacity() + 1);
  first_negative_.push_back(none);
  place_.push_back(0);
  return static_cast<RayId>(capacity() - 1);
}

void RayGraph::insert(RayId ray, ConstBits zeros, std::uint32_t first_negative) {
  std::copy(zeros.begin(), zeros.end(), zeros_[ray].begin());
  first_negative_[ray] = first_negative;
  place_[ray] = static_cast<std::uint32_t>(rays_.size());
  rays_.push_back(ray);
  if (first_negative != none) removed_by_[first_negative].push_back(ray);
}

std::size_t RayGraph::num_simple_rays() const {
  return static_cast<std::size_t>(std::count_if(rays_.begin(), rays_.end(), [&](RayId ray) {
    std::size_t rows = 0;
    for (std::size_t w = 0; w < used_.size(); ++w)
      rows += static_cast<std::size_t>(std::popcount(zeros_[ray][w] & used_[w]));
    return rows + 1 == dimension_;
  }));
}

void RayGraph::add(ConstBits zeros, std::uint32_t first_negative) { insert(new_id(), zeros, first_negative); }

void RayGraph::connect_all() {
  for (std::size_t i = 0; i < rays_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) add_edge(rays_[i], rays_[j]);
}

/// The row that removes the one end first cuts the edge, unless the other end lies on it. If it does, or if
/// the row removes both, the edge ends there.
void RayGraph::add_edge(RayId a, RayId b) {
  if (first_negative_[a] == first_negative_[b]) return;
  if (first_negative_[a] < first_negative_[b]) std::swap(a, b);
  const std::uint32_t row = first_negative_[b];
  if (!is_zero(a, row)) edges_[row].push_back({a, b});
}

/// An edge may have been found in several sections.
const std::vector<CutEdge>& RayGraph::edges_cut_by(std::size_t row) {
  std::vector<CutEdge>& edges = edges_[row];
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

void RayGraph::commit(std::size_t row, const NewRays& made, std::vector<RayId>& ids) {
  polyhedra::insert(used_, row);
  section_.clear();
  for (const RayId ray : rays_)
    if (first_negative_[ray] != row && is_zero(ray, row)) section_.push_back(ray);
  for (const RayId ray : removed_by_[row]) {
    const RayId last = rays_.back();
    rays_[place_[ray]] = last;
    place_[last] = place_[ray];
    rays_.pop_back();
  }
  for (std::size_t i = 0; i < made.edges.size(); ++i) {
    const RayId ray = new_id();
    insert(ray, made.zeros[i], made.first_negative[i]);
    add_edge(ray, made.edges[i].positive);
    section_.push_back(ray);
    ids.push_back(ray);
  }
  // Not before: new rays would take the places of those that they are made from.
  free_ids_.insert(free_ids_.end(), removed_by_[row].begin(), removed_by_[row].end());
  std::vector<RayId>().swap(removed_by_[row]);
  std::vector<CutEdge>().swap(edges_[row]);
}

std::size_t RayGraph::rank_of(const std::vector<std::size_t>& rows) const {
  if (rows.size() < 2) return rows.size();
  Echelon echelon(dimension_);
  for (const std::size_t row : rows) echelon.add((*rows_)[row]);
  return echelon.rank();
}

/// A section that gets no new ray has to be looked at, too: two of its rays may have become adjacent.
void RayGraph::connect(std::size_t row, unsigned threads) {
  if (section_.size() < 2 || row + 1 == num_rows()) return;
  std::sort(section_.begin(), section_.end(), [&](RayId a, RayId b) {
    return first_negative_[a] != first_negative_[b] ? first_negative_[a] < first_negative_[b] : a < b;
  });
  if (first_negative_[section_.front()] == none) return;  // nothing cuts them
  collect_section(row);
  constexpr std::size_t many = 400;
  if (section_.size() > many)
    for (const Adjacency::Pair& pair : adjacency_.join_simple_rays(threads))
      add_edge(section_[pair.first], section_[pair.second]);
  adjacency_.compare(
      [&](std::uint32_t i) { return first_negative_[section_[i]]; },
      [&](std::uint32_t i, std::uint32_t j) { return !is_zero(section_[j], first_negative_[section_[i]]); },
      [&](std::uint32_t i, std::uint32_t j) {
        edges_[first_negative_[section_[i]]].push_back({section_[j], section_[i]});
      },
      threads);
}

/// Gives adjacency_ the rays of the section with the used rows that they lie on, as the words in which they
/// are, or without rows that no ray lies on if that saves much. Rows that contain the whole section lower its
/// dimension.
void RayGraph::collect_section(std::size_t row) {
  const std::size_t h = section_.size(), words = row / 64 + 1;
  std::vector<std::uint64_t> some(words, 0),
      all(used_.begin(), used_.begin() + static_cast<std::ptrdiff_t>(words));
  std::size_t members = 0;
  for (const RayId ray : section_) {
    const ConstBits zeros = zeros_[ray];
    for (std::size_t w = 0; w < words; ++w) {
      some[w] |= zeros[w];
      all[w] &= zeros[w];
      members += static_cast<std::size_t>(std::popcount(zeros[w] & used_[w]));
    }
  }
  std::vector<std::size_t> containing, columns;
  for_each(all, [&](std::size_t i) { containing.push_back(i); });
  std::vector<std::size_t> parts;
  for (std::size_t w = 0; w < words; ++w) {
    some[w] &= used_[w] & ~all[w];
    if (some[w] != 0) parts.push_back(w);
  }
  for_each(some, [&](std::size_t i) { columns.push_back(i); });
  const std::size_t cone_dimension = dimension_ - rank_of(containing);

  constexpr std::size_t few = 64;
  const double cost_of_words = static_cast<double>(h * h) * static_cast<double>(words) / 16;
  const bool is_sparse = h > few && cost_of_words >= 2 * static_cast<double>(members) &&
                         static_cast<double>(columns.size()) <= 0.8 * 64 * static_cast<double>(words);
  if (!is_sparse) {
    adjacency_.reset(h, 64 * parts.size(), cone_dimension);
    for (std::size_t i = 0; i < h; ++i) {
      const ConstBits zeros = zeros_[section_[i]];
      const Bits rows = adjacency_.rows(i);
      for (std::size_t p = 0; p < parts.size(); ++p) rows[p] = zeros[parts[p]] & some[parts[p]];
    }
    return;
  }
  std::vector<std::uint32_t> number(64 * words, 0);
  for (std::size_t c = 0; c < columns.size(); ++c) number[columns[c]] = static_cast<std::uint32_t>(c);
  adjacency_.reset(h, columns.size(), cone_dimension);
  for (std::size_t i = 0; i < h; ++i) {
    const ConstBits zeros = zeros_[section_[i]];
    const Bits rows = adjacency_.rows(i);
    for (const std::size_t w : parts)
      for (std::uint64_t word = zeros[w] & some[w]; word != 0; word &= word - 1)
        polyhedra::insert(rows, number[64 * w + static_cast<std::size_t>(std::countr_zero(word))]);
  }
}

}  // namespace delone::polyhedra
