// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/images.hpp"

#include "base/progress_meter.hpp"
#include "tiles/page_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::periodic {

namespace {

double dot(const double* a, const double* b, std::size_t d) {
  double sum = 0;
  for (std::size_t j = 0; j < d; ++j) sum += a[j] * b[j];
  return sum;
}

}  // namespace

Images::Images(const PeriodicSet& set) : set_(set) {
  for (std::size_t i = 0; i < set_.rank; ++i) {
    double magnitude = 0;
    for (std::size_t j = 0; j < set_.dimension; ++j)
      magnitude += std::abs(set_.period.gradient(i)[j]) * set_.largest[j];
    fraction_slack_.push_back(static_cast<double>(set_.dimension + 4) * 0x1p-52 * magnitude);
  }
  known_below_.assign(set_.rank, 0.0);
  known_above_ = known_below_;
  make_pages();
  shift_number(std::vector<std::int32_t>(set_.rank, 0));
  find_directions();
}

void Images::make_pages() {
  const std::size_t n = set_.num_points(), width = set_.row_size();
  table_.dimension = static_cast<int>(set_.dimension);
  table_.weighted = set_.weighted;
  table_.first_point = {0};
  std::vector<double> records;
  records.reserve(n * (width + 1));
  largest_weight_ = -std::numeric_limits<double>::infinity();
  double least_from_middle = std::numeric_limits<double>::infinity();
  std::uint32_t chosen = 0;
  for (std::size_t row = 0; row < n; ++row) {
    records.insert(records.end(), set_.row(row), set_.row(row) + width);
    records.push_back(tiles::coded_row(static_cast<std::int64_t>(row)));
    if (!set_.weighted) {
      double from_middle = 0;
      for (std::size_t i = 0; i < set_.rank; ++i)
        from_middle = std::max(from_middle, std::abs(set_.period.fraction(i, set_.row(row)) - 0.5));
      if (from_middle < least_from_middle) {
        least_from_middle = from_middle;
        chosen = static_cast<std::uint32_t>(row);
      }
      continue;
    }
    const double weight = set_.row(row)[set_.dimension];
    weight_range_ = std::max(weight_range_, std::abs(weight));
    if (weight > largest_weight_) {
      largest_weight_ = weight;
      chosen = static_cast<std::uint32_t>(row);
    }
  }
  extreme_.push_back(chosen);
  tiles::order_pages(records, tiles::points_per_page(n), table_);
  const double* record = records.data();
  for (std::size_t page = 0; page < table_.num_pages(); ++page) {
    const std::size_t numbers = table_.page_size(page) * (width + 1);
    source_.pages.push_back(tiles::page_of_records({record, numbers}, width));
    record += numbers;
  }
  tree_ = std::make_unique<tiles::PageTree>(table_);
}

void Images::find_directions() {
  const std::size_t d = set_.dimension, n = set_.num_points();
  std::vector<double> basis;  // orthonormal
  const auto add = [&](std::vector<double> x) {
    const double before = std::sqrt(dot(x.data(), x.data(), d));
    for (int pass = 0; pass < 2; ++pass)  // the second one removes what rounding has left
      for (std::size_t at = 0; at < basis.size(); at += d) {
        const double part = dot(x.data(), &basis[at], d);
        for (std::size_t j = 0; j < d; ++j) x[j] -= part * basis[at + j];
      }
    const double length = std::sqrt(dot(x.data(), x.data(), d));
    if (!(length > 0x1p-40 * before)) x.assign(d, 0.0);  // a lattice so flat bounds nothing
    for (double& coordinate : x) coordinate /= length > 0x1p-40 * before ? length : 1;
    basis.insert(basis.end(), x.begin(), x.end());
  };
  for (std::size_t i = 0; i < set_.rank; ++i)
    add(std::vector<double>(set_.period.vector(i), set_.period.vector(i) + d));
  while (basis.size() < d * d) {
    std::size_t best = 0;
    double most = -1;
    for (std::size_t j = 0; j < d; ++j) {
      double rest = 1;
      for (std::size_t at = 0; at < basis.size(); at += d) rest -= basis[at + j] * basis[at + j];
      if (rest > most) {
        most = rest;
        best = j;
      }
    }
    std::vector<double> axis(d, 0.0);
    axis[best] = 1;
    add(std::move(axis));
  }
  free_.assign(basis.begin() + static_cast<std::ptrdiff_t>(set_.rank * d), basis.end());
  along_.assign(basis.begin(), basis.begin() + static_cast<std::ptrdiff_t>(set_.rank * d));
  for (std::size_t i = 0; i < set_.rank; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t row = 0; row < n; ++row) {
      const double at = dot(lattice_direction(i), set_.row(row), d);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    along_low_.push_back(low);
    along_high_.push_back(high);
  }
  double size = 0;
  for (const double largest : set_.largest) size += largest;
  for (std::size_t i = 0; i < d - set_.rank; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::uint32_t lowest = 0, highest = 0;
    for (std::size_t row = 0; row < n; ++row) {
      const double along = dot(free_direction(i), set_.row(row), d);
      if (along < low) {
        low = along;
        lowest = static_cast<std::uint32_t>(row);
      }
      if (along > high) {
        high = along;
        highest = static_cast<std::uint32_t>(row);
      }
    }
    low_.push_back(low - 0x1p-45 * size);
    high_.push_back(high + 0x1p-45 * size);
    extreme_.push_back(lowest);
    extreme_.push_back(highest);
  }
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
                                                 tiles::KnownPoints(table_.num_pages())});
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
  const std::size_t r = set_.rank;
  if (set_.num_points() == 0 || r == 0) return images;
  std::vector<std::uint32_t> rows = extreme_;
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  std::vector<std::uint32_t> corners;
  constexpr std::size_t most_cubes = 4;
  if (r <= most_cubes) {  // Σ ±a_i
    for (std::size_t signs = 0; signs < std::size_t{1} << r; ++signs) {
      std::vector<std::int32_t> k(r);
      for (std::size_t i = 0; i < r; ++i) k[i] = (signs >> i & 1) != 0 ? 1 : -1;
      corners.push_back(shift_number(k));
    }
  } else {  // ±a_i
    for (std::size_t i = 0; i < r; ++i)
      for (const std::int32_t sign : {-1, 1}) {
        std::vector<std::int32_t> k(r, 0);
        k[i] = sign;
        corners.push_back(shift_number(k));
      }
  }
  for (const std::uint32_t row : rows)
    for (const std::uint32_t corner : corners) images.push_back({row, corner});
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
  std::vector<tiles::PointPlace> place_of_row(set_.num_points());
  for (std::uint32_t page = 0; page < source_.pages.size(); ++page)
    for (std::uint32_t slot = 0; slot < source_.pages[page]->size(); ++slot)
      place_of_row[static_cast<std::size_t>(source_.pages[page]->rows[slot])] = {page, slot};
  for (const Image& image : images) {
    if (image.shift == 0) continue;
    const tiles::PointPlace& place = place_of_row[image.row];
    shifts_[image.shift]->known.add(place.page, place.slot, table_.page_size(place.page));
  }
}

void Images::forget_known() {
  known_below_.assign(set_.rank, 0.0);
  known_above_ = known_below_;
  for (const auto& shift : shifts_) shift->known = tiles::KnownPoints(table_.num_pages());
}

void Images::take_layer_of(std::size_t number, double width, std::vector<Image>& images) {
  const tiles::Page& page = *source_.pages[number];
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
