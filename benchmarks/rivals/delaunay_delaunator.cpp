// SPDX-License-Identifier: BSD-3-Clause
// delaunator-cpp: a sweep from the middle of the points, in floating point.
#include "rival.hpp"

#include <delaunator-header-only.hpp>

#include <optional>
#include <stdexcept>

namespace {

class Delaunator {
 public:
  Delaunator(const rival::Arguments&, delone::PointTable&& table) : table_(std::move(table)) {
    if (table_.dimension != 2) throw std::invalid_argument("this program is for points of the plane");
  }

  rival::Program program() const { return {"delaunator-cpp", "1.0", DELONE_BENCHMARK_FLAGS}; }

  void construct() { triangulation_.emplace(table_.coordinates); }
  void reset() { triangulation_.reset(); }

  std::size_t num_cells() const { return triangulation_->triangles.size() / 3; }

  rival::Cells cells() const {
    return {3, {triangulation_->triangles.begin(), triangulation_->triangles.end()}};
  }

  nlohmann::json details() const { return nlohmann::json::object(); }

 private:
  delone::PointTable table_;
  std::optional<delaunator::Delaunator> triangulation_;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Delaunator>(argc, argv); }
