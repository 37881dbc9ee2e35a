// SPDX-License-Identifier: BSD-3-Clause
// From an input to a folder of parts: survey, cut, pages, one tile after the other, seams.
#include "base/platform.hpp"
#include "base/random.hpp"
#include "complex/canonical_hash.hpp"
#include "io/file.hpp"
#include "tiles/folder_names.hpp"
#include "tiles/making/periodic_input.hpp"
#include "tiles/making/periodic_part.hpp"
#include "tiles/making/periodic_surroundings.hpp"
#include "tiles/making/settle_hash.hpp"
#include "tiles/page_file.hpp"
#include "tiles/part_file.hpp"
#include "tiles/repair.hpp"
#include "tiles/survey.hpp"
#include "tiles/tile_plan.hpp"
#include "tiles/tile_triangulation.hpp"
#include "tiles/vtu_parts.hpp"
#include "tiles/work_folder.hpp"

#include <delone/progress.hpp>
#include <delone/tiles.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace delone {

namespace tiles {
namespace {

/// What the steps before and after the tiles take of all the time, about.
constexpr double share_of_survey = 0.04, share_of_pages = 0.1, share_of_seams = 0.04;
/// What reading a finished folder takes, and perhaps all that there is to do.
constexpr double share_of_finished = 0.5;

/// A tile that takes more memory than was forecast.
struct TileTooLarge {
  std::size_t tile;
};

/// Three quarters of what is free, or 2 GiB where that is not known.
std::uint64_t memory_to_use() {
  const std::uint64_t available = platform::available_memory();
  return available > 0 ? available / 4 * 3 : std::uint64_t{2} << 30;
}

/// One run, from the input to the index.
class Run {
 public:
  Run(PointStream& points, std::string folder, std::string fingerprint, const TilesOptions& options)
      : points_(points),
        folder_(std::move(folder)),
        fingerprint_(std::move(fingerprint)),
        options_(options),
        memory_(options.memory > 0 ? options.memory : memory_to_use()) {}

  TilesIndex run() {
    if (options_.vtu && is_periodic())
      throw Error(Errc::unsupported, "vtu is for tiles of sets that are not periodic");
    if (options_.vtu) require_vtu(folder_, points_.dimension() - (options_.weighted ? 1 : 0));
    {
      const ProgressScope scope(part_of_progress(0, share_of_survey));
      SurveyResult result = is_periodic() ? survey_periodic() : make_survey(points_, options_.weighted);
      survey_ = std::move(result.survey);
      sample_ = std::move(result.sample);
      model_ = {cells_per_point(sample_, survey_), ForeignShare::of_uniform_points(survey_.affine_dimension)};
    }
    std::size_t num_tiles = 0;  // not settled
    for (;;) try {
        return run_with(num_tiles);
      } catch (const TileTooLarge& too_large) {
        if (options_.tiles > 0 || repairs_ || forecast_.num_tiles >= survey_.num_points)
          io::fail(Errc::out_of_memory,
                   "tile {} of {} takes more than {} bytes; more memory is needed, or more tiles",
                   too_large.tile, forecast_.num_tiles, memory_);
        num_tiles = 2 * forecast_.num_tiles;
      }
  }

 private:
  bool is_periodic() const { return options_.lattice.rank() > 0; }
  /// Of the points in the box of the lattice.
  SurveyResult survey_periodic() {
    set_ = make_set(points_, options_);
    require_few_shifts(*set_);
    placed_.emplace(points_, *set_);
    PeriodicSurvey made = make_periodic_survey(*placed_, *set_);
    extent_.emplace(std::move(made.extent));
    finest_bit_ = made.finest_bit;
    return std::move(made.result);
  }

