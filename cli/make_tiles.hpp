// SPDX-License-Identifier: BSD-3-Clause
// The commands delaunay and regular with a folder as output: the triangulation is made in tiles, of more
// points than memory holds.
#pragma once

#include "build_options.hpp"
#include "command.hpp"

#include <delone/periodic.hpp>

#include <cstddef>
#include <cstdint>
#include <string>

namespace delone::cli {

/// The options of tiles.
struct TilesInput {
  std::size_t tiles = 0;
  int raw_columns = 0;  ///< 0: IN is not raw
  bool vtu = false, no_resume = false;

  /// What happens beyond the memory (BuildOptions::add_construction()).
  static constexpr const char* beyond_memory =
      "the command ends, or with a folder as output makes more tiles (if not given: three quarters of what "
      "is "
      "free)";

  void add_to(CLI::App& command);
  /// Whether the output is a folder: one that exists, or a path that ends with a slash. Throws UsageError for
  /// options that do not go together with that.
  bool wanted(const CLI::App& command, const std::string& output) const;
};

struct TilesCommand {
  const char* name;  ///< "delaunay" or "regular"
  const PointInput& input;
  std::string weights;  ///< the column, empty: none
  const BuildOptions& build;
  const TilesInput& tiles;
  Lattice lattice;  ///< of a periodic set
  double unit;      ///< the same; 0: none
};

/// Makes the folder, reports, and returns the exit status.
int run_tiles(const TilesCommand& command);

}  // namespace delone::cli
