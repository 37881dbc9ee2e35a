// SPDX-License-Identifier: BSD-3-Clause
// From an input to a folder of parts by all ranks: survey, cut, points to the ranks of their tiles, tiles in
// rounds of questions and pages, seams.
#include "base/platform.hpp"
#include "base/stopwatch.hpp"
#include "io/file.hpp"
#include "owned_pages.hpp"
#include "pages/page_tree.hpp"
#include "periodic/extent.hpp"
#include "ranks.hpp"
#include "remote_pages.hpp"
#include "seam_exchange.hpp"
#include "share.hpp"
#include "split_tree_file.hpp"
#include "tiles/folder_names.hpp"
#include "tiles/index_file.hpp"
#include "tiles/making/periodic_input.hpp"
#include "tiles/making/periodic_part.hpp"
#include "tiles/making/periodic_surroundings.hpp"
#include "tiles/making/settle_hash.hpp"
#include "tiles/part_file.hpp"
#include "tiles/repair.hpp"
#include "tiles/tile_plan.hpp"
#include "tiles/tile_triangulation.hpp"
#include "tiles/vtu_parts.hpp"
#include "tiles/work_folder.hpp"
#include "whole_survey.hpp"

#include <fmt/ranges.h>
#include <delone/mpi/tiles.hpp>
#include <delone/progress.hpp>

#include <algorithm>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace delone::mpi {

namespace {

/// What the steps before and after the tiles take of all the time, about.
constexpr double share_of_survey = 0.04, share_of_points = 0.1, share_of_seams = 0.04;

class Run {
 public:
  Run(Ranks& ranks, Share& share, std::string folder, const TilesOptions& options, RankEffort& effort)
      : ranks_(ranks), share_(share), folder_name_(std::move(folder)), options_(options), effort_(effort) {
    const auto neighbors = static_cast<std::uint64_t>(ranks.num_neighbors());
    memory_ = options.memory > 0 ? options.memory : platform::available_memory() / neighbors / 4 * 3;
  }

  TilesIndex run() {
    const internal::Stopwatch all;
    internal::Stopwatch step;
    {
      const ProgressScope scope(part_of_progress(0, share_of_survey));
      whole_ = survey_whole(share_, options_, ranks_);
    }
    tiles::SplitTree tree = settle_tiles();
    if (auto index = open_folder(tree)) return std::move(*index);
    std::optional<OwnedPages> pages;
    {
      const ProgressScope scope(part_of_progress(share_of_survey, share_of_points));
      tiles::PointStream& points =
          whole_.placed_points ? static_cast<tiles::PointStream&>(*whole_.placed_points) : share_;
      pages.emplace(points, share_, whole_.first_row, survey(), tree, ranks_, memory_);
      settle_starting_points(*pages, tree);
    }
    effort_.reading = step.restart();
    make_parts(*pages);
    step.restart();
    TilesIndex index = finish(pages->owners());
    effort_.writing += step.seconds();
    effort_.num_messages = ranks_.num_messages();
    effort_.bytes_sent = ranks_.bytes_sent();
    effort_.bytes_received = ranks_.bytes_received();
    effort_.total = all.seconds();
    return index;
  }

 private:
  const tiles::Survey& survey() const { return whole_.result.survey; }
  const WholePeriod* period() const { return whole_.period.get(); }

  /// What the folder is to become.
  tiles::Plan plan(std::size_t num_tiles) const {
    tiles::Plan plan;
    plan.dimension = survey().dimension;
    plan.affine_dimension = survey().affine_dimension;
    plan.weighted = survey().weighted;
    if (period()) {
      plan.lattice = tiles::lattice_of(period()->set);
      plan.unit = period()->set.unit;
    }
    plan.num_points = static_cast<std::int64_t>(survey().num_points);
    plan.num_tiles = num_tiles;
    plan.fingerprint = whole_.fingerprint;
    return plan;
  }

