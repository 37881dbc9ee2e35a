// SPDX-License-Identifier: BSD-3-Clause
// Zip archives of stored (uncompressed) members, which is what an .npz is; zip64 where a size or an offset
// needs it. Reference: PKWARE, APPNOTE.TXT, version 6.3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace delone::io {

class AtomicFile;

/// Where a member lies; `offset` is that of its local header.
struct ZipMember {
  std::string name;
  std::uint32_t crc = 0;
  std::uint16_t method = 0, flags = 0;
  std::uint64_t compressed_size = 0, size = 0, offset = 0;
};

class ZipWriter {
 public:
  /// Values from `zip64_from` on are written in zip64 form; the default is the first that the 32-bit fields
  /// cannot hold.
  explicit ZipWriter(AtomicFile& file, std::uint64_t zip64_from = 0xffffffffu)
      : file_(file), zip64_from_(zip64_from) {}

  /// Adds a member whose content is `head` followed by `body`.
  void add(const std::string& name, std::string_view head, std::string_view body);
  /// Writes the directory. Nothing may be added afterwards.
  void finish();

 private:
  void put(const std::string& record);

  AtomicFile& file_;
  std::uint64_t zip64_from_;
  std::uint64_t offset_ = 0;
  std::vector<ZipMember> members_;
};

/// Throws bad_format unless a file with this opening can be an archive.
void require_zip(std::string_view opening, const std::string& name);

class ZipReader {
 public:
  /// Reads the directory of an archive in memory; `bytes` must outlive the reader. The directory has to have
  /// as many entries as the archive says, each with a name of its own, which its member repeats. Throws
  /// bad_format.
  ZipReader(std::string_view bytes, std::string name);

  const std::vector<ZipMember>& members() const { return members_; }
  /// The content of a member, its checksum verified; nothing if there is no such member. Throws bad_format,
  /// or unsupported for compressed and encrypted members.
  std::optional<std::string_view> find(std::string_view member) const;

 private:
  /// Of the member where it lies: bytes counted from its local header, or that.
  std::string_view local_part(const ZipMember& m, std::uint64_t at, std::uint64_t size) const;
  std::string_view local_header(const ZipMember& m) const;

  std::string_view bytes_;
  std::string name_;
  std::vector<ZipMember> members_;
};

}  // namespace delone::io
