// SPDX-License-Identifier: BSD-3-Clause
#include "io/complexes/json_file.hpp"

#include "base/quick_rounds.hpp"
#include "io/collect.hpp"
#include "io/file.hpp"
#include "io/text_cursor.hpp"
#include "messages/in_quotes.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace delone::io {
namespace {

std::string quoted(double x) { return fmt::format("'{}'", x); }

/// What a member is, where another kind was expected.
std::string description(const JsonMember& member) {
  if (member.fault && member.fault->depth == 0) return member.fault->found;
  switch (member.kind) {
    case JsonMember::Kind::number:
      return quoted(member.items[0]);
    case JsonMember::Kind::boolean:
      return "a boolean";
    case JsonMember::Kind::text:
      return "the string " + messages::in_quotes(member.text);
    default:
      return "an array";
  }
}

/// The row of an item.
std::size_t row_of(const JsonMember& member, std::size_t item) {
  if (member.kind != JsonMember::Kind::lists) return item;
  const auto end =
      std::upper_bound(member.offsets.begin(), member.offsets.end(), static_cast<std::int64_t>(item));
  return static_cast<std::size_t>(end - member.offsets.begin()) - 1;
}

class Handler : public nlohmann::json_sax<nlohmann::json> {
 public:
  Handler(const std::string& name, std::map<std::string, JsonMember>& members)
      : name_(name), members_(members) {}

  bool start_object(std::size_t) override {
    if (skip_ > 0) return ++skip_, true;
    if (!std::exchange(in_object_, true)) return true;
    add_fault("an object");
    skip_ = 1;
    return true;
  }
  bool end_object() override {
    if (skip_ > 0) --skip_;
    return true;
  }
  bool key(std::string& key) override {
    if (skip_ > 0) return true;
    const auto [at, is_new] = members_.try_emplace(key);
    if (!is_new) fail(Errc::bad_format, "{}: the member {} appears twice", name_, messages::in_quotes(key));
    key_ = key;
    member_ = &at->second;
    depth_ = 0;
    return true;
  }
  bool start_array(std::size_t) override {
    if (skip_ > 0) return ++skip_, true;
    require_object("an array");
    const bool fits =
        depth_ == 0 || (depth_ == 1 && (member_->kind == JsonMember::Kind::lists || member_->items.empty()));
    if (!fits) {
      add_fault("an array");
      skip_ = 1;
      return true;
    }
    member_->kind = depth_ == 0 ? JsonMember::Kind::list : JsonMember::Kind::lists;
    ++depth_;
    return true;
  }
  bool end_array() override {
    if (skip_ > 0) return --skip_, true;
    if (depth_-- == 2) member_->offsets.push_back(static_cast<std::int64_t>(member_->items.size()));
    return true;
  }

  bool number_integer(std::int64_t x) override { return number(static_cast<double>(x)); }
  bool number_unsigned(std::uint64_t x) override { return number(static_cast<double>(x)); }
  bool number_float(double x, const std::string&) override { return number(x); }
  bool null() override {
    if (skip_ > 0) return true;
    if (depth_ == 0) return other("null");
    member_->first_null = std::min(member_->first_null, member_->items.size());
    return number(std::numeric_limits<double>::infinity());
  }
  bool boolean(bool value) override {
    if (skip_ > 0 || depth_ > 0) return other("a boolean");
    require_object("a boolean");
    member_->kind = JsonMember::Kind::boolean;
    member_->items = {value ? 1.0 : 0.0};
    return true;
  }
  bool string(std::string& text) override {
    if (skip_ == 0 && depth_ == 1) member_->texts.push_back(text);
    if (skip_ > 0 || depth_ > 0) return other("the string " + messages::in_quotes(text));
    require_object("a string");
    member_->kind = JsonMember::Kind::text;
    member_->text = text;
    return true;
  }
  bool binary(nlohmann::json::binary_t&) override { return true; }  // text has none

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::json::exception& error) override {
    constexpr int number_overflow = 406;
    if (error.id == number_overflow && member_ != nullptr) {
      const bool in_row = skip_ == 0 && depth_ > 0;
      throw Error(Errc::not_finite,
                  fmt::format("{}: {}: {}{}", name_, printable(key_),
                              in_row ? fmt::format("row {}: ", row()) : "", describe_not_finite(token)),
                  in_row ? std::vector{row()} : std::vector<std::size_t>{});
    }
    std::string_view what = error.what();  // "[json.exception.parse_error.101] parse error at line 1, …"
    if (const auto close = what.find("] "); close != std::string_view::npos) what.remove_prefix(close + 2);
    // "…; last read: 'EXCERPT'", or with "; expected …" behind it: the excerpt is as long as the file wants.
    constexpr std::string_view before = "last read: '", after = "'; expected ";
    const auto begin = what.find(before);
    if (begin == std::string_view::npos)
      fail(Errc::bad_format, "{}: not valid JSON (byte {}): {}", name_, position, printable(what, 300));
    const std::string_view rest = what.substr(begin + before.size());
    const std::size_t end = std::min(rest.rfind(after), rest.rfind('\''));
    fail(Errc::bad_format, "{}: not valid JSON (byte {}): {}{}{}", name_, position,
         what.substr(0, begin + before.size() - 1), messages::in_quotes(rest.substr(0, end)),
         printable(rest.substr(std::min(end, rest.size() - 1) + 1)));
  }

