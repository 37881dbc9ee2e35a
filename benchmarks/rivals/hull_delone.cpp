// SPDX-License-Identifier: BSD-3-Clause
// delone's convex hull, through the interface of its rivals. The time covers the boundary and what the other
// programs compute with it: merged facets and extreme points. `data_seconds` is the time of everything else
// in ConvexHullBase::data(). Options: --order automatic|as_given|shuffled, --seed S, --points all|extreme.
// Like the other programs, a hull of the extreme points does not keep the coordinates of the others.
#include "rival.hpp"

#include <delone/convex_hull.hpp>

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

class Delone {
 public:
  Delone(const rival::Arguments& arguments, delone::PointTable&& table)
      : table_(std::move(table)),
        order_(arguments.option("order", "automatic")),
        only_extreme_(arguments.option("points", "all") == "extreme") {
    options_.seed = std::stoull(arguments.option("seed", "0"));
    if (order_ == "shuffled")
      options_.order = delone::InsertionOrder::shuffled;
    else if (order_ == "as_given")
      options_.order = delone::InsertionOrder::as_given;
    else if (order_ != "automatic")
      throw std::invalid_argument("--order is automatic, as_given or shuffled");
  }

  rival::Program program() const { return {"delone", DELONE_VERSION, DELONE_BENCHMARK_FLAGS}; }

  void construct() {
    result_.emplace(table_.dimension, options_);
    if (only_extreme_)
      result_->insert_extreme_points(table_.coordinates);
    else
      result_->insert_range(table_.coordinates);
    num_facets_ = result_->num_facets();
    num_vertices_ = result_->num_vertices();
  }

  void reset() { result_.reset(); }
  std::size_t num_cells() const { return result_->num_cells(); }

  rival::Cells cells() const {
    const delone::HullData& data = result_->data();
    return {data.affine_dimension, {data.cells.begin(), data.cells.end()}};
  }

  nlohmann::json details() const {
    const auto start = std::chrono::steady_clock::now();
    result_->data();
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    const delone::Statistics s = result_->statistics();
    return {{"order", order_},
            {"order_seconds", s.order_seconds},
            {"build_seconds", s.build_seconds},
            {"data_seconds", elapsed.count()},
            {"facets", num_facets_},
            {"vertices", num_vertices_},
            {"created_cells", s.created_cells},
            {"cell_bytes", s.cell_bytes},
            {"stages",
             {{"filter", s.filter}, {"direct", s.direct}, {"exact", s.exact}, {"perturbed", s.perturbed}}}};
  }

 private:
  delone::PointTable table_;
  std::string order_;
  bool only_extreme_;
  delone::Options options_;
  std::optional<delone::ConvexHull<>> result_;
  std::size_t num_facets_ = 0, num_vertices_ = 0;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Delone>(argc, argv); }
