// SPDX-License-Identifier: BSD-3-Clause
// Selection of the n-th element of an array under a strict total order: what std::nth_element does, with
// partitions free of unpredictable branches and pivots taken from a sample (after Floyd and Rivest 1975,
// doi:10.1145/360680.360691). About 1.5 comparisons per element for a median. Equal elements must not exist:
// the order breaks ties.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace delone::order {

/// Moves the elements of [first, last) that are below the pivot to the front; returns the end of that part.
template <class T, class Less>
T* partition_below(T* first, T* last, const T& pivot, const Less& less) {
  T* boundary = first;
  for (T* i = first; i != last; ++i) {
    const T value = *i;
    *i = *boundary;
    *boundary = value;
    boundary += static_cast<std::ptrdiff_t>(less(value, pivot));
  }
  return boundary;
}

template <class T, class Less>
void insertion_sort(T* first, T* last, const Less& less) {
  for (T* i = first + 1; i < last; ++i) {
    const T value = *i;
    T* j = i;
    for (; j != first && less(value, j[-1]); --j) *j = j[-1];
    *j = value;
  }
}

/// Two elements that with high probability enclose the element of rank `rank` closely, from an evenly spaced
/// sample.
template <class T, class Less>
std::pair<T, T> enclosing_pivots(const T* first, std::size_t size, std::size_t rank, const Less& less) {
  constexpr std::size_t max_sample = 256;
  std::array<T, max_sample> sample;
  const std::size_t count = size >= 65536 ? max_sample : size >= 4096 ? 64 : 16;
  const std::size_t step = size / count;
  for (std::size_t i = 0; i < count; ++i) sample[i] = first[i * step + (i * 7919) % step];
  const auto middle = static_cast<std::ptrdiff_t>(static_cast<double>(rank) / static_cast<double>(size) *
                                                  static_cast<double>(count));
  // At least 1.25 standard deviations of the rank in a sample of this size, on each side.
  const std::ptrdiff_t margin = count == max_sample ? 14 : count == 64 ? 6 : 2;
  const std::ptrdiff_t end = static_cast<std::ptrdiff_t>(count) - 1;
  std::sort(sample.data(), sample.data() + count, less);
  return {sample[static_cast<std::size_t>(std::clamp(middle - margin, std::ptrdiff_t{0}, end))],
          sample[static_cast<std::size_t>(std::clamp(middle + margin, std::ptrdiff_t{0}, end))]};
}

/// Rearranges [first, last) so that every element before `nth` is below every element from `nth` on. REQUIRES
/// first < nth < last and a strict total order without equal elements. O(n) expected, O(n log n) worst case.
template <class T, class Less>
void split_at(T* first, T* nth, T* last, const Less& less) {
  // Unlucky samples cost rounds; after 16 of them introselect bounds the work.
  for (int round = 0; round < 16; ++round) {
    const auto size = static_cast<std::size_t>(last - first);
    if (size <= 8) return insertion_sort(first, last, less);
    if (size <= 128) {
      T a = first[0], b = first[size / 2], c = last[-1];
      if (less(b, a)) std::swap(a, b);
      if (less(c, b)) b = less(c, a) ? a : c;
      T* middle = partition_below(first, last, b, less);
      if (middle == nth) return;
      (middle < nth ? first : last) = middle;
    } else {
      const auto [low, high] = enclosing_pivots(first, size, static_cast<std::size_t>(nth - first), less);
      T* middle = partition_below(first, last, low, less);
      if (middle == nth) return;
      if (nth < middle) {
        last = middle;
        continue;
      }
      first = middle;
      middle = partition_below(first, last, high, less);
      if (middle == nth) return;
      (middle < nth ? first : last) = middle;
    }
    if (last - first < 2) return;
  }
  std::nth_element(first, nth, last, less);
}

}  // namespace delone::order
