// SPDX-License-Identifier: BSD-3-Clause
// Objects of the C interface: what all kinds have in common, and their members by name.
#pragma once

#include "call.hpp"

#include <delone/delone.h>
#include <delone/check.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace delone::c {

using Value = std::variant<delone_array, std::int64_t, double, const char*>;

/// A member of an object.
struct Member {
  const char* name;
  int type;  // DELONE_ARRAY, …: one more than the alternative of Value
  std::function<Value(const delone_object&)> get;
};
using Members = std::vector<Member>;

}  // namespace delone::c

/// An object. `const` functions may be called from several threads at once.
struct delone_object {
 public:
  delone_object() = default;
  delone_object(const delone_object&) = delete;
  delone_object& operator=(const delone_object&) = delete;
  virtual ~delone_object() = default;

  virtual const char* kind() const = 0;
  virtual const delone::c::Members& members() const = 0;

  // Of the kinds that can do this; others throw unsupported.
  virtual std::unique_ptr<delone_object> clone() const;
  virtual void insert(const double* rows, std::size_t num_rows, const double* weights);
  virtual delone::CheckReport check(const delone::CheckOptions& options, const delone::Execution& how) const;
  virtual void write(const std::string& path, const std::string& format) const;

 protected:
  [[noreturn]] void refuse(const char* what) const;
};

namespace delone::c {

/// The object as one of a class. Throws invalid_argument for NULL and for other objects: it is not
/// `expected`.
template <class T, class Object>
T& as(Object* object, const char* expected) {
  if (T* const found = dynamic_cast<T*>(&required(object, "the object"))) return *found;
  throw Error(Errc::invalid_argument,
              "the object is of the kind " + std::string(object->kind()) + ", not " + expected);
}

/// Options of checks without those of triangulations.
inline CheckOptions of_any_data(const CheckOptions& options) {
  CheckOptions result;
  result.up_to = options.up_to;
  return result;
}

template <class T>
constexpr int type_of() {
  if (std::same_as<T, double>) return DELONE_FLOAT64;
  static_assert(std::same_as<T, double> || sizeof(T) == 1 ||
                (std::signed_integral<T> && (sizeof(T) == 4 || sizeof(T) == 8)));
  return sizeof(T) == 1 ? DELONE_UINT8 : sizeof(T) == 4 ? DELONE_INT32 : DELONE_INT64;
}

/// Borrowed arrays: a list of numbers, and a matrix.
template <class Range>
delone_array list(const Range& items) {
  using T = std::remove_cvref_t<decltype(*std::data(items))>;
  const std::size_t n = std::size(items);
  return {n == 0 ? nullptr : static_cast<const void*>(std::data(items)), type_of<T>(), 1, {n, 1}};
}
template <class Range>
delone_array table(const Range& items, int columns) {
  delone_array array = list(items);
  const std::size_t width = columns < 0 ? 0 : static_cast<std::size_t>(columns);
  array.rank = 2;
  array.shape[0] = width == 0 ? 0 : array.shape[0] / width;
  array.shape[1] = width;
  return array;
}

template <class T>
Value value_of(const T& value) {
  if constexpr (std::integral<T>)
    return static_cast<std::int64_t>(value);
  else if constexpr (std::same_as<T, std::string>)
    return value.c_str();
  else
    return value;
}

/// A member of objects of a class. `get` returns a reference if it returns a string, which has to stay.
template <class Object, class Get>
Member member(const char* name, Get get) {
  using Result = std::invoke_result_t<Get, const Object&>;
  using Plain = std::remove_cvref_t<Result>;
  static_assert(!std::same_as<Plain, std::string> || std::is_reference_v<Result>);
  constexpr int type = std::same_as<Plain, delone_array> ? DELONE_ARRAY
                       : std::integral<Plain>            ? DELONE_INTEGER
                       : std::same_as<Plain, double>     ? DELONE_REAL
                                                         : DELONE_TEXT;
  return {name, type, [get](const delone_object& object) {
            return value_of<Plain>(get(static_cast<const Object&>(object)));
          }};
}

/// The members of a class of objects with those of their base.
inline Members operator+(Members members, Members more) {
  members.insert(members.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  return members;
}

/// What is computed at the first question and kept.
template <class T>
class Lazy {
 public:
  template <class Make>
  const T& get(Make make) const {
    const std::lock_guard lock(mutex_);
    if (!value_) value_.emplace(make());
    return *value_;
  }
  void reset() { value_.reset(); }

 private:
  mutable std::mutex mutex_;
  mutable std::optional<T> value_;
};

/// Does its work when a block ends, however it ends.
template <class Work>
class AtEnd {
 public:
  explicit AtEnd(Work work) : work_(std::move(work)) {}
  AtEnd(const AtEnd&) = delete;
  AtEnd& operator=(const AtEnd&) = delete;
  ~AtEnd() { work_(); }

 private:
  Work work_;
};

/// An object that is nothing but its members: answers and reports.
class Results final : public delone_object {
 public:
  explicit Results(const char* kind) : kind_(kind) {}
  const char* kind() const override { return kind_; }
  const Members& members() const override { return members_; }

  template <class T>
  void add(const char* name, std::vector<T> items) {
    const auto held = std::make_shared<const std::vector<T>>(std::move(items));
    members_.push_back({name, DELONE_ARRAY, [held](const delone_object&) -> Value { return list(*held); }});
  }
  template <class T>
  void add(const char* name, std::vector<T> items, int columns) {
    const auto held = std::make_shared<const std::vector<T>>(std::move(items));
    members_.push_back({name, DELONE_ARRAY,
                        [held, columns](const delone_object&) -> Value { return table(*held, columns); }});
  }
  void add(const char* name, const std::vector<std::size_t>& items) {
    add(name, std::vector<std::int64_t>(items.begin(), items.end()));
  }
  void add(const char* name, std::int64_t value) {
    members_.push_back({name, DELONE_INTEGER, [value](const delone_object&) -> Value { return value; }});
  }
  void add(const char* name, const std::string& text) {
    members_.push_back({name, DELONE_TEXT,
                        [text = std::make_shared<const std::string>(text)](const delone_object&) -> Value {
                          return text->c_str();
                        }});
  }

 private:
  const char* kind_;
  Members members_;
};

/// Lists of answers to queries: the entries of each query, which may come in any order of queries.
template <class T>
std::pair<std::vector<std::int64_t>, std::vector<T>> joined(const std::vector<std::vector<T>>& lists) {
  std::pair<std::vector<std::int64_t>, std::vector<T>> result;
  result.first.reserve(lists.size() + 1);
  result.first.push_back(0);
  for (const std::vector<T>& one : lists) {
    result.second.insert(result.second.end(), one.begin(), one.end());
    result.first.push_back(static_cast<std::int64_t>(result.second.size()));
  }
  return result;
}

}  // namespace delone::c
