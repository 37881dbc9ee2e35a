// SPDX-License-Identifier: BSD-3-Clause
// delone itself, through the interface of its rivals. Options: --order automatic|as_given|shuffled (the
// library's), --order curve (one Hilbert curve through all points) and --order report (rounds sorted along
// it, as in 2008), --seed S, --threads N (1).
#include "rival.hpp"
#include "spatial_sort.hpp"

#include <delone/delaunay.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

class Delone {
 public:
  Delone(const rival::Arguments& arguments, delone::PointTable&& table)
      : table_(std::move(table)), order_(arguments.option("order", "automatic")) {
    if (arguments.repeat > 1) spare_ = table_.coordinates;
    options_.seed = std::stoull(arguments.option("seed", "0"));
    options_.threads = static_cast<unsigned>(std::stoul(arguments.option("threads", "1")));
    if (order_ == "shuffled")
      options_.order = delone::InsertionOrder::shuffled;
    else if (order_ == "as_given" || order_ == "curve" || order_ == "report")
      options_.order = delone::InsertionOrder::as_given;
    else if (order_ != "automatic")
      throw std::invalid_argument("--order is automatic, as_given, shuffled, curve or report");
  }

  rival::Program program() const { return {"delone", DELONE_VERSION, DELONE_BENCHMARK_FLAGS}; }

  void construct() {
    if (order_ != "curve" && order_ != "report") {
      result_.emplace(std::move(table_.coordinates), table_.dimension, options_);
      return;
    }
    const auto start = std::chrono::steady_clock::now();
    rows_ = order_ == "curve" ? spatial_sort::curve(table_.coordinates, table_.dimension)
                              : spatial_sort::rounds(table_.coordinates, table_.dimension, options_.seed);
    std::vector<double> sorted = spatial_sort::permuted(table_.coordinates, table_.dimension, rows_);
    sort_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result_.emplace(std::move(sorted), table_.dimension, options_);
  }

  void reset() {
    result_.reset();
    table_.coordinates = spare_;
  }
  std::size_t num_cells() const { return result_->num_finite_cells(); }

  rival::Cells cells() const {
    const delone::ComplexData data = result_->to_data(false);
    rival::Cells cells{data.affine_dimension + 1, {data.cells.begin(), data.cells.end()}};
    if (!rows_.empty())
      for (std::int64_t& row : cells.rows)
        row = static_cast<std::int64_t>(rows_[static_cast<std::size_t>(row)]);
    return cells;
  }

  nlohmann::json details() const {
    const delone::Statistics s = result_->statistics();
    return {{"order", order_},
            {"order_seconds", s.order_seconds + sort_seconds_},
            {"build_seconds", s.build_seconds},
            {"vertices", result_->num_vertices()},
            {"infinite_cells", result_->num_infinite_cells()},
            {"created_cells", s.created_cells},
            {"visited_cells", s.visited_cells},
            {"insertions", s.insertions},
            {"cell_bytes", s.cell_bytes},
            {"stages",
             {{"filter", s.filter}, {"direct", s.direct}, {"exact", s.exact}, {"perturbed", s.perturbed}}}};
  }

 private:
  delone::PointTable table_;
  std::vector<double> spare_;  ///< for constructions after the first, as each takes the coordinates over
  std::string order_;
  delone::Options options_;
  std::vector<std::size_t> rows_;  ///< where the adapter sorted the points: their rows, in order of insertion
  double sort_seconds_ = 0;
  std::optional<delone::Delaunay<>> result_;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Delone>(argc, argv); }
