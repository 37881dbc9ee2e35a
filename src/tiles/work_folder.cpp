// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/work_folder.hpp"

#include "base/progress_meter.hpp"
#include "io/file.hpp"
#include "tiles/file_content.hpp"
#include "tiles/folder_names.hpp"
#include "tiles/index_file.hpp"
#include "tiles/json_members.hpp"
#include "tiles/part_file.hpp"
#include "tiles/seams.hpp"
#include "tiles/vtu_parts.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

namespace delone::tiles {

namespace fs = std::filesystem;

namespace {

constexpr const char* plan_format = "delone plan of tiles";
constexpr std::int64_t plan_version = 1;
constexpr const char* plan_name = "plan.json";

std::string record_name(std::size_t t) { return fmt::format("tile-{:04}.json", t); }

/// The plan that a finished folder has followed, and its index.
std::pair<Plan, TilesIndex> read_finished(const std::string& folder) {
  Plan plan;
  TilesIndex index;
  try {
    index = read_tiles_index(folder, plan.fingerprint);
  } catch (const Error& error) {
    if (error.code() != Errc::bad_format || !is_damaged_index(folder)) throw;
    io::fail(Errc::bad_format, "{}; make the tiles again with resume off", error.what());
  }
  plan.dimension = index.dimension;
  plan.affine_dimension = index.affine_dimension;
  plan.weighted = index.weighted;
  plan.lattice = index.lattice;
  plan.unit = index.unit;
  plan.num_points = index.num_points;
  plan.num_tiles = index.parts.size();
  return {plan, index};
}

/// In what two plans differ.
std::string difference(const Plan& found, const Plan& wanted) {
  if (found.dimension != wanted.dimension)
    return fmt::format("of points of dimension {}, not {}", found.dimension, wanted.dimension);
  if (found.num_points != wanted.num_points)
    return fmt::format("of {} points, not {}", found.num_points, wanted.num_points);
  if (found.weighted != wanted.weighted)
    return found.weighted ? "of points with weights" : "of points without weights";
  if (found.lattice.rank() != wanted.lattice.rank())
    return fmt::format("of a set with {} lattice vectors, not {}", found.lattice.rank(),
                       wanted.lattice.rank());
  if (found.unit != wanted.unit) return "of a set with another unit";
  if (found.lattice.vectors != wanted.lattice.vectors) return "of another lattice";
  if (found.fingerprint != wanted.fingerprint) return "of other points";
  if (found.num_tiles != wanted.num_tiles)
    return fmt::format("in {} tiles, not {}", found.num_tiles, wanted.num_tiles);
  return "made by another plan";
}

/// Throws unless the index is one, be it damaged.
void require_index(const std::string& folder) {
  try {
    delone::read_tiles_index(folder);
  } catch (const Error& error) {
    if (error.code() != Errc::bad_format || !is_damaged_index(folder)) throw;
  }
}

bool has_plan(const std::string& folder) {
  std::error_code error;
  return fs::exists(fs::path(folder) / work_name / plan_name, error);
}

/// Numbers of a record, by their names in files.
constexpr std::pair<const char*, std::int64_t TileRecord::*> counts_of_record[] = {
    {"num_cells", &TileRecord::num_cells},
    {"num_points", &TileRecord::num_points},
    {"num_seams", &TileRecord::num_seams},
    {"num_vertices", &TileRecord::num_vertices},
    {"num_duplicates", &TileRecord::num_duplicates},
    {"num_hidden", &TileRecord::num_hidden},
    {"num_hull_facets", &TileRecord::num_hull_facets},
    {"num_foreign", &TileRecord::num_foreign},
    {"num_rounds", &TileRecord::num_rounds},
};

/// The record of a tile of the plan, if it is there and sound.
std::optional<TileRecord> find_record(const std::string& work, std::size_t t) {
  const std::string path = path_in(work, record_name(t));
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  try {
    const nlohmann::json json = read_json(path);
    const JsonMembers members(json, io::input_name(path));
    TileRecord record;
    const auto count = [&](const char* member) { return members.number(member, 0, largest_count); };
    for (const auto& [name, member] : counts_of_record) record.*member = count(name);
    record.least_weight = members.real("least_weight");
    record.largest_weight = members.real("largest_weight");
    record.hash = complex::HashAccumulator::of_words(members.words<5>("hash"));
    record.weighted_hash = complex::HashAccumulator::of_words(members.words<5>("weighted_hash"));
    record.part = {count("part_bytes"), members.number("part_crc32", 0, largest_crc32)};
    record.seam_records = {count("seam_bytes"), members.number("seam_crc32", 0, largest_crc32)};
    return record;
  } catch (const Error& damage) {
    if (damage.code() != Errc::bad_format) throw;
    return std::nullopt;  // the tile is made again
  }
}

bool has_size(const std::string& path, std::int64_t expected) {
  std::error_code error;
  const std::uint64_t size = fs::file_size(path, error);
  return !error && size == static_cast<std::uint64_t>(expected);
}

}  // namespace

void write_plan(const std::string& work, const Plan& plan) {
  nlohmann::ordered_json json;
  json["format"] = plan_format;
  json["version"] = plan_version;
  json["dimension"] = plan.dimension;
  json["affine_dimension"] = plan.affine_dimension;
  json["weighted"] = plan.weighted;
  if (plan.lattice.rank() > 0) json["lattice"] = plan.lattice.vectors;
  if (plan.unit > 0) json["unit"] = plan.unit;
  json["num_points"] = plan.num_points;
  json["num_tiles"] = plan.num_tiles;
  json["input"] = plan.fingerprint;
  write_json(path_in(work, plan_name), json, true);
}

Plan read_plan(const std::string& work) {
  const std::string path = path_in(work, plan_name), name = io::input_name(path);
  const nlohmann::json json = read_json(path);
  const JsonMembers members(json, name);
  members.require_format(plan_format, plan_version, "a plan of tiles");
  Plan plan;
  plan.dimension = static_cast<int>(members.number("dimension", 1, std::numeric_limits<int>::max() - 1));
  plan.affine_dimension = static_cast<int>(members.number("affine_dimension", -1, plan.dimension));
  plan.weighted = members.flag("weighted");
  plan.lattice = members.lattice(plan.dimension);
  plan.unit = members.unit();
  plan.num_points = members.number("num_points", 0, largest_count);
  plan.num_tiles =
      static_cast<std::size_t>(members.number("num_tiles", 0, std::numeric_limits<std::int32_t>::max()));
  plan.fingerprint = members.text("input");
  return plan;
}

void require_name(const std::string& folder) {
  if (folder.empty()) throw Error(Errc::invalid_argument, "the name of the folder is empty");
}

WorkFolder::WorkFolder(std::string folder, const Plan& plan, bool resume, bool locked)
    : folder_(std::move(folder)), work_(path_in(folder_, work_name)), plan_(plan), records_(plan.num_tiles) {
  io::guarded(io::output_name(folder_), [&] { open(resume, locked); });
}

void WorkFolder::open(bool resume, bool locked) {
  const std::string name = io::output_name(folder_);
  std::error_code error;
  const fs::file_status status = fs::status(folder_, error);
  error.clear();  // of a folder that does not exist yet
  if (fs::exists(status) && !fs::is_directory(status))
    io::fail(Errc::invalid_argument, "{}: not a folder; tiles need one", name);
  if (fs::exists(status) && !fs::is_empty(folder_, error) && !error) {
    const std::string foreign = foreign_names(folder_);
    const bool finished = has_tiles_index(folder_);
    if (!foreign.empty() || (!finished && !has_plan(folder_)))
      io::fail(Errc::invalid_argument, "{}: the folder is not empty{}; tiles need a folder of their own",
               name, foreign.empty() ? ", and holds no tiles" : ": it holds " + foreign);
    if (std::error_code none; locked && fs::is_directory(work_, none)) lock_ = lock_work(folder_);
    if (!resume) {
      if (finished) require_index(folder_);
      if (DELONE_WINDOWS) lock_.reset();  // as in remove_work()
      remove_parts(folder_);
    } else if (finished) {
      io::fail(Errc::invalid_argument, "{}: the folder holds finished tiles", name);
    } else if (const Plan found = read_plan(work_); found != plan_) {
      io::fail(Errc::invalid_argument,
               "{}: the folder holds unfinished tiles {}; begin again with resume off, or take "
               "another folder",
               name, difference(found, plan_));
    }
  }
  if (error) cannot_write(folder_, error);
  fs::create_directories(work_, error);
  if (error) cannot_write(work_, error);
  if (locked) {
    lock_.reset();
    lock_ = lock_work(folder_);
  }
  if (!has_plan(folder_)) write_plan(work_, plan_);
  for (std::size_t t = 0; t < records_.size(); ++t) records_[t] = find_record(work_, t);
}

std::size_t WorkFolder::num_finished() const {
  return static_cast<std::size_t>(
      std::count_if(records_.begin(), records_.end(), [](const auto& record) { return record.has_value(); }));
}

std::vector<std::string> WorkFolder::verify(std::size_t first, std::size_t last) {
  std::int64_t total = 0, done = 0;
  for (std::size_t t = first; t < last; ++t)
    if (records_[t]) total += records_[t]->part.num_bytes + records_[t]->seam_records.num_bytes;
  const std::function<bool(double)> outer;
  internal::ProgressMeter meter(outer, static_cast<std::size_t>(total));
  const auto read = [&](std::int64_t bytes) { meter(static_cast<std::size_t>(done += bytes)); };
  std::vector<std::string> damage;
  for (std::size_t t = first; t < last; ++t) {
    if (!records_[t]) continue;
    auto what = find_damage(path_in(folder_, part_name(t)), records_[t]->part, read);
    if (!what) what = find_damage(path_in(work_, seam_records_name(t)), records_[t]->seam_records, read);
    if (!what) continue;
    damage.push_back(std::move(*what));
    records_[t].reset();
  }
  return damage;
}

void WorkFolder::finish(std::size_t t, const FinishedTile& tile) {
  TileRecord record;
  record.num_cells = static_cast<std::int64_t>(tile.data.num_cells());
  record.num_points = static_cast<std::int64_t>(tile.data.own_rows.size());
  record.num_seams = static_cast<std::int64_t>(tile.seams.size());
  record.num_vertices = tile.num_vertices;
  record.num_duplicates = tile.num_duplicates;
  record.num_hidden = tile.num_hidden;
  record.num_hull_facets = tile.num_hull_facets;
  record.num_foreign = tile.num_foreign;
  record.num_rounds = tile.num_rounds;
  record.least_weight = tile.least_weight;
  record.largest_weight = tile.largest_weight;
  record.hash = tile.hash;
  record.weighted_hash = tile.weighted_hash;
  record.part = write_part(folder_, t, tile.data);
  record.seam_records = append_seam_records(work_, t, tile);
  nlohmann::ordered_json json;
  for (const auto& [name, member] : counts_of_record) json[name] = record.*member;
  json["least_weight"] = record.least_weight;
  json["largest_weight"] = record.largest_weight;
  json["hash"] = hex_text(record.hash.words());
  json["weighted_hash"] = hex_text(record.weighted_hash.words());
  json["part_bytes"] = record.part.num_bytes;
  json["part_crc32"] = record.part.crc32;
  json["seam_bytes"] = record.seam_records.num_bytes;
  json["seam_crc32"] = record.seam_records.crc32;
  write_json(path_in(work_, record_name(t)), json, false);
  records_[t] = record;
}

TilesIndex WorkFolder::summary() const {
  TilesIndex index;
  index.dimension = plan_.dimension;
  index.affine_dimension = plan_.affine_dimension;
  index.weighted = plan_.weighted;
  index.lattice = plan_.lattice;
  index.unit = plan_.unit;
  index.num_points = plan_.num_points;
  complex::HashAccumulator hash, weighted_hash;
  bool has_vertex = false;
  double least = 0, largest = 0;
  for (std::size_t t = 0; t < records_.size(); ++t) {
    const TileRecord& record = records_[t].value();
    index.parts.push_back({part_name(t), index.num_cells, record.num_cells, record.num_points,
                           record.num_vertices, record.num_foreign, record.num_rounds, record.part.num_bytes,
                           record.part.crc32});
    index.num_vertices += record.num_vertices;
    index.num_duplicates += record.num_duplicates;
    index.num_hidden += record.num_hidden;
    index.num_cells += record.num_cells;
    index.num_hull_facets += record.num_hull_facets;
    hash.add(record.hash);
    weighted_hash.add(record.weighted_hash);
    if (record.num_vertices == 0) continue;
    least = has_vertex ? std::min(least, record.least_weight) : record.least_weight;
    largest = has_vertex ? std::max(largest, record.largest_weight) : record.largest_weight;
    has_vertex = true;
  }
  const bool weights_differ = plan_.weighted && least != largest;
  index.hash = (weights_differ ? weighted_hash : hash).finish(plan_.dimension, plan_.affine_dimension);
  return index;
}

void WorkFolder::sync(std::size_t first, std::size_t last) const {
  for (std::size_t t = first; t < last; ++t)
    for (const std::string& file : {part_name(t), seams_name(t)}) sync_file(path_in(folder_, file));
}

void WorkFolder::close(const TilesIndex& index, bool vtu) {
  if (vtu) write_vtu_parts(folder_, index);
  sync_folder(folder_);
  write_tiles_index(folder_, index, plan_.fingerprint);
  remove_work(folder_, std::move(lock_));
}

TilesIndex WorkFolder::finish_all(std::uint64_t memory, bool vtu) {
  TilesIndex index = summary();
  index.num_hull_facets +=
      match_seams(work_, first_cells(index), memory, [&](std::size_t t, std::span<const std::int64_t> cells) {
        set_content_of_seams(index.parts[t],
                             write_seams(folder_, t, cells, static_cast<std::size_t>(plan_.lattice.rank())));
      });
  sync(0, records_.size());
  close(index, vtu);
  return index;
}

std::vector<std::int64_t> first_cells(const TilesIndex& index) {
  std::vector<std::int64_t> first;
  for (const TilePart& part : index.parts) first.push_back(part.first_cell);
  return first;
}

std::optional<TilesIndex> find_finished(const std::string& folder, const Plan& plan) {
  if (!has_tiles_index(folder)) return std::nullopt;
  std::pair<Plan, TilesIndex> found = read_finished(folder);
  if (found.first != plan)
    io::fail(Errc::invalid_argument,
             "{}: the folder holds finished tiles {}; make them again with resume off, or take "
             "another folder",
             io::output_name(folder), difference(found.first, plan));
  return std::move(found.second);
}

void write_missing_vtu(const std::string& folder, const TilesIndex& index) {
  if (!fs::exists(path_in(folder, "tiles.pvtu"))) write_vtu_parts(folder, index);
}

std::optional<Plan> find_plan(const std::string& folder) {
  if (has_tiles_index(folder)) return read_finished(folder).first;
  if (!has_plan(folder)) return std::nullopt;
  return read_plan(path_in(folder, work_name));
}

}  // namespace delone::tiles

namespace delone {

std::optional<UnfinishedTiles> find_unfinished_tiles(const std::string& folder) {
  if (tiles::has_tiles_index(folder)) return std::nullopt;
  const auto plan = tiles::find_plan(folder);
  if (!plan) return std::nullopt;
  const std::string work = tiles::path_in(folder, tiles::work_name);
  UnfinishedTiles unfinished{plan->num_tiles, 0};
  for (std::size_t t = 0; t < plan->num_tiles; ++t) {
    const auto record = tiles::find_record(work, t);
    if (record && tiles::has_size(tiles::path_in(folder, tiles::part_name(t)), record->part.num_bytes) &&
        tiles::has_size(tiles::path_in(work, tiles::seam_records_name(t)), record->seam_records.num_bytes))
      ++unfinished.num_finished;
  }
  return unfinished;
}

}  // namespace delone
