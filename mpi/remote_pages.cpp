// SPDX-License-Identifier: BSD-3-Clause
#include "remote_pages.hpp"

#include "periodic/images.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace delone::mpi {

std::shared_ptr<const pages::Page> RemotePages::find(std::size_t page) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const pages::Page>& found = pages_[page];
  if (!found) {
    if (own_.has(page))
      found = pages::page_of_records(own_.records(page), own_.table().row_size());
    else
      wanted_.push_back(page);
  }
  return found;
}

void RemotePages::want_near(std::size_t tile) {
  const pages::PageTable& table = own_.table();
  const auto d = static_cast<std::size_t>(table.dimension);
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> low(d, infinity), high(d, -infinity);
  for (std::size_t page = table.tiles[tile].first_page; page < table.tiles[tile].last_page; ++page)
    for (std::size_t j = 0; j < d; ++j) {
      low[j] = std::min(low[j], table.low(page)[j]);
      high[j] = std::max(high[j], table.high(page)[j]);
    }
  // Near is what is not farther than a part of the side of the page: foreign points that a tile inserts are
  // in a layer of a few points.
  constexpr double part = 0.5;
  for (const std::vector<double>& by : nearest_translations())
    for (std::size_t page = 0; page < table.num_pages(); ++page) {
      if (own_.has(page)) continue;
      double distance = 0, side = 0;
      for (std::size_t j = 0; j < d; ++j) {
        const double a = table.low(page)[j] + by[j], b = table.high(page)[j] + by[j];
        distance = std::max({distance, a - high[j], low[j] - b});
        side = std::max(side, b - a);
      }
      if (distance <= part * side) wanted_.push_back(page);
    }
}

/// None, and in a periodic set those to the boxes around, of which there are not too many.
std::vector<std::vector<double>> RemotePages::nearest_translations() const {
  constexpr std::size_t most_rank = 4;
  std::vector<std::vector<double>> translations;
  const std::vector<double> none(static_cast<std::size_t>(own_.table().dimension), 0.0);
  if (period_ == nullptr || period_->rank() > most_rank) return {none};
  const std::vector<std::int32_t> low(period_->rank(), -1), high(period_->rank(), 1);
  std::vector<std::int32_t> k = low;
  do {
    translations.push_back(none);
    period_->translate(k, translations.back().data());
  } while (periodic::next_in_range(k, low, high));
  return translations;
}

std::size_t RemotePages::exchange(Ranks& ranks) {
  const auto p = static_cast<std::size_t>(ranks.size());
  std::sort(wanted_.begin(), wanted_.end());
  wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
  std::vector<std::vector<std::uint64_t>> wanted_of(p);
  for (const std::uint64_t page : wanted_)
    wanted_of[own_.owner_of_page(static_cast<std::size_t>(page))].push_back(page);
  const auto asked_by = ranks.exchange(wanted_of);

  std::vector<std::vector<double>> to_each(p);
  for (std::size_t r = 0; r < p; ++r)
    for (const std::uint64_t page : asked_by[r]) {
      const std::span<const double> records = own_.records(static_cast<std::size_t>(page));
      to_each[r].insert(to_each[r].end(), records.begin(), records.end());
    }
  const auto from_each = ranks.exchange(to_each);
  const std::size_t row_size = own_.table().row_size();
  for (std::size_t r = 0; r < p; ++r) {
    std::span<const double> records(from_each[r]);
    for (const std::uint64_t page : wanted_of[r]) {
      const auto number = static_cast<std::size_t>(page);
      const std::size_t size = own_.table().page_size(number) * (row_size + 1);
      pages_[number] = pages::page_of_records(records.first(size), row_size);
      records = records.subspan(size);
    }
  }
  const std::size_t count = wanted_.size();
  wanted_.clear();
  return count;
}

void RemotePages::drop() {
  for (auto& page : pages_) page.reset();
  wanted_.clear();
}

}  // namespace delone::mpi
