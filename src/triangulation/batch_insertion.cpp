// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/batch_insertion.hpp"

#include "base/compiled_dimension.hpp"
#include "base/compiler.hpp"
#include "base/large_vector.hpp"
#include "base/parallel.hpp"

#include <algorithm>
#include <new>
#include <numeric>

namespace delone {
namespace {

/// Appends rows in an order to `to`, which has room for them.
void append_in_order(std::span<const double> rows, std::size_t width, std::span<const Index> order,
                     std::vector<double>& to) {
  internal::with_compiled_dimension(width, [&](auto fixed_width) {
    const std::size_t w = fixed_width > 0 ? std::size_t{fixed_width} : width;
    // Rows are met in no order of their own: they are prefetched long before their turn.
    constexpr std::size_t ahead = 96, most_in_block = 64;
    std::vector<double> block(std::min(most_in_block, order.size()) *
                              w);  // in the cache: vectors cannot grow without being written
    for (std::size_t first = 0; first < order.size(); first += most_in_block) {
      const std::size_t count = std::min(most_in_block, order.size() - first);
      for (std::size_t i = 0; i < count; ++i) {
        delone::prefetch(rows.data() + order[std::min(first + i + ahead, order.size() - 1)] * w);
        std::copy_n(rows.data() + order[first + i] * w, w, block.data() + i * w);
      }
      to.insert(to.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count * w));
    }
  });
}

}  // namespace

Triangulation::Impl::BatchInsertion::BatchInsertion(Impl& impl, std::vector<Index> order,
                                                    std::vector<std::size_t> rounds,
                                                    internal::BuildLimits& limits)
    : impl_(impl),
      limits_(limits),
      before_{impl.affine_hull,          impl.points.coordinates.size(), impl.vertex_of_row.size(),
              impl.row_of_vertex.size(), impl.num_rows_inserted,         impl.only_vertex(),
              impl.engine != nullptr,    impl.has_ids_of_threads,        nullptr},
      order_(std::move(order)),
      rounds_(std::move(rounds)),
      progress_(impl.options.progress, order_.size()) {}

Triangulation::Impl::BatchInsertion::~BatchInsertion() {
  if (is_done_) return;
  if (before_.engine)
    impl_.engine = std::move(before_.engine);
  else if (before_.had_engine)
    impl_.engine->undo_batch();
  else
    impl_.engine.reset();
  impl_.affine_hull = std::move(before_.affine_hull);
  impl_.points.coordinates.resize(before_.num_coordinates);
  impl_.vertex_of_row.resize(before_.num_rows);
  impl_.row_of_vertex.resize(before_.num_row_of_vertex);
  impl_.num_rows_inserted = before_.num_rows_inserted;
  impl_.only_vertex() = before_.only_vertex;
  impl_.has_ids_of_threads = before_.had_ids_of_threads;
  internal::shrink_large(impl_.points.coordinates);
  internal::shrink_large(impl_.vertex_of_row);
  internal::shrink_large(impl_.row_of_vertex);
  internal::shrink_large(impl_.cell_of_vertex);
}

void Triangulation::Impl::BatchInsertion::take(std::span<const double> rows) {
  const std::size_t n = order_.size();
  if (n > max_index - before_.num_rows) throw Error(Errc::too_many, "more points than this build has ids");
  impl_.vertex_of_row.reserve(before_.num_rows + n);
  impl_.row_of_vertex.reserve(before_.num_row_of_vertex + n);
  impl_.cell_of_vertex.reserve(before_.num_row_of_vertex + n);
  impl_.points.coordinates.reserve(before_.num_coordinates + rows.size() + impl_.row_size());
  impl_.vertex_of_row.resize(before_.num_rows + n, invalid_vertex);
  spanning_rows_first(rows);
  include(rows);
  append_in_order(rows, impl_.row_size(), order_, impl_.points.coordinates);
}

/// The grid and the box of all rows.
void Triangulation::Impl::BatchInsertion::include(std::span<const double> rows) {
  const std::size_t width = impl_.row_size();
  low_.assign(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(width));
  high_ = low_;
  for (const double* row = rows.data(); row != rows.data() + rows.size(); row += width) {
    impl_.points.grid.include(row);
    for (std::size_t j = 0; j < width; ++j) {
      low_[j] = std::min(low_[j], row[j]);
      high_[j] = std::max(high_[j], row[j]);
    }
  }
}

/// Puts the rows that raise the affine dimension before all others.
void Triangulation::Impl::BatchInsertion::spanning_rows_first(std::span<const double> rows) {
  kernel::AffineHull span = impl_.affine_hull;
  for (std::size_t place = 0; place < order_.size() && span.dimension() < impl_.dimension; ++place) {
    if (!span.add(rows.data() + std::size_t{order_[place]} * impl_.row_size())) continue;
    const auto first = order_.begin() + static_cast<std::ptrdiff_t>(num_spanning_++),
               found = order_.begin() + static_cast<std::ptrdiff_t>(place);
    std::rotate(first, found, found + 1);
  }
}

