// SPDX-License-Identifier: BSD-3-Clause
// Intersections of halfspaces as objects: made ones, and those that are arrays only.
#pragma once

#include "object.hpp"

#include <delone/data.hpp>
#include <delone/halfspaces.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace delone::c {

/// What has the arrays of an intersection.
class IntersectionObject : public delone_object {
 public:
  virtual const IntersectionData& data() const = 0;  // with the halfspaces
  CheckReport check(const CheckOptions& options, const Execution& how) const override {
    return delone::check(data(), of_any_data(options), how);
  }
  void write(const std::string& path, const std::string& format) const override;

 protected:
  static Members members_of_data();
};

/// Arrays that were read.
class GivenIntersection final : public IntersectionObject {
 public:
  explicit GivenIntersection(IntersectionData data) : data_(std::move(data)) {}
  const char* kind() const override { return "intersection"; }
  const Members& members() const override;
  const IntersectionData& data() const override { return data_; }

 private:
  IntersectionData data_;
};

class MadeIntersection final : public IntersectionObject {
 public:
  explicit MadeIntersection(HalfspaceIntersection<> polyhedron) : polyhedron_(std::move(polyhedron)) {}
  const char* kind() const override { return "halfspace_intersection"; }
  const Members& members() const override;
  std::unique_ptr<delone_object> clone() const override;
  void insert(const double* rows, std::size_t num_rows, const double* weights) override;
  const IntersectionData& data() const override {
    return data_.get([&] { return polyhedron_.to_data(); });
  }

 private:
  HalfspaceIntersection<> polyhedron_;
  Lazy<IntersectionData> data_;
};

}  // namespace delone::c
