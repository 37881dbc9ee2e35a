// SPDX-License-Identifier: BSD-3-Clause
// What the programs that edit CGAL's triangulations have in common.
#pragma once

#include "edit.hpp"
#include "rows_by_coordinates.hpp"

#include <CGAL/version.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rival {

/// An editor without moves. A peer has the types Triangulation, Point and Vertex (a handle), the constants
/// `dimension` and `name`, and
///   make()                  an empty triangulation
///   to_point(p), coordinates_of(v)
///   finite_vertices(t), neighbors(t, v)   a range of handles each, the second without the infinite vertex
///   insert(t, p, v)         inserts a point with vertex v as hint
template <class Peer>
class CgalEditor {
 public:
  using Point = typename Peer::Point;
  using Vertex = typename Peer::Vertex;

  CgalEditor(const Arguments&, int dimension) : triangulation_(Peer::make()) {
    if (dimension != Peer::dimension)
      throw std::invalid_argument("this program is for points of dimension " +
                                  std::to_string(Peer::dimension));
  }

  Program program() const { return {Peer::name, CGAL_VERSION_STR, DELONE_BENCHMARK_FLAGS}; }

  void prepare(std::span<const double> coordinates) {
    coordinates_.assign(coordinates.begin(), coordinates.end());
    for (std::size_t i = 0; i < coordinates.size(); i += size)
      points_.push_back(Peer::to_point(coordinates.subspan(i, size)));
  }
  void build() { triangulation_.insert(points_.begin(), points_.end()); }

  void find_vertices() {
    if (triangulation_.number_of_vertices() != points_.size())
      throw std::invalid_argument("this program is for distinct points");
    const RowsByCoordinates row_of(std::move(coordinates_), Peer::dimension);
    vertices_.resize(points_.size());
    for (const Vertex v : Peer::finite_vertices(triangulation_))
      vertices_[static_cast<std::size_t>(row_of(Peer::coordinates_of(v)))] = v;
  }

  void find_hints(std::span<const std::size_t> rows) {
    std::set<Vertex> gone;
    for (const std::size_t row : rows) gone.insert(vertices_[row]);
    Vertex any = vertices_[0];
    for (const Vertex v : vertices_)
      if (!gone.contains(v)) any = v;
    hints_.clear();
    for (const std::size_t row : rows) {
      const Vertex v = vertices_[row];
      hints_.push_back(nearest_that_stays(
          Peer::neighbors(triangulation_, v), [&](Vertex u) { return gone.contains(u); },
          [&](Vertex u) { return squared_distance(Peer::coordinates_of(u), Peer::coordinates_of(v)); }, any));
    }
  }

  void remove(std::size_t row) { triangulation_.remove(vertices_[row]); }
  void insert(std::size_t number, std::size_t row, std::span<const double> point) {
    vertices_[row] = Peer::insert(triangulation_, Peer::to_point(point), hints_[number]);
  }

 protected:
  static constexpr auto size = static_cast<std::size_t>(Peer::dimension);

  std::vector<double> coordinates_;  ///< until the vertices have been found
  std::vector<Point> points_;
  typename Peer::Triangulation triangulation_;
  std::vector<Vertex> vertices_, hints_;
};

/// With moves: each, also of a time step, is move_if_no_collision(). A time step goes through the vertices in
/// their order in memory.
template <class Peer>
class CgalMover : public CgalEditor<Peer> {
 public:
  using CgalEditor<Peer>::CgalEditor;

  void move(std::size_t row, std::span<const double> point) {
    vertices_[row] = triangulation_.move_if_no_collision(vertices_[row], Peer::to_point(point));
  }

  void prepare_time_step(std::span<const double> coordinates) {
    for (std::size_t row = 0; row < vertices_.size(); ++row)
      targets_.emplace_back(vertices_[row], Peer::to_point(coordinates.subspan(size * row, size)));
    std::sort(targets_.begin(), targets_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  void time_step() {
    for (const auto& [vertex, point] : targets_) triangulation_.move_if_no_collision(vertex, point);
  }

 protected:
  using CgalEditor<Peer>::size;
  using CgalEditor<Peer>::triangulation_;
  using CgalEditor<Peer>::vertices_;

 private:
  std::vector<std::pair<typename Peer::Vertex, typename Peer::Point>> targets_;
};

}  // namespace rival
