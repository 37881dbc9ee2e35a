// SPDX-License-Identifier: BSD-3-Clause
#include "sites/site_set.hpp"

#include "base/compiler.hpp"
#include "base/large_vector.hpp"
#include "base/parallel.hpp"
#include "base/reserve_one_more.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <new>

namespace delone::sites {

void SiteSet::reserve(std::size_t more) {
  vertex_of_row_.reserve(vertex_of_row_.size() + more);
  row_of_vertex_.reserve(row_of_vertex_.size() + more);
  points_.coordinates.reserve(points_.coordinates.size() + (more + 1) * points_.row_size());
}

void SiteSet::reserve_one_more() {
  internal::reserve_one_more(vertex_of_row_);
  internal::reserve_one_more(row_of_vertex_);
}

std::size_t SiteSet::add_rows(std::size_t count) {
  const std::size_t first = vertex_of_row_.size();
  if (count > max_index - first) throw Error(Errc::too_many, "more points than this build has ids");
  vertex_of_row_.resize(first + count, invalid_vertex);
  return first;
}

void SiteSet::assign(std::size_t row, Index v) {
  const auto r = static_cast<Index>(row);
  if (v >= row_of_vertex_.size()) row_of_vertex_.resize(std::size_t{v} + 1, invalid_index);
  Index& first = row_of_vertex_[v];
  if (is_noted(row)) internal::reserve_one_more(journal_->rows);
  if (shared_rows_ && first != invalid_index) shared_rows_->add(v, std::max(first, r));
  if (is_noted(row)) journal_->rows.push_back({row, invalid_vertex, VertexId{v}, invalid_index, first});
  first = std::min(first, r);
  vertex_of_row_[row] = VertexId{v};
  ++num_present_rows_;
}

void SiteSet::assign_in_order(std::span<const Index> rows, std::size_t first_row, Index first,
                              unsigned threads) {
  forget_shared_rows();
  const std::size_t n = rows.size();
  row_of_vertex_.resize(std::size_t{first} + n, invalid_index);
  internal::parallel_for(threads, n, 16384, [&](std::size_t from, std::size_t to) {
    constexpr std::size_t ahead = 64;  // rows have no order of their own here
    for (std::size_t i = from; i < to; ++i) {
      internal::prefetch_for_writing(vertex_of_row_.data() + first_row + rows[std::min(i + ahead, n - 1)]);
      const Index v = first + static_cast<Index>(i);
      vertex_of_row_[first_row + rows[i]] = VertexId{v};
      row_of_vertex_[v] = static_cast<Index>(first_row) + rows[i];
    }
  });
  num_present_rows_ += n;
}

void SiteSet::detach(std::size_t row) {
  const VertexId v = vertex_of_row_[row];
  Index& first = row_of_vertex_[index(v)];
  SharedRows& shared = shared_rows();
  if (is_noted(row)) journal_->rows.push_back({row, v, invalid_vertex, first, invalid_index});
  Index next = invalid_index;  // the one to be taken out of the others
  if (first != row)
    next = static_cast<Index>(row);
  else if (shared.has_several(index(v)))
    next = shared.others(index(v)).front();
  if (first == row) first = next;
  if (next != invalid_index) shared.remove(index(v), next);
  vertex_of_row_[row] = invalid_vertex;
  --num_present_rows_;
}

void SiteSet::merge(Index v, Index into) {
  while (has_rows(v)) {
    const std::size_t row = row_of(v);
    detach(row);
    assign(row, into);
  }
}

void SiteSet::shrink_to_fit() {
  points_.coordinates.shrink_to_fit();
  row_of_vertex_.shrink_to_fit();
  vertex_of_row_.shrink_to_fit();
}

void SiteSet::begin(Journal& journal) {
  journal.num_coordinates = points_.coordinates.size();
  journal.num_rows = num_rows();
  journal.num_present_rows = num_present_rows_;
  journal.num_ids = num_ids();
  journal_ = &journal;
}

void SiteSet::note_point(Index v) {
  journal_->points.insert(journal_->points.end(), point(v), point(v) + points_.row_size());
  journal_->moved.push_back(v);
}

void SiteSet::restore_points(Journal& journal, std::size_t first) noexcept {
  const std::size_t size = points_.row_size();
  for (std::size_t i = journal.moved.size(); i-- > first;)
    std::copy_n(journal.points.begin() + static_cast<std::ptrdiff_t>(i * size), size,
                points_.coordinates.begin() + static_cast<std::ptrdiff_t>(journal.moved[i] * size));
}

void SiteSet::roll_back(Journal& journal) noexcept {
  journal_ = nullptr;
  const auto detach_if_known = [&](std::size_t row) {
    if (shared_rows_ && vertex_of_row_[row] != invalid_vertex) detach(row);
  };
  const auto or_forget = [&](auto&& change) {
    try {
      change();
    } catch (const std::bad_alloc&) {
      forget_shared_rows();
    }
  };
  for (std::size_t row = num_rows(); row-- > journal.num_rows;) or_forget([&] { detach_if_known(row); });
  for (std::size_t i = journal.rows.size(); i-- > 0;) {
    const Journal::MovedRow& moved = journal.rows[i];
    or_forget([&] {
      detach_if_known(moved.row);
      if (shared_rows_ && moved.before != invalid_vertex) assign(moved.row, index(moved.before));
    });
    vertex_of_row_[moved.row] = moved.before;
    if (moved.before != invalid_vertex) row_of_vertex_[index(moved.before)] = moved.first_of_before;
    if (moved.after != invalid_vertex) row_of_vertex_[index(moved.after)] = moved.first_of_after;
  }
  vertex_of_row_.resize(journal.num_rows);
  row_of_vertex_.resize(journal.num_ids);
  num_present_rows_ = journal.num_present_rows;
  restore_points(journal, 0);
  points_.coordinates.resize(journal.num_coordinates);
  internal::shrink_large(points_.coordinates);
  internal::shrink_large(vertex_of_row_);
  internal::shrink_large(row_of_vertex_);
}

}  // namespace delone::sites