  /// The cut of an unfinished folder of the same points, or as few tiles as fit into memory, a multiple of
  /// the number of ranks.
  tiles::SplitTree settle_tiles() {
    std::optional<tiles::SplitTree> tree;
    ranks_.together([&] {
      if (ranks_.rank() != 0 || !options_.resume) return;
      const auto found = tiles::find_plan(folder_name_);
      if (!found || *found != plan(found->num_tiles) ||
          (options_.tiles > 0 && options_.tiles != found->num_tiles))
        return;
      tree = read_split_tree(tiles::path_in(folder_name_, "work"), found->dimension, found->num_tiles);
    });
    const bool is_found = ranks_.max(std::int64_t{tree ? 1 : 0}) == 1;
    TilesOptions options = options_;
    if (is_found) {
      if (!tree) tree.emplace();
      tree->dimension = survey().dimension;
      ranks_.broadcast(tree->axes);
      ranks_.broadcast(tree->splitters);
      ranks_.broadcast(tree->below);
      ranks_.broadcast(tree->beyond);
      tree->num_tiles = static_cast<std::int32_t>(tree->axes.size() + 1);
      options.tiles = static_cast<std::size_t>(tree->num_tiles);
    }
    ranks_.together([&] { forecast(options); });
    if (!is_found) {
      const auto num_tiles = ranks_.max(static_cast<std::int64_t>(forecast_.num_tiles));
      tree = tiles::make_split_tree(whole_.result.sample, survey().dimension,
                                    static_cast<std::size_t>(num_tiles));
    }
    forecast_.num_tiles = static_cast<std::size_t>(tree->num_tiles);
    whole_.result.sample = {};
    ranks_.together([&] {
      if (options_.forecast && !options_.forecast(forecast_)) throw Error(Errc::cancelled, "cancelled");
    });
    return std::move(*tree);
  }
  /// So many tiles as options say, or as few as fit into memory, a multiple of the number of ranks. The share
  /// of foreign points is measured only where it matters, as this takes some tenths of a second.
  void forecast(TilesOptions options) {
    const auto p = static_cast<std::size_t>(ranks_.size());
    const std::uint64_t memory = memory_for_tiles();
    const auto settle = [&](const tiles::SetModel& model) {
      forecast_ = tiles::plan_tiles(survey(), model, options, memory);
      if (options.tiles > 0) return;
      TilesOptions rounded = options;
      rounded.tiles = (forecast_.num_tiles + p - 1) / p * p;
      forecast_ = tiles::plan_tiles(survey(), model, rounded, memory);
    };
    if (options.tiles > 0 && !options_.forecast) return settle({});
    tiles::SetModel model{tiles::cells_per_point(whole_.result.sample, survey()),
                          tiles::ForeignShare::of_uniform_points(survey().affine_dimension)};
    settle(model);
    if (!options_.forecast && forecast_.num_tiles == p && forecast_.bytes_per_tile < memory / 4) return;
    model.foreign = tiles::ForeignShare::of_sample(whole_.result.sample, survey().dimension);
    settle(model);
  }
  /// Without what is there already, the points of the rank in their pages, and the boxes of all pages.
  std::uint64_t memory_for_tiles() const {
    const auto d = static_cast<std::uint64_t>(survey().dimension),
               p = static_cast<std::uint64_t>(ranks_.size());
    const std::uint64_t pages = survey().num_points / pages::points_per_page(survey().num_points) + 1,
                        used = platform::resident_memory() + pages * (60 * d + 56) +
                               survey().num_points / p * 8 * (d + 2);
    return used + memory_ / 10 < memory_ ? memory_ - used - memory_ / 20 : memory_ / 10;
  }

