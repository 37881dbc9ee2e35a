// SPDX-License-Identifier: BSD-3-Clause
#include "construction/bulk_insertion.hpp"

#include "base/compiled_dimension.hpp"
#include "base/compiler.hpp"
#include "base/parallel.hpp"
#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <new>
#include <numeric>

namespace delone::construction {
namespace {

/// Where several threads share the places of an order, each takes a part at a time.
constexpr std::size_t places_in_part = 16384;

/// Copies those rows whose places in an order are first … last − 1.
void copy_in_order(std::span<const double> rows, std::size_t width, std::span<const Index> order,
                   std::size_t first, std::size_t last, double* to) {
  internal::with_compiled_dimension(width, [&](auto fixed_width) {
    const std::size_t w = fixed_width > 0 ? std::size_t{fixed_width} : width;
    // Rows are met in no order of their own: they are prefetched long before their turn.
    constexpr std::size_t ahead = 96;
    for (std::size_t place = first; place < last; ++place) {
      internal::prefetch(rows.data() + order[std::min(place + ahead, order.size() - 1)] * w);
      std::copy_n(rows.data() + order[place] * w, w, to + (place - first) * w);
    }
  });
}

/// Appends rows in an order to `to`, which has room for them.
void append_in_order(std::span<const double> rows, std::size_t width, std::span<const Index> order,
                     unsigned threads, std::vector<double>& to) {
  if (threads > 1) {
    const std::size_t before = to.size();
    to.resize(before + order.size() * width);
    internal::parallel_for(threads, order.size(), places_in_part, [&](std::size_t first, std::size_t last) {
      internal::cancellation_point();
      copy_in_order(rows, width, order, first, last, to.data() + before + first * width);
    });
    return;
  }
  constexpr std::size_t most_in_block = 64;
  std::vector<double> block(std::min(most_in_block, order.size()) *
                            width);  // in the cache: vectors cannot grow without being written
  for (std::size_t first = 0; first < order.size(); first += most_in_block) {
    internal::cancellation_point();
    const std::size_t count = std::min(most_in_block, order.size() - first);
    copy_in_order(rows, width, order, first, first + count, block.data());
    to.insert(to.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count * width));
  }
}

}  // namespace

BulkInsertion::BulkInsertion(State& state, std::vector<Index> order, std::vector<std::size_t> rounds,
                             bool keeps_slots, double margin, internal::BuildLimits& limits,
                             std::function<void(std::size_t)> tick)
    : state_(state),
      limits_(limits),
      keeps_slots_(keeps_slots),
      margin_(margin),
      order_(std::move(order)),
      rounds_(std::move(rounds)),
      tick_(std::move(tick)),
      first_(state.sites.points().last_vertex() + 1) {}

void BulkInsertion::take(std::span<const double> rows) {
  std::vector<double>& coordinates = state_.sites.points().coordinates;
  coordinates.reserve(coordinates.size() + (order_.size() + 1) * state_.row_size());
  state_.cell_of_vertex.reserve(first_ + order_.size());
  find_spanning(rows);
  const unsigned threads =
      engine::threads_for_batch(state_.options.threads, order_.size(), state_.dimension());
  append_in_order(rows, state_.row_size(), order_, threads, coordinates);
  find_box(threads);
}

/// Puts the rows that raise the affine dimension before all others.
void BulkInsertion::find_spanning(std::span<const double> rows) {
  kernel::AffineHull span = state_.affine_hull;
  for (std::size_t place = 0; place < order_.size() && span.dimension() < state_.dimension(); ++place) {
    if (!span.add(rows.data() + std::size_t{order_[place]} * state_.row_size())) continue;
    const auto first = order_.begin() + static_cast<std::ptrdiff_t>(num_spanning_++),
               found = order_.begin() + static_cast<std::ptrdiff_t>(place);
    std::rotate(first, found, found + 1);
  }
}

/// The grid and the box of all points.
void BulkInsertion::find_box(unsigned threads) {
  const std::size_t width = state_.row_size();
  low_.assign(point_at(0), point_at(0) + width);
  high_ = low_;
  const auto include = [&](std::size_t place) {
    const double* const point = point_at(place);
    state_.sites.points().grid.include(point);
    for (std::size_t j = 0; j < width; ++j) {
      low_[j] = std::min(low_[j], point[j]);
      high_[j] = std::max(high_[j], point[j]);
    }
  };
  if (threads == 1) {
    internal::QuickRounds quick;
    for (std::size_t place = 0; place < order_.size(); ++place) {
      quick();
      include(place);
    }
    return;
  }
  // A point that changes nothing of the grid of those before it in its part is in their box, too.
  std::mutex mutex;
  internal::parallel_for(threads, order_.size(), places_in_part, [&](std::size_t first, std::size_t last) {
    internal::cancellation_point();
    kernel::Grid grid(state_.dimension(), state_.weighted());
    std::vector<std::size_t> decisive;
    for (std::size_t place = first; place < last; ++place) {
      const std::uint64_t before = grid.revision();
      grid.include(point_at(place));
      if (grid.revision() != before) decisive.push_back(place);
    }
    const std::lock_guard lock(mutex);
    std::for_each(decisive.begin(), decisive.end(), include);
  });
}

void BulkInsertion::run() {
  at_.resize(order_.size());
  start();
  if (!state_.engine)
    insert_at_only_vertex();
  else if (num_done_ < order_.size())  // wrapped cells would get their functionals, which nobody may need
    insert_rest();
}

