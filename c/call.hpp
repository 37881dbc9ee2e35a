// SPDX-License-Identifier: BSD-3-Clause
// The border between C and C++: no exception passes, errors are remembered for the thread, and its progress
// function is asked.
#pragma once

#include <delone/delone.h>
#include <delone/arithmetic.hpp>
#include <delone/error.hpp>
#include <delone/progress.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>

namespace delone::c {

/// To be called in a catch block: remembers what was caught, and returns its status.
int remember_exception() noexcept;

/// The progress function of this thread; empty if there is none.
std::function<bool(double)> progress_of_thread();

/// Does the work of a C function, in the floating-point state of the library.
template <class Work>
int run(Work work) noexcept {
  const ArithmeticScope arithmetic;
  try {
    const ProgressScope scope(progress_of_thread());
    work();
    return DELONE_OK;
  } catch (...) {
    return remember_exception();
  }
}

/// Throws invalid_argument if it is NULL, which `what` must not be.
template <class T>
T& required(T* pointer, const char* what) {
  if (pointer == nullptr) throw Error(Errc::invalid_argument, std::string(what) + " must not be NULL");
  return *pointer;
}

/// Does the work of a C function that makes an object, and gives it to the caller.
template <class Object, class Make>
int make(Object** object, Make work) noexcept {
  if (object != nullptr) *object = nullptr;
  return run([&] {
    Object*& made = required(object, "the place for the object");
    made = work().release();
  });
}

/// The numbers of a matrix of the caller. Throws invalid_argument for NULL, too_many if there is no such
/// amount of memory.
template <class T>
std::span<T> matrix(T* first, std::size_t rows, std::size_t columns, const char* what) {
  if (rows == 0 || columns == 0) return {};
  if (rows > static_cast<std::size_t>(PTRDIFF_MAX) / sizeof(T) / columns)
    throw Error(Errc::too_many, std::string(what) + ": there is no memory of that size");
  return {&required(first, what), rows * columns};
}

/// n rows of numbers. Throws bad_dimension for less than one column, and as above.
inline PointsView view_of(const double* first, std::size_t n, int columns, const char* what) {
  if (columns < 1)
    throw Error(Errc::bad_dimension, std::string(what) + ": the dimension is " + std::to_string(columns) +
                                         ", and must be at least 1");
  return {matrix(first, n, static_cast<std::size_t>(columns), what), columns};
}

}  // namespace delone::c