 private:
  std::size_t row() const {
    return member_->kind == JsonMember::Kind::lists ? member_->offsets.size() - 1 : member_->items.size();
  }
  void require_object(std::string_view found) const {
    if (!in_object_) fail(Errc::bad_format, "{}: expected an object, found {}", name_, found);
  }
  void add_fault(std::string found) {
    if (!member_->fault) member_->fault = {depth_ > 0 ? row() : 0, depth_, std::move(found)};
  }
  bool other(const std::string& found) {
    if (skip_ > 0) return true;
    require_object(found);
    add_fault(found);
    return true;
  }
  bool number(double x) {
    rounds_();
    if (skip_ > 0) return true;
    require_object(quoted(x));
    if (depth_ == 0) member_->kind = JsonMember::Kind::number;
    if (depth_ == 1 && member_->kind == JsonMember::Kind::lists)
      add_fault(quoted(x));
    else
      member_->items.push_back(x);
    return true;
  }

  const std::string& name_;
  std::map<std::string, JsonMember>& members_;
  bool in_object_ = false;
  std::string key_;
  JsonMember* member_ = nullptr;
  int depth_ = 0;  ///< of arrays, within the member
  int skip_ = 0;   ///< of what nobody can read
  internal::QuickRounds rounds_;
};

}  // namespace

JsonFile::JsonFile(std::string_view bytes, std::string name) : name_(std::move(name)) {
  const std::string_view text = text_of(bytes, name_);
  Handler handler(name_, members_);
  nlohmann::json::sax_parse(text.begin(), text.end(), &handler);
}

std::vector<std::string> JsonFile::members() const {
  std::vector<std::string> names;
  for (const auto& [name, member] : members_) names.push_back(name);
  return names;
}

void JsonFile::refuse(const std::string& member, const JsonMember::Fault& fault, std::size_t rank,
                      bool indices) const {
  const auto depth = static_cast<std::size_t>(fault.depth);
  const std::string_view expected = depth >= rank       ? (indices ? "an integer" : "a number")
                                    : rank - depth == 2 ? "an array of arrays"
                                                        : "an array";
  fail(Errc::bad_format, "{}: {}: {}expected {}, found {}", name_, member,
       depth > 0 ? fmt::format("row {}: ", fault.row) : "", expected, fault.found);
}

std::vector<SignedIndex> JsonFile::indices_of(const std::string& member, const JsonMember& read,
                                              std::size_t rank) const {
  std::vector<SignedIndex> indices;
  indices.reserve(read.items.size());
  for (std::size_t i = 0; i < read.items.size(); ++i) {
    const double x = read.items[i];
    const auto depth = static_cast<int>(rank);
    if (i == read.first_null) refuse(member, {row_of(read, i), depth, "null"}, rank, true);
    if (x != std::floor(x)) refuse(member, {row_of(read, i), depth, quoted(x)}, rank, true);
    // The largest index of 64 bits is no double; the next one is.
    constexpr double limit = static_cast<double>(std::uint64_t{1} << (8 * sizeof(SignedIndex) - 1));
    if (x < -limit || x >= limit)
      fail(Errc::bad_format, "{}: {}: row {}: {} does not fit the {}-bit indices of this build", name_,
           member, row_of(read, i), x, 8 * sizeof(SignedIndex));
    indices.push_back(static_cast<SignedIndex>(x));
  }
  return indices;
}

