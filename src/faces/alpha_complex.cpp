// SPDX-License-Identifier: BSD-3-Clause
// A face is in the complex if a face of one dimension more that contains it is, or if it is in conflict with
// no vertex and its smallest orthosphere is small enough; why that is enough: alpha_values.cpp.
#include <delone/alpha.hpp>
#include <delone/arithmetic.hpp>
#include <delone/error.hpp>

#include "base/guarded.hpp"
#include "base/large_vector.hpp"
#include "base/parallel_parts.hpp"
#include "base/quick_rounds.hpp"
#include "faces/face_blocks.hpp"
#include "faces/face_rows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace delone {

using sites::VertexPoints;

struct AlphaComplex::Impl {
  Impl(const Triangulation& t, internal::SquareBound b, const Execution& how)
      : triangulation(&t), bound(std::move(b)), k(t.affine_dimension()) {
    internal::require_alpha(t);
    internal::guarded("the alpha complex", [&] {
      const internal::ProgressMeter meter(how.progress);
      unit = internal::unit_of(t);
      if (k < 0) return;
      find_cells(how.threads);
      find_boundary(how.threads);
    });
  }

  void find_cells(unsigned threads);
  void find_boundary(unsigned threads);
  enum class Conflict : unsigned char { no, yes, unknown };
  Conflict known_conflict(CellId cell, int apex) const;
  bool has_no_conflict(internal::Orthospheres& of_cells, CellId c, int i) const;
  Faces faces(int j, const Execution& how) const;

  const Triangulation* triangulation;
  internal::SquareBound bound;
  int k, unit = 0;
  // By the slot of the cell; none for infinite cells and vacant slots. A cell that is out may have the bits
  // of Orthospheres::Answer::beyond above those of its state, which then is `out_with_bits`.
  enum : unsigned char { none, out, in, out_with_bits };
  static constexpr int bits_of_state = 2;
  static constexpr unsigned mask_of_state = (1U << bits_of_state) - 1;
  static_assert(internal::most_orthosphere_edges + 1 + bits_of_state <= 8);
  std::vector<unsigned char> states;
  std::vector<SignedIndex> cells, boundary, boundary_cells, singular;
};

void AlphaComplex::Impl::find_cells(unsigned threads) {
  constexpr std::size_t block = internal::orthosphere_block;
  const Complex complex = triangulation->complex();
  const VertexPoints& points = triangulation::StoredPoints::of(*triangulation);
  const auto corners = static_cast<std::size_t>(k) + 1;
  states.assign(complex.num_cell_slots(), none);
  internal::work_in_parts(threads, states.size(), internal::faces_in_part, [&] {
    return [&, spheres = internal::Orthospheres(points.ambient, points.weighted(), unit, corners),
            of_block = std::vector<const double*>(block * corners)](std::size_t first, std::size_t last,
                                                                    const internal::StopPoint& stop) mutable {
      std::size_t slots[block], count = 0;
      bool is_within[block], beyond_is_known[block];
      std::uint64_t beyond[block];
      const auto flush = [&] {
        stop();
        if (count == 0) return;
        spheres.is_within_block(count, of_block.data(), bound, is_within, beyond, beyond_is_known);
        for (std::size_t i = 0; i < count; ++i)
          states[slots[i]] = is_within[i] ? static_cast<unsigned char>(in)
                             : beyond_is_known[i]
                                 ? static_cast<unsigned char>(beyond[i] << bits_of_state | out_with_bits)
                                 : static_cast<unsigned char>(out);
        count = 0;
      };
      for (std::size_t slot = first; slot < last; ++slot) {
        const CellId c{static_cast<Index>(slot)};
        if (!complex.is_cell(c)) continue;
        bool is_finite = true;
        for (std::size_t i = 0; i < corners; ++i) {
          const VertexId v = complex.vertex(c, static_cast<int>(i));
          is_finite = is_finite && v != infinite_vertex;
          of_block[count * corners + i] = points.point(index(v));
        }
        if (!is_finite) continue;
        slots[count++] = slot;
        if (count == block) flush();
      }
      flush();
    };
  });
}

