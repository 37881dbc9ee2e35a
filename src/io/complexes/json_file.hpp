// SPDX-License-Identifier: BSD-3-Clause
// The members of a JSON object by name: numbers, booleans, texts, arrays of numbers, and arrays of arrays of
// numbers. Read as a stream of events, so that no tree of the whole file is built. Members of other kinds are
// an error only for who reads them.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace delone::io {

struct JsonMember {
  enum class Kind { number, boolean, text, list, lists, other };
  /// An entry that is neither a number nor, at depth 1, an array of numbers; or the member itself.
  struct Fault {
    std::size_t row = 0;
    int depth = 0;  ///< 0 the member, 1 a row of it, 2 an entry of a row
    std::string found;
  };
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  Kind kind = Kind::other;
  std::string text;                         ///< of a text
  std::vector<std::string> texts;           ///< entries that are texts; each is a fault, too
  std::vector<double> items;                ///< a boolean is 0 or 1, null in an array infinity
  std::vector<std::int64_t> offsets = {0};  ///< of lists
  std::size_t first_null = none;            ///< the item that is null
  std::optional<Fault> fault;               ///< the first one
};

class JsonFile {
 public:
  static constexpr bool nests_lists = true, tells_columns = false;

  JsonFile(std::string_view bytes, std::string name);

  const std::string& name() const { return name_; }
  bool has(const std::string& member) const { return members_.contains(member); }
  std::vector<std::string> members() const;

  /// An array of `rank` dimensions, of double or SignedIndex, whose content is moved out. null stands for
  /// infinity if `nullable`, and is an error otherwise and in arrays of indices. The shape of a matrix
  /// without rows is (0,).
  template <class T>
  std::vector<T> read(const std::string& member, std::size_t rank, bool nullable,
                      std::vector<std::size_t>& shape);
  /// An array of arrays of indices.
  std::vector<SignedIndex> read_lists(const std::string& member, std::vector<std::int64_t>& offsets);

  /// An array of texts; empty if there is no such member. Throws bad_format for anything else.
  std::vector<std::string> find_texts(const std::string& member) const;
  /// A text; nullopt if there is no such member. Throws bad_format for anything else.
  std::optional<std::string> find_text(const std::string& member) const;
  std::optional<std::int64_t> find_number(const std::string& member) const;
  std::optional<bool> find_flag(const std::string& member) const;
  /// The index of a choice; the number of choices if it is none of them.
  std::optional<std::size_t> find_choice(const std::string& member,
                                         std::span<const char* const> choices) const;

 private:
  [[noreturn]] void refuse(const std::string& member, const JsonMember::Fault& fault, std::size_t rank,
                           bool indices) const;
  [[noreturn]] void refuse_scalar(const std::string& member, std::string_view expected) const;
  std::vector<SignedIndex> indices_of(const std::string& member, const JsonMember& read,
                                      std::size_t rank) const;

  std::string name_;
  std::map<std::string, JsonMember> members_;
};

}  // namespace delone::io
