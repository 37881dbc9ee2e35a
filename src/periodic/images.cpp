// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/images.hpp"

#include "base/progress_meter.hpp"
#include "pages/page_order.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace delone::periodic {

Images::Images(const PeriodicSet& set) : set_(set), extent_(set) {
  known_below_.assign(set_.rank, 0.0);
  known_above_ = known_below_;
  make_pages();
  shift_number(std::vector<std::int32_t>(set_.rank, 0));
}

void Images::make_pages() {
  const std::size_t n = set_.num_points(), width = set_.row_size();
  table_.dimension = static_cast<int>(set_.dimension);
  table_.weighted = set_.weighted;
  table_.first_point = {0};
  std::vector<double> records;
  records.reserve(n * (width + 1));
  for (std::size_t row = 0; row < n; ++row) {
    records.insert(records.end(), set_.row(row), set_.row(row) + width);
    records.push_back(pages::coded_row(static_cast<std::int64_t>(row)));
    extent_.add(set_.row(row), static_cast<std::int64_t>(row));
  }
  pages::order_pages(records, pages::points_per_page(n), table_);
  const double* record = records.data();
  for (std::size_t page = 0; page < table_.num_pages(); ++page) {
    const std::size_t numbers = table_.page_size(page) * (width + 1);
    source_.pages.push_back(pages::page_of_records({record, numbers}, width));
    record += numbers;
  }
  tree_ = std::make_unique<pages::PageTree>(table_);
}

std::uint32_t Images::shift_number(std::span<const std::int32_t> k) {
  std::uint64_t code = 0;
  for (std::size_t i = 0; i < k.size(); ++i) {
    const auto reach = static_cast<std::uint64_t>(set_.period.reach(i));
    code = code * (2 * reach + 1) + static_cast<std::uint64_t>(k[i] + set_.period.reach(i));
  }
  const auto [place, is_new] = number_of_code_.try_emplace(code, static_cast<std::uint32_t>(shifts_.size()));
  if (is_new) {
    try {
      auto shift = std::make_unique<Shift>(Shift{{k.begin(), k.end()},
                                                 std::vector<double>(set_.dimension, 0.0),
                                                 pages::KnownPoints(table_.num_pages())});
      set_.period.translate(k, shift->by.data());
      shifts_.push_back(std::move(shift));
    } catch (...) {
      number_of_code_.erase(place);
      throw;
    }
  }
  return place->second;
}

void Images::copy_image(const Image& image, double* to) const {
  std::copy_n(set_.row(image.row), set_.row_size(), to);
  const Shift& shift = *shifts_[image.shift];
  for (std::size_t j = 0; j < set_.dimension; ++j) to[j] += shift.by[j];
}

std::vector<Image> Images::frame() {
  std::vector<Image> images;
  const std::vector<std::vector<std::int32_t>> shifts = extent_.frame_shifts();
  for (const Extent::Extreme& extreme : extent_.extremes())
    for (const std::vector<std::int32_t>& k : shifts)
      images.push_back({static_cast<std::uint32_t>(extreme.row), shift_number(k)});
  return images;
}

std::vector<Image> Images::layer(double width) {
  std::vector<Image> images;
  constexpr double nearly_one = 0.999;
  known_below_.assign(set_.rank, nearly_one);
  known_above_ = known_below_;
  for (std::size_t page = 0; page < table_.num_pages(); ++page) {
    internal::cancellation_point();
    take_layer_of(page, width, images);
  }
  return images;
}

void Images::set_known(std::vector<double> below, std::vector<double> above, std::span<const Image> images) {
  known_below_ = std::move(below);
  known_above_ = std::move(above);
  std::vector<pages::PointPlace> place_of_row(set_.num_points());
  for (std::uint32_t page = 0; page < source_.pages.size(); ++page)
    for (std::uint32_t slot = 0; slot < source_.pages[page]->size(); ++slot)
      place_of_row[static_cast<std::size_t>(source_.pages[page]->rows[slot])] = {page, slot};
  for (const Image& image : images) {
    if (image.shift == 0) continue;
    const pages::PointPlace& place = place_of_row[image.row];
    shifts_[image.shift]->known.add(place.page, place.slot, table_.page_size(place.page));
  }
}

void Images::forget_known() {
  known_below_.assign(set_.rank, 0.0);
  known_above_ = known_below_;
  for (const auto& shift : shifts_) shift->known = pages::KnownPoints(table_.num_pages());
}

void Images::take_layer_of(std::size_t number, double width, std::vector<Image>& images) {
  const pages::Page& page = *source_.pages[number];
  const std::size_t d = set_.dimension, r = set_.rank, size = page.size();
  double side = 0;
  for (std::size_t j = 0; j < d; ++j) side += table_.high(number)[j] - table_.low(number)[j];
  const double spacing =
      side / static_cast<double>(d) / std::pow(static_cast<double>(size), 1 / static_cast<double>(d));
  std::vector<double> fractions(size * r), widths(r);
  bool is_near = false;
  for (std::size_t i = 0; i < r; ++i) {
    double low = 1, high = 0;
    for (std::size_t slot = 0; slot < size; ++slot) {
      double& fraction = fractions[slot * r + i] =
          set_.period.fraction(i, set_.row(static_cast<std::size_t>(page.rows[slot])));
      low = std::min(low, fraction);
      high = std::max(high, fraction);
    }
    widths[i] = width * spacing * set_.period.gradient_length(i);
    known_above_[i] = std::min(known_above_[i], std::max(widths[i], low));
    known_below_[i] = std::min(known_below_[i], std::max(widths[i], 1 - high));
    is_near = is_near || low <= widths[i] || 1 - high <= widths[i];
  }
  if (!is_near) return;
  std::vector<std::int32_t> k(r), low(r), high(r);
  for (std::size_t slot = 0; slot < size; ++slot) {
    bool is_inner = true;
    for (std::size_t i = 0; i < r; ++i) {
      const double fraction = fractions[slot * r + i];
      low[i] = 1 - fraction <= widths[i] ? -1 : 0;
      high[i] = fraction <= widths[i] ? 1 : 0;
      is_inner = is_inner && low[i] == 0 && high[i] == 0;
    }
    if (is_inner) continue;
    k = low;
    do {
      if (std::all_of(k.begin(), k.end(), [](std::int32_t one) { return one == 0; })) continue;
      const std::uint32_t shift = shift_number(k);
      shifts_[shift]->known.add(number, slot, size);
      images.push_back({static_cast<std::uint32_t>(page.rows[slot]), shift});
    } while (next_in_range(k, low, high));
  }
}

}  // namespace delone::periodic
