// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/making/settle_hash.hpp"

#include "periodic/periodic_hash.hpp"
#include "tiles/making/periodic_part.hpp"
#include "tiles/part_file.hpp"

#include <algorithm>

namespace delone::tiles {

bool has_hidden_points(const WorkFolder& folder, std::size_t first, std::size_t last) {
  for (std::size_t t = first; t < last; ++t)
    if (folder.finished(t)->num_hidden > 0) return true;
  return false;
}

int finest_bit_of_vertices(const periodic::PeriodicSet& set, const WorkFolder& folder, std::size_t first,
                           std::size_t last) {
  int finest = periodic::finest_bit(set.period);
  for (std::size_t t = first; t < last; ++t)
    finest = std::min(finest, finest_bit_of_part(set, read_part(folder.folder(), t, folder.finished(t)->part),
                                                 folder.finished(t)->num_vertices));
  return finest;
}

void settle_hashes(const periodic::PeriodicSet& set, int grid, int finest, WorkFolder& folder,
                   std::size_t first, std::size_t last) {
  for (std::size_t t = first; t < last; ++t) {
    TileRecord record = *folder.finished(t);
    if (finest != grid) {
      const TileData part = read_part(folder.folder(), t, record.part);
      record.hash = hash_of_part(set, finest, part, record.num_vertices, false);
      record.weighted_hash = hash_of_part(set, finest, part, record.num_vertices, true);
    }
    if (t == 0) {
      record.hash.add(lattice_hash(set, finest));
      record.weighted_hash.add(lattice_hash(set, finest));
    }
    folder.know(t, record);
  }
}

}  // namespace delone::tiles