/// Whether a cell that is not in the complex has its center beyond the facet opposite its vertex `apex`: that
/// vertex is in conflict with the facet then.
AlphaComplex::Impl::Conflict AlphaComplex::Impl::known_conflict(CellId cell, int apex) const {
  const unsigned state = states[index(cell)];
  if (state == none) return Conflict::no;
  if ((state & mask_of_state) != out_with_bits) return Conflict::unknown;
  return (state >> (apex + bits_of_state) & 1) != 0 ? Conflict::yes : Conflict::no;
}

/// Whether facet i of c, which is no face of a cell of the complex, is in conflict with no vertex of its
/// cells.
bool AlphaComplex::Impl::has_no_conflict(internal::Orthospheres& of_cells, CellId c, int i) const {
  const Complex complex = triangulation->complex();
  const VertexPoints& points = triangulation::StoredPoints::of(*triangulation);
  const double* corners[64];
  const auto is_in_conflict = [&](CellId cell, int apex) {
    if (const Conflict known = known_conflict(cell, apex); known != Conflict::unknown)
      return known == Conflict::yes;
    for (int m = 0; m <= k; ++m) corners[m] = points.point(index(complex.vertex(cell, m)));
    const auto answer = of_cells.find(corners, internal::Orthospheres::Want::beyond);
    return (answer.beyond >> apex & 1) != 0;
  };
  return !is_in_conflict(c, i) && !is_in_conflict(complex.neighbor(c, i), complex.mirror_index(c, i));
}

void AlphaComplex::Impl::find_boundary(unsigned threads) {
  const Complex complex = triangulation->complex();
  const VertexPoints& points = triangulation::StoredPoints::of(*triangulation);
  const std::size_t slots = states.size(), part = internal::faces_in_part;
  const std::vector<SignedIndex> rows = internal::rows_of_vertices(*triangulation);
  const auto row = [&](CellId c, int i) { return rows[index(complex.vertex(c, i))]; };
  struct Found {
    std::vector<SignedIndex> cells, boundary, boundary_cells, singular;  // cells by their place in the part
    SignedIndex num_cells = 0;
  };
  std::vector<Found> found((slots + part - 1) / part);
  internal::work_in_parts(threads, slots, part, [&] {
    return [&,
            of_facets = internal::Orthospheres(points.ambient, points.weighted(), unit,
                                               static_cast<std::size_t>(std::max(k, 1))),
            of_cells = internal::Orthospheres(points.ambient, points.weighted(), unit,
                                              static_cast<std::size_t>(k) + 1),
            of_block = std::vector<const double*>()](std::size_t first, std::size_t last,
                                                     const internal::StopPoint& stop) mutable {
      Found& to = found[first / part];
      Facet facets[internal::orthosphere_block];  // that may be singular
      bool is_within[internal::orthosphere_block];
      std::size_t count = 0;
      const auto flush = [&] {
        if (count == 0) return;
        of_facets.is_within_block(count, of_block.data(), bound, is_within);
        for (std::size_t f = 0; f < count; ++f) {
          const auto [c, i] = facets[f];
          if (!is_within[f] || !has_no_conflict(of_cells, c, i)) continue;
          const auto begin = static_cast<std::ptrdiff_t>(to.singular.size());
          for (int m = 0; m <= k; ++m)
            if (m != i) to.singular.push_back(row(c, m));
          std::sort(to.singular.begin() + begin, to.singular.end());
        }
        count = 0;
        of_block.clear();
      };
      for (std::size_t slot = first; slot < last; ++slot) {
        if (slot % 64 == 0) stop();
        const CellId c{static_cast<Index>(slot)};
        if (states[slot] == none) continue;
        const SignedIndex number = to.num_cells++;
        if (states[slot] == in) to.cells.push_back(number);
        // Bits of the facets to look at, without a branch that depends on the states.
        const unsigned own = states[slot];
        std::uint64_t wanted = 0;
        for (int i = 0; i <= k && k > 0; ++i) {
          const CellId across = complex.neighbor(c, i);
          const unsigned state = states[index(across)];
          const bool is_seen_from_here = (own == in) | (c < across) | (state == none);
          wanted |= static_cast<std::uint64_t>((state != in) & is_seen_from_here) << i;
        }
        // Facets known to be in conflict with their opposite vertex of this cell are out, see
        // known_conflict().
        if ((own & mask_of_state) == out_with_bits) wanted &= ~std::uint64_t{own >> bits_of_state};
        for (; wanted != 0; wanted &= wanted - 1) {
          const int i = std::countr_zero(wanted);
          if (own == in) {
            const std::size_t begin = to.boundary.size();
            for (int m = 0; m <= k; ++m)
              if (m != i) to.boundary.push_back(row(c, m));
            // A point inside put first takes i transpositions to its place in the cell.
            if (i % 2 == 1 && k > 1) std::swap(to.boundary[begin], to.boundary[begin + 1]);
            to.boundary_cells.push_back(number);
          } else {
            for (int m = 0; m <= k; ++m)
              if (m != i) of_block.push_back(points.point(index(complex.vertex(c, m))));
            facets[count++] = {c, i};
            if (count == internal::orthosphere_block) flush();
          }
        }
      }
      flush();
    };
  });
  std::size_t num_boundary = 0, num_singular = 0;
  for (const Found& some : found) {
    num_boundary += some.boundary_cells.size();
    num_singular += some.singular.size();
  }
  internal::reserve_large(cells, static_cast<std::size_t>(std::count(states.begin(), states.end(), in)));
  internal::reserve_large(boundary_cells, num_boundary);
  internal::reserve_large(boundary, num_boundary * static_cast<std::size_t>(std::max(k, 0)));
  internal::reserve_large(singular, num_singular);
  SignedIndex before = 0;
  for (const Found& some : found) {
    internal::cancellation_point();
    for (const SignedIndex c : some.cells) cells.push_back(before + c);
    for (const SignedIndex c : some.boundary_cells) boundary_cells.push_back(before + c);
    boundary.insert(boundary.end(), some.boundary.begin(), some.boundary.end());
    singular.insert(singular.end(), some.singular.begin(), some.singular.end());
    before += some.num_cells;
  }
}

