// SPDX-License-Identifier: BSD-3-Clause
// CMake defines DELONE_WITH_ZLIB for this file: 1 if the build has zlib.
#include "view/encode.hpp"

#if DELONE_WITH_ZLIB
#include <zlib.h>

#include <limits>
#endif

namespace delone::view {

#if DELONE_WITH_ZLIB

bool deflate(std::string& bytes) {
  if (bytes.size() > std::numeric_limits<uLong>::max() / 2) return false;
  std::string packed(compressBound(static_cast<uLong>(bytes.size())), '\0');
  auto size = static_cast<uLongf>(packed.size());
  const int status =
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), 6);
  if (status != Z_OK || size >= bytes.size()) return false;
  packed.resize(size);
  bytes = std::move(packed);
  return true;
}

#else

bool deflate(std::string&) { return false; }

#endif

}  // namespace delone::view