  /// The number of tiles: that of a folder of the same input, or as few as fit into memory.
  void settle_tiles(std::size_t num_tiles) {
    TilesOptions options = options_;
    if (options.tiles == 0) options.tiles = num_tiles;
    if (options.tiles == 0 && options_.resume)
      if (const auto plan = find_plan(folder_); plan && plan->fingerprint == fingerprint_)
        options.tiles = plan->num_tiles;
    const std::uint64_t memory = memory_for_tiles();
    forecast_ = plan_tiles(survey_, model_, options, memory);
    if (forecast_.num_tiles > 1 || is_periodic()) {
      model_.foreign = ForeignShare::of_sample(sample_, survey_.dimension);
      forecast_ = plan_tiles(survey_, model_, options, memory);
    }
    if (options.tiles == 0 && forecast_.bytes_per_tile > memory)
      io::fail(Errc::out_of_memory,
               "{} bytes of memory are not enough: {} tiles would take {} each, and more tiles not less",
               memory_, forecast_.num_tiles, forecast_.bytes_per_tile);
  }
  /// Without what is there already, the boxes of all pages, the cache of pages, and a reserve.
  std::uint64_t memory_for_tiles() const {
    const std::uint64_t pages = survey_.num_points / pages::points_per_page(survey_.num_points) + 1,
                        per_page = 60 * static_cast<std::uint64_t>(survey_.dimension) + 40,
                        used = platform::resident_memory() + pages * per_page + cache_bytes() + memory_ / 20;
    if (used >= memory_)
      io::fail(Errc::out_of_memory,
               "{} bytes of memory are not enough for tiles of {} points: {} are in use before the first one",
               memory_, survey_.num_points, used);
    return memory_ - used;
  }
  std::size_t cache_bytes() const {
    return static_cast<std::size_t>(std::min<std::uint64_t>(memory_ / 16, std::uint64_t{256} << 20));
  }

  TilesIndex run_with(std::size_t num_tiles) {
    settle_tiles(num_tiles);
    const SplitTree tree = make_split_tree(sample_, survey_.dimension, forecast_.num_tiles);
    forecast_.num_tiles = static_cast<std::size_t>(tree.num_tiles);
    if (options_.forecast && !std::exchange(has_told_, true) && !options_.forecast(forecast_))
      throw Error(Errc::cancelled, "cancelled");
    Plan plan;
    plan.dimension = survey_.dimension;
    plan.affine_dimension = survey_.affine_dimension;
    plan.weighted = survey_.weighted;
    if (set_) {
      plan.lattice = lattice_of(*set_);
      plan.unit = set_->unit;
    }
    plan.num_points = static_cast<std::int64_t>(survey_.num_points);
    plan.num_tiles = forecast_.num_tiles;
    plan.fingerprint = fingerprint_;
    if (options_.resume)
      if (auto index = find_finished(folder_, plan)) {
        repair(plan, *index, tree);
        if (options_.vtu) write_missing_vtu(folder_, *index);
        return std::move(*index);
      }
    WorkFolder folder(folder_, plan, options_.resume && num_tiles == 0);
    {
      const ProgressScope scope(part_of_progress(share_of_survey, share_of_pages));
      tell(folder.verify(0, plan.num_tiles));
    }
    const PageTable table = make_pages(tree, folder.work());
    make_parts(folder, table);
    const ProgressScope scope(part_of_progress(1 - share_of_seams, 1));
    if (set_) settle_hash(folder);
    return folder.finish_all(memory_ / 4, options_.vtu);
  }

  void settle_hash(WorkFolder& folder) {
    const std::size_t n = folder.plan().num_tiles;
    const int finest =
        has_hidden_points(folder, 0, n) ? finest_bit_of_vertices(*set_, folder, 0, n) : finest_bit_;
    settle_hashes(*set_, finest_bit_, finest, folder, 0, n);
  }

  /// Makes what is damaged in a finished folder again.
  void repair(const Plan& plan, const TilesIndex& index, const SplitTree& tree) {
    std::vector<DamagedFile> damaged;
    {
      const ProgressScope scope(part_of_progress(share_of_survey, share_of_finished));
      damaged = find_damaged_files(folder_, index, 0, index.parts.size());
    }
    if (damaged.empty()) return remove_leftover_work(folder_);
    tell(texts_of(damaged));
    begin_ = share_of_finished;
    repairs_ = true;
    RepairFolder folder(folder_, plan, index, damaged);
    if (folder.has_damaged_parts()) make_parts(folder, make_pages(tree, folder.work()));
    const ProgressScope scope(part_of_progress(1 - share_of_seams, 1));
    folder.close(memory_ / 4);
  }

  /// Says what is damaged, before it is made again.
  void tell(const std::vector<std::string>& damage) const {
    if (!damage.empty() && options_.damage && !options_.damage(damage))
      throw Error(Errc::cancelled, "cancelled");
  }

  PageTable make_pages(const SplitTree& tree, const std::string& work) {
    const ProgressScope scope(part_of_progress(share_of_survey, share_of_pages));
    pages_path_ = path_in(work, "points.bin");
    const std::string table_path = path_in(work, "pages.bin");
    if (auto table = find_page_table(table_path, pages_path_)) return std::move(*table);
    PageFileOptions how;
    how.memory = memory_;
    PageTable table = make_page_file(placed_ ? static_cast<PointStream&>(*placed_) : points_, survey_, tree,
                                     pages_path_, how);
    write_page_table(table_path, table);
    return table;
  }

