// SPDX-License-Identifier: BSD-3-Clause
// delone, edited, through the interface of its rivals. A time step is one edit() with all rows. Options:
// --threads N (1).
#include "edit.hpp"

#include <delone/delaunay.hpp>

namespace {

class Delone {
 public:
  Delone(const rival::Arguments& arguments, int dimension) : dimension_(dimension) {
    options_.threads = static_cast<unsigned>(std::stoul(arguments.option("threads", "1")));
  }

  rival::Program program() const { return {"delone", DELONE_VERSION, DELONE_BENCHMARK_FLAGS}; }

  void prepare(std::span<const double> coordinates) {
    coordinates_.assign(coordinates.begin(), coordinates.end());
  }
  void build() { triangulation_.emplace(std::move(coordinates_), dimension_, options_); }

  void find_vertices() {
    if (triangulation_->num_duplicates() != 0)
      throw std::invalid_argument("this program is for distinct points");
    rows_.resize(triangulation_->num_rows());
    std::iota(rows_.begin(), rows_.end(), std::size_t{0});
  }

  void find_hints(std::span<const std::size_t> rows) {
    const delone::Complex complex = triangulation_->complex();
    const auto vertex_of = [&](std::size_t row) { return triangulation_->vertex_at(rows_[row]); };
    std::vector<bool> gone(complex.num_vertex_slots());
    for (const std::size_t row : rows) gone[delone::index(vertex_of(row))] = true;
    delone::VertexId any = delone::invalid_vertex;
    for (const delone::VertexId v : complex.finite_vertices())
      if (!gone[delone::index(v)]) any = v;
    hints_.clear();
    for (const std::size_t row : rows) {
      const delone::VertexId v = vertex_of(row);
      hints_.push_back(rival::nearest_that_stays(
          complex.adjacent_vertices(v), [&](delone::VertexId u) { return gone[delone::index(u)]; },
          [&](delone::VertexId u) {
            return rival::squared_distance(triangulation_->point(u), triangulation_->point(v));
          },
          any));
    }
  }

  void remove(std::size_t row) { triangulation_->remove(rows_[row]); }
  void insert(std::size_t number, std::size_t row, std::span<const double> point) {
    rows_[row] = triangulation_->num_rows();
    triangulation_->insert(point, triangulation_->complex().incident_cell(hints_[number]));
  }
  void move(std::size_t row, std::span<const double> point) { triangulation_->move(rows_[row], point); }

  void prepare_time_step(std::span<const double> coordinates) {
    coordinates_.assign(coordinates.begin(), coordinates.end());
  }
  void time_step() { triangulation_->edit({.move = rows_, .to = coordinates_}); }

  std::size_t num_cells() const { return triangulation_->num_finite_cells(); }
  std::uint64_t checksum() const {
    rival::Checksum sum;
    for (const delone::CellId cell : triangulation_->finite_cells()) {
      for (const delone::VertexId v : triangulation_->vertices(cell))
        sum.add_vertex(triangulation_->point(v));
      sum.end_cell();
    }
    return sum.value();
  }

 private:
  int dimension_;
  delone::Options options_;
  std::vector<double> coordinates_;
  std::optional<delone::Delaunay<>> triangulation_;
  std::vector<std::size_t> rows_;  ///< of the rows of the input: those they have now
  std::vector<delone::VertexId> hints_;
};

}  // namespace

int main(int argc, char** argv) { return rival::run_edits<Delone>(argc, argv); }
