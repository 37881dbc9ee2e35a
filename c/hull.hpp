// SPDX-License-Identifier: BSD-3-Clause
// Convex hulls as objects: made ones, and those that are arrays only.
#pragma once

#include "object.hpp"

#include <delone/convex_hull.hpp>
#include <delone/data.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace delone::c {

/// What has the arrays of a convex hull.
class HullObject : public delone_object {
 public:
  virtual const HullData& data() const = 0;  // maybe without points
  virtual const std::vector<double>& points() const = 0;
  CheckReport check(const CheckOptions& options, const Execution& how) const override;
  void write(const std::string& path, const std::string& format) const override;

 protected:
  virtual HullData with_points() const = 0;
  static Members members_of_data();
};

/// Arrays that were read.
class GivenHull final : public HullObject {
 public:
  explicit GivenHull(HullData data) : data_(std::move(data)) {}
  const char* kind() const override { return "hull"; }
  const Members& members() const override;
  const HullData& data() const override { return data_; }
  const std::vector<double>& points() const override { return data_.points; }

 private:
  HullData with_points() const override { return data_; }

  HullData data_;
};

class MadeHull final : public HullObject {
 public:
  explicit MadeHull(ConvexHull<> hull) : hull_(std::move(hull)) {}
  const char* kind() const override { return "convex_hull"; }
  const Members& members() const override;
  std::unique_ptr<delone_object> clone() const override;
  void insert(const double* rows, std::size_t num_rows, const double* weights) override;
  const HullData& data() const override { return hull_.data(); }
  const std::vector<double>& points() const override;
  const ConvexHull<>& hull() const { return hull_; }

 private:
  HullData with_points() const override { return hull_.to_data(); }

  ConvexHull<> hull_;
  Lazy<std::vector<std::int64_t>> f_vector_;
  Lazy<std::string> hash_;
  Lazy<std::vector<double>> points_;
};

}  // namespace delone::c
