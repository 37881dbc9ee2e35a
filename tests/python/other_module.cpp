// SPDX-License-Identifier: BSD-3-Clause
// Another module of pybind11 in the process, as packages of others are.
#include <pybind11/pybind11.h>

#include <new>

namespace {

struct Thing {};

}  // namespace

PYBIND11_MODULE(other_module, module) {
  pybind11::class_<Thing>(module, "Thing").def(pybind11::init<>());
  module.def("exhaust_memory", [] { throw std::bad_alloc(); });
}
