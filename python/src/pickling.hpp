// SPDX-License-Identifier: BSD-3-Clause
// What the states of pickles have in common. Anything can be in a pickle that was damaged: what does not fit
// raises ValueError, whatever made it.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace delone::python {

namespace py = pybind11;

/// Returns make(state). Raises ValueError unless the state has `size` entries of the types that it asks for.
template <class Make>
auto from_state(const py::tuple& state, std::size_t size, const char* what, Make make) {
  const auto wrong = [what] { return py::value_error(std::string("not the state of ") + what); };
  if (state.size() != size) throw wrong();
  try {
    return make(state);
  } catch (const py::cast_error&) {
    throw wrong();
  }
}

inline std::size_t num_rows(std::span<const std::size_t> batches) {
  return std::accumulate(batches.begin(), batches.end(), std::size_t{0});
}

inline py::list batches_to_state(std::span<const std::size_t> batches) {
  py::list numbers;
  for (const std::size_t rows : batches) numbers.append(rows);
  return numbers;
}

/// Calls add(slice) for the rows of each batch. Raises ValueError, before any call, unless these are all of
/// `num_rows` rows.
template <class Add>
void add_batches(const py::object& state, py::ssize_t num_rows, Add add) {
  std::vector<py::ssize_t> ends{0};
  for (const py::handle item : state) {
    const auto rows = item.cast<py::ssize_t>();
    if (rows < 1 || rows > num_rows - ends.back()) throw py::value_error("batches: not those of the rows");
    ends.push_back(ends.back() + rows);
  }
  if (ends.back() != num_rows) throw py::value_error("batches: not those of the rows");
  for (std::size_t i = 1; i < ends.size(); ++i) add(py::slice(ends[i - 1], ends[i], 1));
}

}  // namespace delone::python
