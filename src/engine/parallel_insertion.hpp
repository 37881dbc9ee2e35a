// SPDX-License-Identifier: BSD-3-Clause
// Insertion by several threads at once (docs/decisions/0015-insertions-claim-their-cells.md).
//
// Each worker inserts a stretch of its own of the order, far from the others. It claims every cell before it
// reads it (claims.hpp): those that its walk passes, the zone, and the survivors around it. Nothing is
// written before all are claimed, so where another worker is in the way, the vertex is simply put off. The
// conflict zone of a vertex is a function of what was inserted before; the triangulation at the end is a
// function of the set of points, whatever the order, so the result is that of one thread.
//
// Cells do not move while workers are at work. When memory for them runs out, all workers end their
// insertions, it grows, and they go on.
#pragma once

#include "base/parallel.hpp"
#include "cells/cell_memory.hpp"
#include "engine/batch.hpp"
#include "engine/cell_store.hpp"
#include "engine/claimed_cells.hpp"
#include "engine/claims.hpp"
#include "engine/locate.hpp"
#include "engine/retriangulate.hpp"
#include "engine/undo_log.hpp"
#include "engine/work_ranges.hpp"
#include "engine/workspace.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <thread>
#include <utility>
#include <vector>

namespace delone::engine {

/// Cells of so many dimensions may be shared, if the geometry can be copied for a thread.
constexpr bool is_shareable(int k) { return k >= 2 && k <= 6; }
template <int K, class G>
constexpr bool is_shared = is_shareable(K) && requires {
  typename G::ForThread;
};

/// So few vertices have too few cells for several threads …
constexpr std::size_t few_vertices_of(int k) {
  return k <= 4 ? 16 * static_cast<std::size_t>(k) : k == 5 ? 150 : 200;
}
template <int K>
constexpr std::size_t few_vertices = few_vertices_of(K);
/// … unless there are as many cells as so many vertices have if they are spread evenly.
template <int K>
constexpr std::size_t many_cells = K == 2   ? 64
                                   : K == 3 ? 300
                                   : K == 4 ? 1600
                                   : K == 5 ? 12000
                                            : 60000;

/// The slots that no worker has yet: each takes many at a time.
template <int K>
class SharedSlots {
 public:
  /// Thrown where memory has to grow first.
  struct Exhausted {};

  SharedSlots(CellMemory<K>& memory, ClaimTable& claims, Index first)
      : memory_(memory), claims_(claims), next_(first) {}

  std::pair<Index, Index> take(std::size_t least, unsigned worker) {
    std::unique_lock lock(mutex_);
    const std::size_t count = std::max(least, at_a_time), left = memory_.capacity() - next_;
    if (left < least) {
      needed_ = std::max(needed_, next_ + least);
      throw Exhausted();
    }
    const Index first = next_, last = static_cast<Index>(first + std::min(count, left));
    next_ = last;
    const std::size_t ahead = std::min(last + prepared_ahead, memory_.capacity());
    const bool prepares = ahead > prepared_ && !is_preparing_;
    if (prepares) {
      is_preparing_ = true;
      prepared_ = std::min(ahead + prepared_ahead, memory_.capacity());
    }
    lock.unlock();
    if (prepares) {  // others need not wait for it
      memory_.prepare(prepared_);
      is_preparing_.store(false, std::memory_order_release);
    }
    claims_.keep(first, last, worker);
    return {first, last};
  }
  /// Makes room for half as many slots again. No worker may be at work. Throws as CellStore::reserve() does.
  void grow() {
    if (needed_ > max_index)
      throw Error(Errc::too_many, "the triangulation has more cells than this build has ids");
    const std::size_t slots =
        std::min<std::size_t>(std::max(needed_, memory_.capacity() + memory_.capacity() / 2), max_index);
    memory_.reserve(slots);
    claims_.cover(memory_);
  }
  Index num_slots() const { return next_; }

 private:
  static constexpr std::size_t at_a_time = 1024;
  /// Pages of so many cells are fetched before they are needed.
  static constexpr std::size_t prepared_ahead = 16384;

  CellMemory<K>& memory_;
  ClaimTable& claims_;
  std::mutex mutex_;
  Index next_;
  std::size_t needed_ = 0, prepared_ = 0;
  std::atomic<bool> is_preparing_ = false;
};

/// One of the threads that insert.
template <int K, class G>
class alignas(128) Worker final : public SlotSource {
 public:
  /// What all workers share.
  struct Shared {
    CellMemory<K>& memory;
    SharedSlots<K>& slots;
    ClaimTable& claims;
    UndoLog<K>* log;  ///< null if nothing has to be undone
    std::mutex log_mutex;
  };
  enum class Outcome { done, put_off, needs_memory };

