// SPDX-License-Identifier: BSD-3-Clause
// The check of a folder of tiles. All parts are read once. What a part tells alone is examined then by the
// stages of check(); facets with one cell in their part, and rows, go to buckets on disk, with their
// coordinates, and are compared bucket by bucket.
//
// Why that suffices. Glue cells that are neighbors. Level 2 finds that each facet is glued to one other at
// most, of the same k rows with the same coordinates, and that facets with one cell in their part are glued
// whenever two of them are equal; three are never. Glue infinite cells to the facets that are left, and to
// each other across the ridges of these: level 3 finds that each of them is a ridge of two hull facets, so
// that the complex is closed. Level 4 finds that no cell is flat and that cells lie on different sides of
// their common facet. The hull facets, as they are oriented by their cells, are the boundary of the chain of
// all cells, and have no boundary: the two at a ridge are oriented coherently. So with o, the cones behind
// hull facets, and the reference cell of check_geometry.cpp, and with its argument, the complex is mapped to
// R^k ∪ {∞} without a fold. Each point of general position is then covered equally often, and if the complex
// falls apart, by each piece at least once. At o that number is one, since no cell but the reference cell
// covers o and all hull facets have o on their inner side. So there is one piece, its cells tile a convex
// region, and no third cell has the facet of two. Convexity at ridges and locally at facets then proves the
// empty-sphere property.
//
// Neither connected stars nor an Euler characteristic have to be examined: they follow. Suppose two vertices,
// or two pieces of the star of one, are at one point x. The cells of either piece, from one to the next
// across facets with that vertex, cover all directions from x that lead into the region: only a hull facet
// ends such a walk. Then points close to x are covered twice, a contradiction.
//
// Level 6 finds that a row has the same coordinates wherever a part has it, that it is a vertex in one sense
// everywhere, and that every row of the input is in one part. Coordinates of duplicates and of hidden points
// are not in the parts, so nothing is proved of them but that they are counted once; unless the input is at
// hand, which duplicates are compared with.
#include "tiles/check/check_tiles.hpp"
#include "base/progress_meter.hpp"

#include "base/random.hpp"
#include "io/file.hpp"
#include "tiles/check/check_part.hpp"
#include "tiles/check/check_periodic_tiles.hpp"
#include "tiles/check/check_rows.hpp"
#include "tiles/check/check_seams.hpp"
#include "tiles/index_file.hpp"
#include "tiles/part_file.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>

namespace delone::tiles {

namespace fs = std::filesystem;

namespace {

/// A folder for scratch files: in the folder that is checked, or in that of the system if nothing can be
/// created there.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& folder) {
    std::error_code error;
    for (const fs::path& parent : {fs::path(folder), fs::temp_directory_path(error)})
      for (int attempt = 0; attempt < 10; ++attempt) {
        const auto ticks =
            static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count()) +
            reinterpret_cast<std::uintptr_t>(this);
        path_ = parent / fmt::format(".delone-partial-check-{:016x}", random::mix(ticks));
        if (fs::create_directory(path_, error)) return;
      }
    io::fail(Errc::cannot_write, "{}: no folder for scratch files can be created: {}",
             io::output_name(folder), error.message());
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

std::uint64_t size_of(const std::string& path) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  return error ? 0 : static_cast<std::uint64_t>(size);
}

void require_input(PointsView input, const TilesIndex& index) {
  const int columns = index.dimension + (index.weighted ? 1 : 0);
  if (input.dimension() != columns)
    io::fail(Errc::bad_dimension, "the input has {} columns; points in the folder have dimension {}{}",
             input.dimension(), index.dimension, index.weighted ? " and a weight" : "");
  if (static_cast<std::int64_t>(input.size()) != index.num_points)
    io::fail(Errc::invalid_argument, "the input has {} points; those of the folder are {}", input.size(),
             index.num_points);
}

struct Sizes {
  std::uint64_t largest = 0, parts = 0, seams = 0;  ///< bytes
};

Sizes sizes_of(const std::string& folder, const TilesIndex& index) {
  Sizes sizes;
  for (std::size_t i = 0; i < index.parts.size(); ++i) {
    const std::uint64_t part = size_of(path_in(folder, part_name(i)));
    sizes.largest = std::max(sizes.largest, part);
    sizes.parts += part;
    sizes.seams += size_of(path_in(folder, seams_name(i)));
  }
  return sizes;
}

