// SPDX-License-Identifier: BSD-3-Clause
// Points of laser scanners: LAS 1.0 to 1.4, without compression. Of a record only its first 12 bytes are
// read, three integers; a coordinate is one of them times a scale, plus an offset.
#include "io/collect.hpp"
#include "io/file.hpp"
#include "io/points/read_points.hpp"

#include <bit>
#include <cstdint>
#include <limits>

namespace delone::io {

namespace {

/// Numbers at places of a header or record, little-endian.
class LasFields {
 public:
  explicit LasFields(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T at(std::size_t offset) const {
    std::uint64_t bits = 0;
    for (std::size_t i = sizeof(T); i-- > 0;)
      bits = (bits << 8) | static_cast<unsigned char>(bytes_[offset + i]);
    if constexpr (sizeof(T) == sizeof(double))
      return std::bit_cast<T>(bits);
    else
      return static_cast<T>(bits);
  }

 private:
  std::string_view bytes_;
};

constexpr std::size_t header_bytes = 227, header_bytes_of_1_4 = 375, least_record_bytes = 20;

struct LasHeader {
  std::uint64_t count;
  std::size_t begin, record_bytes;
  double scale[3], offset[3];
};

LasHeader read_las_header(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with("LASF"))
    fail(Errc::bad_format, "{}: not a .las file (its signature is missing)", name);
  const auto require = [&](std::size_t size) {
    if (bytes.size() < size)
      fail(Errc::bad_format, "{}: the header ends after {} of {} bytes", name, bytes.size(), size);
  };
  require(header_bytes);
  const LasFields fields(bytes);
  const int major = fields.at<std::uint8_t>(24), minor = fields.at<std::uint8_t>(25);
  if (major != 1 || minor > 4)
    fail(Errc::unsupported, "{}: LAS {}.{} is not supported; 1.0 to 1.4 are", name, major, minor);
  constexpr int compressed = 0x80;
  if ((fields.at<std::uint8_t>(104) & compressed) != 0)
    fail(Errc::unsupported, "{}: the points are compressed; {}", name, laz_advice);
  if (minor == 4) require(header_bytes_of_1_4);
  LasHeader header{.count = minor == 4 ? fields.at<std::uint64_t>(247) : fields.at<std::uint32_t>(107),
                   .begin = fields.at<std::uint32_t>(96),
                   .record_bytes = fields.at<std::uint16_t>(105),
                   .scale = {},
                   .offset = {}};
  if (header.record_bytes < least_record_bytes)
    fail(Errc::bad_format, "{}: records of {} bytes, fewer than the least, {}", name, header.record_bytes,
         least_record_bytes);
  for (std::size_t i = 0; i < 3; ++i) {
    header.scale[i] = fields.at<double>(131 + 8 * i);
    header.offset[i] = fields.at<double>(155 + 8 * i);
  }
  return header;
}

}  // namespace

PointTable read_las(std::string_view bytes, const std::string& name, Missing missing) {
  const LasHeader header = read_las_header(bytes, name);
  const std::size_t room =
      bytes.size() < header.begin ? 0 : (bytes.size() - header.begin) / header.record_bytes;
  if (header.count > room)
    fail(Errc::bad_format, "{}: expected {} points of {} bytes, the file ends after {}", name, header.count,
         header.record_bytes, room);
  PointCollector points(missing);
  points.table.dimension = 3;
  points.table.coordinates.reserve(3 * static_cast<std::size_t>(header.count));
  for (std::size_t row = 0; row < header.count; ++row) {
    const LasFields record(bytes.substr(header.begin + row * header.record_bytes, header.record_bytes));
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = record.at<std::int32_t>(4 * i) * header.scale[i] + header.offset[i];
      points.add(value, [&] { return fmt::format("{}: row {}: {} is not finite", name, row, value); });
    }
  }
  return points.finish();
}

}  // namespace delone::io