/// The engine that all others are inserted into, if there is one, in a frame of all rows.
void BulkInsertion::start() {
  if (state_.engine && num_spanning_ == 0) {
    const geometry::Frame& frame = frame_of(*state_.engine);
    if (!frame.contains(low_.data()) || !frame.contains(high_.data())) {
      state_.engine->set_frame(state_.frame_with(low_.data(), high_.data(), margin_));
      state_.landmarks.reset();
    }
    state_.engine->begin_batch();
    state_.record->engine_has_log = true;
  } else if (state_.engine) {
    while (num_done_ < num_spanning_) jump();
  } else if (num_spanning_ > 0) {
    seed();
  }
}

/// The vertex of the next place: of a spanning row, so no duplicate.
Index BulkInsertion::next_spanning() {
  const Index v = first_ + static_cast<Index>(num_done_);
  state_.affine_hull.add(state_.sites.point(v));
  at_[num_done_] = v;
  tick_(++num_done_);
  return v;
}

/// Raises the affine dimension of the engine by the point of the next place.
void BulkInsertion::jump() {
  const Index v = next_spanning();
  auto raised = state_.new_engine(state_.affine_hull, state_.frame_with(low_.data(), high_.data(), margin_));
  raised->jump(state_.complex(), v);
  state_.replace_engine(std::move(raised));
}

/// The first simplex, of the spanning rows and the only vertex if there is one.
void BulkInsertion::seed() {
  std::vector<Index> simplex;
  if (state_.affine_hull.dimension() == 0) simplex.push_back(state_.only_vertex());
  while (num_done_ < num_spanning_) simplex.push_back(next_spanning());
  if (state_.affine_hull.dimension() < 1) {
    state_.only_vertex() = simplex.front();
    return;
  }
  state_.replace_engine(
      state_.new_engine(state_.affine_hull, state_.frame_with(low_.data(), high_.data(), margin_)));
  if (!wrap(simplex)) state_.engine->seed(simplex);
}

/// Creates all cells at once, if that costs less. Returns false, and there are none, if not, or if it fails.
bool BulkInsertion::wrap(std::span<const Index> simplex) {
  if (simplex.size() != num_spanning_ || first_ != 1 || !is_worth_wrapping(*state_.engine, order_.size()))
    return false;
  try {
    order_ = merge_duplicates();
  } catch (const std::bad_alloc&) {  // insertion does with less
    return false;
  }
  at_.resize(order_.size());
  const auto tick = [this](double done) {
    tick_(static_cast<std::size_t>(done * static_cast<double>(order_.size())));
  };
  constexpr unsigned most = 64;  // more would find nothing to do
  const unsigned threads = std::min(internal::threads_to_use(state_.options.threads), most);
  limits_.count_items(false);  // but facets
  if (!state_.engine->wrap(threads, tick)) {
    limits_.count_items(true);
    return false;
  }
  std::iota(at_.begin(), at_.end(), first_);
  num_done_ = order_.size();
  threads_ = threads;
  state_.statistics.threads = std::max(state_.statistics.threads, threads);
  return true;
}

/// Moves equal rows together: the first of them stays, in the order of their places, the others are taken out
/// and noted. Returns the rows that stay.
std::vector<Index> BulkInsertion::merge_duplicates() {
  const std::size_t width = state_.row_size();
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
  std::vector<double>& coordinates = state_.sites.points().coordinates;
  const std::size_t num_before = first_ * width;
  for (std::size_t place = 0; place < order_.size(); ++place) {
    if (first[place] != place) {
      duplicates_.emplace_back(order_[place], order_[first[place]]);
      continue;
    }
    std::copy_n(point_at(place), width, coordinates.data() + num_before + distinct.size() * width);
    distinct.push_back(order_[place]);
  }
  coordinates.resize(num_before + num_distinct * width);
  return distinct;
}

/// All points are in one place: the heaviest is the vertex, equal ones are duplicates, lighter ones hidden.
void BulkInsertion::insert_at_only_vertex() {
  for (; num_done_ < order_.size(); tick_(++num_done_)) {
    const Index v = first_ + static_cast<Index>(num_done_);
    const int heavier = state_.compare_with_only_vertex(state_.sites.point(v));
    if (heavier > 0) state_.only_vertex() = v;
    at_[num_done_] = heavier == 0 ? state_.only_vertex() : heavier > 0 ? v : invalid_index;
  }
}

/// Inserts the vertices of all places left. Where several threads could, the ids of cells may tell of timing
/// from then on, however many there are.
void BulkInsertion::insert_rest() {
  const std::size_t begin = num_done_, n = order_.size() - begin;
  if (shares_batches_of(*state_.engine, n) && !(keeps_slots_ && !state_.record->has_other_engine)) {
    state_.ids_tell_of_timing = true;
    threads_ = engine::threads_for_batch(state_.options.threads, n, state_.dimension());
  }
  std::vector<std::size_t> rounds;
  for (const std::size_t end : rounds_)
    if (end > begin) rounds.push_back(end - begin);
  engine::Batch batch{threads_, first_ + static_cast<Index>(begin), std::span(at_).subspan(begin), rounds};
  batch.tick = [&](std::size_t done) { tick_(begin + done); };
  state_.engine->insert_all(batch);
  num_done_ = order_.size();
  state_.statistics.threads = std::max(state_.statistics.threads, threads_);
}

}  // namespace delone::construction