template <class T>
std::vector<T> JsonFile::read(const std::string& member, std::size_t rank, bool nullable,
                              std::vector<std::size_t>& shape) {
  constexpr bool indices = std::is_same_v<T, SignedIndex>;
  JsonMember& found = members_.at(member);
  if (found.kind != JsonMember::Kind::list && found.kind != JsonMember::Kind::lists)
    refuse(member, {0, 0, description(found)}, rank, indices);
  if (rank == 1 && found.kind == JsonMember::Kind::lists) refuse(member, {0, 1, "an array"}, rank, indices);
  if (rank == 2 && found.kind == JsonMember::Kind::list && !found.items.empty())
    refuse(member, {0, 1, quoted(found.items[0])}, rank, indices);
  if (found.fault) refuse(member, *found.fault, rank, indices);
  if (!indices && !nullable && found.first_null != JsonMember::none)
    refuse(member, {row_of(found, found.first_null), static_cast<int>(rank), "null"}, rank, indices);
  shape = {found.items.size()};
  if (found.kind == JsonMember::Kind::lists) {
    const std::size_t rows = found.offsets.size() - 1;
    const std::int64_t columns = found.offsets[1];
    for (std::size_t row = 0; row < rows; ++row)
      if (const std::int64_t size = found.offsets[row + 1] - found.offsets[row]; size != columns)
        fail(Errc::bad_format, "{}: {}: row {}: expected {} numbers as in row 0, found {}", name_, member,
             row, columns, size);
    shape = {rows, static_cast<std::size_t>(columns)};
  }
  if constexpr (indices)
    return indices_of(member, found, rank);
  else
    return std::move(found.items);
}
template std::vector<double> JsonFile::read(const std::string&, std::size_t, bool, std::vector<std::size_t>&);
template std::vector<SignedIndex> JsonFile::read(const std::string&, std::size_t, bool,
                                                 std::vector<std::size_t>&);

std::vector<SignedIndex> JsonFile::read_lists(const std::string& member, std::vector<std::int64_t>& offsets) {
  JsonMember& found = members_.at(member);
  if (found.kind != JsonMember::Kind::list && found.kind != JsonMember::Kind::lists)
    refuse(member, {0, 0, description(found)}, 2, true);
  if (found.kind == JsonMember::Kind::list && !found.items.empty())
    refuse(member, {0, 1, quoted(found.items[0])}, 2, true);
  if (found.fault) refuse(member, *found.fault, 2, true);
  offsets = std::move(found.offsets);
  found.offsets = {0};
  return indices_of(member, found, 2);
}

void JsonFile::refuse_scalar(const std::string& member, std::string_view expected) const {
  fail(Errc::bad_format, "{}: {}: expected {}, found {}", name_, member, expected,
       description(members_.at(member)));
}

std::vector<std::string> JsonFile::find_texts(const std::string& member) const {
  const auto at = members_.find(member);
  if (at == members_.end()) return {};
  if (at->second.kind != JsonMember::Kind::list || !at->second.items.empty() ||
      (at->second.fault && at->second.texts.empty()))
    fail(Errc::bad_format, "{}: {}: expected an array of strings", name_, member);
  return at->second.texts;
}

std::optional<std::string> JsonFile::find_text(const std::string& member) const {
  const auto at = members_.find(member);
  if (at == members_.end()) return std::nullopt;
  if (at->second.kind != JsonMember::Kind::text) refuse_scalar(member, "a string");
  return at->second.text;
}

std::optional<std::int64_t> JsonFile::find_number(const std::string& member) const {
  const auto at = members_.find(member);
  if (at == members_.end()) return std::nullopt;
  constexpr double limit = 0x1p62;
  if (at->second.kind != JsonMember::Kind::number || at->second.items[0] != std::floor(at->second.items[0]) ||
      std::abs(at->second.items[0]) > limit)
    refuse_scalar(member, "an integer");
  return static_cast<std::int64_t>(at->second.items[0]);
}

std::optional<bool> JsonFile::find_flag(const std::string& member) const {
  const auto at = members_.find(member);
  if (at == members_.end()) return std::nullopt;
  if (at->second.kind != JsonMember::Kind::boolean) refuse_scalar(member, "true or false");
  return at->second.items[0] != 0;
}

std::optional<std::size_t> JsonFile::find_choice(const std::string& member,
                                                 std::span<const char* const> choices) const {
  const auto at = members_.find(member);
  if (at == members_.end()) return std::nullopt;
  if (at->second.kind != JsonMember::Kind::text) return choices.size();
  return static_cast<std::size_t>(std::find(choices.begin(), choices.end(), at->second.text) -
                                  choices.begin());
}

}  // namespace delone::io