const double* Triangulation::Impl::BatchInsertion::point_at(std::size_t place) const {
  return impl_.points.coordinates.data() + before_.num_coordinates + place * impl_.row_size();
}

/// The vertex of the next place: of a spanning row, so no duplicate.
Index Triangulation::Impl::BatchInsertion::next_spanning() {
  const auto v = static_cast<Index>(before_.num_coordinates / impl_.row_size() + place_);
  impl_.affine_hull.add(impl_.points.point(v));
  impl_.assign(row(place_++), v);
  return v;
}

void Triangulation::Impl::BatchInsertion::insert_all() {
  start();
  std::vector<Index> at(order_.size() - place_);
  if (!impl_.engine)
    insert_at_only_vertex(at);
  else if (!at.empty())  // wrapped cells would get their functionals, which nobody may need
    insert(at);
  place_in_order(at);
  finish();
}

/// The engine that all others are inserted into, if there is one, in a frame of all rows.
void Triangulation::Impl::BatchInsertion::start() {
  if (impl_.engine && num_spanning_ == 0) {
    const geometry::Frame& frame = impl_.engine->frame();
    if (!frame.contains(low_.data()) || !frame.contains(high_.data())) {
      impl_.engine->set_frame(impl_.frame_with(low_.data(), high_.data(), 0.0));
      impl_.landmarks.reset();
    }
    impl_.engine->begin_batch();
  } else if (impl_.engine) {
    while (place_ < num_spanning_) jump();
    impl_.landmarks.reset();
  } else if (num_spanning_ > 0) {
    seed();
  }
}

/// Raises the affine dimension of the engine by the point of the next place. The first engine of all is kept.
void Triangulation::Impl::BatchInsertion::jump() {
  const Index v = next_spanning();
  auto raised = impl_.new_engine(low_.data(), high_.data(), impl_.engine->effort());
  raised->jump(impl_.complex(), v);
  std::swap(impl_.engine, raised);
  if (!before_.engine) before_.engine = std::move(raised);
}

/// The first simplex, of the spanning rows and the only vertex if there is one.
void Triangulation::Impl::BatchInsertion::seed() {
  std::vector<Index> simplex;
  if (impl_.affine_hull.dimension() == 0) simplex.push_back(impl_.only_vertex());
  while (place_ < num_spanning_) simplex.push_back(next_spanning());
  if (impl_.affine_hull.dimension() < 1) {
    impl_.only_vertex() = simplex.front();
    return;
  }
  impl_.engine = impl_.new_engine(low_.data(), high_.data(), {});
  if (!wrap(simplex)) impl_.engine->seed(simplex);
}

/// Creates all cells at once, if that costs less. Returns false, and no vertex has been added, if not, or if
/// it fails.
bool Triangulation::Impl::BatchInsertion::wrap(std::span<const Index> simplex) {
  if (simplex.size() != num_spanning_ || before_.num_coordinates != impl_.row_size() ||
      !impl_.engine->is_worth_wrapping(order_.size()))
    return false;
  std::vector<Index> distinct;
  try {
    distinct = merge_duplicates();
  } catch (const std::bad_alloc&) {  // insertion does with less
    return false;
  }
  order_ = std::move(distinct);
  const auto tick = [this](double done) {
    progress_(static_cast<std::size_t>(done * static_cast<double>(order_.size())));
  };
  constexpr unsigned most = 64;  // more would find nothing to do
  const unsigned threads = std::min(internal::threads_to_use(impl_.options.threads), most);
  limits_.count_items(false);  // but facets
  if (!impl_.engine->wrap(threads, tick)) {
    limits_.count_items(true);
    return false;
  }
  for (; place_ < order_.size(); ++place_) impl_.assign(row(place_), static_cast<Index>(place_) + 1);
  impl_.statistics.threads = std::max(impl_.statistics.threads, threads);
  return true;
}

/// Moves equal rows together: the first of them stays, in the order of their places, the others are taken out
/// and noted. Returns the rows that stay.
std::vector<Index> Triangulation::Impl::BatchInsertion::merge_duplicates() {
  const std::size_t width = impl_.row_size();
  std::vector<std::size_t> places(order_.size()), first(order_.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    const auto end = point_at(a) + width;
    const auto [x, y] = std::mismatch(point_at(a), end, point_at(b));
    return x != end ? *x < *y : a < b;
  });
  std::size_t num_distinct = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool is_new =
        i == 0 || !std::equal(point_at(places[i]), point_at(places[i]) + width, point_at(places[i - 1]));
    first[places[i]] = is_new ? places[i] : first[places[i - 1]];
    num_distinct += is_new;
  }
  std::vector<Index> distinct;
  distinct.reserve(num_distinct);
  duplicates_.reserve(order_.size() - num_distinct);
  std::vector<double>& coordinates = impl_.points.coordinates;
  for (std::size_t place = 0; place < order_.size(); ++place) {
    if (first[place] != place) {
      duplicates_.emplace_back(order_[place], order_[first[place]]);
      continue;
    }
    std::copy_n(point_at(place), width,
                coordinates.data() + before_.num_coordinates + distinct.size() * width);
    distinct.push_back(order_[place]);
  }
  coordinates.resize(before_.num_coordinates + num_distinct * width);
  return distinct;
}

