// SPDX-License-Identifier: BSD-3-Clause
// Repairs a finished folder with damaged or missing files. Only these are made again, byte for byte. The
// index stays, so a repair that was interrupted goes on with the next call.
#pragma once

#include "base/platform_files.hpp"
#include "tiles/finished_tile.hpp"
#include "tiles/work_folder.hpp"

#include <delone/tiles.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace delone::tiles {

/// A file of a finished folder that is not as the index says.
struct DamagedFile {
  std::size_t part = 0;
  bool is_seams = false;
  std::string what;  ///< for a message: the file, and what is wrong with it
};

/// Reads the files of the parts first … last − 1.
std::vector<DamagedFile> find_damaged_files(const std::string& folder, const TilesIndex& index,
                                            std::size_t first, std::size_t last);
/// What is wrong with each of them.
std::vector<std::string> texts_of(const std::vector<DamagedFile>& files);

class RepairFolder {
 public:
  /// Creates FOLDER/work, or goes on with what an earlier repair by an equal plan has left there, and holds a
  /// lock on it. Throws invalid_argument if the folder holds anything else; cannot_write.
  RepairFolder(std::string folder, const Plan& plan, const TilesIndex& index,
               const std::vector<DamagedFile>& damaged);

  /// FOLDER/work
  const std::string& work() const { return work_; }
  bool has_damaged_parts() const;
  /// Whether part t needs not be made again.
  bool finished(std::size_t t) const { return !damage_[t].part; }
  /// Writes part t. Throws bad_format, and changes nothing, unless it becomes what the index says.
  void finish(std::size_t t, const FinishedTile& tile);
  /// REQUIRES that all parts are finished. Makes damaged seams again, and removes FOLDER/work. Uses about
  /// `memory` bytes besides those of one part.
  void close(std::uint64_t memory);

 private:
  struct Damage {
    bool part = false, seams = false;
  };

  void make_seams(std::uint64_t memory);

  const std::string folder_, work_;
  const TilesIndex& index_;
  std::vector<Damage> damage_;  ///< of each part, as it was at the beginning but for parts that are finished
  std::unique_ptr<platform::FileLock> lock_;
};

}  // namespace delone::tiles
