// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/repair.hpp"

#include "base/progress_meter.hpp"
#include "io/file.hpp"
#include "tiles/file_content.hpp"
#include "tiles/folder_names.hpp"
#include "tiles/part_file.hpp"
#include "tiles/seams.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

namespace delone::tiles {

namespace fs = std::filesystem;

namespace {

/// Where the seams of a part are.
std::vector<Seam> seams_of(const TileData& data) {
  std::vector<Seam> seams(count_seams(data));
  const auto corners = static_cast<std::size_t>(data.affine_dimension + 1);
  for (std::size_t i = 0; i < data.neighbors.size(); ++i)
    if (data.neighbors[i] < -1)
      seams[static_cast<std::size_t>(-2 - static_cast<std::int64_t>(data.neighbors[i]))] = {
          static_cast<std::int32_t>(i / corners), static_cast<std::int32_t>(i % corners)};
  return seams;
}

/// Whether FOLDER/work is left by an earlier repair by this plan.
bool is_of_plan(const std::string& work, const Plan& plan) {
  try {
    return read_plan(work) == plan;
  } catch (const Error& error) {
    if (error.code() != Errc::bad_format && error.code() != Errc::cannot_open) throw;
    return false;
  }
}

}  // namespace

std::vector<DamagedFile> find_damaged_files(const std::string& folder, const TilesIndex& index,
                                            std::size_t first, std::size_t last) {
  std::int64_t total = 0, done = 0;
  for (std::size_t t = first; t < last; ++t)
    total += index.parts[t].num_bytes + index.parts[t].num_seam_bytes;
  const std::function<bool(double)> outer;
  internal::ProgressMeter meter(outer, static_cast<std::size_t>(total));
  const auto read = [&](std::int64_t bytes) { meter(static_cast<std::size_t>(done += bytes)); };
  std::vector<DamagedFile> damaged;
  for (std::size_t t = first; t < last; ++t) {
    const TilePart& part = index.parts[t];
    if (auto what = find_damage(path_in(folder, part_name(t)), content_of_part(part), read))
      damaged.push_back({t, false, std::move(*what)});
    if (auto what = find_damage(path_in(folder, seams_name(t)), content_of_seams(part), read))
      damaged.push_back({t, true, std::move(*what)});
  }
  return damaged;
}

std::vector<std::string> texts_of(const std::vector<DamagedFile>& files) {
  std::vector<std::string> texts;
  for (const DamagedFile& file : files) texts.push_back(file.what);
  return texts;
}

RepairFolder::RepairFolder(std::string folder, const Plan& plan, const TilesIndex& index,
                           const std::vector<DamagedFile>& damaged)
    : folder_(std::move(folder)),
      work_(path_in(folder_, work_name)),
      index_(index),
      damage_(index.parts.size()) {
  for (const DamagedFile& file : damaged)
    (file.is_seams ? damage_[file.part].seams : damage_[file.part].part) = true;
  if (const std::string foreign = foreign_names(folder_); !foreign.empty())
    io::fail(Errc::invalid_argument, "{}: the folder holds {}; tiles need a folder of their own",
             io::output_name(folder_), foreign);
  std::error_code error;
  fs::create_directories(work_, error);
  if (error) cannot_write(work_, error);
  lock_ = lock_work(folder_);
  if (is_of_plan(work_, plan)) return;
  remove_work(folder_, std::move(lock_));
  fs::create_directories(work_, error);
  if (error) cannot_write(work_, error);
  lock_ = lock_work(folder_);
  write_plan(work_, plan);
}

bool RepairFolder::has_damaged_parts() const {
  return std::any_of(damage_.begin(), damage_.end(), [](const Damage& damage) { return damage.part; });
}

void RepairFolder::finish(std::size_t t, const FinishedTile& tile) {
  write_part(folder_, t, tile.data, content_of_part(index_.parts[t]));
  sync_file(path_in(folder_, part_name(t)));
  damage_[t].part = false;
}

void RepairFolder::make_seams(std::uint64_t memory) {
  for (std::size_t t = 0; t < damage_.size(); ++t) {
    FinishedTile tile;
    tile.data = read_part(folder_, t, content_of_part(index_.parts[t]));
    tile.seams = seams_of(tile.data);
    append_seam_records(work_, t, tile);
  }
  match_seams(work_, first_cells(index_), memory, [&](std::size_t t, std::span<const std::int64_t> cells) {
    if (!damage_[t].seams) return;
    write_seams(folder_, t, cells, static_cast<std::size_t>(index_.lattice.rank()),
                content_of_seams(index_.parts[t]));
    sync_file(path_in(folder_, seams_name(t)));
  });
}

void RepairFolder::close(std::uint64_t memory) {
  if (std::any_of(damage_.begin(), damage_.end(), [](const Damage& damage) { return damage.seams; }))
    make_seams(memory);
  sync_folder(folder_);
  remove_work(folder_, std::move(lock_));
}

}  // namespace delone::tiles