Faces AlphaComplex::Impl::faces(int j, const Execution& how) const {
  using namespace internal;
  require_face_dimension(*triangulation, j);
  if (j > k) return faces_by_rows(*triangulation, {}, j, how.threads);
  return guarded("the faces of the alpha complex", [&] {
    const ProgressMeter meter(how.progress);
    FaceLevel level = level_of_cells(*triangulation);
    std::vector<unsigned char> marks(level.size(), 0);
    for (const SignedIndex c : cells) marks[static_cast<std::size_t>(c)] = 1;
    while (level.dimension > j) {
      const std::size_t corners = level.corners();
      Masks masks(level.size(), corners);
      // The center of an edge without weights is between its vertices.
      if (level.dimension > 1 || triangulation::StoredPoints::of(*triangulation).weighted())
        for_wanted_faces(
            *triangulation, level, unit, how.threads, [&](std::size_t face) { return marks[face] == 0; },
            [&](FaceBlocks& blocks, std::span<const std::size_t> some) {
              blocks.find(some, Orthospheres::Want::beyond,
                          [&](std::size_t face, const Orthospheres::Answer& answer) {
                            masks.set(face, answer.beyond);
                          });
            });
      FaceLevel below = facets_of(level, triangulation->complex().num_vertex_slots(), how.threads);
      enum : unsigned char { unknown, contained, in_conflict };
      std::vector<unsigned char> next(below.size(), unknown);
      QuickRounds round;
      for (std::size_t face = 0; face < level.size(); ++face) {
        round();
        for (std::size_t i = 0; i < corners; ++i) {
          unsigned char& facet = next[level.facets[face * corners + i]];
          if (marks[face] != 0)
            facet = contained;
          else if (facet == unknown && masks.has(face, i))
            facet = in_conflict;
        }
      }
      level = std::move(below);
      for_wanted_faces(
          *triangulation, level, unit, how.threads, [&](std::size_t face) { return next[face] == unknown; },
          [&](FaceBlocks& blocks, std::span<const std::size_t> some) {
            blocks.find_within(some, bound, [&](std::size_t face) { next[face] = contained; });
          });
      for (unsigned char& mark : next) mark = mark == contained ? 1 : 0;
      marks = std::move(next);
    }
    return faces_by_rows(*triangulation, std::move(level), j, how.threads, marks);
  });
}