  /// Rank 0 makes the folder, or finds it finished: then the index.
  std::optional<TilesIndex> open_folder(const tiles::SplitTree& tree) {
    const tiles::Plan plan = this->plan(forecast_.num_tiles);
    std::optional<TilesIndex> index;
    const auto open = [&](bool resume) { folder_.emplace(folder_name_, plan, resume, ranks_.rank() == 0); };
    ranks_.together([&] {
      if (ranks_.rank() != 0) return;
      if (options_.resume) index = tiles::find_finished(folder_name_, plan);
      if (index) {
        if (options_.vtu) tiles::write_missing_vtu(folder_name_, *index);
        return;
      }
      open(options_.resume);
      if (!read_split_tree(folder_->work(), plan.dimension, plan.num_tiles))
        write_split_tree(folder_->work(), tree);
    });
    const bool is_finished = ranks_.max(std::int64_t{index ? 1 : 0}) == 1;
    ranks_.together([&] {
      if (ranks_.rank() != 0) {
        if (is_finished)
          index = read_tiles_index(folder_name_);
        else
          open(true);
      }
      if (index) require_undamaged(*index);
    });
    ranks_.together([&] {
      if (index && ranks_.rank() == 0) tiles::remove_leftover_work(folder_name_);
    });
    return index;
  }

  /// Each rank reads its share of the files of a finished folder. Parts cannot be made again one by one, as
  /// the cut into tiles depends on the number of ranks, and is not kept.
  void require_undamaged(const TilesIndex& index) {
    const auto p = static_cast<std::size_t>(ranks_.size()), rank = static_cast<std::size_t>(ranks_.rank());
    const std::size_t n = index.parts.size();
    const ProgressScope scope(part_of_progress(share_of_survey, 1));
    const auto damaged = tiles::find_damaged_files(folder_name_, index, n * rank / p, n * (rank + 1) / p);
    if (!damaged.empty())
      io::fail(Errc::bad_format, "{}; make the tiles again with resume off",
               fmt::join(tiles::texts_of(damaged), "; "));
  }

  /// The points that every tile begins with get their rows.
  void settle_starting_points(const OwnedPages& pages, const tiles::SplitTree& tree) {
    tiles::Survey& survey = whole_.result.survey;
    pages.settle(survey.landmarks, survey.landmark_rows, tree, ranks_);
    if (!period()) return;
    std::vector<periodic::Extent::Extreme*> frame;
    for (periodic::Extent::Extreme& one : whole_.period->extent.frame_points())
      if (one.row >= 0) frame.push_back(&one);
    std::vector<double> points;
    std::vector<std::int64_t> rows;
    for (const auto* one : frame) points.insert(points.end(), one->point.begin(), one->point.end());
    pages.settle(points, rows, tree, ranks_);
    const std::size_t width = period()->set.row_size();
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const auto first = points.begin() + static_cast<std::ptrdiff_t>(i * width);
      *frame[i] = {rows[i], {first, first + static_cast<std::ptrdiff_t>(width)}};
    }
  }

  /// Each rank makes its tiles one after the other; in a wave all ranks have one tile, or none.
  void make_parts(const OwnedPages& pages) {
    const pages::PageTree tree(pages.table());
    RemotePages source(pages, period() ? &period()->set.period : nullptr);
    const auto rank = static_cast<std::size_t>(ranks_.rank());
    std::vector<std::size_t> own;
    for (std::size_t t = pages.owners().first_tile(rank); t < pages.owners().first_tile(rank + 1); ++t) {
      effort_.num_points +=
          static_cast<std::int64_t>(pages.table().first_point[pages.table().tiles[t].last_page] -
                                    pages.table().first_point[pages.table().tiles[t].first_page]);
    }
    ranks_.together([&] {
      const ProgressScope scope(part_of_progress(share_of_points, share_of_points));
      const std::size_t first = pages.owners().first_tile(rank), last = pages.owners().first_tile(rank + 1);
      const auto damage = folder_->verify(first, last);
      if (!damage.empty() && options_.damage && !options_.damage(damage))
        throw Error(Errc::cancelled, "cancelled");
      for (std::size_t t = first; t < last; ++t)
        if (!folder_->finished(t)) own.push_back(t);
    });
    const auto waves = static_cast<std::size_t>(ranks_.max(static_cast<std::int64_t>(own.size())));
    for (std::size_t wave = 0; wave < waves; ++wave) {
      const double start = share_of_points,
                   step = (1 - share_of_points - share_of_seams) / static_cast<double>(waves);
      const auto progress = part_of_progress(start + step * static_cast<double>(wave),
                                             start + step * static_cast<double>(wave + 1));
      make_part(wave < own.size() ? std::optional(own[wave]) : std::nullopt, pages, tree, source, progress);
      source.drop();
    }
  }

