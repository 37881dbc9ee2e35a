// SPDX-License-Identifier: BSD-3-Clause
#include "io/complexes/write_arrays.hpp"

#include "io/atomic_file.hpp"
#include "io/complexes/arrays.hpp"
#include "io/complexes/json_file.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/utf8.hpp"
#include "io/write_npy.hpp"
#include "io/zip.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace delone::io {
namespace {

std::size_t product(std::initializer_list<std::size_t> shape) {
  std::size_t size = 1;
  for (const std::size_t extent : shape) size *= extent;
  return size;
}

class Validator {
 public:
  explicit Validator(const std::string& name) : name_(name) {}

  template <class T>
  void operator()(const Array& array, const std::vector<T>& items,
                  std::initializer_list<std::size_t> shape) const {
    if (items.size() != product(shape) && (array.required || !items.empty()))
      fail(Errc::invalid_argument,
           "{}: cannot write: {}: expected shape {}, as of the other arrays, found {} {}", name_, array.name,
           shape_text(shape), items.size(), items.size() == 1 ? "number" : "numbers");
  }
  template <class Offset>
  void lists(const Lists& lists, const std::vector<Offset>& offsets,
             const std::vector<SignedIndex>& items) const {
    const bool are_lists = offsets.empty()
                               ? items.empty()
                               : offsets.front() == 0 && std::is_sorted(offsets.begin(), offsets.end()) &&
                                     static_cast<std::size_t>(offsets.back()) == items.size();
    if (!are_lists)
      fail(Errc::invalid_argument, "{}: cannot write: {}: no offsets into the {} entries of {}", name_,
           lists.offsets, items.size(), lists.items);
  }

 private:
  const std::string& name_;
};

/// Whether an array is known; the others are left out.
template <class T>
bool is_known(const Array& array, const std::vector<T>& items, std::initializer_list<std::size_t> shape) {
  return array.required || items.size() == product(shape);
}

class NpzWriter {
 public:
  explicit NpzWriter(AtomicFile& file) : zip_(file) {}

  template <class T>
  void operator()(const Array& array, const std::vector<T>& items, std::initializer_list<std::size_t> shape) {
    if (!is_known(array, items, shape)) return;
    if constexpr (std::is_enum_v<T> || std::is_same_v<T, int>) {
      std::vector<SignedIndex> numbers;
      for (const T item : items) numbers.push_back(static_cast<SignedIndex>(item));
      add(array.name, std::span<const SignedIndex>(numbers), shape);
    } else {
      add(array.name, std::span<const T>(items), shape);
    }
  }
  template <class Offset>
  void lists(const Lists& lists, const std::vector<Offset>& offsets, const std::vector<SignedIndex>& items) {
    add(lists.offsets, std::span<const Offset>(offsets), {offsets.size()});
    add(lists.items, std::span<const SignedIndex>(items), {items.size()});
  }
  void number(const char* name, std::int64_t value) {
    add(name, std::span<const std::int64_t>(&value, 1), {});
  }
  void texts(const std::string& name, const std::vector<std::string>& items) {
    zip_.add(name + ".npy", npy_of_texts(items), {});
  }
  void text(const std::string& name, std::string_view item) {
    zip_.add(name + ".npy", npy_of_text(item), {});
  }
  void finish() { zip_.finish(); }

 private:
  template <class T>
  void add(const std::string& name, std::span<const T> items, std::initializer_list<std::size_t> shape) {
    const std::string_view type = std::is_same_v<T, double>         ? "f8"
                                  : std::is_same_v<T, std::int64_t> ? "i8"
                                                                    : npy_index_type;
    zip_.add(name + ".npy", npy_header(type, shape), little_endian_bytes(items, storage_));
  }

  ZipWriter zip_;
  std::string storage_;
};

class JsonWriter {
 public:
  explicit JsonWriter(AtomicFile& file) : file_(file) {}

  template <class T>
  void operator()(const Array& array, const std::vector<T>& items, std::initializer_list<std::size_t> shape) {
    if (!is_known(array, items, shape)) return;
    member(array.name);
    const std::span<const T> all(items);
    if (shape.size() == 1) return row(all);
    const std::size_t columns = shape.begin()[1];
    rows(columns == 0 ? 0 : items.size() / columns,
         [&](std::size_t i) { row(all.subspan(i * columns, columns)); });
  }
  template <class Offset>
  void lists(const Lists& lists, const std::vector<Offset>& offsets, const std::vector<SignedIndex>& items) {
    if (lists.nested == nullptr) {
      (*this)(Array{lists.offsets}, offsets, {offsets.size()});
      return (*this)(Array{lists.items}, items, {items.size()});
    }
    member(lists.nested);
    rows(offsets.empty() ? 0 : offsets.size() - 1, [&](std::size_t i) {
      row(std::span(items).subspan(static_cast<std::size_t>(offsets[i]),
                                   static_cast<std::size_t>(offsets[i + 1] - offsets[i])));
    });
  }
  /// `value` is a JSON value.
  void scalar(const char* name, std::string_view value) {
    member(name);
    file_.write(value);
  }
  void texts(const char* name, const std::vector<std::string>& items) {
    std::string list = "[";
    for (const std::string& item : items) list += (list.size() > 1 ? ", " : "") + json_of_text(item);
    scalar(name, list + "]");
  }
  void finish() { file_.write("\n}\n"); }

