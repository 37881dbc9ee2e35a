// SPDX-License-Identifier: BSD-3-Clause
// A triangulation from JSON: an object with the members points, cells (or simplices), and optionally
// dimension, neighbors, vertex_of_point and affine_dimension; others are ignored. Read as a stream of events,
// so that no tree of the whole file is built.
#include "io/collect.hpp"
#include "io/complexes/raw_complex.hpp"
#include "io/file.hpp"
#include "io/text_cursor.hpp"

#include <nlohmann/json.hpp>

#include <limits>
#include <set>
#include <utility>

namespace delone::io {

namespace {

using Json = nlohmann::json;

class Handler : public nlohmann::json_sax<Json> {
 public:
  explicit Handler(const std::string& name) : name_(name) {}

  ComplexData finish() {
    if (!seen_.contains("points")) fail(Errc::bad_format, "{}: there is no member 'points'", name_);
    if (points_.rows == 0 && !dimension_)
      fail(Errc::bad_format, "{}: without points the member 'dimension' is needed", name_);
    const std::int64_t dimension = dimension_.value_or(static_cast<std::int64_t>(points_.columns));
    if (dimension < 1 || dimension > std::numeric_limits<int>::max())
      fail(Errc::bad_dimension, "{}: the dimension is {}", name_, dimension);
    if (points_.rows > 0 && static_cast<std::int64_t>(points_.columns) != dimension)
      fail(Errc::bad_format, "{}: points: expected {} columns as 'dimension' says, found {}", name_,
           dimension, points_.columns);
    raw_.points.dimension = static_cast<int>(dimension);
    require_finite(raw_.points.coordinates, raw_.points.dimension, name_ + ": points");
    if (raw_.weights) require_finite(*raw_.weights, 1, name_ + ": weights");
    return assemble(std::move(raw_), name_);
  }

  bool start_object(std::size_t) override {
    if (skipping()) return ++skip_depth_, true;
    if (in_object_) wrong("an object");
    in_object_ = true;
    return true;
  }
  bool end_object() override {
    if (skip_depth_ > 0) --skip_depth_;
    return true;
  }
  bool key(std::string& key) override {
    if (skip_depth_ > 0) return true;
    if (!seen_.insert(key).second)
      fail(Errc::bad_format, "{}: the member {} appears twice", name_, in_quotes(key));
    member_ = key;
    matrix_ = nullptr;
    indices_ = nullptr;
    kind_ = Kind::ignored;
    if (key == "points") {
      kind_ = Kind::matrix;
      matrix_ = &points_;
    } else if (key == "cells" || (key == "simplices" && !seen_.contains("cells"))) {
      raw_.cells.emplace();
      index_matrix(*raw_.cells);
    } else if (key == "neighbors") {
      raw_.neighbors.emplace();
      index_matrix(*raw_.neighbors);
    } else if (key == "vertex_of_point") {
      kind_ = Kind::list;
      indices_ = &raw_.vertex_of_point.emplace();
    } else if (key == "weights") {
      kind_ = Kind::list;
      raw_.weights.emplace();
    } else if (key == "dimension" || key == "affine_dimension") {
      kind_ = Kind::scalar;
    }
    return true;
  }
  bool start_array(std::size_t) override {
    if (skipping()) return ++skip_depth_, true;
    const int deepest = kind_ == Kind::matrix ? 2 : kind_ == Kind::list ? 1 : 0;
    if (!in_object_ || depth_ == deepest) wrong("an array");
    ++depth_;
    column_ = 0;
    return true;
  }
  bool end_array() override {
    if (skipping()) return --skip_depth_, true;
    if (depth_-- < 2) return true;
    if (matrix_->rows == 0) matrix_->columns = column_;
    if (column_ != matrix_->columns)
      fail(Errc::bad_format, "{}: expected {} numbers as in row 0, found {}", place(), matrix_->columns,
           column_);
    ++matrix_->rows;
    return true;
  }

