// SPDX-License-Identifier: BSD-3-Clause
// Diagrams as objects: made ones, and those that are arrays only.
#pragma once

#include "object.hpp"

#include <delone/data.hpp>
#include <delone/voronoi.hpp>

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace delone::c {

/// What has the arrays of a diagram.
class DiagramObject : public delone_object {
 public:
  virtual const VoronoiData& data() const = 0;
  CheckReport check(const CheckOptions& options, const Execution& how) const override {
    return delone::check(data(), of_any_data(options), how);
  }
  void write(const std::string& path, const std::string& format) const override;

 protected:
  static Members members_of_data();
};

/// Arrays that were read.
class GivenDiagram final : public DiagramObject {
 public:
  explicit GivenDiagram(VoronoiData data) : data_(std::move(data)) {}
  const char* kind() const override { return "diagram"; }
  const Members& members() const override;
  const VoronoiData& data() const override { return data_; }

 private:
  VoronoiData data_;
};

class MadeDiagram final : public DiagramObject {
 public:
  using Any = std::variant<Voronoi<>, PowerDiagram<>, FurthestVoronoi<>>;

  MadeDiagram(Any any, unsigned threads) : any_(std::move(any)), threads_(threads) {}
  const char* kind() const override { return name_of(diagram().kind()).data(); }
  const Members& members() const override;
  std::unique_ptr<delone_object> clone() const override;
  void write(const std::string& path, const std::string& format) const override;
  const VoronoiData& data() const override {
    return data_.get([&] { return diagram().to_data(); });
  }
  const Diagram& diagram() const {
    return std::visit([](const auto& one) -> const Diagram& { return one; }, any_);
  }

 private:
  Any any_;
  unsigned threads_;
  Lazy<VoronoiData> data_;
  Lazy<std::vector<double>> region_volumes_, ridge_volumes_;
};

}  // namespace delone::c
