// SPDX-License-Identifier: BSD-3-Clause
// The compiled part of delone.mpi: delone::mpi::make_tiles() for a communicator of mpi4py.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <delone/mpi/tiles.hpp>
#include <delone/printable.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace py = pybind11;

namespace delone::python {
namespace {

using namespace py::literals;

/// The exceptions are those of delone._core, which is another library with another delone::Error.
[[noreturn]] void raise(const Error& error) {
  const char* name = "Error";
  switch (error.code()) {
    case Errc::not_finite:
    case Errc::bad_dimension:
    case Errc::invalid_argument:
    case Errc::bad_format:
      name = "InputError";
      break;
    case Errc::out_of_memory:
      name = "OutOfMemoryError";
      break;
    case Errc::cancelled:
      name = "CancelledError";
      break;
    default:
      break;
  }
  const py::object exception = py::module_::import("delone._core").attr(name)(printable(error.what(), 2000));
  exception.attr("rows") = error.rows();
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
  throw py::error_already_set();
}

using Rows = py::array_t<double, py::array::c_style>;

/// `input`: paths, or rows of numbers. `communicator`: the address of an MPI_Comm.
py::dict make(const py::object& input, const std::string& folder, std::uintptr_t communicator,
              std::uint64_t memory, std::size_t tiles, unsigned threads, bool weighted,
              const std::string& format, int columns, const std::vector<double>& lattice, int dimension,
              double unit, bool resume) {
  TilesOptions options;
  options.memory = memory;
  options.tiles = tiles;
  options.threads = threads;
  options.weighted = weighted;
  options.format = format;
  options.columns = columns;
  options.lattice = {dimension, lattice};
  options.unit = unit;
  options.resume = resume;
  MPI_Comm const ranks = *reinterpret_cast<const MPI_Comm*>(communicator);
  mpi::RankEffort effort;
  std::optional<Error> failure;
  const auto guarded = [&](const auto& work) {
    const py::gil_scoped_release no_gil;
    try {
      work();
    } catch (const Error& error) {
      failure = error;
    }
  };
  if (py::isinstance<py::list>(input)) {
    const auto files = input.cast<std::vector<std::string>>();
    guarded([&] { mpi::make_tiles(files, folder, ranks, options, &effort); });
  } else {
    const Rows rows = input.cast<Rows>();
    const auto size = static_cast<std::size_t>(rows.size());
    const PointsView view(std::span<const double>(rows.data(), size), static_cast<int>(rows.shape(1)));
    guarded([&] { mpi::make_tiles(view, folder, ranks, options, &effort); });
  }
  if (failure) raise(*failure);
  return py::dict("num_tiles"_a = effort.num_tiles, "num_points"_a = effort.num_points,
                  "num_foreign"_a = effort.num_foreign, "num_rounds"_a = effort.num_rounds,
                  "num_pages_received"_a = effort.num_pages_received, "num_messages"_a = effort.num_messages,
                  "bytes_sent"_a = effort.bytes_sent, "bytes_received"_a = effort.bytes_received,
                  "reading"_a = effort.reading, "inserting"_a = effort.inserting, "asking"_a = effort.asking,
                  "exchanging"_a = effort.exchanging, "waiting"_a = effort.waiting,
                  "writing"_a = effort.writing, "total"_a = effort.total);
}

}  // namespace
}  // namespace delone::python

using namespace pybind11::literals;

PYBIND11_MODULE(_mpi, module) {
  module.attr("size_of_communicator") = sizeof(MPI_Comm);
  char version[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  MPI_Get_library_version(version, &length);
  module.attr("library_version") = std::string(version, static_cast<std::size_t>(length));
  module.def("make_tiles", &delone::python::make, "input"_a, "folder"_a, "communicator"_a, py::kw_only(),
             "memory"_a, "tiles"_a, "threads"_a, "weighted"_a, "format"_a, "columns"_a, "lattice"_a,
             "dimension"_a, "unit"_a, "resume"_a);
}
