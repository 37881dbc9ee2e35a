// SPDX-License-Identifier: BSD-3-Clause
// The yardstick: the cost of only touching the same memory in the same order. The cells that each insertion
// of a real build reads, deletes and creates are recorded. Then, on memory of the same size, with each cell
// in one place and without any geometry,
//   every cell of the conflict zone is read, and every cell beyond its horizon;
//   for every facet of the horizon a record is written in full, and one neighbor of the survivor;
//   one word of every dead cell is written.
// This is done once on memory that has been written before, and once on fresh memory, with page faults. The
// rest of a build's time is what better code could save. The yardstick knows all ids beforehand and
// prefetches early, which no engine can.
#include "clocks.hpp"
#include "engine_run.hpp"

#include "base/growable_array.hpp"

#include <delone/point_sets.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using benchmarks::Index;

/// Of each insertion: the sizes of zone and horizon, the zone, and survivor and created cell of each facet.
class Recorder : public benchmarks::Observer {
 public:
  void ends(const delone::engine::Workspace& work) {
    trace.push_back(static_cast<Index>(work.zone.num_cells));
    trace.push_back(static_cast<Index>(work.zone.num_facets));
    trace.insert(trace.end(), work.zone.cells.data(), work.zone.cells.data() + work.zone.num_cells);
    for (const delone::cells::HorizonFacet& facet : work.star()) {
      trace.push_back(facet.survivor);
      trace.push_back(facet.created);
    }
  }
  std::vector<Index> trace;
};

/// A record is prefetched this many records ahead of its use.
constexpr std::size_t ahead = 8;

/// Returns a number that depends on everything read.
std::uint64_t touch(const std::vector<Index>& trace, std::uint64_t* words, std::size_t stride) {
  std::uint64_t all = 0;
  const auto fetch = [&](Index cell) {
    for (std::size_t i = 0; i < stride + 7; i += 8)
      __builtin_prefetch(words + cell * stride + std::min(i, stride - 1));
  };
  const auto read = [&](Index cell) {
    const std::uint64_t* record = words + cell * stride;
    for (std::size_t i = 0; i < stride; ++i) all += record[i];
  };
  for (std::size_t at = 0; at < trace.size();) {
    const std::size_t num_cells = trace[at], num_facets = trace[at + 1];
    const Index* const zone = trace.data() + at + 2;
    const Index* const facets = zone + num_cells;
    at += 2 + num_cells + 2 * num_facets;
    for (std::size_t i = 0; i < num_cells; ++i) {
      if (i + ahead < num_cells) fetch(zone[i + ahead]);
      read(zone[i]);
    }
    for (std::size_t f = 0; f < num_facets; ++f) {
      if (f + ahead < num_facets) fetch(facets[2 * (f + ahead)]);
      read(facets[2 * f]);
    }
    for (std::size_t f = 0; f < num_facets; ++f) {
      if (f + ahead < num_facets) fetch(facets[2 * (f + ahead) + 1]);
      std::fill_n(words + facets[2 * f + 1] * stride, stride, all);
      words[facets[2 * f] * stride + stride - 1] = all;
    }
    for (std::size_t i = 0; i < num_cells; ++i) words[zone[i] * stride] = all;
  }
  return all;
}

template <int K>
void touch(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<double> coordinates = delone::make_point_set("uniform", K, n, 1);
  Recorder recorder;
  std::size_t num_words, stride;
  double created;
  {
    benchmarks::EngineRun<K, Recorder> run({coordinates, K}, recorder);
    run.insert_all();
    created = static_cast<double>(run.effort().created_cells);
    stride = run.cells().layout().bytes() / sizeof(std::uint64_t);
    num_words = run.cells().num_slots() * stride;
  }
  double fresh = std::numeric_limits<double>::infinity(), warm = fresh;
  const auto measured = [&](std::uint64_t* words) {
    const double start = benchmarks::thread_seconds();
    benchmark::DoNotOptimize(touch(recorder.trace, words, stride));
    return 1e9 * (benchmarks::thread_seconds() - start) / created;
  };
  for (auto _ : state) {
    delone::internal::GrowableArray<std::uint64_t> words(K >= 5 ? delone::internal::Pages::large
                                                                : delone::internal::Pages::usual);
    words.reserve(num_words);
    fresh = std::min(fresh, measured(words.data()));
    warm = std::min(warm, measured(words.data()));
  }
  state.counters["warm"] = warm;
  state.counters["fresh"] = fresh;
  state.counters["created"] = created;
  state.counters["bytes_per_cell"] = static_cast<double>(8 * stride);
  state.counters["megabytes"] = 8e-6 * static_cast<double>(num_words);
}

BENCHMARK(touch<2>)->Name("touch/2D")->Arg(1'000'000)->Iterations(5);
BENCHMARK(touch<3>)->Name("touch/3D")->Arg(1'000'000)->Iterations(5);
BENCHMARK(touch<4>)->Name("touch/4D")->Arg(100'000)->Iterations(5);
BENCHMARK(touch<5>)->Name("touch/5D")->Arg(10'000)->Iterations(5);
BENCHMARK(touch<6>)->Name("touch/6D")->Arg(1'000)->Iterations(5);
BENCHMARK(touch<7>)->Name("touch/7D")->Arg(190)->Iterations(5);  // more are wrapped

}  // namespace

BENCHMARK_MAIN();
