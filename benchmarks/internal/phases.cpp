// SPDX-License-Identifier: BSD-3-Clause
// Where the time per created cell goes: order, walk, search of the conflict zone, creation (slots and
// mirrors; functionals), gluing, page faults, and the rest of the library.
//
// Some insertions are timed phase by phase. Insertions of microseconds are timed by the monotonic clock, and
// do not count if the thread was interrupted. Longer ones are timed by the processor time of the thread,
// which a busy machine disturbs little. Insertions with page faults never count, so that these are not
// counted twice. The cost of reading the clock is measured and subtracted. The whole is the processor time in
// which the library builds the same triangulation unobserved; the rest is the whole less all phases.
#include "clocks.hpp"
#include "engine_run.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <limits>
#include <optional>
#include <string>

namespace {

using benchmarks::ThreadUsage;

enum Phase : std::size_t { walk, search, slots, functionals, gluing, num_phases };
constexpr std::array<const char*, num_phases> phase_names{"walk", "search", "slots", "functionals", "gluing"};

/// A clock of the system, in nanoseconds.
class Clock {
 public:
  explicit Clock(clockid_t id) : id_(id) {}
  double now() const {
    timespec time{};
    clock_gettime(id_, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
  }
  bool stops_for_others() const { return id_ == CLOCK_THREAD_CPUTIME_ID; }
  /// The time between two readings with nothing in between.
  double cost() const {
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 100; ++round) {
      constexpr int looks = 100;
      const double start = now();
      for (int i = 1; i < looks; ++i) benchmark::DoNotOptimize(now());
      least = std::min(least, (now() - start) / looks);
    }
    return least;
  }

 private:
  clockid_t id_;
};

/// Times every stride-th insertion.
class Stopwatch : public benchmarks::Observer {
 public:
  Stopwatch(Clock clock, std::uint64_t stride) : clock_(clock), look_(clock.cost()), stride_(stride) {}

  void begins(int evaluators) {
    timing_ = ++insertions_ % stride_ == 0;
    if (!timing_) return;
    evaluators_ = -evaluators;
    spent_.fill(0);
    before_ = ThreadUsage::now();
    last_ = clock_.now();
  }
  void evaluates() {
    if (timing_ && ++evaluators_ == 1) ends_phase(walk);
  }
  void reserves() { ends_phase(search); }
  // These two in turn, once for each block of cells and once more for each cell that needs elimination.
  void creates() { ends_phase(slots); }
  void created() { ends_phase(functionals); }
  void ends(const delone::engine::Workspace& work) {
    if (!timing_) return;
    ends_phase(gluing);
    timing_ = false;
    const ThreadUsage during = ThreadUsage::now() - before_;
    ++seen_;
    if (during.fresh_pages > 0 || (during.interruptions > 0 && !clock_.stops_for_others())) return;
    ++kept_;
    created_ += work.zone.num_facets;
    for (std::size_t phase = 0; phase < num_phases; ++phase) ns_[phase] += spent_[phase];
  }

  /// Nanoseconds per created cell.
  double operator[](Phase phase) const { return ns_[phase] / static_cast<double>(created_); }
  double kept() const { return static_cast<double>(kept_) / static_cast<double>(seen_); }

 private:
  void ends_phase(Phase phase) {
    if (!timing_) return;
    const double now = clock_.now();
    spent_[phase] += now - last_ - look_;
    last_ = now;
  }

  Clock clock_;
  double look_;
  std::uint64_t stride_;
  bool timing_ = false;
  int evaluators_ = 0;
  std::uint64_t insertions_ = 0, seen_ = 0, kept_ = 0, created_ = 0;
  ThreadUsage before_;
  double last_ = 0;
  std::array<double, num_phases> spent_{}, ns_{};  // by the insertion that is timed, and by all that count
};

template <int K>
void phases(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<double> coordinates = delone::make_point_set("uniform", K, n, 1);
  const delone::PointsView points(coordinates, K);
  constexpr double never = std::numeric_limits<double>::infinity();
  std::array<double, num_phases> best;
  best.fill(never);
  double user = never, system = never, order = never, kept = 0, created = 0;
  for (auto _ : state) {
    const ThreadUsage start = ThreadUsage::now();
    std::optional<delone::Delaunay<>> triangulation(std::in_place, coordinates, K);
    const ThreadUsage whole = ThreadUsage::now() - start;
    created = static_cast<double>(triangulation->statistics().created_cells);
    triangulation.reset();
    user = std::min(user, whole.user);
    system = std::min(system, whole.system);

    const double before_order = benchmarks::thread_seconds();
    benchmark::DoNotOptimize(delone::order::automatic_order(points, 0));
    order = std::min(order, benchmarks::thread_seconds() - before_order);

    Stopwatch watch(Clock(K <= 3 ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID),
                    std::max<std::uint64_t>(n / 50'000, 1));
    benchmarks::EngineRun<K, Stopwatch> run(points, watch);
    run.insert_all();
    for (std::size_t phase = 0; phase < num_phases; ++phase)
      best[phase] = std::min(best[phase], watch[static_cast<Phase>(phase)]);
    kept = std::max(kept, watch.kept());
  }
  const double whole = 1e9 * (user + system) / created;
  double told = 1e9 * (order + system) / created;
  for (std::size_t phase = 0; phase < num_phases; ++phase) {
    state.counters[phase_names[phase]] = best[phase];
    told += best[phase];
  }
  state.counters["order"] = 1e9 * order / created;
  state.counters["pages"] = 1e9 * system / created;
  state.counters["rest"] = whole - told;
  state.counters["whole"] = whole;
  state.counters["kept"] = kept;
  state.counters["created"] = created;
  state.counters["created_per_insertion"] = created / static_cast<double>(n);
}

BENCHMARK(phases<2>)->Name("phases/2D")->Arg(1'000'000)->Iterations(3);
BENCHMARK(phases<3>)->Name("phases/3D")->Arg(1'000'000)->Iterations(3);
BENCHMARK(phases<4>)->Name("phases/4D")->Arg(100'000)->Iterations(3);
BENCHMARK(phases<5>)->Name("phases/5D")->Arg(10'000)->Iterations(3);
BENCHMARK(phases<6>)->Name("phases/6D")->Arg(1'000)->Iterations(3);
BENCHMARK(phases<7>)->Name("phases/7D")->Arg(190)->Iterations(3);  // more are wrapped

}  // namespace

BENCHMARK_MAIN();