  /// In a WorkFolder or RepairFolder.
  void make_parts(auto& folder, const PageTable& table) {
    const PageTree tree(table);
    PageFile pages(pages_path_, table, cache_bytes());
    for (std::size_t t = 0; t < table.tiles.size(); ++t) {
      if (folder.finished(t)) continue;
      const double start = share_of_pages,
                   step = (1 - share_of_pages - share_of_seams) / static_cast<double>(table.tiles.size());
      TileOptions how;
      how.threads = options_.threads;
      const auto progress =
          part_of_progress(start + step * static_cast<double>(t), start + step * static_cast<double>(t + 1));
      how.progress = [&](double fraction) {
        if (platform::resident_memory() > memory_ - memory_ / 32) throw TileTooLarge{t};
        return progress(fraction);
      };
      const ProgressScope scope(how.progress);
      FinishedTile finished;
      {
        TileTriangulation tile(
            survey_, tree, pages, t, pages.read_tile_points(t), how,
            set_ ? periodic_surroundings(*set_, *extent_, survey_, tree, pages, t) : nullptr);
        while (tile.advance()) {
        }
        finished = tile.finish();
        if (set_) finish_periodic_part(*set_, finest_bit_, finished);
      }
      pages.drop();
      folder.finish(t, finished);
    }
  }

  /// The progress function of a part of the work, which is from `low` to `high` of all.
  std::function<bool(double)> part_of_progress(double low, double high) {
    return [this, low, high](double fraction) {
      done_ = std::max(done_, begin_ + (1 - begin_) * (low + (high - low) * fraction));
      return !options_.progress || options_.progress(done_);
    };
  }

  PointStream& points_;
  const std::string folder_, fingerprint_;
  const TilesOptions& options_;
  const std::uint64_t memory_;
  std::optional<periodic::PeriodicSet> set_;  // what follows is of a periodic set, too
  std::optional<PlacedPoints> placed_;
  std::optional<periodic::Extent> extent_;
  int finest_bit_ = 0;  // of lattice and points
  Survey survey_;
  std::vector<double> sample_;
  SetModel model_;
  TilesForecast forecast_;
  double begin_ = 0, done_ = 0;  ///< of the progress: what steps are fractions of, and what is told
  bool has_told_ = false, repairs_ = false;
  std::string pages_path_;
};

/// What tells rows from others.
std::string hash_of_rows(PointStream& points, const TilesOptions& options) {
  const ProgressScope scope(options.progress);
  std::uint64_t hash = 0;
  each_point(points, [&](const double* row) {
    hash = random::mix(hash ^ complex::point_tag(row, points.dimension()).low);
  });
  return fmt::format("rows of {} numbers, of hash {:016x}", points.dimension(), hash);
}

/// The folder that a folder is in, or will be.
std::string folder_above(const std::string& folder) {
  namespace fs = std::filesystem;
  const fs::path path(folder);
  const fs::path above = (path.has_filename() ? path : path.parent_path()).parent_path();
  return above.empty() ? "." : above.string();
}

}  // namespace
}  // namespace tiles

TilesIndex make_tiles(const std::string& input, const std::string& folder, const TilesOptions& options) {
  return io::guarded(io::input_name(input), [&] {
    tiles::require_name(folder);
    if (!options.weighted && !options.weights.empty())
      throw Error(Errc::invalid_argument, "a column of weights without weights");
    std::unique_ptr<tiles::PointStream> points;
    {
      const ProgressScope scope(options.progress);
      tiles::StreamOptions how;
      how.format = options.format;
      how.dimension = options.columns;
      how.columns = options.coordinates;
      how.last_column = options.weights;
      how.scratch_folder = tiles::folder_above(folder);
      points = tiles::open_point_stream(input, how);
    }
    return tiles::Run(*points, folder, tiles::hash_of_rows(*points, options), options).run();
  });
}

TilesIndex make_tiles(PointsView rows, const std::string& folder, const TilesOptions& options) {
  return io::guarded(io::output_name(folder), [&] {
    tiles::require_name(folder);
    const auto points = tiles::stream_of(rows);
    return tiles::Run(*points, folder, tiles::hash_of_rows(*points, options), options).run();
  });
}

}  // namespace delone