CheckedPart read_checked(const std::string& folder, const TilesIndex& index, std::size_t i) {
  CheckedPart part;
  part.number = i;
  part.first_cell = index.parts[i].first_cell;
  part.tile = read_tile_of(folder, index, i);
  part.data.dimension = part.tile.dimension;
  part.data.affine_dimension = part.tile.affine_dimension;
  part.data.points = std::exchange(part.tile.points, {});
  part.data.weights = std::exchange(part.tile.weights, {});
  if constexpr (std::is_same_v<SignedIndex, std::int32_t>)
    part.data.cells = std::exchange(part.tile.cells, {});
  else
    part.data.cells.assign(part.tile.cells.begin(), part.tile.cells.end());
  return part;
}

}  // namespace

CheckReport check_tiles(const std::string& folder, const CheckOptions& options, unsigned threads,
                        std::uint64_t memory, std::optional<PointsView> input) {
  if (options.furthest_site || !options.oriented)
    io::fail(Errc::invalid_argument,
             "cells of tiles are oriented and Delaunay or regular; oriented and furthest_site are options of "
             "the check "
             "of a triangulation in one piece");
  const TilesIndex index = delone::read_tiles_index(folder);
  if (index.lattice.rank() > 0) {
    if (input)
      io::fail(Errc::unsupported, "the tiles of a periodic set are not compared with points: leave them out");
    return check_periodic_tiles(folder, index, options);
  }
  if (input) require_input(*input, index);
  const Sizes sizes = sizes_of(folder, index);
  const std::uint64_t bound =
      memory != 0 ? memory : std::max<std::uint64_t>(sizes.largest, std::uint64_t{64} << 20);
  const ScratchFolder scratch(folder);
  Findings findings(std::max(options.up_to, 1));
  Reference reference;
  const std::uint64_t hull_facets =
      std::min<std::uint64_t>(static_cast<std::uint64_t>(index.num_hull_facets), sizes.parts / 4);
  SeamChecker seams(index, reference, scratch.path(), sizes.seams / 8 + hull_facets, bound / 3,
                    options.canonical);
  RowChecker rows(index, scratch.path(), sizes.parts / 8, bound / 3,
                  input ? input->coordinates().data() : nullptr);
  std::size_t ties = 0;
  const auto examine = [&](std::size_t i) {
    std::optional<CheckedPart> part;
    try {
      part = read_checked(folder, index, i);
    } catch (const Error& error) {
      if (error.code() != Errc::bad_format && error.code() != Errc::cannot_open) throw;
      return findings.add(1, {error.what()});
    }
    ties += check_part(*part, reference, options.canonical, threads, findings);
    if (findings.wanted(2)) seams.add(*part);
    if (findings.wanted(6)) rows.add(*part, findings);
  };
  return internal::run_levels<ComplexData>(
      options,
      [&](CheckReport&) {
        for (std::size_t i = 0; i < index.parts.size(); ++i) examine(i);
        findings.require(1);
      },
      [&](CheckReport&) {
        if (findings.wanted(2)) seams.match_facets(findings);
        findings.require(2);
      },
      [&](CheckReport&) {
        if (index.affine_dimension >= 0 && index.num_cells == 0) findings.add(3, {"there is no cell"});
        if (findings.wanted(3)) seams.match_ridges(findings);
        findings.require(3);
      },
      [&](CheckReport&) { findings.require(4); },
      [&](CheckReport& report) {
        findings.require(5);
        report.ties = ties + seams.ties();
      },
      [&](CheckReport&) {
        rows.match(findings);
        findings.require(6);
        compare_with_index("hull facets", seams.num_hull_facets(), index.num_hull_facets);
      });
}

}  // namespace delone::tiles

namespace delone {

CheckReport check_tiles(const std::string& folder, const CheckOptions& options, const Execution& how) {
  const internal::ProgressMeter meter(how.progress);
  return io::guarded(io::input_name(folder),
                     [&] { return tiles::check_tiles(folder, options, how.threads, 0); });
}

CheckReport check_tiles(const std::string& folder, PointsView input, const CheckOptions& options,
                        const Execution& how) {
  const internal::ProgressMeter meter(how.progress);
  return io::guarded(io::input_name(folder),
                     [&] { return tiles::check_tiles(folder, options, how.threads, 0, input); });
}

}  // namespace delone