  Worker(Shared& shared, const G& geometry, unsigned number)
      : shared_(shared),
        number_(number),
        cells_(shared.memory, *this),
        geometry_(geometry, typename G::ForThread()),
        claims_(shared.claims, number, shares_survivors(K)) {
    work_.shares_survivors = shares_survivors(K);
    work_.cells_have_marks = false;
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  std::pair<Index, Index> take(std::size_t least) override { return shared_.slots.take(least, number_); }

  /// A cell to start from; the latest is tried first.
  void add_start(Index cell) { starts_[num_starts_++ % starts_.size()] = cell; }

  /// Inserts vertex number i of a batch, or changes nothing. What the insertion claims is held until the next
  /// one, or release().
  Outcome insert(const Batch& batch, std::size_t i) {
    end_last();
    const Index v = batch.vertex(i);
    Index& at = batch.at[i];
    const typename G::Query q = geometry_.query_at(v);
    const ClaimedCells<K> cells(cells_, claims_);
    try {
      const Index start = take_start(q);
      work_.clear();
      if (start == invalid_index) return Outcome::put_off;
      const WalkResult found = locate(cells, geometry_, q, start, effort_.stages);
      effort_.visited_cells += found.visited;
      at = found.vertex;
      if (found.vertex != invalid_index || found.hidden) {
        batch.note_strictly(i, found.strictly);
        add_start(found.cell);
        return Outcome::done;
      }
      find_conflict_zone(cells, geometry_, q, found.cell, claims_.marks(), work_.zone, effort_.stages);
      note_dying();
      const Filling made = retriangulate(cells_, geometry_, v, q, work_);
      effort_.created_cells += made.num_cells;
      num_more_infinite_ +=
          static_cast<std::int64_t>(made.num_infinite) - static_cast<std::int64_t>(work_.zone.num_infinite);
      at = v;
      batch.note_strictly(i, false);
    } catch (const Clash&) {
      abandon();
      return Outcome::put_off;
    } catch (const typename SharedSlots<K>::Exhausted&) {
      abandon();
      return Outcome::needs_memory;
    } catch (...) {
      abandon();
      throw;
    }
    has_star_ = true;
    add_start(work_.star().back().created);
    return Outcome::done;
  }

  /// Gives up all cells.
  void release() {
    end_last();
    if (std::exchange(has_star_, false)) release_star_but(invalid_index);
  }

  CellStore<K>& cells() { return cells_; }
  Claims& claims() { return claims_; }
  const Effort& effort() const { return effort_; }
  std::int64_t num_more_infinite() const { return num_more_infinite_; }
  /// Counts an insertion; another thread may ask how many there were.
  void count_done() {
    num_done_.store(num_done_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  std::size_t num_done() const { return num_done_.load(std::memory_order_relaxed); }

 private:
  /// Gives up what the last insertion has claimed, but for its star. Slots of the zone have cells of the star
  /// now, or are vacant.
  void end_last() { claims_.give_up_and_keep_zone(); }
  /// A cell that is held, to walk to q from: of the last star, which is given up but for it; or a start that
  /// no other worker has. None, perhaps.
  Index take_start(const typename G::Query& q) {
    if (has_star_) {
      const Index best = start_in_star(geometry_, q, work_.star());
      claims_.hold_kept(best);
      has_star_ = false;
      release_star_but(best);
      return best;
    }
    for (std::size_t i = 0; i < std::min(num_starts_, starts_.size()); ++i) {
      const Index cell = starts_[(num_starts_ - 1 - i) % starts_.size()];
      if (claims_.try_claim(cell)) return cell;
    }
    // Anywhere: it does not happen often.
    for (int attempt = 0; attempt < 64; ++attempt) {
      random_ = random_ * 6364136223846793005u + 1442695040888963407u + number_;
      const auto cell = static_cast<Index>((random_ >> 33) % num_known_slots_);
      if (claims_.try_claim(cell)) return cell;
    }
    return invalid_index;
  }
  void release_star_but(Index cell) {
    const std::span<const HorizonFacet> star = work_.star();
    claims_.release_kept(
        star.size(), [star](std::size_t f) { return star[f].created; }, cell);
  }
  void note_dying() {
    if (shared_.log == nullptr) return;
    const std::lock_guard lock(shared_.log_mutex);
    shared_.log->note(cells_, {work_.zone.cells.data(), work_.zone.num_cells});
  }
  void abandon() {
    claims_.give_up();
    work_.clear();
  }

 public:
  /// Slots before this one may be asked for whether they are cells.
  void set_known_slots(Index count) { num_known_slots_ = count; }

 private:
  Shared& shared_;
  unsigned number_;
  CellStore<K> cells_;
  G geometry_;
  Claims claims_;
  Workspace work_;
  Effort effort_;
  std::int64_t num_more_infinite_ = 0;
  bool has_star_ = false;
  std::array<Index, 16> starts_{};
  std::size_t num_starts_ = 0;
  Index num_known_slots_ = 0;
  std::atomic<std::size_t> num_done_ = 0;
  std::uint64_t random_ = 0x9e3779b97f4a7c15u;
};

/// What a worker has done in its turn; ended: nothing, and there is nothing left that it could.
enum class Step { inserted, put_off, ended };

/// Each worker has a thread, and takes its turns there. A schedule calls step(w) for each of n workers w
/// until it returns Step::ended.
struct WorkersInThreads {
  template <class TakeTurn>
  void operator()(unsigned n, TakeTurn step) const {
    internal::run_workers(n, [&](unsigned w) {
      while (step(w) != Step::ended) {
      }
    });
  }
};

/// What insertions change: a sphere that has cells. `log`: null if nothing has to be undone.
template <int K, class G>
struct InsertionParts {
  CellMemory<K>& memory;
  CellStore<K>& cells;
  G& geometry;
  UndoLog<K>* log;
  Effort& effort;
  Index& num_infinite;
  Index& last_cell;
};

/// A batch, from when there are enough cells for several workers.
template <int K, class G, class Schedule = WorkersInThreads>
class ParallelInsertion {
 public:
  ParallelInsertion(InsertionParts<K, G> parts, const Batch& batch, Schedule schedule = {})
      : parts_(parts),
        schedule_(std::move(schedule)),
        batch_(batch),
        claims_(std::min(batch.threads, ClaimTable::most_workers)),
        slots_(parts.memory, claims_, parts.cells.num_slots()),
        shared_{parts.memory, slots_, claims_, parts.log, {}},
        ranges_(claims_.num_workers()),
        stretches_(claims_.num_workers()) {}

  /// Inserts the vertices of the batch from number `begin` on. After an exception the cells are of no use,
  /// unless they are undone.
  void insert_from(std::size_t begin) {
    num_before_ = begin;
    prepare();
    for (const std::size_t end : batch_.rounds) {
      if (end <= begin) continue;
      insert_round(begin, std::min(end, batch_.at.size()));
      begin = end;
    }
    if (begin < batch_.at.size()) insert_round(begin, batch_.at.size());
    finish();
  }

 private:
  using W = Worker<K, G>;
  using Outcome = typename W::Outcome;

  void prepare() {
    const Index last = batch_.last_vertex();
    parts_.cells.admit_vertices(last);
    parts_.geometry.prepare_rows(last);
    internal::parallel_for(batch_.threads, batch_.at.size(), 4096, [&](std::size_t first, std::size_t end) {
      if (batch_.steps.empty())
        parts_.geometry.write_rows(batch_.vertex(first), batch_.vertex(end - 1));
      else
        for (std::size_t i = first; i < end; ++i)
          parts_.geometry.write_rows(batch_.vertex(i), batch_.vertex(i));
    });
    reserve_slots();
    claims_.cover(parts_.memory);
    internal::parallel_for(batch_.threads, parts_.cells.num_slots(), 65536,
                           [&](std::size_t first, std::size_t end) { claims_.clear(first, end); });
    for (unsigned w = 0; w < claims_.num_workers(); ++w) {
      workers_.push_back(std::make_unique<W>(shared_, parts_.geometry, w));
      workers_.back()->add_start(parts_.last_cell);
    }
    // Vacant slots are the first worker's.
    for (const Index slot : parts_.cells.vacant()) workers_.front()->claims().keep(slot);
    workers_.front()->cells().reserve_vacancies(parts_.cells.num_vacant());
    workers_.front()->cells().take_vacant(parts_.cells, 0);
  }

  /// Makes room for as many cells as there will be if vertices get as many as they have now, and some more.
  /// Without, memory grows several times.
  void reserve_slots() {
    const std::size_t now = parts_.cells.num_slots(), before = batch_.vertices_before();
    const std::size_t n = before + batch_.at.size(), per_vertex = now / (before + num_before_) + 1;
    try {
      parts_.memory.reserve(
          std::min<std::size_t>(max_index, std::max(now, per_vertex * n + n / 2 * per_vertex)));
    } catch (const std::bad_alloc&) {
    }
  }

  void insert_round(std::size_t begin, std::size_t end) {
    ranges_.assign(begin, end);
    do {
      needs_memory_ = false;
      for (Stretch& stretch : stretches_) stretch.begin();
      for (auto& worker : workers_) worker->set_known_slots(slots_.num_slots());
      schedule_(claims_.num_workers(), [&](unsigned w) { return step(w); });
      if (needs_memory_) slots_.grow();
    } while (needs_memory_);
    // What has always been in the way of others.
    for (Stretch& stretch : stretches_) {
      for (const std::size_t i : stretch.put_off) insert_alone(i);
      stretch.put_off.clear();
    }
  }

  /// What a worker has to do, besides its range. It is written at each insertion, so it has cache lines of
  /// its own.
  struct alignas(128) Stretch {
    std::vector<std::size_t> put_off;  // numbers in the batch
    std::size_t next = 0;              // of those in put_off; the ones before have been tried again
    std::size_t since_last_clash = 0, failures = 0, since_tick = 0;

    void begin() { since_last_clash = failures = 0; }
    bool has_put_off() const { return next < put_off.size(); }
    void end() {
      put_off.erase(put_off.begin(), put_off.begin() + static_cast<std::ptrdiff_t>(std::exchange(next, 0)));
    }
  };

  /// A worker tries to insert one vertex.
  Step step(unsigned w) {
    W& worker = *workers_[w];
    try {
      const Step done = try_next(worker, w);
      if (done != Step::ended) return done;
    } catch (...) {
      failed_.store(true, std::memory_order_relaxed);
      worker.release();
      throw;
    }
    worker.release();
    stretches_[w].end();
    return Step::ended;
  }

  Step try_next(W& worker, unsigned w) {
    Stretch& stretch = stretches_[w];
    if (needs_memory_.load(std::memory_order_relaxed) || failed_.load(std::memory_order_relaxed))
      return Step::ended;
    std::size_t i;
    const bool may_retry = stretch.has_put_off(), is_time = stretch.since_last_clash >= 2;
    bool is_retry = may_retry && is_time;
    if (!is_retry && !ranges_.next(w, i)) {
      if (!may_retry || stretch.failures > most_failures) return Step::ended;
      is_retry = true;
      std::this_thread::yield();
    }
    if (is_retry) i = stretch.put_off[stretch.next++];
    const Outcome outcome = worker.insert(batch_, i);
    if (outcome == Outcome::done) {
      ++stretch.since_last_clash;
      stretch.failures = 0;
      worker.count_done();
      if (std::this_thread::get_id() == caller_ && ++stretch.since_tick == insertions_per_tick) {
        stretch.since_tick = 0;
        batch_.tick(num_done());
      }
      return Step::inserted;
    }
    stretch.put_off.push_back(i);
    stretch.since_last_clash = 0;
    ++stretch.failures;
    if (outcome == Outcome::needs_memory) needs_memory_.store(true, std::memory_order_relaxed);
    return Step::put_off;
  }

  void insert_alone(std::size_t i) {
    W& worker = *workers_.front();
    for (;;) {
      const Outcome outcome = worker.insert(batch_, i);
      if (outcome == Outcome::done) break;
      if (outcome == Outcome::needs_memory) slots_.grow();
    }
    worker.release();
    worker.count_done();
    batch_.tick(num_done());
  }

  std::size_t num_done() const {
    std::size_t sum = num_before_;
    for (const auto& worker : workers_) sum += worker->num_done();
    return sum;
  }

  /// All vacant slots go back to the one store.
  void finish() {
    std::size_t num_vacant = 0;
    for (const auto& worker : workers_) num_vacant += worker->cells().num_vacant();
    parts_.cells.reserve_vacancies(num_vacant);
    for (const auto& worker : workers_) {
      parts_.cells.take_vacant(worker->cells(), slots_.num_slots());
      const Effort& effort = worker->effort();
      parts_.effort.created_cells += effort.created_cells;
      parts_.effort.visited_cells += effort.visited_cells;
      parts_.effort.stages += effort.stages;
      parts_.num_infinite += static_cast<Index>(worker->num_more_infinite());
    }
    parts_.last_cell = 0;
    while (parts_.cells.is_vacant(parts_.last_cell)) ++parts_.last_cell;
  }

  static constexpr std::size_t insertions_per_tick = 16;
  /// After so many clashes in a row, when all else is done, a worker leaves what it has put off to the end.
  static constexpr std::size_t most_failures = 64;

  InsertionParts<K, G> parts_;
  Schedule schedule_;
  const Batch& batch_;
  ClaimTable claims_;
  SharedSlots<K> slots_;
  typename W::Shared shared_;
  WorkRanges ranges_;
  std::vector<Stretch> stretches_;
  std::vector<std::unique_ptr<W>> workers_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::size_t num_before_ = 0;  // vertices of the batch that one thread has inserted
  alignas(128) std::atomic<bool> needs_memory_ = false;
  std::atomic<bool> failed_ = false;
};

}  // namespace delone::engine
