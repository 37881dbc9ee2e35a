// SPDX-License-Identifier: BSD-3-Clause
// CMake defines DELONE_WITH_ZLIB for this file: 1 if the build has zlib.
#include "view/encode.hpp"

#include <string>

#if DELONE_WITH_ZLIB
#include "base/progress_meter.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#endif

namespace delone::view {

#if DELONE_WITH_ZLIB

bool deflate(std::string& bytes, const std::function<void(double)>& tell) {
  z_stream stream{};
  if (deflateInit(&stream, 6) != Z_OK) return false;
  const std::unique_ptr<z_stream, int (*)(z_stream*)> ends(&stream, &deflateEnd);
  // In parts of some milliseconds; no more is written than there was.
  constexpr std::size_t part = std::size_t{1} << 17;
  std::string packed;
  std::array<char, 1 << 16> room;
  std::size_t taken = 0;
  for (int status = Z_OK; status != Z_STREAM_END;) {
    internal::cancellation_point();
    if (stream.avail_in == 0 && taken < bytes.size()) {
      const std::size_t size = std::min(part, bytes.size() - taken);
      stream.next_in = reinterpret_cast<Bytef*>(bytes.data() + taken);
      stream.avail_in = static_cast<uInt>(size);
      if (tell) tell(static_cast<double>(taken) / static_cast<double>(bytes.size()));
      taken += size;
    }
    stream.next_out = reinterpret_cast<Bytef*>(room.data());
    stream.avail_out = static_cast<uInt>(room.size());
    status = ::deflate(&stream, taken == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR) return false;
    packed.append(room.data(), room.size() - stream.avail_out);
    if (packed.size() >= bytes.size()) return false;
  }
  bytes = std::move(packed);
  return true;
}

#else

bool deflate(std::string&, const std::function<void(double)>&) { return false; }

#endif

}  // namespace delone::view
