// SPDX-License-Identifier: BSD-3-Clause
#include "convert.hpp"

#include "call.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace delone_octave {
namespace {

/// Integers that count, in place of numbers of rows, cells, vertices or axes.
constexpr std::string_view counts[] = {"f_vector", "affine_dimensions"};

Matrix real_matrix(const octave_value& value, const char* name) {
  const bool is_real = (value.isnumeric() || value.islogical()) && value.isreal();
  if (!is_real || value.ndims() != 2)
    error_with_id("delone:invalid-argument", "delone: %s must be a real matrix", name);
  return value.matrix_value();
}

delone_array array_of(const delone_object* object, const std::string& name) {
  delone_array array{};
  call([&] { return delone_get_array(object, name.c_str(), &array); });
  return array;
}

/// Calls work(first number) with the type of the numbers.
template <class Work>
auto with_type(const delone_array& array, Work work) {
  switch (array.type) {
    case DELONE_INT32:
      return work(static_cast<const int32_t*>(array.data));
    case DELONE_INT64:
      return work(static_cast<const int64_t*>(array.data));
    case DELONE_UINT8:
      return work(static_cast<const uint8_t*>(array.data));
    default:
      return work(static_cast<const double*>(array.data));
  }
}

octave_value value_of(const delone_array& array, const std::string& name) {
  const bool is_number = array.type == DELONE_INT32 || array.type == DELONE_INT64;
  const bool from_1 = is_number && std::find(std::begin(counts), std::end(counts), name) == std::end(counts);
  return with_type(array, [&](const auto* first) {
    return octave_value(from_1 ? numbers_from_1(first, array.shape[0], array.shape[1])
                               : matrix_of(first, array.shape[0], array.shape[1]));
  });
}

}  // namespace

Rows::Rows(const octave_value& value, const char* name)
    : transposed_(real_matrix(value, name).transpose()), name_(name) {
  if (transposed_.rows() > std::numeric_limits<int>::max())
    error_with_id("delone:too-many", "delone: %s has too many columns", name);
}

const Rows& Rows::with_columns(int expected) const {
  if (columns() != expected)
    error_with_id("delone:bad-dimension", "delone: %s has %d columns, and must have %d", name_, columns(),
                  expected);
  return *this;
}

const Rows& Rows::with_rows(std::size_t expected) const {
  if (size() != expected)
    error_with_id("delone:invalid-argument", "delone: %s has %zu rows, and must have %zu", name_, size(),
                  expected);
  return *this;
}

std::vector<int64_t> row_numbers(const octave_value& value, const char* name, std::size_t largest,
                                 const char* items) {
  const Matrix given = real_matrix(value, name);
  std::vector<int64_t> numbers;
  numbers.reserve(static_cast<std::size_t>(given.numel()));
  for (octave_idx_type i = 0; i < given.rows(); ++i)
    for (octave_idx_type j = 0; j < given.columns(); ++j) {
      const double number = given(i, j);
      if (!(number >= 1 && number <= static_cast<double>(largest)) || number != std::floor(number))
        error_with_id("delone:invalid-argument",
                      "delone: row %ld of %s has the number %g, and there are %s 1 to %zu",
                      static_cast<long>(i + 1), name, number, items, largest);
      numbers.push_back(static_cast<int64_t>(number) - 1);
    }
  return numbers;
}

octave_value member_of(const delone_object* object, const std::string& name) {
  int type = 0;
  const char* found = nullptr;
  for (std::size_t i = 0; (found = delone_member(object, i, &type)) != nullptr && found != name;) ++i;
  int64_t integer = 0;
  double real = 0;
  const char* text = nullptr;
  switch (found == nullptr ? DELONE_ARRAY : type) {
    case DELONE_INTEGER:
      call([&] { return delone_get_integer(object, name.c_str(), &integer); });
      return octave_value(static_cast<double>(integer));
    case DELONE_REAL:
      call([&] { return delone_get_real(object, name.c_str(), &real); });
      return octave_value(real);
    case DELONE_TEXT:
      call([&] { return delone_get_text(object, name.c_str(), &text); });
      return octave_value(std::string(text));
    default:
      return value_of(array_of(object, name), name);
  }
}

Cell lists_of(const delone_object* object, const std::string& offsets, const std::string& items,
              double first) {
  const delone_array starts = array_of(object, offsets), entries = array_of(object, items);
  const std::size_t count = starts.shape[0] == 0 ? 0 : starts.shape[0] - 1;
  Cell result(static_cast<octave_idx_type>(count), 1);
  const bool is_real = entries.type == DELONE_FLOAT64;
  with_type(starts, [&](const auto* start) {
    with_type(entries, [&](const auto* entry) {
      for (std::size_t i = 0; i < count; ++i) {
        const auto begin = static_cast<std::size_t>(start[i]), end = static_cast<std::size_t>(start[i + 1]);
        RowVector list(static_cast<octave_idx_type>(end - begin));
        for (std::size_t j = begin; j < end; ++j)
          list.xelem(static_cast<octave_idx_type>(j - begin)) =
              static_cast<double>(entry[j]) + (is_real ? 0.0 : first);
        result(static_cast<octave_idx_type>(i)) = list;
      }
    });
  });
  return result;
}

}  // namespace delone_octave