/// All points are in one place: the heaviest is the vertex, equal ones are duplicates, lighter ones hidden.
void Triangulation::Impl::BatchInsertion::insert_at_only_vertex(std::span<Index> at) {
  auto v = impl_.points.last_vertex() + 1 - static_cast<Index>(at.size());
  for (Index& of_v : at) {
    const int heavier = impl_.compare_with_only_vertex(impl_.points.point(v));
    if (heavier > 0) impl_.only_vertex() = v;
    of_v = heavier == 0 ? impl_.only_vertex() : heavier > 0 ? v : invalid_index;
    progress_(++place_);
    ++v;
  }
  place_ -= at.size();
}

/// Inserts the vertices of all places left.
void Triangulation::Impl::BatchInsertion::insert(std::span<Index> at) {
  const std::size_t begin = place_, n = at.size();
  if (impl_.engine->shares_batches_of(n)) {
    impl_.has_ids_of_threads = true;
    threads_ = engine::threads_for_batch(impl_.options.threads, n, impl_.dimension);
  }
  std::vector<std::size_t> rounds;
  for (const std::size_t end : rounds_)
    if (end > begin) rounds.push_back(end - begin);
  engine::ParallelBatch batch{threads_, impl_.points.last_vertex() + 1 - static_cast<Index>(n), at, rounds};
  batch.tick = [&](std::size_t done) { progress_(begin + done); };
  impl_.engine->insert_all(batch);
  impl_.statistics.threads = std::max(impl_.statistics.threads, threads_);
}

/// Rows of the vertices that have been inserted. at: for each place, the vertex at its point. Of equal
/// points, the first in the order is the vertex; then ids are given again, without gaps.
void Triangulation::Impl::BatchInsertion::place_in_order(std::span<const Index> at) {
  const std::size_t begin = place_, n = at.size();
  VertexPoints& vertices = impl_.points;
  const Index first = vertices.last_vertex() + 1 - static_cast<Index>(n);
  place_ = order_.size();
  const auto is_duplicate = [&](std::size_t i) { return at[i] != first + i && at[i] != invalid_index; };
  std::size_t num_duplicates = 0;
  for (std::size_t i = 0; i < n; ++i) num_duplicates += is_duplicate(i);
  if (num_duplicates == 0) {
    impl_.row_of_vertex.resize(std::size_t{first} + n);
    internal::parallel_for(threads_, n, 16384, [&](std::size_t from, std::size_t to) {
      constexpr std::size_t ahead = 64;  // rows have no order of their own here
      for (std::size_t i = from; i < to; ++i) {
        delone::prefetch_for_writing(impl_.vertex_of_row.data() + row(begin + std::min(i + ahead, n - 1)));
        const Index v = first + static_cast<Index>(i);
        impl_.vertex_of_row[row(begin + i)] = VertexId{v};
        impl_.row_of_vertex[v] = static_cast<Index>(row(begin + i));
      }
    });
    impl_.num_rows_inserted += n;
    return;
  }
  std::vector<Index> new_ids(std::size_t{first} + n, invalid_index);
  std::iota(new_ids.begin(), new_ids.begin() + static_cast<std::ptrdiff_t>(first), Index{0});
  Index next = first;
  for (std::size_t i = 0; i < n; ++i) {
    Index& id = new_ids[is_duplicate(i) ? at[i] : first + i];
    if (id == invalid_index) {
      id = next++;
      double* const to = vertices.coordinates.data() + std::size_t{id} * vertices.row_size();
      if (to != vertices.point(first + static_cast<Index>(i)))
        std::copy_n(vertices.point(first + static_cast<Index>(i)), vertices.row_size(), to);
    }
    impl_.assign(row(begin + i), id);
  }
  vertices.coordinates.resize(std::size_t{next} * vertices.row_size());
  if (impl_.engine)
    impl_.engine->renumber_vertices(new_ids);
  else
    impl_.only_vertex() = new_ids[impl_.only_vertex()];
}

/// Nothing of it throws.
void Triangulation::Impl::BatchInsertion::finish() {
  for (const auto& [row, first] : duplicates_)
    impl_.assign(before_.num_rows + row, index(impl_.vertex_of_row[before_.num_rows + first]));
  const Index last = impl_.points.last_vertex();
  if (impl_.engine) impl_.engine->keep_batch();
  is_done_ = true;
  before_.engine.reset();
  order_ = {};
  impl_.find_cells_of_vertices();
  const auto before = static_cast<Index>(before_.num_coordinates / impl_.row_size()) - 1;
  if (impl_.landmarks) impl_.add_landmarks(before + 1, last);
}

}  // namespace delone
