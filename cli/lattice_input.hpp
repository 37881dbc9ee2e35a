// SPDX-License-Identifier: BSD-3-Clause
// --lattice, --periodic and --unit: the lattice of a periodic set. Also of `delone-mpi`.
#pragma once

#include <delone/periodic.hpp>

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace delone::cli {

struct LatticeInput {
  std::string lattice;              ///< lengths, or a file of vectors; empty: not periodic
  std::optional<std::string> axes;  ///< which of the vectors; none: all
  std::optional<double> unit;

  /// Returns --lattice.
  CLI::Option* add_to(CLI::App& command);
  bool is_wanted() const { return !lattice.empty(); }
  /// Throws UsageError if the value is not a lattice of this dimension.
  Lattice read(int dimension) const;
  /// That of points in tiles, which are not read before: a length per axis, or a file of vectors, tells the
  /// dimension. Without vectors if it is not wanted. Throws UsageError for a single length.
  Lattice of_tiles() const;
  /// 0: none. Throws UsageError for a bad one.
  double unit_or_0() const;
};

}  // namespace delone::cli
