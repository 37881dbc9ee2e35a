// SPDX-License-Identifier: BSD-3-Clause
// Periodic input of the commands `delaunay`, `regular` and `cells`: --lattice and what goes with it.
#pragma once

#include "build_options.hpp"
#include "command.hpp"
#include "cost.hpp"
#include "report.hpp"

#include <optional>
#include <span>
#include <string>

namespace delone::cli {

struct PeriodicInput {
  std::string lattice;              ///< lengths, or a file of vectors; empty: not periodic
  std::optional<std::string> axes;  ///< which of the vectors; none: all
  std::optional<double> unit;
  bool exact = false;

  void add_to(CLI::App& command);
  bool is_wanted() const { return !lattice.empty(); }
  /// Throws UsageError if the value is not a lattice of this dimension.
  Lattice read(int dimension) const;
  /// That of points in tiles, which are not read before: a length per axis, or a file of vectors, tells the
  /// dimension. Without vectors if it is not wanted. Throws UsageError for a single length.
  Lattice lattice_of_tiles() const;
  /// Throws UsageError for a bad unit.
  PeriodicOptions options() const;
};

Counts counts_of(const PeriodicTriangulation& triangulation, std::string hash);
/// Adds what reports say of periodic sets.
void add_periodic(Json& json, const PeriodicTriangulation& triangulation);
Summary& add_periodic(Summary& summary, const PeriodicTriangulation& triangulation);

/// Triangulates points, with weights if there are some, and writes and reports as the command does.
/// `command`: its name.
int run_periodic(const char* command, const PointInput& input, const PointTable& table,
                 const std::vector<double>* weights, const PeriodicInput& periodic, const BuildOptions& build,
                 Clock::time_point start, Cost cost);

}  // namespace delone::cli
