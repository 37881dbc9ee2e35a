// SPDX-License-Identifier: BSD-3-Clause
// The first look at all points. See survey.hpp.
#include "tiles/survey.hpp"

#include "base/random.hpp"
#include "kernel/predicates.hpp"
#include "pages/cyclic_order.hpp"

#include <algorithm>

namespace delone::tiles {

namespace {

/// Sees all rows in their order.
class Surveyor {
 public:
  Surveyor(int dimension, bool weighted, std::size_t sample_size, std::uint64_t seed)
      : d_(static_cast<std::size_t>(dimension)),
        row_size_(d_ + (weighted ? 1 : 0)),
        sample_size_(sample_size),
        hull_(dimension),
        random_(seed) {
    Survey& survey = result_.survey;
    survey.dimension = dimension;
    survey.weighted = weighted;
  }

  void add(const double* row) {
    Survey& survey = result_.survey;
    if (survey.num_points == 0) begin(row);
    bool is_extreme = false;
    for (std::size_t axis = 0; axis < d_; ++axis) {
      is_extreme |= row[axis] <= survey.low[axis] || row[axis] >= survey.high[axis];
      survey.low[axis] = std::min(survey.low[axis], row[axis]);
      survey.high[axis] = std::max(survey.high[axis], row[axis]);
    }
    if (is_extreme) find_extremes(row);
    if (hull_.dimension() < survey.dimension) grow_hull(row);
    if (survey.weighted) weigh(row);
    take_into_sample(row);
    ++survey.num_points;
  }

  SurveyResult finish() {
    Survey& survey = result_.survey;
    survey.affine_dimension = hull_.dimension();
    for (const std::vector<Landmark>& some : {basis_, extremes_})
      for (const Landmark& one : some) add_landmark(one);
    return std::move(result_);
  }

 private:
  struct Landmark {
    std::vector<double> point;
    std::int64_t row;
  };

  Landmark landmark(const double* row) const {
    return {{row, row + row_size_}, static_cast<std::int64_t>(result_.survey.num_points)};
  }

  void begin(const double* row) {
    Survey& survey = result_.survey;
    survey.low.assign(row, row + d_);
    survey.high = survey.low;
    extremes_.assign(2 * d_, landmark(row));
    if (survey.weighted) survey.lowest_weight = survey.largest_weight = row[d_];
  }

  /// The first and the last point along each axis, in the order where only equal positions are tied.
  void find_extremes(const double* row) {
    for (std::size_t axis = 0; axis < d_; ++axis)
      for (std::size_t end = 0; end < 2; ++end) {
        Landmark& extreme = extremes_[2 * axis + end];
        const int order =
            pages::compare_along(row, extreme.point.data(), static_cast<int>(axis), static_cast<int>(d_));
        if (end == 0 ? order < 0 : order > 0) extreme = landmark(row);
      }
  }

  void grow_hull(const double* row) {
    if (fills_varying_axes() || !hull_.add(row)) return;
    basis_.push_back(landmark(row));
  }
  /// Whether the coordinates that all points share leave no more dimensions than the hull has: then it
  /// contains all points so far, the present one included.
  bool fills_varying_axes() const {
    const Survey& survey = result_.survey;
    int varying = 0;
    for (std::size_t axis = 0; axis < d_; ++axis) varying += survey.low[axis] != survey.high[axis] ? 1 : 0;
    return varying == hull_.dimension();
  }

  /// Of equal positions the largest weight counts.
  void weigh(const double* row) {
    Survey& survey = result_.survey;
    survey.lowest_weight = std::min(survey.lowest_weight, row[d_]);
    survey.largest_weight = std::max(survey.largest_weight, row[d_]);
    for (std::vector<Landmark>* some : {&basis_, &extremes_})
      for (Landmark& one : *some)
        if (one.point[0] == row[0] && row[d_] > one.point[d_] && std::equal(row, row + d_, one.point.begin()))
          one = landmark(row);
  }

  /// Each row is in a uniform sample of the rows so far with the same chance (Vitter 1985, algorithm R,
  /// doi:10.1145/3147.3165).
  void take_into_sample(const double* row) {
    const std::uint64_t before = result_.survey.num_points;
    if (before < sample_size_) {
      result_.sample.insert(result_.sample.end(), row, row + d_);
    } else if (const std::uint64_t at = random_.below(before + 1); at < sample_size_) {
      std::copy(row, row + d_, result_.sample.begin() + static_cast<std::ptrdiff_t>(at * d_));
    }
  }

  void add_landmark(const Landmark& one) {
    Survey& survey = result_.survey;
    for (std::size_t i = 0; i < survey.landmarks.size(); i += row_size_)
      if (std::equal(one.point.begin(), one.point.begin() + static_cast<std::ptrdiff_t>(d_),
                     survey.landmarks.begin() + static_cast<std::ptrdiff_t>(i)))
        return;
    survey.landmarks.insert(survey.landmarks.end(), one.point.begin(), one.point.end());
    survey.landmark_rows.push_back(one.row);
  }

  std::size_t d_, row_size_, sample_size_;
  kernel::AffineHull hull_;
  random::Generator random_;
  std::vector<Landmark> basis_, extremes_;
  SurveyResult result_;
};

}  // namespace

SurveyResult make_survey(PointStream& points, bool weighted, std::size_t sample_size, std::uint64_t seed) {
  const int row_size = points.dimension();
  if (row_size < (weighted ? 2 : 1))
    throw Error(Errc::bad_dimension, weighted ? "rows of points with weights need two numbers at least"
                                              : "the dimension of the points is 0");
  Surveyor surveyor(row_size - (weighted ? 1 : 0), weighted, sample_size, seed);
  each_point(points, [&](const double* row) { surveyor.add(row); });
  return surveyor.finish();
}

}  // namespace delone::tiles
