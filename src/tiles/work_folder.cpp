// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/work_folder.hpp"

#include "io/file.hpp"
#include "tiles/index_file.hpp"
#include "tiles/json_members.hpp"
#include "tiles/part_file.hpp"
#include "tiles/seams.hpp"
#include "tiles/vtu_parts.hpp"

#include <delone/io.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

namespace delone::tiles {

namespace fs = std::filesystem;

namespace {

constexpr const char* format_name = "delone plan of tiles";
constexpr std::int64_t version = 1;
constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max() - 1;
constexpr const char *work_name = "work", *plan_name = "plan.json";

std::string record_name(std::size_t t) { return fmt::format("tile-{:04}.json", t); }

[[noreturn]] void cannot_write(const std::string& path, const std::error_code& error) {
  io::fail(Errc::cannot_write, "{}: {}", io::output_name(path), error.message());
}

void write_plan(const std::string& work, const Plan& plan) {
  nlohmann::ordered_json json;
  json["format"] = format_name;
  json["version"] = version;
  json["dimension"] = plan.dimension;
  json["affine_dimension"] = plan.affine_dimension;
  json["weighted"] = plan.weighted;
  json["num_points"] = plan.num_points;
  json["num_tiles"] = plan.num_tiles;
  json["input"] = plan.fingerprint;
  write_text(path_in(work, plan_name), json.dump(1) + "\n");
}

Plan read_plan(const std::string& work) {
  const std::string path = path_in(work, plan_name), name = io::input_name(path);
  const nlohmann::json json = read_json(path);
  const JsonMembers members(json, name);
  members.require_format(format_name, version, "a plan of tiles");
  Plan plan;
  plan.dimension = static_cast<int>(members.number("dimension", 1, std::numeric_limits<int>::max() - 1));
  plan.affine_dimension = static_cast<int>(members.number("affine_dimension", -1, plan.dimension));
  plan.weighted = members.flag("weighted");
  plan.num_points = members.number("num_points", 0, most);
  plan.num_tiles =
      static_cast<std::size_t>(members.number("num_tiles", 0, std::numeric_limits<std::int32_t>::max()));
  plan.fingerprint = members.text("input");
  return plan;
}

/// In what two plans differ.
std::string difference(const Plan& found, const Plan& wanted) {
  if (found.dimension != wanted.dimension)
    return fmt::format("of points of dimension {}, not {}", found.dimension, wanted.dimension);
  if (found.num_points != wanted.num_points)
    return fmt::format("of {} points, not {}", found.num_points, wanted.num_points);
  if (found.weighted != wanted.weighted)
    return found.weighted ? "of points with weights" : "of points without weights";
  if (found.fingerprint != wanted.fingerprint) return "of other points";
  if (found.num_tiles != wanted.num_tiles)
    return fmt::format("in {} tiles, not {}", found.num_tiles, wanted.num_tiles);
  return "made by another plan";
}

bool is_of_parts(const std::string& name) {
  return name == index_name || name == work_name || name == "tiles.pvtu" ||
         name.starts_with(".delone-partial-") ||
         (name.starts_with("part-") &&
          (name.ends_with(".npz") || name.ends_with(".npy") || name.ends_with(".vtu")));
}

bool is_of_work(const std::string& name) {
  for (const char* const start : {"plan.json", "split.json", "lock", "points.bin", "pages.bin", "tile-",
                                  "seams-", "answers", "facets", ".delone-partial-"})
    if (name.starts_with(start)) return true;
  return false;
}

/// Names in the folder, and in its folder `work`, that no folder of tiles has.
std::vector<std::string> foreign_names(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (const std::string name = at->path().filename().string(); !is_of_parts(name)) names.push_back(name);
  const std::string work = path_in(folder, work_name);
  if (!error && fs::is_directory(work, error))
    for (fs::directory_iterator at(work, error), end; !error && at != end; at.increment(error))
      if (const std::string name = at->path().filename().string(); !is_of_work(name))
        names.push_back(path_in(work_name, name));
  if (error == std::errc::no_such_file_or_directory) error.clear();
  if (error) cannot_write(folder, error);
  std::sort(names.begin(), names.end());
  return names;
}

/// Removes what folders of tiles have, the plan and the index last.
void remove_parts(const std::string& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (is_of_parts(at->path().filename().string())) paths.push_back(at->path());
  std::sort(paths.begin(), paths.end(), [](const fs::path& a, const fs::path& b) {
    const bool last_a = a.filename() == index_name || a.filename() == work_name;
    const bool last_b = b.filename() == index_name || b.filename() == work_name;
    return last_a != last_b ? last_b : a < b;
  });
  for (const fs::path& path : paths)
    if (!error) fs::remove_all(path, error);
  if (error) cannot_write(folder, error);
}

bool has_plan(const std::string& folder) {
  std::error_code error;
  return fs::exists(fs::path(folder) / work_name / plan_name, error);
}

/// The record of a tile of the plan, if it is there, sound, and the files have the sizes that it names.
std::optional<TileRecord> find_record(const std::string& folder, const std::string& work, std::size_t t) {
  const auto has_size = [](const std::string& path, std::uint64_t expected) {
    std::error_code error;
    const std::uint64_t size = fs::file_size(path, error);
    return !error && size == expected;
  };
  const std::string path = path_in(work, record_name(t));
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  try {
    const nlohmann::json json = read_json(path);
    const JsonMembers members(json, io::input_name(path));
    TileRecord record;
    const auto count = [&](const char* member) { return members.number(member, 0, most); };
    record.num_cells = count("num_cells");
    record.num_points = count("num_points");
    record.num_seams = count("num_seams");
    record.num_vertices = count("num_vertices");
    record.num_duplicates = count("num_duplicates");
    record.num_hidden = count("num_hidden");
    record.num_hull_facets = count("num_hull_facets");
    record.num_foreign = count("num_foreign");
    record.num_rounds = count("num_rounds");
    record.least_weight = members.real("least_weight");
    record.largest_weight = members.real("largest_weight");
    record.hash = complex::HashAccumulator::of_words(members.words<5>("hash"));
    record.weighted_hash = complex::HashAccumulator::of_words(members.words<5>("weighted_hash"));
    record.part_bytes = static_cast<std::uint64_t>(count("part_bytes"));
    record.seam_bytes = static_cast<std::uint64_t>(count("seam_bytes"));
    if (!has_size(path_in(folder, part_name(t)), record.part_bytes) ||
        !has_size(path_in(work, seam_records_name(t)), record.seam_bytes))
      return std::nullopt;
    return record;
  } catch (const Error& damage) {
    if (damage.code() != Errc::bad_format) throw;
    return std::nullopt;  // the tile is made again
  }
}

}  // namespace

void require_name(const std::string& folder) {
  if (folder.empty()) throw Error(Errc::invalid_argument, "the name of the folder is empty");
}

WorkFolder::WorkFolder(std::string folder, const Plan& plan, bool resume, bool locked)
    : folder_(std::move(folder)), work_(path_in(folder_, work_name)), plan_(plan), records_(plan.num_tiles) {
  io::guarded(io::output_name(folder_), [&] { open(resume, locked); });
}

void WorkFolder::lock() {
  lock_ = std::make_unique<platform::FileLock>(path_in(work_, "lock").c_str());
  if (!lock_->is_held())
    io::fail(Errc::cannot_write, "{}: another process is making tiles in this folder",
             io::output_name(folder_));
}

void WorkFolder::open(bool resume, bool locked) {
  const std::string name = io::output_name(folder_);
  std::error_code error;
  const fs::file_status status = fs::status(folder_, error);
  error.clear();  // of a folder that does not exist yet
  if (fs::exists(status) && !fs::is_directory(status))
    io::fail(Errc::invalid_argument, "{}: not a folder; tiles need one", name);
  if (fs::exists(status) && !fs::is_empty(folder_, error) && !error) {
    const std::vector<std::string> foreign = foreign_names(folder_);
    const bool finished = has_tiles_index(folder_);
    if (!foreign.empty() || (!finished && !has_plan(folder_)))
      io::fail(Errc::invalid_argument, "{}: the folder is not empty{}; tiles need a folder of their own",
               name, foreign.empty() ? ", and holds no tiles" : ": it holds " + io::joined(foreign));
    if (std::error_code none; locked && fs::is_directory(work_, none)) lock();
    if (!resume) {
      if (std::string input; finished) read_tiles_index(folder_, input);  // throws if it is not an index
      if (DELONE_WINDOWS) lock_.reset();                                  // as in close()
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
    lock();
  }
  if (!has_plan(folder_)) write_plan(work_, plan_);
  for (std::size_t t = 0; t < records_.size(); ++t) records_[t] = find_record(folder_, work_, t);
}

std::size_t WorkFolder::num_finished() const {
  return static_cast<std::size_t>(
      std::count_if(records_.begin(), records_.end(), [](const auto& record) { return record.has_value(); }));
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
  record.part_bytes = write_part(folder_, t, tile);
  record.seam_bytes = append_seam_records(work_, t, tile);
  nlohmann::ordered_json json;
  json["num_cells"] = record.num_cells;
  json["num_points"] = record.num_points;
  json["num_seams"] = record.num_seams;
  json["num_vertices"] = record.num_vertices;
  json["num_duplicates"] = record.num_duplicates;
  json["num_hidden"] = record.num_hidden;
  json["num_hull_facets"] = record.num_hull_facets;
  json["num_foreign"] = record.num_foreign;
  json["num_rounds"] = record.num_rounds;
  json["least_weight"] = record.least_weight;
  json["largest_weight"] = record.largest_weight;
  json["hash"] = hex_text(record.hash.words());
  json["weighted_hash"] = hex_text(record.weighted_hash.words());
  json["part_bytes"] = record.part_bytes;
  json["seam_bytes"] = record.seam_bytes;
  write_text(path_in(work_, record_name(t)), json.dump(1) + "\n");
  records_[t] = record;
}

TilesIndex WorkFolder::summary() const {
  TilesIndex index;
  index.dimension = plan_.dimension;
  index.affine_dimension = plan_.affine_dimension;
  index.weighted = plan_.weighted;
  index.num_points = plan_.num_points;
  complex::HashAccumulator hash, weighted_hash;
  bool has_vertex = false;
  double least = 0, largest = 0;
  for (std::size_t t = 0; t < records_.size(); ++t) {
    const TileRecord& record = records_[t].value();
    index.parts.push_back({part_name(t), index.num_cells, record.num_cells, record.num_points,
                           record.num_vertices, record.num_foreign, record.num_rounds});
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

void WorkFolder::close(const TilesIndex& index, bool vtu) {
  if (vtu) write_vtu_parts(folder_, index);
  write_tiles_index(folder_, index, plan_.fingerprint);
  std::error_code error;
  if (DELONE_WINDOWS) lock_.reset();  // where the file of the lock cannot be removed while it is open
  fs::remove_all(work_, error);
  if (error) cannot_write(work_, error);
}

TilesIndex WorkFolder::finish_all(std::uint64_t memory, bool vtu) {
  TilesIndex index = summary();
  index.num_hull_facets += match_seams(folder_, work_, first_cells(index), memory);
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
  Plan found;
  TilesIndex index = read_tiles_index(folder, found.fingerprint);
  found.dimension = index.dimension;
  found.affine_dimension = index.affine_dimension;
  found.weighted = index.weighted;
  found.num_points = index.num_points;
  found.num_tiles = index.parts.size();
  if (found != plan)
    io::fail(Errc::invalid_argument,
             "{}: the folder holds finished tiles {}; make them again with resume off, or take "
             "another folder",
             io::output_name(folder), difference(found, plan));
  for (std::size_t i = 0; i < index.parts.size(); ++i)
    for (const std::string& file : {part_name(i), seams_name(i)})
      if (std::error_code error; !fs::exists(path_in(folder, file), error))
        io::fail(Errc::bad_format, "{}: {} is missing; make the tiles again with resume off",
                 io::output_name(folder), file);
  if (foreign_names(folder).empty()) {
    std::error_code error;
    fs::remove_all(fs::path(folder) / work_name, error);  // left by a call that ended just before that
  }
  return index;
}

void write_missing_vtu(const std::string& folder, const TilesIndex& index) {
  if (!fs::exists(path_in(folder, "tiles.pvtu"))) write_vtu_parts(folder, index);
}

std::optional<Plan> find_plan(const std::string& folder) {
  if (!has_plan(folder)) return std::nullopt;
  return read_plan(path_in(folder, work_name));
}

}  // namespace delone::tiles

namespace delone {

std::optional<UnfinishedTiles> find_unfinished_tiles(const std::string& folder) {
  const auto plan = tiles::find_plan(folder);
  if (!plan || tiles::has_tiles_index(folder)) return std::nullopt;
  UnfinishedTiles unfinished{plan->num_tiles, 0};
  for (std::size_t t = 0; t < plan->num_tiles; ++t)
    if (tiles::find_record(folder, tiles::path_in(folder, tiles::work_name), t)) ++unfinished.num_finished;
  return unfinished;
}

}  // namespace delone
