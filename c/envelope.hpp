// SPDX-License-Identifier: BSD-3-Clause
// Lower and upper hulls as objects.
#pragma once

#include "object.hpp"

#include <delone/lower_hull.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace delone::c {

class EnvelopeObject final : public delone_object {
 public:
  explicit EnvelopeObject(LowerHull<> hull) : hull_(std::move(hull)) {}
  const char* kind() const override { return hull_.side() == HullSide::lower ? "lower_hull" : "upper_hull"; }
  const Members& members() const override;
  std::unique_ptr<delone_object> clone() const override;
  CheckReport check(const CheckOptions& options, const Execution& how) const override;
  void write(const std::string& path, const std::string& format) const override;
  const LowerHull<>& hull() const { return hull_; }

 private:
  LowerHull<> hull_;
  Lazy<std::vector<int>> axes_;
};

}  // namespace delone::c
