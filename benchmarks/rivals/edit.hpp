// SPDX-License-Identifier: BSD-3-Clause
// What all programs do that edit triangulations, so that all do the same to the same points:
//   PROGRAM points.npy [--repeat K] [--edits M] [--moves STEP,STEP,...] [--time-step STEP] [--seed S]
// M vertices (1000) are removed, and inserted again, each with a hint. For each STEP of --moves (0.001,0.1,1)
// M other vertices move, in random directions, by STEP times the mean distance of a point to the nearest
// other one. Then all vertices move by the STEP of --time-step (0.001; 0: no time step). The vertices are
// chosen at random, so that most of what an edit reads is not in a cache. Each of K rounds begins with the
// points of the file.
#pragma once

#include "rival.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rival {

/// An editor holds one triangulation. Rows are those of the input, whatever has happened to them since.
/// Only build(), remove(), insert(), move() and time_step() are timed, the last if there is one.
template <class E>
concept Editor = std::constructible_from<E, const Arguments&, int> &&
    requires(E e, const E c, std::span<const double> coordinates, std::span<const std::size_t> rows,
             std::size_t row) {
  { c.program() } -> std::convertible_to<Program>;
  e.prepare(coordinates);  // brings the points to the peer's form
  e.build();
  e.find_vertices();   // of the rows; throws if two points are equal
  e.find_hints(rows);  // of rows that are about to be removed
  e.remove(row);
  e.insert(row, row, coordinates);  // the number of the hint, the row, and its point
  e.move(row, coordinates);
  { c.num_cells() } -> std::convertible_to<std::size_t>;
  { c.checksum() } -> std::convertible_to<std::uint64_t>;
};

/// An editor that can move all vertices at once, or has a best order of moving them one by one.
template <class E>
concept TimeStepper = Editor<E> && requires(E e, std::span<const double> coordinates) {
  e.prepare_time_step(coordinates);
  e.time_step();
};

/// A sum over cells that depends on the coordinates of their vertices, not on rows, ids or orders: equal for
/// programs that find the same triangulation.
class Checksum {
 public:
  void add_vertex(std::span<const double> point) {
    std::uint64_t hash = 0;
    for (const double x : point) hash = mix(hash ^ std::bit_cast<std::uint64_t>(x + 0.0));  // −0 is 0
    cell_ += hash;
  }
  void end_cell() { sum_ += mix(std::exchange(cell_, 0)); }
  std::uint64_t value() const { return sum_; }

 private:
  /// The finalizer of splitmix64.
  static std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
  }
  std::uint64_t cell_ = 0, sum_ = 0;
};

/// Random choices that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  /// All rows, in random order.
  std::vector<std::size_t> permutation(std::size_t n) {
    std::vector<std::size_t> rows(n);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i) std::swap(rows[i - 1], rows[bits_() % i]);
    return rows;
  }

  /// Adds a vector of this length, in a random direction.
  void displace(std::span<double> point, double length) {
    step_.resize(point.size());
    double square = 0;
    do {
      square = 0;
      for (double& x : step_) {
        x = 2 * fraction() - 1;
        square += x * x;
      }
    } while (square > 1 || square < 1e-6);
    for (std::size_t i = 0; i < point.size(); ++i) point[i] += length / std::sqrt(square) * step_[i];
  }

 private:
  double fraction() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  std::mt19937_64 bits_;
  std::vector<double> step_;
};

inline double squared_distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/// The hint for a vertex that is about to go: the nearest of its neighbors that stays, of a peer's type. If
/// none does, `otherwise`.
template <class Vertex, class Range, class Gone, class Distance>
Vertex nearest_that_stays(const Range& neighbors, const Gone& is_gone, const Distance& distance,
                          Vertex otherwise) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vertex& neighbor : neighbors) {
    if (is_gone(neighbor)) continue;
    if (const double d = distance(neighbor); d < least) {
      least = d;
      otherwise = neighbor;
    }
  }
  return otherwise;
}

/// A set of points, and what is done to them.
class Edits {
 public:
  Edits(const Arguments& arguments, const delone::PointTable& table)
      : dimension(static_cast<std::size_t>(table.dimension)),
        count(std::stoul(arguments.option("edits", "1000"))),
        time_step(std::stod(arguments.option("time-step", "0.001"))),
        seed_(std::stoull(arguments.option("seed", "1"))) {
    std::istringstream words(arguments.option("moves", "0.001,0.1,1"));
    for (std::string word; std::getline(words, word, ',');) moves.push_back(word);
    if (count < 1 || 2 * count > table.num_points())
      throw std::invalid_argument("--edits is at least 1, and at most half of the points");
    spacing = mean_distance_to_nearest(table.coordinates);
  }

  Random random() const { return Random(seed_); }
  std::span<double> point(std::vector<double>& coordinates, std::size_t row) const {
    return {&coordinates[row * dimension], dimension};
  }
  std::span<const double> point(const std::vector<double>& coordinates, std::size_t row) const {
    return {&coordinates[row * dimension], dimension};
  }

