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
  Impl(const periodic::SetInput& input, const Lattice& given_lattice, const PeriodicOptions& how,
       const Options& options)
      : given_lattice(given_lattice),
        how(how),
        options(options),
        set(make_periodic_set(input)),
        ghosts(set, options) {}
  /// The same after a step from another one.
  Impl(const periodic::SetInput& input, const Lattice& given_lattice, const Impl& before)
      : given_lattice(given_lattice),
        how(before.how),
        options(before.options),
        set(make_periodic_set(input)),
        ghosts(set, before.ghosts, options) {}

  // As they were given.
  Lattice given_lattice;
  PeriodicOptions how;
  Options options;

  periodic::PeriodicSet set;
  periodic::GhostTriangulation ghosts;
  Lattice lattice;                           // in numbers of the caller
  std::vector<double> points, weights;       // the same
  std::vector<SignedIndex> vertex_of_point;  // by row
  std::vector<std::int32_t> point_offsets;
  std::size_t num_vertices = 0, num_hidden = 0;

  /// What there is to say of the lattice and the points, as they were given.
  void describe(std::span<const double> given, std::span<const double> given_weights);
  const periodic::CellClasses& classes() const;
  const periodic::Quotient& quotient() const;
  bool is_simplicial() const;

 private:
  mutable std::mutex mutex_;
  mutable std::optional<periodic::CellClasses> classes_;
  mutable std::optional<periodic::Quotient> quotient_;
  mutable std::optional<bool> is_simplicial_;
};