  void make_part(std::optional<std::size_t> number, const OwnedPages& pages, const pages::PageTree& tree,
                 RemotePages& source, const std::function<bool(double)>& progress) {
    tiles::TileOptions how;
    how.threads = options_.threads;
    how.progress = [&](double fraction) {
      if (platform::resident_memory() > memory_)
        io::fail(Errc::out_of_memory,
                 "tile {} of {} takes more than {} bytes; more memory is needed, or more tiles", *number,
                 pages.table().tiles.size(), memory_);
      return progress(fraction);
    };
    const ProgressScope scope(how.progress);
    std::optional<tiles::TileTriangulation> tile;
    internal::Stopwatch step;
    if (number) source.want_near(*number);
    effort_.num_pages_received += static_cast<std::int64_t>(source.exchange(ranks_));
    effort_.exchanging += step.restart();
    for (bool has_more = number.has_value();;) {
      std::exception_ptr failure;
      try {
        if (has_more && !tile)
          tile.emplace(survey(), tree, source, *number, pages.points(*number), how,
                       period() ? tiles::periodic_surroundings(period()->set, period()->extent, survey(),
                                                               tree, source, *number)
                                : nullptr);
        if (has_more) has_more = tile->advance();
      } catch (...) {
        failure = std::current_exception();
      }
      step.restart();
      // Whether a rank has failed, and whether one has more to do.
      const auto state = ranks_.max({failure ? 1 : 0, has_more ? 1 : 0});
      effort_.waiting += step.restart();
      if (state[0] != 0) ranks_.raise(failure);
      if (state[1] == 0) break;
      ++effort_.num_rounds;
      effort_.num_pages_received += static_cast<std::int64_t>(source.exchange(ranks_));
      effort_.exchanging += step.restart();
    }
    ranks_.together([&] {
      step.restart();
      if (!tile) return;
      ++effort_.num_tiles;
      effort_.num_foreign += static_cast<std::int64_t>(tile->num_foreign());
      effort_.inserting += tile->effort().insert_seconds;
      effort_.asking += tile->effort().ask_seconds;
      tiles::FinishedTile finished = tile->finish();
      tile.reset();
      if (period()) tiles::finish_periodic_part(period()->set, period()->finest_bit, finished);
      folder_->finish(*number, finished);
      effort_.writing += step.restart();
    });
  }

  /// Of the own tiles. Collective.
  void settle_hash(std::size_t first, std::size_t last) {
    const periodic::PeriodicSet& set = period()->set;
    int finest = period()->finest_bit;
    const bool has_hidden = tiles::has_hidden_points(*folder_, first, last);
    if (ranks_.max(std::int64_t{has_hidden ? 1 : 0}) == 1) {
      ranks_.together([&] { finest = tiles::finest_bit_of_vertices(set, *folder_, first, last); });
      finest = static_cast<int>(ranks_.min(finest));
    }
    ranks_.together([&] { tiles::settle_hashes(set, period()->finest_bit, finest, *folder_, first, last); });
  }