  std::size_t dimension, count;
  std::vector<std::string> moves;  ///< lengths of single moves, as given
  double time_step;                ///< 0: none
  double spacing = 0;

 private:
  /// Of 256 points, chosen at random.
  double mean_distance_to_nearest(const std::vector<double>& coordinates) const {
    const std::size_t n = coordinates.size() / dimension, sample = std::min<std::size_t>(n, 256);
    const std::vector<std::size_t> rows = random().permutation(n);
    double sum = 0;
    for (std::size_t i = 0; i < sample; ++i) {
      const std::span<const double> p = point(coordinates, rows[i]);
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t row = 0; row < n; ++row)
        if (row != rows[i]) least = std::min(least, squared_distance(p, point(coordinates, row)));
      sum += std::sqrt(least);
    }
    return sum / static_cast<double>(sample);
  }

  std::uint64_t seed_;
};

/// Throws unless two ways have led to the same triangulation.
template <Editor E>
void require_equal(const E& moved, std::size_t num_cells, std::uint64_t checksum) {
  if (moved.num_cells() != num_cells || moved.checksum() != checksum)
    throw std::runtime_error("the triangulation of the moved points is another than that of a rebuild");
}

/// One round: what is done to one triangulation. Adds its times to the report.
template <Editor E>
void run_round(const Arguments& arguments, const Edits& edits, std::vector<double> points,
               nlohmann::json& report) {
  const int dimension = static_cast<int>(edits.dimension);
  const std::size_t n = points.size() / edits.dimension;
  const auto add = [&](const char* where, const std::string& what, double clock, double cpu) {
    report[where][what].push_back(clock);
    report[std::string("cpu_") + where][what].push_back(cpu);
  };
  const auto add_nanoseconds = [&](const std::string& what, const Seconds& seconds) {
    const double each = 1e9 / static_cast<double>(edits.count);
    add("ns", what, each * seconds.clock, each * seconds.cpu);
  };

  std::optional<E> editor(std::in_place, arguments, dimension);
  editor->prepare(points);
  const Seconds construction = time([&] { editor->build(); });
  report["seconds"].push_back(construction.clock);
  report["cpu_seconds"].push_back(construction.cpu);
  if (!report.contains("peak_bytes")) report["peak_bytes"] = peak_bytes();
  editor->find_vertices();
  const std::size_t cells_of_points = editor->num_cells();
  const std::uint64_t checksum_of_points = editor->checksum();

  Random random = edits.random();
  const std::vector<std::size_t> order = random.permutation(n);
  std::vector<std::size_t> rows(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(edits.count));
  editor->find_hints(rows);
  add_nanoseconds("removal", time([&] {
                    for (const std::size_t row : rows) editor->remove(row);
                  }));
  report["cells_after_removals"] = editor->num_cells();
  report["checksum_after_removals"] = editor->checksum();
  add_nanoseconds("insertion", time([&] {
                    for (std::size_t i = 0; i < rows.size(); ++i)
                      editor->insert(i, rows[i], edits.point(std::as_const(points), rows[i]));
                  }));
  report["same_after_insertions"] =
      editor->num_cells() == cells_of_points && editor->checksum() == checksum_of_points;

  std::size_t begin = edits.count;
  for (const std::string& step : edits.moves) {
    for (std::size_t& row : rows) {
      row = order[begin++ % n];
      random.displace(edits.point(points, row), std::stod(step) * edits.spacing);
    }
    add_nanoseconds("move " + step, time([&] {
                      for (const std::size_t row : rows)
                        editor->move(row, edits.point(std::as_const(points), row));
                    }));
  }
  report["cells"] = editor->num_cells();
  report["checksum"] = editor->checksum();
  if (edits.time_step == 0) return;

  for (std::size_t row = 0; row < n; ++row)
    random.displace(edits.point(points, row), edits.time_step * edits.spacing);
  std::size_t num_cells = 0;
  std::uint64_t checksum = 0;
  if constexpr (TimeStepper<E>) {
    editor->prepare_time_step(points);
    const Seconds step = time([&] { editor->time_step(); });
    add("time_step", "moves", step.clock, step.cpu);
    num_cells = editor->num_cells();
    checksum = editor->checksum();
  }
  editor.reset();  // a rebuild has the memory to itself
  editor.emplace(arguments, dimension);
  editor->prepare(points);
  const Seconds rebuild = time([&] { editor->build(); });
  add("time_step", "rebuild", rebuild.clock, rebuild.cpu);
  if (TimeStepper<E>) require_equal(*editor, num_cells, checksum);
}

/// The main function of a program that edits.
template <Editor E>
int run_edits(int argc, char** argv) {
  return run_main(argc, argv, [](const Arguments& arguments, delone::PointTable&& table, auto& report) {
    const Edits edits(arguments, table);
    report.update({{"edits", edits.count}, {"spacing", edits.spacing}});
    add_program(report, E(arguments, table.dimension).program());
    for (int round = 0; round < arguments.repeat; ++round)
      run_round<E>(arguments, edits, table.coordinates, report);
  });
}

}  // namespace rival
