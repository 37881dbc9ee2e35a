// SPDX-License-Identifier: BSD-3-Clause
// What a periodic triangulation is made of: the set, its triangulation with ghosts, and what is made of it on
// first use.
#pragma once

#include "periodic/ghost_triangulation.hpp"
#include "periodic/periodic_set.hpp"
#include "periodic/quotient.hpp"

#include <delone/periodic.hpp>

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

struct delone::PeriodicTriangulation::Impl {
  Impl(const periodic::SetInput& input, const Options& options)
      : set(make_periodic_set(input)), ghosts(set, options) {}

  periodic::PeriodicSet set;
  periodic::GhostTriangulation ghosts;
  Lattice lattice;                           // in numbers of the caller
  std::vector<double> points, weights;       // the same
  std::vector<SignedIndex> vertex_of_point;  // by row
  std::vector<std::int32_t> point_offsets;
  std::size_t num_vertices = 0, num_hidden = 0;

  void describe_points(std::span<const double> given, std::span<const double> given_weights);
  const periodic::CellClasses& classes() const;
  const periodic::Quotient& quotient() const;
  bool is_simplicial() const;

 private:
  mutable std::mutex mutex_;
  mutable std::optional<periodic::CellClasses> classes_;
  mutable std::optional<periodic::Quotient> quotient_;
  mutable std::optional<bool> is_simplicial_;
};
