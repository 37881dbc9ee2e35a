// SPDX-License-Identifier: BSD-3-Clause
// How far insertion by several threads would go with more cores than there are: logical workers take turns in
// one thread, in the order of clocks of their own. A worker holds what it has claimed until its clock has
// passed the end of its insertion, so that others clash with it as they would if they ran at once. The engine
// is unchanged. What cores share (caches, memory bandwidth, clock rate) is left out.
//
// Counters: `put_off`, attempts that clashed, per vertex; `insertions`, the time of the turns that inserted a
// vertex divided by the critical path, which is the sum over all rounds of the time of the worker that ends
// last; `serial`, the share of one thread's time in the library that is not insertion; `whole`, the speed-up
// if none of that part were shared.
#include "clocks.hpp"
#include "engine_run.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <utility>
#include <vector>

namespace {

/// What the turns of all workers came to.
struct Turns {
  double inserting = 0, critical_path = 0;  // seconds
  std::size_t inserted = 0, put_off = 0;
};

/// A schedule (engine/parallel_insertion.hpp): the worker whose clock is behind all others takes its turn.
class ByClocks {
 public:
  explicit ByClocks(Turns& turns) : turns_(turns) {}

  template <class TakeTurn>
  void operator()(unsigned n, TakeTurn step) const {
    using Entry = std::pair<double, unsigned>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> clocks;
    for (unsigned w = 0; w < n; ++w) clocks.emplace(0.0, w);
    double last = 0;
    while (!clocks.empty()) {
      const auto [clock, w] = clocks.top();
      clocks.pop();
      const double start = benchmarks::thread_seconds();
      const delone::engine::Step done = step(w);
      const double seconds = benchmarks::thread_seconds() - start - look_;
      if (done == delone::engine::Step::inserted) turns_.inserting += seconds;
      last = std::max(last, clock + seconds);
      turns_.inserted += done == delone::engine::Step::inserted;
      turns_.put_off += done == delone::engine::Step::put_off;
      if (done != delone::engine::Step::ended) clocks.emplace(clock + seconds, w);
    }
    turns_.critical_path += last;
  }

 private:
  /// The time between two readings with nothing in between.
  static double cost_of_looking() {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 1000; ++i) {
      const double start = benchmarks::thread_seconds();
      least = std::min(least, benchmarks::thread_seconds() - start);
    }
    return least;
  }

  Turns& turns_;
  double look_ = cost_of_looking();
};

template <int K>
Turns turns_of(delone::PointsView points, unsigned workers) {
  Turns turns;
  benchmarks::Observer observer;
  benchmarks::EngineRun<K, benchmarks::Observer>(points, observer).insert_by(workers, ByClocks(turns));
  return turns;
}

/// Arguments: number of points, number of workers.
template <int K>
void workers(benchmark::State& state, const char* kind) {
  const std::vector<double> coordinates =
      delone::make_point_set(kind, K, static_cast<std::size_t>(state.range(0)), 1);
  const delone::PointsView points(coordinates, K);
  for (auto _ : state) {
    const auto clock_start = std::chrono::steady_clock::now();
    const double build_seconds = delone::Delaunay<>(coordinates, K).statistics().build_seconds;
    const std::chrono::duration<double> by_clock = std::chrono::steady_clock::now() - clock_start;
    const double serial = 1 - build_seconds / by_clock.count();
    const Turns turns = turns_of<K>(points, static_cast<unsigned>(state.range(1)));
    const double insertions = turns.inserting / turns.critical_path;
    state.counters["put_off"] = static_cast<double>(turns.put_off) / static_cast<double>(turns.inserted);
    state.counters["insertions"] = insertions;
    state.counters["serial"] = serial;
    state.counters["whole"] = 1 / (serial + (1 - serial) / insertions);
  }
}

template <int K>
void add(const char* kind, std::int64_t n) {
  auto* const benchmark = benchmark::RegisterBenchmark(
      ("workers/" + std::string(kind) + std::to_string(K) + "D").c_str(), workers<K>, kind);
  for (const std::int64_t count : {2, 4, 8, 16, 64}) benchmark->Args({n, count});
  benchmark->Iterations(1);
}

}  // namespace

int main(int argc, char** argv) {
  add<2>("uniform", 1'000'000);
  add<3>("uniform", 1'000'000);
  add<4>("uniform", 100'000);
  add<5>("uniform", 10'000);
  add<6>("uniform", 4'000);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
