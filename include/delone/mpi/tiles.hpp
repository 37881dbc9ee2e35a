// SPDX-License-Identifier: BSD-3-Clause
// Triangulations of more points than one machine holds: the processes of an MPI communicator make a folder of
// tiles together. Link delone::mpi, which exists if delone was built with DELONE_BUILD_MPI.
#pragma once

#include <delone/tiles.hpp>

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace delone::mpi {

/// What one rank did, and how long it took, in seconds.
struct RankEffort {
  std::int64_t num_tiles = 0;           ///< triangulated by this rank
  std::int64_t num_points = 0;          ///< distinct points of all its tiles
  std::int64_t num_foreign = 0;         ///< points of other tiles that it inserted
  std::int64_t num_rounds = 0;          ///< exchanges of pages
  std::int64_t num_pages_received = 0;  ///< each once per tile
  std::int64_t num_messages = 0;        ///< sent to other ranks, collective calls apart
  std::int64_t bytes_sent = 0, bytes_received = 0;
  double reading = 0;     ///< the survey, and sending points to their tiles
  double inserting = 0;   ///< points
  double asking = 0;      ///< searching the local pages for points of other tiles
  double exchanging = 0;  ///< pages
  double waiting = 0;     ///< for other ranks, between rounds
  double writing = 0;     ///< parts, and the cells across their seams
  double total = 0;
};

/// As delone::make_tiles(), by all ranks of `ranks`: every rank calls it, with equal arguments, and gets the
/// index. Each holds about an equal share of the points, and all ranks must see the folder. The result is
/// that of one process, for any number of ranks: the same triangulation, hash, and numbers of rows.
///
/// inputs: one file, from which each rank reads its share, or everything if it is a text; or several files,
/// each read by one rank, whose rows are numbered file after file. A name with %d stands for the files with
/// the numbers 0, 1, 2, … in its place, as long as they exist.
///
/// options: `memory` is that of one rank, and `tiles` the number of all tiles; there are at least as many
/// tiles as ranks. `progress` and `forecast` are called by every rank, by itself. Rank 0 writes the
/// files of `vtu`, at the end. With a `lattice` all ranks agree on the grid of the periodic set, which takes
/// one more pass over the input.
///
/// Errors of any rank are thrown by all, with the number of the rank in front unless all have the same one.
/// If a rank runs out of memory in the middle of an exchange, it says so on standard error and ends all ranks
/// by MPI_Abort. If a process dies, MPI ends the others; another call, by any number of ranks, continues from
/// what the first has finished.
TilesIndex make_tiles(const std::vector<std::string>& inputs, const std::string& folder, MPI_Comm ranks,
                      const TilesOptions& options = {}, RankEffort* effort = nullptr);
/// The same for points in memory: each rank has some of the rows, which are numbered rank by rank.
TilesIndex make_tiles(PointsView rows_of_rank, const std::string& folder, MPI_Comm ranks,
                      const TilesOptions& options = {}, RankEffort* effort = nullptr);

}  // namespace delone::mpi
