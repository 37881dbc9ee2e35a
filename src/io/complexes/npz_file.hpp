// SPDX-License-Identifier: BSD-3-Clause
// The arrays of an .npz file by name.
#pragma once

#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/zip.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace delone::io {

class NpzFile {
 public:
  /// Whether lists of lists are members of their own, and whether a matrix without rows has columns.
  static constexpr bool nests_lists = false, tells_columns = true;

  /// `bytes` must outlive this.
  NpzFile(std::string_view bytes, std::string name) : zip_(bytes, name), name_(std::move(name)) {}

  const std::string& name() const { return name_; }
  bool has(const std::string& member) const { return zip_.find(member + ".npy").has_value(); }
  std::vector<std::string> members() const {
    std::vector<std::string> names;
    for (const ZipMember& m : zip_.members())
      names.push_back(m.name.ends_with(".npy") ? m.name.substr(0, m.name.size() - 4) : m.name);
    return names;
  }

  /// An array of `rank` dimensions, of double or SignedIndex.
  template <class T>
  std::vector<T> read(const std::string& member, std::size_t rank, bool /*nullable*/,
                      std::vector<std::size_t>& shape) const {
    const NpyArray array = parse(member);
    if (array.shape.size() != rank)
      fail(Errc::bad_format, "{}: {}: expected a {}-D array, found shape {}", name_, member, rank,
           shape_text(array.shape));
    shape = array.shape;
    if constexpr (std::is_same_v<T, double>)
      return to_doubles(array, name_ + ": " + member);
    else
      return to_indices(array, name_ + ": " + member);
  }

  /// An array of texts; empty if there is no such member.
  std::vector<std::string> find_texts(const std::string& member) const {
    if (!has(member)) return {};
    return parse_npy_texts(*zip_.find(member + ".npy"), name_ + ": " + member);
  }
  /// A text; nullopt if there is no such member. Throws bad_format for anything else.
  std::optional<std::string> find_text(const std::string& member) const {
    if (!has(member)) return std::nullopt;
    return parse_npy_texts(*zip_.find(member + ".npy"), name_ + ": " + member, 0)[0];
  }
  std::optional<std::int64_t> find_number(const std::string& member) const {
    if (!has(member)) return std::nullopt;
    const NpyArray array = parse(member);
    const std::vector<SignedIndex> items = to_indices(array, name_ + ": " + member);
    if (items.size() != 1)
      fail(Errc::bad_format, "{}: {}: expected one number, found shape {}", name_, member,
           shape_text(array.shape));
    return items[0];
  }
  std::optional<bool> find_flag(const std::string& member) const {
    const auto number = find_number(member);
    return number ? std::optional(*number != 0) : std::nullopt;
  }
  /// The index of a choice; the number of choices if it is none of them.
  std::optional<std::size_t> find_choice(const std::string& member,
                                         std::span<const char* const> choices) const {
    const auto number = find_number(member);
    if (!number) return std::nullopt;
    return *number < 0 ? choices.size() : std::min(static_cast<std::size_t>(*number), choices.size());
  }

 private:
  NpyArray parse(const std::string& member) const {
    return parse_npy(*zip_.find(member + ".npy"), name_ + ": " + member);
  }

  ZipReader zip_;
  std::string name_;
};

}  // namespace delone::io
