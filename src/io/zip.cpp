// SPDX-License-Identifier: BSD-3-Clause
// Stored zip archives. See zip.hpp. All fields are little-endian; every offset read is checked before it is
// followed.
#include "io/zip.hpp"

#include "io/atomic_file.hpp"
#include "io/crc32.hpp"
#include "io/file.hpp"
#include "messages/in_quotes.hpp"

#include <algorithm>

namespace delone::io {

namespace {

constexpr std::uint32_t local_signature = 0x04034b50, central_signature = 0x02014b50,
                        end_signature = 0x06054b50, end64_signature = 0x06064b50,
                        locator64_signature = 0x07064b50;
constexpr std::size_t local_size = 30, central_size = 46, end_size = 22, end64_size = 56, locator64_size = 20;
constexpr std::uint16_t plain_version = 20, zip64_version = 45, zip64_extra = 0x0001;
constexpr std::uint32_t in_zip64 =
    0xffffffff;  // the value of a 32-bit field whose true value is in the zip64 extra
constexpr std::uint16_t dos_date_1980 = 0x0021;  // fixed: equal content gives equal files

std::uint64_t field(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}
std::uint16_t u16(std::string_view b, std::size_t at) { return static_cast<std::uint16_t>(field(b, at, 2)); }
std::uint32_t u32(std::string_view b, std::size_t at) { return static_cast<std::uint32_t>(field(b, at, 4)); }
std::uint64_t u64(std::string_view b, std::size_t at) { return field(b, at, 8); }

/// A record under construction.
struct Record {
  std::string bytes;
  Record& put(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
    return *this;
  }
};

/// The bytes [at, at + size), or bad_format.
std::string_view part(std::string_view bytes, std::uint64_t at, std::uint64_t size, const std::string& name) {
  if (at > bytes.size() || size > bytes.size() - at)
    fail(Errc::bad_format,
         "{}: damaged or truncated archive: expected {} bytes at offset {}, the file has {}", name, size, at,
         bytes.size());
  return bytes.substr(static_cast<std::size_t>(at), static_cast<std::size_t>(size));
}

/// Fills in the values of `member` that its 32-bit fields refer to the zip64 extra field.
void read_zip64_extra(std::string_view extra, ZipMember& member, const std::string& name) {
  std::vector<std::uint64_t*> wanted;
  for (std::uint64_t* value : {&member.size, &member.compressed_size, &member.offset})
    if (*value == in_zip64) wanted.push_back(value);
  if (wanted.empty()) return;
  while (extra.size() >= 4) {
    const std::uint16_t id = u16(extra, 0);
    const std::string_view content = part(extra, 4, u16(extra, 2), name);
    if (id == zip64_extra && content.size() >= 8 * wanted.size()) {
      for (std::size_t i = 0; i < wanted.size(); ++i) *wanted[i] = u64(content, 8 * i);
      return;
    }
    extra.remove_prefix(4 + content.size());
  }
}

}  // namespace

void ZipWriter::put(const std::string& record) {
  file_.write(record);
  offset_ += record.size();
}

void ZipWriter::add(const std::string& name, std::string_view head, std::string_view body) {
  ZipMember m;
  m.name = name;
  m.crc = crc32(body, crc32(head));
  m.size = m.compressed_size = std::uint64_t{head.size()} + body.size();
  m.offset = offset_;
  const bool large = m.size >= zip64_from_;
  Record r;
  r.put(local_signature, 4)
      .put(large ? zip64_version : plain_version, 2)
      .put(0, 2)
      .put(0, 2)
      .put(0, 2)
      .put(dos_date_1980, 2);
  r.put(m.crc, 4).put(large ? in_zip64 : m.size, 4).put(large ? in_zip64 : m.size, 4);
  r.put(name.size(), 2).put(large ? 20 : 0, 2).bytes += name;
  if (large) r.put(zip64_extra, 2).put(16, 2).put(m.size, 8).put(m.size, 8);
  put(r.bytes);
  file_.write(head);
  file_.write(body);
  offset_ += m.size;
  members_.push_back(std::move(m));
}

void ZipWriter::finish() {
  const std::uint64_t start = offset_;
  for (const ZipMember& m : members_) {
    const bool large = m.size >= zip64_from_, far = m.offset >= zip64_from_;
    const unsigned extra = 8 * ((large ? 2 : 0) + (far ? 1 : 0));
    const std::uint16_t version = extra != 0 ? zip64_version : plain_version;
    Record r;
    r.put(central_signature, 4)
        .put(version, 2)
        .put(version, 2)
        .put(0, 2)
        .put(0, 2)
        .put(0, 2)
        .put(dos_date_1980, 2);
    r.put(m.crc, 4).put(large ? in_zip64 : m.size, 4).put(large ? in_zip64 : m.size, 4);
    r.put(m.name.size(), 2).put(extra != 0 ? extra + 4 : 0, 2).put(0, 2).put(0, 2).put(0, 2).put(0, 4);
    r.put(far ? in_zip64 : m.offset, 4).bytes += m.name;
    if (extra != 0) r.put(zip64_extra, 2).put(extra, 2);
    if (large) r.put(m.size, 8).put(m.size, 8);
    if (far) r.put(m.offset, 8);
    put(r.bytes);
  }
  const std::uint64_t size = offset_ - start, count = members_.size();
  const bool large = start >= zip64_from_ || size >= zip64_from_;
  Record r;
  if (large) {
    r.put(end64_signature, 4)
        .put(end64_size - 12, 8)
        .put(zip64_version, 2)
        .put(zip64_version, 2)
        .put(0, 4)
        .put(0, 4);
    r.put(count, 8).put(count, 8).put(size, 8).put(start, 8);
    r.put(locator64_signature, 4).put(0, 4).put(offset_, 8).put(1, 4);
  }
  r.put(end_signature, 4).put(0, 2).put(0, 2).put(count, 2).put(count, 2);
  r.put(large ? in_zip64 : size, 4).put(large ? in_zip64 : start, 4).put(0, 2);
  put(r.bytes);
}

void require_zip(std::string_view opening, const std::string& name) {
  if (opening.empty()) fail(Errc::bad_format, "{}: the file is empty", name);
  if (!opening.starts_with("PK")) fail(Errc::bad_format, "{}: not an .npz file (not a zip archive)", name);
}

ZipReader::ZipReader(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {
  require_zip(bytes, name_);
  // The end record is the last thing in the file but for a comment of at most 65535 bytes.
  const std::string end_mark("PK\x05\x06");
  const std::size_t at =
      bytes.size() < end_size ? std::string_view::npos : bytes.rfind(end_mark, bytes.size() - end_size);
  if (at == std::string_view::npos || bytes.size() - at > end_size + 0xffff)
    fail(Errc::bad_format, "{}: truncated archive: it has no directory", name_);
  std::uint64_t count = u16(bytes, at + 10), size = u32(bytes, at + 12), start = u32(bytes, at + 16);
  if (count == 0xffff || size == in_zip64 || start == in_zip64) {
    if (at >= locator64_size && u32(bytes, at - locator64_size) == locator64_signature) {
      const std::string_view end64 = part(bytes, u64(bytes, at - locator64_size + 8), end64_size, name_);
      if (u32(end64, 0) != end64_signature)
        fail(Errc::bad_format, "{}: damaged archive: zip64 directory", name_);
      count = u64(end64, 32);
      size = u64(end64, 40);
      start = u64(end64, 48);
    }
  }
  std::string_view directory = part(bytes, start, size, name_);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string_view fixed = part(directory, 0, central_size, name_);
    if (u32(fixed, 0) != central_signature)
      fail(Errc::bad_format, "{}: damaged archive: directory entry {}", name_, i);
    ZipMember m;
    m.flags = u16(fixed, 8);
    m.method = u16(fixed, 10);
    m.crc = u32(fixed, 16);
    m.compressed_size = u32(fixed, 20);
    m.size = u32(fixed, 24);
    m.offset = u32(fixed, 42);
    const std::size_t name_size = u16(fixed, 28), extra_size = u16(fixed, 30), comment_size = u16(fixed, 32);
    m.name = part(directory, central_size, name_size, name_);
    read_zip64_extra(part(directory, central_size + name_size, extra_size, name_), m, name_);
    directory.remove_prefix(
        part(directory, 0, central_size + name_size + extra_size + comment_size, name_).size());
    if (local_part(m, local_size, u16(local_header(m), 26)) != m.name)
      fail(Errc::bad_format,
           "{}: damaged archive: the directory and a member disagree about its name, {} or {}", name_,
           messages::in_quotes(m.name),
           messages::in_quotes(local_part(m, local_size, u16(local_header(m), 26))));
    members_.push_back(std::move(m));
  }
  if (!directory.empty())
    fail(Errc::bad_format, "{}: damaged archive: the directory has more than {} entries", name_, count);
  std::vector<std::string_view> names;
  for (const ZipMember& m : members_) names.push_back(m.name);
  std::sort(names.begin(), names.end());
  if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end())
    fail(Errc::bad_format, "{}: the member {} appears twice", name_, messages::in_quotes(*twice));
}