namespace {

internal::SquareBound bound_of_radius(double radius) {
  if (!(radius >= 0))
    throw Error(Errc::invalid_argument, "the radius is " +
                                            std::string(std::isnan(radius) ? "NaN" : "negative") +
                                            ", which is not a number from 0 on");
  return internal::SquareBound::of_radius(radius);
}

}  // namespace

AlphaComplex::AlphaComplex(const Triangulation& triangulation, double radius, const Execution& how)
    : impl_(internal::guarded("the alpha complex", [&] {
        return std::make_unique<Impl>(triangulation, bound_of_radius(radius), how);
      })) {}

AlphaComplex AlphaComplex::of_squared_radius(const Triangulation& triangulation, double square,
                                             const Execution& how) {
  const ArithmeticScope arithmetic;
  if (std::isnan(square)) throw Error(Errc::invalid_argument, "the squared radius is NaN");
  return AlphaComplex(internal::guarded("the alpha complex", [&] {
    return std::make_unique<Impl>(triangulation, internal::SquareBound::of_square(square), how);
  }));
}

AlphaComplex::AlphaComplex(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
AlphaComplex::AlphaComplex(AlphaComplex&&) noexcept = default;
AlphaComplex& AlphaComplex::operator=(AlphaComplex&&) noexcept = default;
AlphaComplex::~AlphaComplex() = default;

int AlphaComplex::dimension() const { return impl_->triangulation->dimension(); }
int AlphaComplex::affine_dimension() const { return impl_->k; }
std::span<const SignedIndex> AlphaComplex::cell_numbers() const { return impl_->cells; }
std::span<const SignedIndex> AlphaComplex::boundary() const { return impl_->boundary; }
std::span<const SignedIndex> AlphaComplex::boundary_cells() const { return impl_->boundary_cells; }
std::span<const SignedIndex> AlphaComplex::singular_facets() const { return impl_->singular; }

Faces AlphaComplex::faces(int j, const Execution& how) const { return impl_->faces(j, how); }

ComplexData AlphaComplex::to_data() const {
  return internal::guarded("the cells of the alpha complex", [&] {
    ComplexData data = impl_->triangulation->to_data();
    const auto corners = static_cast<std::size_t>(impl_->k + 1);
    std::vector<SignedIndex> number(data.num_cells(), -1);
    for (std::size_t i = 0; i < impl_->cells.size(); ++i)
      number[static_cast<std::size_t>(impl_->cells[i])] = static_cast<SignedIndex>(i);
    std::size_t to = 0;
    for (std::size_t i = 0; i < data.cells.size(); ++i) {
      if (number[i / corners] < 0) continue;
      const SignedIndex across = data.neighbors[i];
      data.cells[to] = data.cells[i];
      data.neighbors[to++] = across < 0 ? -1 : number[static_cast<std::size_t>(across)];
    }
    data.cells.resize(to);
    data.neighbors.resize(to);
    data.kind = DataKind::alpha_complex;
    return data;
  });
}

ComplexData AlphaComplex::boundary_data() const {
  return internal::guarded("the boundary of the alpha complex", [&] {
    const Triangulation& triangulation = *impl_->triangulation;
    const auto d = static_cast<std::size_t>(dimension());
    ComplexData data;
    data.dimension = dimension();
    data.affine_dimension = std::max(impl_->k - 1, -1);
    data.kind = DataKind::alpha_boundary;
    const std::size_t rows = triangulation::StoredPoints::vertices_of_rows(triangulation).size();
    data.points.reserve(rows * d);
    internal::QuickRounds round;
    for (std::size_t row = 0; row < rows; ++row) {
      round();
      const double* const point = triangulation::StoredPoints::of_row(triangulation, row);
      if (point == nullptr)
        data.points.insert(data.points.end(), d, std::numeric_limits<double>::quiet_NaN());
      else
        data.points.insert(data.points.end(), point, point + d);
    }
    data.cells = impl_->boundary;
    return data;
  });
}

}  // namespace delone
