// SPDX-License-Identifier: BSD-3-Clause
// The points of a tile in the order of a k-d tree. See page_order.hpp.
#include "pages/page_order.hpp"

#include "base/progress_meter.hpp"
#include "order/select.hpp"
#include "pages/cyclic_order.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace delone::pages {

namespace {

/// Orders handles of records: the records themselves, or their numbers. `size()` is that of a record.
template <class Handles>
class KdOrder {
 public:
  using Handle = typename Handles::Handle;

  KdOrder(const Handles& handles, std::size_t page_points, PageTable& table)
      : handles_(handles), page_points_(page_points), table_(table), d_(table.dimension) {}

  void order(Handle* first, Handle* last) {
    const auto size = static_cast<std::size_t>(last - first);
    if (size > 0) split(first, last, (size + page_points_ - 1) / page_points_);
  }

 private:
  /// Cuts into so many pages of about equal sizes, none above page_points_: halves of p pages with n·⌊p/2⌋/p
  /// points, rounded down, and the rest.
  void split(Handle* first, Handle* last, std::size_t num_pages) {
    internal::cancellation_point();
    auto low = handles_.template filled<double>(std::numeric_limits<double>::infinity());
    auto high = handles_.template filled<double>(-std::numeric_limits<double>::infinity());
    for (const Handle* one = first; one != last; ++one) {
      const double* const record = handles_.at(*one);
      for (std::size_t i = 0; i + 1 < handles_.size(); ++i) {
        low[i] = record[i] < low[i] ? record[i] : low[i];
        high[i] = record[i] > high[i] ? record[i] : high[i];
      }
    }
    const auto size = static_cast<std::size_t>(last - first);
    if (num_pages == 1) {
      table_.first_point.push_back(table_.first_point.back() + size);
      table_.boxes.insert(table_.boxes.end(), low.begin(), low.begin() + d_);
      table_.boxes.insert(table_.boxes.end(), high.begin(), high.begin() + d_);
      if (table_.weighted) table_.weights.push_back(high[static_cast<std::size_t>(d_)]);
      return;
    }
    const int axis = longest_axis(low.data(), high.data(), d_);
    const std::size_t pages_below = num_pages / 2;
    Handle* const middle = first + static_cast<std::ptrdiff_t>(size * pages_below / num_pages);
    order::split_at(first, middle, last, [&](const Handle& a, const Handle& b) {
      return is_below(handles_.at(a), handles_.at(b), axis);
    });
    split(first, middle, pages_below);
    split(middle, last, num_pages - pages_below);
  }

  /// A total order: equal positions by their rows.
  bool is_below(const double* a, const double* b, int axis) const {
    if (a[axis] != b[axis]) return a[axis] < b[axis];
    if (const int order = compare_along(a, b, axis, d_); order != 0) return order < 0;
    const std::size_t row = handles_.size() - 1;
    return row_of(a[row]) < row_of(b[row]);
  }

  const Handles& handles_;
  const std::size_t page_points_;
  PageTable& table_;
  const int d_;
};

/// Records of few numbers are moved themselves.
template <std::size_t N>
struct Records {
  using Handle = std::array<double, N>;
  static constexpr std::size_t size() { return N; }
  static const double* at(const Handle& record) { return record.data(); }
  template <class T>
  static std::array<T, N> filled(T value) {
    std::array<T, N> out;
    out.fill(value);
    return out;
  }
};

/// Of others their numbers.
struct RecordNumbers {
  using Handle = std::size_t;
  const double* records;
  std::size_t record_size;
  std::size_t size() const { return record_size; }
  const double* at(std::size_t number) const { return records + number * record_size; }
  template <class T>
  std::vector<T> filled(T value) const {
    return std::vector<T>(record_size, value);
  }
};

template <std::size_t N>
void order_records(std::vector<double>& records, std::size_t page_points, PageTable& table) {
  auto* const first = reinterpret_cast<std::array<double, N>*>(records.data());
  KdOrder(Records<N>(), page_points, table).order(first, first + records.size() / N);
}

void order_by_numbers(std::vector<double>& records, std::size_t page_points, PageTable& table) {
  const RecordNumbers handles{records.data(), table.row_size() + 1};
  std::vector<std::size_t> numbers(records.size() / handles.record_size);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  KdOrder(handles, page_points, table).order(numbers.data(), numbers.data() + numbers.size());
  std::vector<double> ordered;
  ordered.reserve(records.size());
  for (const std::size_t number : numbers)
    ordered.insert(ordered.end(), handles.at(number), handles.at(number) + handles.record_size);
  records = std::move(ordered);
}

}  // namespace

std::shared_ptr<const Page> page_of_records(std::span<const double> records, std::size_t row_size) {
  auto page = std::make_shared<Page>();
  const std::size_t size = records.size() / (row_size + 1), stride = Page::stride_of(size);
  page->coordinates.reserve(stride * row_size);
  for (std::size_t j = 0; j < row_size; ++j)
    for (std::size_t i = 0; i < stride; ++i)
      page->coordinates.push_back(records[std::min(i, size - 1) * (row_size + 1) + j]);
  page->rows.reserve(size);
  for (std::size_t i = 0; i < size; ++i) page->rows.push_back(row_of(records[i * (row_size + 1) + row_size]));
  return page;
}

std::size_t points_per_page(std::uint64_t num_points) {
  constexpr std::uint64_t least = 64, most = 1024, pages = std::uint64_t{1} << 20;
  return static_cast<std::size_t>(std::clamp(std::bit_ceil(num_points / pages + 1), least, most));
}

void order_pages(std::vector<double>& records, std::size_t page_points, PageTable& table) {
  Tile tile;
  tile.first_page = table.num_pages();
  page_points = std::max<std::size_t>(page_points, 1);
  switch (table.row_size() + 1) {
    case 3:
      order_records<3>(records, page_points, table);
      break;
    case 4:
      order_records<4>(records, page_points, table);
      break;
    case 5:
      order_records<5>(records, page_points, table);
      break;
    case 6:
      order_records<6>(records, page_points, table);
      break;
    default:
      order_by_numbers(records, page_points, table);
  }
  tile.last_page = table.num_pages();
  table.tiles.push_back(tile);
}

}  // namespace delone::pages
