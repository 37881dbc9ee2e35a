// SPDX-License-Identifier: BSD-3-Clause
#include "whole_survey.hpp"

#include "base/random.hpp"
#include "complex/canonical_hash.hpp"
#include "io/file.hpp"
#include "periodic/periodic_hash.hpp"
#include "tiles/making/periodic_surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace delone::mpi {

namespace {

/// Passes the rows of a share on, and adds up their hashes h: Σh and Σ(number of the row)·h. Once it is known
/// how many rows are before the share, these tell its part of the sums over all rows.
class HashingStream final : public tiles::PointStream {
 public:
  explicit HashingStream(Share& share) : share_(share) {}
  int dimension() const override { return share_.dimension(); }
  std::optional<std::uint64_t> size_hint() const override { return share_.size_hint(); }
  void rewind() override {
    share_.rewind();
    sum_ = weighted_sum_ = num_rows_ = 0;
  }
  bool next(std::vector<double>& rows) override {
    if (!share_.next(rows)) return false;
    const auto width = static_cast<std::size_t>(dimension());
    const auto first = static_cast<std::uint64_t>(share_.first_row(0));
    for (std::size_t i = 0; i < rows.size() / width; ++i) {
      const std::uint64_t hash = complex::point_tag(&rows[i * width], dimension()).low;
      sum_ += hash;
      weighted_sum_ += (first + i) * hash;
      ++num_rows_;
    }
    return true;
  }
  std::uint64_t num_rows() const { return num_rows_; }
  std::uint64_t hash(std::int64_t offset) const {
    return sum_ + 3 * weighted_sum_ + (share_.is_dealt() ? 0 : 3 * static_cast<std::uint64_t>(offset) * sum_);
  }

 private:
  Share& share_;
  std::uint64_t sum_ = 0, weighted_sum_ = 0, num_rows_ = 0;
};

/// Puts `count` rows in front that are chosen uniformly at random, and forgets the others.
void choose_rows(std::vector<double>& rows, std::size_t width, std::size_t count, random::Generator random) {
  const std::size_t n = rows.size() / width;
  count = std::min(count, n);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = i + static_cast<std::size_t>(random.below(n - i));
    if (j != i)
      std::swap_ranges(rows.begin() + static_cast<std::ptrdiff_t>(i * width),
                       rows.begin() + static_cast<std::ptrdiff_t>((i + 1) * width),
                       rows.begin() + static_cast<std::ptrdiff_t>(j * width));
  }
  rows.resize(count * width);
}

/// The length of the rows of all ranks.
int agreed_width(const Share& share, const Ranks& ranks, bool weighted) {
  const int mine = share.dimension();
  const auto width = static_cast<int>(ranks.max(std::int64_t{mine}));
  ranks.together([&] {
    if (mine != 0 && mine != width)
      io::fail(Errc::bad_dimension, "rows have {} numbers, those of another rank {}", mine, width);
    if (width < (weighted ? 2 : 1))
      throw Error(Errc::bad_dimension, weighted && width == 1
                                           ? "rows of points with weights need two numbers at least"
                                           : "no rank has points, so that their dimension is not known");
  });
  return width;
}

/// The set of the points of all ranks, which are all read, and the same grid at each.
std::unique_ptr<WholePeriod> agreed_period(HashingStream& stream, int width, const TilesOptions& options,
                                           const Ranks& ranks) {
  periodic::SetInput input;
  std::vector<double> free;
  ranks.together([&] {
    input = tiles::input_of_set(width, options);
    free.assign(input.dimension, 0.0);
    if (stream.dimension() == 0) return;
    free = periodic::free_extent(
        input, [&](const std::function<void(const double*)>& visit) { tiles::each_point(stream, visit); });
    if (options.lattice.rank() == options.lattice.dimension) tiles::each_point(stream, [](const double*) {});
  });
  for (double& bound : free) bound = ranks.max_real(bound);
  std::unique_ptr<WholePeriod> period;
  ranks.together([&] {
    period = std::make_unique<WholePeriod>(periodic::make_set_without_rows(input, free));
    tiles::require_few_shifts(period->set);
  });
  return period;
}