std::string_view ZipReader::local_part(const ZipMember& m, std::uint64_t at, std::uint64_t size) const {
  return part(bytes_, m.offset + at, size, name_);
}

std::string_view ZipReader::local_header(const ZipMember& m) const {
  if (m.offset > bytes_.size()) part(bytes_, m.offset, local_size, name_);  // no sum of offsets overflows
  const std::string_view local = local_part(m, 0, local_size);
  if (u32(local, 0) != local_signature)
    fail(Errc::bad_format, "{}: {}: damaged archive: no member there", name_, printable(m.name));
  return local;
}

std::optional<std::string_view> ZipReader::find(std::string_view member) const {
  const auto found =
      std::find_if(members_.begin(), members_.end(), [&](const ZipMember& m) { return m.name == member; });
  if (found == members_.end()) return std::nullopt;
  const ZipMember& m = *found;
  if ((m.flags & 1) != 0) fail(Errc::unsupported, "{}: {}: the member is encrypted", name_, member);
  if (m.method != 0)
    fail(
        Errc::unsupported,
        "{}: {}: the member is compressed; write the file with numpy.savez instead of numpy.savez_compressed",
        name_, member);
  if (m.compressed_size != m.size)
    fail(Errc::bad_format, "{}: {}: damaged archive: sizes disagree", name_, member);
  const std::string_view local = local_header(m);
  const std::string_view content = local_part(m, local_size + u16(local, 26) + u16(local, 28), m.size);
  if (crc32(content) != m.crc)
    fail(Errc::bad_format, "{}: {}: damaged archive: the checksum is wrong", name_, member);
  return content;
}

}  // namespace delone::io
