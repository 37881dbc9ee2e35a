// SPDX-License-Identifier: BSD-3-Clause
// Periodic triangulations as objects.
#pragma once

#include "object.hpp"

#include <delone/periodic.hpp>
#include <delone/periodic_queries.hpp>

#include <memory>
#include <string>
#include <utility>

namespace delone::c {

class PeriodicObject final : public delone_object {
 public:
  PeriodicObject(std::shared_ptr<const PeriodicTriangulation> made, unsigned threads)
      : made_(std::move(made)), threads_(threads) {}

  const char* kind() const override { return made_->is_regular() ? "periodic_regular" : "periodic_delaunay"; }
  const Members& members() const override;
  CheckReport check(const CheckOptions& options, const Execution& how) const override;
  void write(const std::string& path, const std::string& format) const override;

  const PeriodicTriangulation& triangulation() const { return *made_; }
  unsigned threads() const { return threads_; }
  const PeriodicPointLocator& locator() const {
    return locator_.get([&] { return PeriodicPointLocator(*made_); });
  }

 private:
  const std::string& hash() const {
    return hash_.get([&] { return made_->hash({.threads = threads_}).hex(); });
  }

  std::shared_ptr<const PeriodicTriangulation> made_;
  unsigned threads_;
  Lazy<PeriodicPointLocator> locator_;
  Lazy<std::string> hash_;
};

}  // namespace delone::c
