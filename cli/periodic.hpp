// SPDX-License-Identifier: BSD-3-Clause
// Periodic input of the commands `delaunay`, `regular` and `cells`: --lattice and what goes with it.
#pragma once

#include "build_options.hpp"
#include "command.hpp"
#include "cost.hpp"
#include "lattice_input.hpp"
#include "report.hpp"

#include <optional>
#include <span>
#include <string>

namespace delone::cli {

struct PeriodicInput : LatticeInput {
  bool exact = false;

  void add_to(CLI::App& command);
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
