// SPDX-License-Identifier: BSD-3-Clause
// A folder of tiles while it is being made. FOLDER/work/plan.json says what it is to become.
// FOLDER/work/tile-0000.json is the record of a tile whose part and seams are complete.
#pragma once

#include "base/platform_files.hpp"
#include "io/crc32.hpp"
#include "tiles/finished_tile.hpp"

#include <delone/tiles.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace delone::tiles {

/// What a folder is to become. Two calls with equal plans make the same parts.
struct Plan {
  int dimension = 0, affine_dimension = -1;
  bool weighted = false;
  Lattice lattice;  ///< of a periodic set
  double unit = 0;  ///< the same
  std::int64_t num_points = 0;
  std::size_t num_tiles = 0;
  std::string fingerprint;  ///< of the input: any text that tells it from others

  friend bool operator==(const Plan& a, const Plan& b) {
    return a.dimension == b.dimension && a.affine_dimension == b.affine_dimension &&
           a.weighted == b.weighted && a.lattice.vectors == b.lattice.vectors && a.unit == b.unit &&
           a.num_points == b.num_points && a.num_tiles == b.num_tiles && a.fingerprint == b.fingerprint;
  }
};

/// What remains to be known of a tile whose part is written.
struct TileRecord {
  std::int64_t num_cells = 0, num_points = 0, num_seams = 0;
  std::int64_t num_vertices = 0, num_duplicates = 0, num_hidden = 0, num_hull_facets = 0;
  std::int64_t num_foreign = 0, num_rounds = 0;
  double least_weight = 0, largest_weight = 0;
  complex::HashAccumulator hash, weighted_hash;
  io::FileContent part, seam_records;  ///< of its two files
};

/// WORK/plan.json. It is written whole or not at all, also at a power cut.
void write_plan(const std::string& work, const Plan& plan);
/// Throws cannot_open, or bad_format.
Plan read_plan(const std::string& work);

/// Throws invalid_argument if the name of a folder is empty.
void require_name(const std::string& folder);

class WorkFolder {
 public:
  /// Creates FOLDER and FOLDER/work, or goes on with an unfinished folder of an equal plan if `resume`;
  /// without `resume` parts that delone has left there, finished or not, are removed. Throws invalid_argument
  /// and changes nothing if the folder holds anything else, or is of another plan; cannot_write with the
  /// system's reason. Holds a lock on the folder as long as it lives, and throws cannot_write if another
  /// process has it; `locked`: whether this process may be one of several that share the folder, of which one
  /// has the lock.
  WorkFolder(std::string folder, const Plan& plan, bool resume, bool locked = true);

  const std::string& folder() const { return folder_; }
  /// FOLDER/work
  const std::string& work() const { return work_; }
  const Plan& plan() const { return plan_; }

  /// Reads the files of the tiles first … last − 1 that have a record. A tile whose files are not as its
  /// record says is not finished; returns what is wrong with each.
  std::vector<std::string> verify(std::size_t first, std::size_t last);

  /// The record of tile t, if there is one; after verify(), if its files are complete.
  const std::optional<TileRecord>& finished(std::size_t t) const { return records_[t]; }
  std::size_t num_finished() const;

  /// Writes the part, the seams and at last the record of tile t. Tiles may be finished by several threads.
  void finish(std::size_t t, const FinishedTile& tile);

  /// REQUIRES that all tiles are finished. Matches the seams, writes the files of TilesOptions::vtu if
  /// wanted, then index.json, and removes FOLDER/work. Uses about `memory` bytes besides those of one part.
  TilesIndex finish_all(std::uint64_t memory, bool vtu = false);

  /// Waits until the parts and seams of the tiles first … last − 1 are on the disk.
  void sync(std::size_t first, std::size_t last) const;

  /// The steps of finish_all() by themselves, for processes that share the folder. What others have finished:
  void know(std::size_t t, const TileRecord& record) { records_[t] = record; }
  /// What the index will be. Facets of the hull that are seams of parts are not yet counted, and what the
  /// files of seams hold is not known.
  TilesIndex summary() const;
  /// REQUIRES sync() of all tiles. Writes the files of TilesOptions::vtu if wanted, then index.json, and
  /// removes FOLDER/work.
  void close(const TilesIndex& index, bool vtu = false);

 private:
  void open(bool resume, bool locked);

  std::string folder_, work_;
  std::unique_ptr<platform::FileLock> lock_;
  Plan plan_;
  std::vector<std::optional<TileRecord>> records_;
};

/// The global id of the first cell of each part.
std::vector<std::int64_t> first_cells(const TilesIndex& index);

/// The index of a finished folder of this plan, whose files may be damaged. Nothing if there is no index;
/// throws invalid_argument if the folder is finished and is of another plan, bad_format if the index is
/// damaged.
std::optional<TilesIndex> find_finished(const std::string& folder, const Plan& plan);
/// Writes tiles.pvtu and its parts into a finished folder that does not have them.
void write_missing_vtu(const std::string& folder, const TilesIndex& index);

/// What a folder is to become, or has become; nothing if the folder has neither plan nor index.
std::optional<Plan> find_plan(const std::string& folder);

}  // namespace delone::tiles
