// SPDX-License-Identifier: BSD-3-Clause
// The bytes of arrays as .npy files hold them: little-endian, C order.
#pragma once

#include <bit>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace delone::io {

/// A view of the items as little-endian bytes; `storage` holds them on machines of the other byte order.
template <class T>
std::string_view little_endian_bytes(std::span<const T> items, std::string& storage) {
  const std::string_view native(reinterpret_cast<const char*>(items.data()), items.size_bytes());
  if constexpr (std::endian::native == std::endian::little) {
    static_cast<void>(storage);
    return native;
  } else {
    storage.resize(native.size());
    for (std::size_t i = 0; i < native.size(); ++i)
      storage[i] = native[i - i % sizeof(T) + sizeof(T) - 1 - i % sizeof(T)];
    return storage;
  }
}

}  // namespace delone::io
