// SPDX-License-Identifier: BSD-3-Clause
// std::atomic_ref, or what the library uses of it: libc++ has it from version 19 on.
#pragma once

#include <atomic>

namespace delone::internal {

#ifdef __cpp_lib_atomic_ref
template <class T>
using AtomicRef = std::atomic_ref<T>;
#else
/// By the builtins of clang and g++.
template <class T>
class AtomicRef {
 public:
  explicit AtomicRef(T& value) : value_(&value) {}
  T load(std::memory_order order) const noexcept {
    T result;
    __atomic_load(value_, &result, static_cast<int>(order));
    return result;
  }
  void store(T value, std::memory_order order) const noexcept {
    __atomic_store(value_, &value, static_cast<int>(order));
  }
  T fetch_add(T more, std::memory_order order) const noexcept {
    return __atomic_fetch_add(value_, more, static_cast<int>(order));
  }
  bool compare_exchange_weak(T& expected, T value, std::memory_order order) const noexcept {
    return __atomic_compare_exchange(value_, &expected, &value, true, static_cast<int>(order),
                                     __ATOMIC_RELAXED);
  }

 private:
  T* value_;
};
#endif

}  // namespace delone::internal
