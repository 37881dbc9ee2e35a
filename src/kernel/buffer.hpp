// SPDX-License-Identifier: BSD-3-Clause
// Scratch arrays: on the stack when the size is known at compile time, on the heap otherwise.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

namespace delone::kernel {

/// Room for Size entries, uninitialised.
template <class T, int Size>
class StackBuffer {
 public:
  explicit StackBuffer(std::size_t) {}  // NOLINT: entries are written before they are read
  T* data() { return entries_; }
  const T* data() const { return entries_; }
  T& operator[](std::size_t i) { return entries_[i]; }
  const T& operator[](std::size_t i) const { return entries_[i]; }

 private:
  T entries_[static_cast<std::size_t>(Size)];
};

/// An array whose size depends on a dimension, constructed with that size: Size entries on the stack if the
/// dimension is a template parameter (the size is then at most Size), a vector if Size is 0.
template <class T, int Size>
using Buffer = std::conditional_t<(Size > 0), StackBuffer<T, (Size > 0 ? Size : 1)>, std::vector<T>>;

}  // namespace delone::kernel