  bool number_integer(std::int64_t value) override {
    if (skipping()) return true;
    if (at_number()) return coordinate(static_cast<double>(value));
    return integer(value);
  }
  bool number_unsigned(std::uint64_t value) override {
    if (skipping()) return true;
    if (at_number()) return coordinate(static_cast<double>(value));
    if (value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
      too_large(fmt::format("{}", value));
    return integer(static_cast<std::int64_t>(value));
  }
  bool number_float(double value, const std::string& text) override {
    if (skipping()) return true;
    if (!at_number()) wrong(in_quotes(text));
    return coordinate(value);
  }
  bool null() override { return skipping() || (wrong("null"), true); }
  bool boolean(bool) override { return skipping() || (wrong("a boolean"), true); }
  bool string(std::string& text) override {
    return skipping() || (wrong("the string " + in_quotes(text)), true);
  }
  bool binary(Json::binary_t&) override { return true; }  // text has none

  bool parse_error(std::size_t position, const std::string& token, const Json::exception& error) override {
    constexpr int number_overflow = 406;
    if (error.id == number_overflow) {
      if (matrix_ == &points_ && depth_ == 2)
        throw Error(Errc::not_finite, place() + ": " + describe_not_finite(token), {points_.rows});
      if (at_number())
        throw Error(Errc::not_finite, place() + ": " + describe_not_finite(token), {raw_.weights->size()});
      too_large(token);
    }
    // "[json.exception.parse_error.101] parse error at line 1, column 5: …"
    std::string_view what = error.what();
    if (const auto close = what.find("] "); close != std::string_view::npos) what.remove_prefix(close + 2);
    fail(Errc::bad_format, "{}: not valid JSON (byte {}): {}", name_, position, what);
  }

 private:
  enum class Kind { none, matrix, list, scalar, ignored };

  void index_matrix(IndexMatrix& matrix) {
    kind_ = Kind::matrix;
    matrix = {};
    matrix_ = &matrix;
    indices_ = &matrix.items;
  }
  /// True inside the value of a member that nobody asked for.
  bool skipping() const { return kind_ == Kind::ignored; }
  bool at_coordinate() const { return matrix_ == &points_ && depth_ == 2; }
  bool in_weights() const { return kind_ == Kind::list && indices_ == nullptr; }
  /// Where any number may stand, not integers only.
  bool at_number() const { return at_coordinate() || (in_weights() && depth_ == 1); }
  std::string place() const {
    if (kind_ == Kind::none) return name_;
    if (kind_ == Kind::matrix && depth_ > 0)
      return fmt::format("{}: {}: row {}", name_, member_, matrix_->rows);
    if (kind_ == Kind::list && depth_ > 0)
      return fmt::format("{}: {}: row {}", name_, member_,
                         in_weights() ? raw_.weights->size() : indices_->size());
    return fmt::format("{}: {}", name_, member_);
  }
  [[noreturn]] void wrong(const std::string& found) const {
    std::string_view expected = "an object";
    if (kind_ == Kind::matrix)
      expected = depth_ == 0 ? "an array of arrays" : depth_ == 1 ? "an array" : "a number";
    if (kind_ == Kind::list) expected = depth_ == 0 ? "an array" : in_weights() ? "a number" : "an integer";
    if (kind_ == Kind::scalar) expected = "an integer";
    if (kind_ == Kind::matrix && depth_ == 2 && indices_ != nullptr) expected = "an integer";
    fail(Errc::bad_format, "{}: expected {}, found {}", place(), expected, found);
  }
  [[noreturn]] void too_large(const std::string& text) const {
    fail(Errc::bad_format, "{}: {} does not fit the {}-bit indices of this build", place(), text,
         8 * sizeof(SignedIndex));
  }
  bool coordinate(double value) {
    (in_weights() ? *raw_.weights : raw_.points.coordinates).push_back(value);
    ++column_;
    return true;
  }
  bool integer(std::int64_t value) {
    if (kind_ == Kind::scalar) {
      (member_ == "dimension" ? dimension_ : raw_.affine_dimension) = value;
      return true;
    }
    if ((kind_ != Kind::list || depth_ != 1) && (kind_ != Kind::matrix || depth_ != 2))
      wrong(fmt::format("{}", value));
    if (value < std::numeric_limits<SignedIndex>::min() || value > std::numeric_limits<SignedIndex>::max())
      too_large(fmt::format("{}", value));
    indices_->push_back(static_cast<SignedIndex>(value));
    ++column_;
    return true;
  }

  const std::string& name_;
  RawComplex raw_;
  IndexMatrix points_;  ///< the shape only
  std::optional<std::int64_t> dimension_;
  std::set<std::string> seen_;
  bool in_object_ = false;
  std::string member_;
  Kind kind_ = Kind::none;
  IndexMatrix* matrix_ = nullptr;
  std::vector<SignedIndex>* indices_ = nullptr;
  int depth_ = 0, skip_depth_ = 0;
  std::size_t column_ = 0;
};

}  // namespace

ComplexData read_json_complex(std::string_view bytes, const std::string& name) {
  const std::string_view text = text_of(bytes, name);
  Handler handler(name);
  Json::sax_parse(text.begin(), text.end(), &handler);
  return handler.finish();
}

}  // namespace delone::io