 private:
  void member(const char* name) {
    file_.print("{}\n\"{}\": ", is_first_ ? '{' : ',', name);
    is_first_ = false;
  }
  template <class WriteRow>
  void rows(std::size_t count, WriteRow write_row) {
    file_.put('[');
    for (std::size_t i = 0; i < count; ++i) {
      file_.write(i == 0 ? "\n" : ",\n");
      write_row(i);
    }
    file_.write(count == 0 ? "]" : "\n]");
  }
  template <class T>
  void row(std::span<const T> items) {
    file_.put('[');
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (i > 0) file_.write(", ");
      put(items[i]);
    }
    file_.put(']');
  }
  /// JSON has no infinities and no NaN.
  void put(double x) {
    if (!std::isfinite(x))
      file_.write("null");
    else if (x == 0)
      file_.write(std::signbit(x) ? "-0.0" : "0");  // "-0" would be read as an integer
    else
      file_.put(x);
  }
  template <class Integer>
  void put(Integer x) {
    file_.put(static_cast<std::int64_t>(x));
  }

  AtomicFile& file_;
  bool is_first_ = true;
};

}  // namespace

template <PlainData Data>
void validate(const Data& data, const std::string& name) {
  if (data.dimension < 1)
    fail(Errc::bad_dimension, "{}: cannot write: the dimension is {}", name, data.dimension);
  if constexpr (!std::is_same_v<Data, IntersectionData>)
    if (data.affine_dimension < -1 || data.affine_dimension > data.dimension)
      fail(Errc::invalid_argument, "{}: cannot write: the affine dimension is {}, outside -1...{}", name,
           data.affine_dimension, data.dimension);
  if (!fits<Data>(data.kind))
    fail(Errc::invalid_argument, "{}: cannot write: the kind is {}, which has other arrays", name,
         name_of(data.kind));
  for_each_array(data, Validator(name));
  if constexpr (!std::is_same_v<Data, IntersectionData>)
    if (!data.column_names.empty() && data.column_names.size() != static_cast<std::size_t>(data.dimension))
      fail(Errc::invalid_argument, "{}: cannot write: {} column_names for dimension {}", name,
           data.column_names.size(), data.dimension);
}

template <PlainData Data>
void write_npz(AtomicFile& file, const Data& data) {
  NpzWriter writer(file);
  for_each_array(data, writer);
  if (data.kind != DataKind::unknown) writer.text("kind", name_of(data.kind));
  if constexpr (std::is_same_v<Data, IntersectionData>) {
    writer.number("dimension", data.dimension);
    writer.number("rank", data.rank);
    writer.number("state", static_cast<std::int64_t>(data.state));
    writer.number("bounded", data.bounded);
    writer.number("interior_point_is_exact", data.interior_point_is_exact);
  } else {
    writer.number("affine_dimension", data.affine_dimension);
    if (!data.column_names.empty()) writer.texts("column_names", data.column_names);
  }
  writer.finish();
}

template <PlainData Data>
void write_json(AtomicFile& file, const Data& data) {
  JsonWriter writer(file);
  if (data.kind != DataKind::unknown) writer.scalar("kind", fmt::format("\"{}\"", name_of(data.kind)));
  writer.scalar("dimension", std::to_string(data.dimension));
  if constexpr (std::is_same_v<Data, IntersectionData>) {
    const auto flag = [](bool value) { return value ? "true" : "false"; };
    writer.scalar("rank", std::to_string(data.rank));
    writer.scalar("state", fmt::format("\"{}\"", state_names[static_cast<std::size_t>(data.state)]));
    writer.scalar("bounded", flag(data.bounded));
    writer.scalar("interior_point_is_exact", flag(data.interior_point_is_exact));
  } else {
    writer.scalar("affine_dimension", std::to_string(data.affine_dimension));
    if (!data.column_names.empty()) writer.texts("column_names", data.column_names);
  }
  for_each_array(data, writer);
  writer.finish();
}

template void validate(const ComplexData&, const std::string&);
template void validate(const HullData&, const std::string&);
template void validate(const IntersectionData&, const std::string&);
template void validate(const VoronoiData&, const std::string&);
template void write_npz(AtomicFile&, const ComplexData&);
template void write_npz(AtomicFile&, const HullData&);
template void write_npz(AtomicFile&, const IntersectionData&);
template void write_npz(AtomicFile&, const VoronoiData&);
template void write_json(AtomicFile&, const ComplexData&);
template void write_json(AtomicFile&, const HullData&);
template void write_json(AtomicFile&, const IntersectionData&);
template void write_json(AtomicFile&, const VoronoiData&);

}  // namespace delone::io
