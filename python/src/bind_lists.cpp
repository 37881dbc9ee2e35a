// SPDX-License-Identifier: BSD-3-Clause
// Lists of lists for delone.spatial, which has them where scipy has.
#include "arrays.hpp"
#include "module.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;
using Integers = py::array_t<SignedIndex, py::array::c_style | py::array::forcecast>;

/// Stops the search for garbage, which goes through all objects again and again while many are made.
class NoGarbageCollection {
 public:
#if PY_VERSION_HEX >= 0x030A0000
  NoGarbageCollection() : was_on_(PyGC_Disable() != 0) {}
  ~NoGarbageCollection() {
    if (was_on_) PyGC_Enable();
  }
  NoGarbageCollection(const NoGarbageCollection&) = delete;
  NoGarbageCollection& operator=(const NoGarbageCollection&) = delete;

 private:
  bool was_on_;
#endif
};

/// Numbers as Python objects; equal ones that are small are one object.
class NumberObjects {
 public:
  explicit NumberObjects(std::size_t table_size) : known_(table_size) {}

  py::object operator()(SignedIndex number) {
    if (number < 0 || static_cast<std::size_t>(number) >= known_.size()) return py::int_(number);
    py::object& object = known_[static_cast<std::size_t>(number)];
    if (!object) object = py::int_(number);
    return object;
  }

 private:
  std::vector<py::object> known_;
};

py::list lists(const Integers& items, const py::array_t<std::int64_t>& offsets) {
  const auto item = items.unchecked<1>();
  const auto offset = offsets.unchecked<1>();
  const py::ssize_t count = std::max<py::ssize_t>(offset.shape(0) - 1, 0);
  SignedIndex largest = -1;
  for (py::ssize_t i = 0; i < item.shape(0); ++i) largest = std::max(largest, item(i));
  NumberObjects numbers(
      std::min(static_cast<std::size_t>(largest + 1), static_cast<std::size_t>(item.shape(0))));
  [[maybe_unused]] const NoGarbageCollection pause;
  py::list all(static_cast<std::size_t>(count));
  for (py::ssize_t i = 0; i < count; ++i) {
    const auto begin = static_cast<py::ssize_t>(offset(i)), end = static_cast<py::ssize_t>(offset(i + 1));
    if (begin < 0 || end < begin || end > item.shape(0))
      throw std::invalid_argument("offsets beyond the items");
    py::list list(static_cast<std::size_t>(end - begin));
    for (py::ssize_t j = begin; j < end; ++j)
      PyList_SET_ITEM(list.ptr(), j - begin, numbers(item(j)).release().ptr());
    PyList_SET_ITEM(all.ptr(), i, list.release().ptr());
  }
  return all;
}

}  // namespace

void bind_lists(py::module_& module) {
  module.def(
      "_lists", &lists, "items"_a, "offsets"_a,
      "The lists that are stored one after the other in items: list i from offsets[i] to offsets[i+1].");
}

}  // namespace delone::python
