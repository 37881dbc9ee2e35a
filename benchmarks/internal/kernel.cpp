// SPDX-License-Identifier: BSD-3-Clause
// The cost of one predicate call at each stage: the cached functional (filter), the determinant in binary64
// (direct) and in integers (exact), and the symbolic perturbation of a tie (perturbed). The argument is the
// dimension.
//
//   filter/finite          evaluation and comparison with the threshold, cells in the L1 cache
//   STAGE/FORM/INPUT       in-sphere tests of points, weighted and furthest points; sides of facets for homogeneous rows
//   STAGE/orientation/INPUT
//
// Inputs: random (uniform), near (rounded points of one sphere or hyperplane), lattice (integers with exact
// ties), wide (magnitudes from 1e-300 to 1e150, denormal numbers), denormal (denormal numbers only).
// `decided` is the share of calls that the stage decides; direct stages leave the rest to the exact one.
#include "engine_run.hpp"

#include "base/random.hpp"
#include "kernel/hull_stages.hpp"
#include "kernel/stages.hpp"

#include <delone/point_sets.hpp>

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace {

using delone::Sign;
using delone::internal::StageCounts;
using delone::kernel::Flat;
using delone::kernel::Grid;
using delone::kernel::RowForm;
using delone::random::Generator;

enum class Input { random, near, lattice, wide, denormal };
constexpr std::array<const char*, 5> input_names{"random", "near", "lattice", "wide", "denormal"};
constexpr std::array<const char*, 4> form_names{"point", "weighted", "furthest", "homogeneous"};

/// The question: on which side of the sphere of k+1 rows, or of the flat of k rows, is the last row?
enum class Question { sphere, side };

/// Instances of a question, too many for a branch predictor to learn.
template <int K>
class Pool {
 public:
  static constexpr std::size_t size = 256;

  Pool(Question question, RowForm form, Input input)
      : question_(question),
        form_(form),
        input_(input),
        grid_(ambient(), form == RowForm::weighted_point),
        generator_(1) {
    for (int axis = 0; axis < ambient(); ++axis) axes_.push_back(axis);
    for (std::size_t i = 0; i < size; ++i) add_instance();
    if (form != RowForm::homogeneous)
      for (std::size_t row = 0; row < numbers_.size(); row += row_size())
        grid_.include(numbers_.data() + row);
    for (std::size_t row = 0; row < numbers_.size(); row += row_size())
      rows_.push_back(numbers_.data() + row);
  }

  Flat flat() const { return {ambient(), axes_, form_}; }
  const Grid& grid() const { return grid_; }
  /// The rows of the cell or facet, and after them the query.
  const double* const* rows(std::size_t i) const { return rows_.data() + i % size * num_rows(); }
  const double* query(std::size_t i) const { return rows(i)[num_rows() - 1]; }

 private:
  int ambient() const { return form_ == RowForm::homogeneous ? K + 1 : K; }
  std::size_t row_size() const {
    return static_cast<std::size_t>(ambient()) + (form_ == RowForm::weighted_point ? 1 : 0);
  }
  std::size_t num_rows() const { return K + (question_ == Question::sphere ? 2 : 1); }

  double number() {
    switch (input_) {
      case Input::lattice:
        return static_cast<double>(generator_.below(18));
      case Input::wide: {
        const auto exponent = static_cast<int>(generator_.below(1500)) - 1000;
        return std::ldexp(generator_.uniform() - 0.5, generator_.below(8) == 0 ? -1040 : exponent);
      }
      case Input::denormal:
        return std::ldexp(static_cast<double>(generator_.below(1u << 20)), -1074);
      default:
        return generator_.uniform();
    }
  }

  void add_instance() {
    const std::size_t first = numbers_.size();
    for (std::size_t r = 0; r < num_rows(); ++r) {
      for (int j = 0; j < ambient(); ++j) numbers_.push_back(number());
      if (form_ == RowForm::weighted_point) numbers_.push_back(number() / 64);
    }
    double* const rows = numbers_.data() + first;
    if (input_ == Input::near && question_ == Question::sphere) round_to_sphere(rows);
    if (input_ == Input::near && question_ == Question::side) round_to_flat(rows);
    if (input_ == Input::lattice && question_ == Question::sphere) take_corners(rows);
    if (input_ == Input::lattice && question_ == Question::side) take_flat(rows);
  }

  /// Points of the unit sphere; weights, if any, all but equal.
  void round_to_sphere(double* rows) {
    for (std::size_t r = 0; r < num_rows(); ++r, rows += row_size()) {
      double squares = 0;
      for (int j = 0; j < K; ++j) squares += (rows[j] - 0.5) * (rows[j] - 0.5);
      for (int j = 0; j < K; ++j) rows[j] = (rows[j] - 0.5) / std::sqrt(squares);
      if (form_ == RowForm::weighted_point) rows[K] = 1 + 0x1p-52 * static_cast<double>(generator_.below(2));
    }
  }
  /// The last entry is nearly a linear function of the others.
  void round_to_flat(double* rows) {
    for (std::size_t r = 0; r < num_rows(); ++r, rows += row_size()) {
      const int last = ambient() - 1;
      rows[last] = 0;
      for (int j = 0; j < last; ++j) rows[last] += rows[j] / (3 + j);
    }
  }
  /// Corners of a cube: one, its neighbors, and another as query. All on one sphere; weights equal.
  void take_corners(double* rows) {
    const std::uint64_t corner = generator_.below(std::uint64_t{1} << K);
    const double side = static_cast<double>(1 + generator_.below(8));
    std::array<double, K> origin;
    for (double& x : origin) x = number();
    const double weight = number();
    for (std::size_t r = 0; r < num_rows(); ++r, rows += row_size()) {
      std::uint64_t bits = r == 0 ? corner : corner ^ std::uint64_t{1} << (r - 1);
      if (r + 1 == num_rows()) {
        std::uint64_t flipped = 0;
        while (std::popcount(flipped) < 2) flipped = generator_.below(std::uint64_t{1} << K);
        bits = corner ^ flipped;
      }
      for (std::size_t j = 0; j < K; ++j) rows[j] = origin[j] + side * static_cast<double>(bits >> j & 1);
      if (form_ == RowForm::weighted_point) rows[K] = weight;
    }
  }
  /// Integers whose last one is the sum of the others; homogeneous rows have integers of any size.
  void take_flat(double* rows) {
    for (std::size_t r = 0; r < num_rows(); ++r, rows += row_size())
      rows[ambient() - 1] = std::accumulate(rows, rows + ambient() - 1, 0.0);
  }

  Question question_;
  RowForm form_;
  Input input_;
  Grid grid_;
  Generator generator_;
  std::vector<int> axes_;
  std::vector<double> numbers_;
  std::vector<const double*> rows_;
};

/// Times answer(instance), an optional sign or a sign.
template <class Answer>
void ask(benchmark::State& state, Answer answer) {
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(answer(i++));
  double decided = Pool<2>::size;
  if constexpr (requires { answer(i).has_value(); })
    for (std::size_t j = 0; j < Pool<2>::size; ++j) decided -= answer(j).has_value() ? 0 : 1;
  state.counters["decided"] = decided / Pool<2>::size;
}

template <int K>
void direct_sphere(benchmark::State& state, RowForm form, Input input) {
  const Pool<K> pool(Question::sphere, form, input);
  const Flat flat = pool.flat();
  ask(state, [&](std::size_t i) {
    return delone::kernel::direct_sphere<K>(flat, pool.rows(i), pool.query(i), pool.grid());
  });
}

template <int K>
void exact_sphere(benchmark::State& state, RowForm form, Input input) {
  const Pool<K> pool(Question::sphere, form, input);
  const Flat flat = pool.flat();
  ask(state, [&](std::size_t i) { return delone::kernel::exact_sphere(flat, pool.rows(i), pool.query(i)); });
}

template <int K>
void perturbed_sphere(benchmark::State& state, RowForm form, Input input) {
  const Pool<K> pool(Question::sphere, form, input);
  const Flat flat = pool.flat();
  ask(state, [&](std::size_t i) {
    return delone::kernel::perturbed_in_sphere<K>(flat, pool.rows(i), pool.query(i), pool.grid());
  });
}

template <int K>
void direct_orientation(benchmark::State& state, RowForm form, Input input) {
  const Pool<K> pool(Question::side, form, input);
  const Flat flat = pool.flat();
  ask(state, [&](std::size_t i) {
    return delone::kernel::direct_orientation<K>(flat, pool.rows(i), pool.query(i), pool.grid());
  });
}

template <int K>
void exact_orientation(benchmark::State& state, RowForm form, Input input) {
  const Pool<K> pool(Question::side, form, input);
  const Flat flat = pool.flat();
  ask(state,
      [&](std::size_t i) { return delone::kernel::exact_orientation(flat, pool.rows(i), pool.query(i)); });
}

template <int K>
void direct_side(benchmark::State& state, RowForm form, Input input) {
  const Pool<K> pool(Question::side, form, input);
  const Flat flat = pool.flat();
  ask(state,
      [&](std::size_t i) { return delone::kernel::direct_determinant<K + 1>(flat.axes, pool.rows(i)); });
}

template <int K>
void exact_side(benchmark::State& state, RowForm form, Input input) {
  const Pool<K> pool(Question::side, form, input);
  const Flat flat = pool.flat();
  ask(state, [&](std::size_t i) { return delone::kernel::exact_determinant(flat.axes, pool.rows(i)); });
}

/// One evaluation against its threshold, for all cells of a small triangulation and a point inside.
template <int K>
void filter(benchmark::State& state) {
  const std::vector<double> coordinates = delone::make_point_set("uniform", K, K + 3, 1);
  benchmarks::Observer nobody;
  benchmarks::EngineRun<K, benchmarks::Observer> run({coordinates, K}, nobody);
  run.insert_all();
  std::vector<delone::Index> cells;
  for (delone::Index cell = 0; cell < run.cells().num_slots() && cells.size() < 64; ++cell)
    if (!run.cells().is_vacant(cell)) cells.push_back(cell);
  const std::vector<double> center(K, 0.5);
  const auto functional = run.geometry().evaluator(run.geometry().make_query(center.data()));
  std::int64_t asked = 0;
  for (auto _ : state) {
    int certain = 0;
    for (const delone::Index cell : cells)
      certain += std::fabs(functional.value(cell)) > functional.threshold(cell);
    benchmark::DoNotOptimize(certain);
    asked += static_cast<std::int64_t>(cells.size());
  }
  state.SetItemsProcessed(asked);
  state.counters["ns_per_item"] = benchmark::Counter(
      1e-9 * static_cast<double>(asked), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

using Benchmark = void (*)(benchmark::State&, RowForm, Input);

void add(const char* stage, const char* question, Benchmark function, RowForm form, Input input,
         int dimension) {
  const std::string name = std::string(stage) + "/" + question + "/" +
                           input_names[static_cast<std::size_t>(input)] + "/" + std::to_string(dimension) +
                           "D";
  benchmark::RegisterBenchmark(name.c_str(), function, form, input)->MinTime(0.02);
}

template <int K>
void add_dimension() {
  benchmark::RegisterBenchmark(("filter/finite/" + std::to_string(K) + "D").c_str(), filter<K>)
      ->MinTime(0.02);
  for (const RowForm form : {RowForm::point, RowForm::weighted_point, RowForm::furthest_point}) {
    const char* name = form_names[static_cast<std::size_t>(form)];
    for (const Input input : {Input::random, Input::near, Input::lattice, Input::wide, Input::denormal}) {
      add("direct", name, direct_sphere<K>, form, input, K);
      add("exact", name, exact_sphere<K>, form, input, K);
    }
    add("perturbed", name, perturbed_sphere<K>, form, Input::lattice, K);
  }
  for (const Input input : {Input::random, Input::near, Input::lattice, Input::wide, Input::denormal}) {
    add("direct", "orientation", direct_orientation<K>, RowForm::point, input, K);
    add("exact", "orientation", exact_orientation<K>, RowForm::point, input, K);
    add("direct", "homogeneous", direct_side<K>, RowForm::homogeneous, input, K);
    add("exact", "homogeneous", exact_side<K>, RowForm::homogeneous, input, K);
  }
}

}  // namespace

int main(int argc, char** argv) {
  add_dimension<2>();
  add_dimension<3>();
  add_dimension<4>();
  add_dimension<5>();
  add_dimension<6>();
  add_dimension<7>();
  add_dimension<8>();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