/// The survey of the share, in the box of the lattice, and the extent of the points of all ranks.
tiles::SurveyResult survey_in_box(WholeSurvey& whole, Share& share, const Ranks& ranks) {
  WholePeriod& period = *whole.period;
  whole.placed_points = std::make_unique<tiles::PlacedPoints>(
      share, period.set, [&share, first = whole.first_row] { return share.first_row(first); });
  tiles::SurveyResult mine;
  std::vector<double> witnesses;
  period.finest_bit = periodic::no_grid;
  ranks.together([&] {
    if (share.dimension() == 0) return;
    tiles::PeriodicSurvey made =
        tiles::make_periodic_survey(*whole.placed_points, period.set, tiles::default_sample_size,
                                    static_cast<std::uint64_t>(ranks.rank()));
    mine = std::move(made.result);
    witnesses = made.extent.witnesses();
    period.finest_bit = made.finest_bit;
  });
  period.finest_bit = static_cast<int>(ranks.min(period.finest_bit));
  witnesses = ranks.gather(witnesses);
  std::int64_t number = 0;
  for (std::size_t at = 0; at < witnesses.size(); at += period.set.row_size())
    period.extent.add(&witnesses[at], number++);
  return mine;
}

}  // namespace

WholeSurvey survey_whole(Share& share, const TilesOptions& options, const Ranks& ranks) {
  const bool weighted = options.weighted;
  const int width = agreed_width(share, ranks, weighted), dimension = width - (weighted ? 1 : 0);
  const auto d = static_cast<std::size_t>(dimension);
  const auto seed = static_cast<std::uint64_t>(ranks.rank());
  HashingStream stream(share);
  WholeSurvey whole;
  tiles::SurveyResult mine;
  if (options.lattice.rank() > 0)
    whole.period = agreed_period(stream, width, options, ranks);
  else
    ranks.together([&] {
      if (share.dimension() > 0)
        mine = tiles::make_survey(stream, weighted, tiles::default_sample_size, seed);
    });
  const auto n = static_cast<std::int64_t>(stream.num_rows()), all = ranks.sum(n);
  whole.first_row = ranks.sum_before(n);
  whole.fingerprint = fmt::format("rows of {} numbers, of hash {:016x}, on ranks", width,
                                  ranks.sum_of_words(stream.hash(whole.first_row)));
  if (whole.period) mine = survey_in_box(whole, share, ranks);

  // Each rank gives the same share of its points to the sample.
  const double share_of_sample = std::min(
      static_cast<double>(tiles::default_sample_size) / static_cast<double>(std::max<std::int64_t>(all, 1)),
      1.0);
  choose_rows(mine.sample, d, static_cast<std::size_t>(std::ceil(share_of_sample * static_cast<double>(n))),
              random::Generator(seed));
  std::vector<double> sample = ranks.gather(mine.sample);
  choose_rows(sample, d, sample.size() / d, random::Generator(0));

  // The affine hull of all points is that of the landmarks of all ranks, and the extreme points are among
  // them.
  const std::vector<double> landmarks = ranks.gather(mine.survey.landmarks);
  if (!landmarks.empty()) {
    const auto candidates = tiles::stream_of(PointsView(landmarks, width));
    whole.result = tiles::make_survey(*candidates, weighted, 0);
  }
  tiles::Survey& survey = whole.result.survey;
  survey.dimension = dimension;
  survey.weighted = weighted;
  survey.num_points = static_cast<std::uint64_t>(all);
  survey.landmark_rows.assign(survey.landmark_rows.size(), -1);
  if (whole.period) tiles::add_translates(whole.period->set, survey);
  if (weighted && all > 0) {
    const double infinity = std::numeric_limits<double>::infinity();
    survey.lowest_weight = ranks.min_real(n > 0 ? mine.survey.lowest_weight : infinity);
    survey.largest_weight = ranks.max_real(n > 0 ? mine.survey.largest_weight : -infinity);
  }
  whole.result.sample = std::move(sample);
  return whole;
}

}  // namespace delone::mpi
