// SPDX-License-Identifier: BSD-3-Clause
// Orders of insertion: the cost of sorting per point, and for each order the cells created per insertion and
// visited per walk.
//
//   sort/brio/dD/n      nanoseconds for each point, uniform points
//   build/ORDER/dD/n    one construction; online: points one by one in random order, without hints, through insert()
#include "clocks.hpp"

#include "order/insertion_order.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <benchmark/benchmark.h>

#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace {

void sort(benchmark::State& state, int dimension, std::size_t n) {
  const std::vector<double> coordinates = delone::make_point_set("uniform", dimension, n, 1);
  const delone::PointsView points(coordinates, dimension);
  double best = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    const double start = benchmarks::thread_seconds();
    benchmark::DoNotOptimize(delone::order::automatic_order(points, 0));
    best = std::min(best, benchmarks::thread_seconds() - start);
  }
  state.counters["ns_per_point"] = 1e9 * best / static_cast<double>(n);
}

enum class Order { automatic, given, shuffled, online };
constexpr const char* order_names[] = {"automatic", "given", "shuffled", "online"};

delone::Statistics construct(std::span<const double> coordinates, int dimension, Order order) {
  delone::Options options;
  options.order = order == Order::automatic ? delone::InsertionOrder::automatic
                  : order == Order::given   ? delone::InsertionOrder::as_given
                                            : delone::InsertionOrder::shuffled;
  if (order != Order::online) return delone::Delaunay<>(coordinates, dimension, options).statistics();
  delone::Delaunay<> triangulation(dimension, options);
  const auto d = static_cast<std::size_t>(dimension);
  for (std::size_t at = 0; at < coordinates.size(); at += d) triangulation.insert(coordinates.subspan(at, d));
  return triangulation.statistics();
}

/// The points are independent and uniform: as given, they are in random order.
void build(benchmark::State& state, int dimension, std::size_t n, Order order) {
  const std::vector<double> coordinates = delone::make_point_set("uniform", dimension, n, 1);
  delone::Statistics statistics;
  double best = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    const double start = benchmarks::thread_seconds();
    statistics = construct(coordinates, dimension, order);
    best = std::min(best, benchmarks::thread_seconds() - start);
  }
  const auto insertions = static_cast<double>(n);
  state.counters["created_per_insertion"] = static_cast<double>(statistics.created_cells) / insertions;
  state.counters["visited_per_insertion"] = static_cast<double>(statistics.visited_cells) / insertions;
  state.counters["seconds"] = best;
  state.counters["ns_per_created"] = 1e9 * best / static_cast<double>(statistics.created_cells);
}

void add(int dimension, std::size_t n, std::initializer_list<Order> orders) {
  const auto name = [&](std::string of) {
    return of.append("/").append(std::to_string(dimension)).append("D/").append(std::to_string(n));
  };
  benchmark::RegisterBenchmark(name("sort/brio").c_str(), sort, dimension, n)->Iterations(3);
  for (const Order order : orders)
    benchmark::RegisterBenchmark(
        name(std::string("build/").append(order_names[static_cast<std::size_t>(order)])).c_str(), build,
        dimension, n, order)
        ->Iterations(n >= 1'000'000 ? 1 : 2);
}

}  // namespace

int main(int argc, char** argv) {
  const std::initializer_list<Order> all = {Order::automatic, Order::given, Order::shuffled, Order::online};
  const std::initializer_list<Order> batch = {Order::automatic, Order::given};
  for (const std::size_t n : {1'000, 10'000, 100'000}) add(2, n, all);
  add(2, 1'000'000, all);
  for (const std::size_t n : {1'000, 10'000, 100'000}) add(3, n, all);
  add(3, 1'000'000, {Order::automatic, Order::online});
  for (const std::size_t n : {1'000, 10'000}) add(4, n, all);
  add(4, 100'000, {Order::automatic});
  for (const std::size_t n : {300, 1'000, 3'000}) add(5, n, all);
  add(5, 10'000, batch);
  for (const std::size_t n : {100, 300, 1'000}) add(6, n, all);
  for (const std::size_t n : {100, 190}) add(7, n, batch);  // more are wrapped
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