  /// All ranks know all records; seams; rank 0 writes the index.
  TilesIndex finish(const TileOwners& owners) {
    const ProgressScope scope(part_of_progress(1 - share_of_seams, 1));
    const auto rank = static_cast<std::size_t>(ranks_.rank());
    if (period()) settle_hash(owners.first_tile(rank), owners.first_tile(rank + 1));
    std::vector<tiles::TileRecord> records;
    for (std::size_t t = owners.first_tile(rank); t < owners.first_tile(rank + 1); ++t)
      records.push_back(folder_->finished(t).value());
    records = ranks_.gather(records);
    for (std::size_t t = 0; t < records.size(); ++t) folder_->know(t, records[t]);
    TilesIndex index = folder_->summary();
    std::vector<io::FileContent> seams;
    index.num_hull_facets +=
        match_seams(folder_->work(), tiles::first_cells(index), owners, ranks_,
                    [&](std::size_t t, std::span<const std::int64_t> cells) {
                      seams.push_back(tiles::write_seams(folder_name_, t, cells,
                                                         static_cast<std::size_t>(index.lattice.rank())));
                    });
    seams = ranks_.gather(seams);
    for (std::size_t t = 0; t < seams.size(); ++t) tiles::set_content_of_seams(index.parts[t], seams[t]);
    ranks_.together([&] { folder_->sync(owners.first_tile(rank), owners.first_tile(rank + 1)); });
    ranks_.together([&] {
      if (ranks_.rank() == 0) folder_->close(index, options_.vtu);
    });
    return index;
  }

  /// The progress function of a part of the work, which is from `low` to `high` of all.
  std::function<bool(double)> part_of_progress(double low, double high) {
    return [this, low, high](double fraction) {
      done_ = std::max(done_, low + (high - low) * fraction);
      return !options_.progress || options_.progress(done_);
    };
  }

  Ranks& ranks_;
  Share& share_;
  const std::string folder_name_;
  const TilesOptions& options_;
  RankEffort& effort_;
  std::uint64_t memory_ = 0;
  WholeSurvey whole_;
  TilesForecast forecast_;
  std::optional<tiles::WorkFolder> folder_;
  double done_ = 0;
};

/// Ranks with different lattices would wait for each other, or make parts that do not fit.
void require_equal_lattice(const TilesOptions& options, const Ranks& ranks) {
  std::vector<double> mine(options.lattice.vectors);
  mine.push_back(options.lattice.dimension);
  mine.push_back(options.unit);
  std::vector<double> first = mine;
  ranks.broadcast(first);
  ranks.together([&] {
    if (first.size() != mine.size() ||
        std::memcmp(first.data(), mine.data(), mine.size() * sizeof(double)) != 0)
      throw Error(Errc::invalid_argument, "the lattice, or its unit, is not that of rank 0");
  });
}

template <class MakeShare>
TilesIndex make(MPI_Comm comm, const std::string& folder, const TilesOptions& options, RankEffort* effort,
                const MakeShare& make_share) {
  Ranks ranks(comm);
  return ranks.guarded([&] {
    require_equal_lattice(options, ranks);
    std::optional<Share> share;
    ranks.together([&] {
      tiles::require_name(folder);
      if (options.vtu && options.lattice.rank() > 0)
        throw Error(Errc::unsupported, "vtu is for tiles of sets that are not periodic");
      make_share(ranks, share);
      if (ranks.rank() != 0) return;
      if (options.vtu) tiles::require_vtu(folder, share->dimension() - (options.weighted ? 1 : 0));
    });
    RankEffort unused;
    RankEffort& to = effort ? *effort : unused;
    to = {};
    return Run(ranks, *share, folder, options, to).run();
  });
}

}  // namespace

TilesIndex make_tiles(const std::vector<std::string>& inputs, const std::string& folder, MPI_Comm ranks,
                      const TilesOptions& options, RankEffort* effort) {
  return make(ranks, folder, options, effort, [&](const Ranks& all, std::optional<Share>& share) {
    share.emplace(files_of(inputs), all, options);
  });
}

TilesIndex make_tiles(PointsView rows_of_rank, const std::string& folder, MPI_Comm ranks,
                      const TilesOptions& options, RankEffort* effort) {
  return make(ranks, folder, options, effort,
              [&](const Ranks&, std::optional<Share>& share) { share.emplace(rows_of_rank); });
}

}  // namespace delone::mpi
