// SPDX-License-Identifier: BSD-3-Clause
// Why the vertices of its link tell the alpha value of a face. Let τ have the smallest orthosphere with
// center c and squared radius R². All points x with the same power π(x) with respect to all vertices of τ
// form a flat orthogonal to that of τ, on which π(x) = R² + |x − c|². V(τ) is the part of it where no vertex
// has a smaller power, and the alpha value of τ is the least π on V(τ). V(τ) is the intersection of the
// halfspaces H_v, where v has no smaller power, for the vertices v of the link of τ alone: these are the
// facets of V(τ) in the triangulation of slightly perturbed weights, whose limit is V(τ). (That the halfspace
// of another vertex contains their intersection has, by the lemma of Farkas, a proof by fixed multipliers,
// which one combination of the finitely many gives for arbitrarily small perturbations, and in the limit.)
//
// If c ∈ V(τ), the value is R². Otherwise it is π at the point x* ∈ V(τ) that is next to c. c − x* is a sum
// of outward normals of halfspaces whose boundaries contain x*, with factors of at least 0, so c is strictly
// outside of one of these. Its vertex v is strictly inside the smallest orthosphere of τ, and x* is in V(τ ∪
// {v}) ⊂ V(τ). So the value of τ is the least one of the faces τ ∪ {v} for which v is in conflict with τ.
// That is so if and only if v and the center of the smallest orthosphere of τ ∪ {v} are strictly on different
// sides of τ. Ties need no care: v on the orthosphere of τ gives τ ∪ {v} the same orthosphere.
#include <delone/alpha.hpp>

#include "base/guarded.hpp"
#include "base/large_vector.hpp"
#include "base/parallel_parts.hpp"
#include "base/quick_rounds.hpp"
#include "faces/face_rows.hpp"
#include "faces/orthosphere.hpp"
#include "faces/orthosphere_kernel.hpp"
#include "kernel/grid.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

namespace delone {
namespace internal {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t faces_in_part = 8192;

void require_alpha(const Triangulation& triangulation) {
  if (triangulation.kind() == TriangulationKind::furthest_site)
    throw Error(Errc::unsupported, "a furthest-site triangulation has no alpha complex");
  if (triangulation.affine_dimension() > 63)
    throw Error(Errc::unsupported, "alpha complexes of cells with more than 64 vertices");
}

/// The exponent of a unit that all coordinates are multiples of, and its square all weights.
int unit_of(const Triangulation& triangulation) {
  const VertexPoints& points = StoredPoints::of(triangulation);
  const auto d = static_cast<std::size_t>(points.ambient);
  int unit = std::numeric_limits<int>::max();
  QuickRounds round;
  for (std::size_t i = 0; i < points.coordinates.size(); ++i) {
    const bool is_weight = points.weighted() && i % (d + 1) == d;
    const double x = points.coordinates[i];
    unit = std::min(unit, is_weight ? kernel::square_exponent(x) : kernel::trailing_exponent(x));
    if (unit < -400) return unit;
    round();
  }
  return unit;
}

/// The faces of a level, or some of them, in blocks of orthosphere_block.
class FaceBlocks {
 public:
  FaceBlocks(const VertexPoints& points, int unit, const FaceLevel& level)
      : points_(points),
        level_(level),
        spheres_(points.ambient, points.weighted(), unit, level.corners()),
        of_block_(orthosphere_block * level.corners()) {}

  /// Calls take(face, answer) for these faces.
  template <class Take>
  void find(std::span<const std::size_t> faces, Orthospheres::Want want, const Take& take) {
    Orthospheres::Answer answers[orthosphere_block];
    for_each_block(faces, [&](std::span<const std::size_t> block) {
      spheres_.find_block(block.size(), of_block_.data(), want, answers);
      for (std::size_t i = 0; i < block.size(); ++i) take(block[i], answers[i]);
    });
  }
  /// Calls take(face) for those that are within the bound.
  template <class Take>
  void find_within(std::span<const std::size_t> faces, const SquareBound& bound, const Take& take) {
    bool is_within[orthosphere_block];
    for_each_block(faces, [&](std::span<const std::size_t> block) {
      spheres_.is_within_block(block.size(), of_block_.data(), bound, is_within);
      for (std::size_t i = 0; i < block.size(); ++i)
        if (is_within[i]) take(block[i]);
    });
  }

 private:
  template <class Work>
  void for_each_block(std::span<const std::size_t> faces, const Work& work) {
    const std::size_t corners = level_.corners();
    for (std::size_t first = 0; first < faces.size(); first += orthosphere_block) {
      const auto block = faces.subspan(first, std::min(orthosphere_block, faces.size() - first));
      const double** to = of_block_.data();
      for (const std::size_t face : block)
        for (std::size_t i = 0; i < corners; ++i)
          *to++ = points_.point(static_cast<Index>(level_.vertices[face * corners + i]));
      work(block);
    }
  }

  const VertexPoints& points_;
  const FaceLevel& level_;
  Orthospheres spheres_;
  std::vector<const double*> of_block_;
};

/// Calls work(blocks, faces) for parts of those faces of a level for which is_wanted(face).
template <class IsWanted, class Work>
void for_wanted_faces(const Triangulation& triangulation, const FaceLevel& level, int unit, unsigned threads,
                      const IsWanted& is_wanted, const Work& work) {
  const VertexPoints& points = StoredPoints::of(triangulation);
  work_in_parts(threads, level.size(), faces_in_part, [&] {
    return [&, blocks = FaceBlocks(points, unit, level), wanted = std::vector<std::size_t>()](
               std::size_t first, std::size_t last, const StopPoint& stop) mutable {
      constexpr std::size_t between_stops = 16 * orthosphere_block;
      for (std::size_t begin = first; begin < last; begin += between_stops) {
        stop();
        wanted.clear();
        for (std::size_t face = begin; face < std::min(last, begin + between_stops); ++face)
          if (is_wanted(face)) wanted.push_back(face);
        work(blocks, std::span<const std::size_t>(wanted));
      }
    };
  });
}

/// For each face the facets beyond which its center is, in as few bytes as they need.
class Masks {
 public:
  Masks(std::size_t count, std::size_t corners) : stride_((corners + 7) / 8), bytes_(count * stride_, 0) {}
  void set(std::size_t face, std::uint64_t bits) {
    for (std::size_t b = 0; b < stride_; ++b)
      bytes_[face * stride_ + b] = static_cast<unsigned char>(bits >> (8 * b));
  }
  bool has(std::size_t face, std::size_t bit) const {
    return (bytes_[face * stride_ + bit / 8] >> (bit % 8) & 1) != 0;
  }

 private:
  std::size_t stride_;
  std::vector<unsigned char> bytes_;
};

/// The levels from dimension k down, and the alpha values of their faces.
class Filtration {
 public:
  Filtration(const Triangulation& triangulation, unsigned threads)
      : triangulation_(triangulation),
        threads_(threads),
        unit_(unit_of(triangulation)),
        level_(level_of_cells(triangulation)) {
    resize_large(values_, level_.size());
    find_values({});
  }

  FaceLevel& level() { return level_; }
  std::vector<double>& values() { return values_; }

  /// To the level of one dimension less. Returns the level before, and its values.
  std::pair<FaceLevel, std::vector<double>> descend() {
    const Complex complex = triangulation_.complex();
    sizes_.push_back(level_.size());
    // Euler's formula for the edges in space: vertices − edges + triangles − cells = 1.
    const std::size_t expected =
        sizes_.size() == 2 && level_.dimension == 2 ? complex.num_vertices() + sizes_[1] - sizes_[0] - 1 : 0;
    FaceLevel below = facets_of(level_, complex.num_vertex_slots(), threads_, expected);
    const std::size_t corners = level_.corners();
    std::vector<double> values;
    reserve_large(values, below.size());
    values.assign(below.size(), infinity);
    std::vector<unsigned char> in_conflict(below.size(), 0);
    QuickRounds round;
    for (std::size_t face = 0; face < level_.size(); ++face) {
      round();
      for (std::size_t i = 0; i < corners; ++i) {
        if (!masks_.has(face, i)) continue;
        const Index facet = level_.facets[face * corners + i];
        in_conflict[facet] = 1;
        values[facet] = std::min(values[facet], values_[face]);
      }
    }
    level_.facets = {};
    level_.neighbors = {};
    std::swap(values_, values);
    std::swap(level_, below);
    find_values(in_conflict);
    return {std::move(below), std::move(values)};
  }

 private:
  /// Of those that are not in conflict; and the masks of all.
  void find_values(const std::vector<unsigned char>& in_conflict) {
    masks_ = Masks(level_.size(), level_.corners());
    using Want = Orthospheres::Want;
    const bool has_beyond = level_.dimension > 1 || StoredPoints::of(triangulation_).weighted();
    const auto has_value = [&](std::size_t face) { return !in_conflict.empty() && in_conflict[face] != 0; };
    for_wanted_faces(
        triangulation_, level_, unit_, threads_, [&](std::size_t face) { return !has_value(face); },
        [&](FaceBlocks& blocks, std::span<const std::size_t> faces) {
          blocks.find(faces, has_beyond ? Want::both : Want::square,
                      [&](std::size_t face, const Orthospheres::Answer& answer) {
                        masks_.set(face, has_beyond ? answer.beyond : 0);
                        values_[face] = answer.square;
                      });
        });
    if (!has_beyond || in_conflict.empty()) return;
    for_wanted_faces(triangulation_, level_, unit_, threads_, has_value,
                     [&](FaceBlocks& blocks, std::span<const std::size_t> faces) {
                       blocks.find(faces, Want::beyond,
                                   [&](std::size_t face, const Orthospheres::Answer& answer) {
                                     masks_.set(face, answer.beyond);
                                   });
                     });
  }

  const Triangulation& triangulation_;
  const unsigned threads_;
  const int unit_;
  FaceLevel level_;
  std::vector<double> values_;
  Masks masks_{0, 1};
  std::vector<std::size_t> sizes_;  // of the levels above
};

}  // namespace
}  // namespace internal

FaceValues alpha_values(const Triangulation& triangulation, int j, const FaceOptions& options) {
  internal::require_face_dimension(triangulation, j);
  internal::require_alpha(triangulation);
  return internal::guarded("the alpha values", [&] {
    const internal::ProgressMeter meter(options.progress);
    FaceValues result;
    result.faces.dimension = j;
    if (j > triangulation.affine_dimension()) return result;
    internal::Filtration filtration(triangulation, options.threads);
    while (filtration.level().dimension > j) filtration.descend();
    result.values = std::move(filtration.values());
    result.faces = internal::faces_by_rows(triangulation, std::move(filtration.level()), j, options.threads,
                                           {}, &result.values);
    return result;
  });
}

std::vector<FaceValues> alpha_filtration(const Triangulation& triangulation, const FaceOptions& options) {
  internal::require_alpha(triangulation);
  return internal::guarded("the alpha values", [&] {
    const internal::ProgressMeter meter(options.progress);
    const int k = triangulation.affine_dimension();
    std::vector<FaceValues> result(static_cast<std::size_t>(k + 1));
    if (k < 0) return result;
    internal::Filtration filtration(triangulation, options.threads);
    for (int j = k; j >= 0; --j) {
      FaceValues& to = result[static_cast<std::size_t>(j)];
      internal::FaceLevel level;
      if (j > 0) {
        std::tie(level, to.values) = filtration.descend();
      } else {
        std::swap(level, filtration.level());
        std::swap(to.values, filtration.values());
      }
      to.faces = internal::faces_by_rows(triangulation, std::move(level), j, options.threads, {}, &to.values);
    }
    return result;
  });
}

struct AlphaComplex::Impl {
  Impl(const Triangulation& t, internal::SquareBound b, const FaceOptions& options)
      : triangulation(&t), bound(std::move(b)), k(t.affine_dimension()) {
    internal::require_alpha(t);
    internal::guarded("the alpha complex", [&] {
      const internal::ProgressMeter meter(options.progress);
      unit = internal::unit_of(t);
      if (k < 0) return;
      find_cells(options.threads);
      find_boundary(options.threads);
    });
  }

  void find_cells(unsigned threads);
  void find_boundary(unsigned threads);
  bool has_no_conflict(internal::Orthospheres& of_cells, CellId c, int i) const;
  Faces faces(int j, const FaceOptions& options) const;

  const Triangulation* triangulation;
  internal::SquareBound bound;
  int k, unit = 0;
  enum : unsigned char { none, out, in };
  std::vector<unsigned char> states;  // by the slot of the cell; none for infinite cells and vacant slots
  std::vector<SignedIndex> cells, boundary, boundary_cells, singular;
};

void AlphaComplex::Impl::find_cells(unsigned threads) {
  constexpr std::size_t block = internal::orthosphere_block;
  const Complex complex = triangulation->complex();
  const VertexPoints& points = internal::StoredPoints::of(*triangulation);
  const auto corners = static_cast<std::size_t>(k) + 1;
  states.assign(complex.num_cell_slots(), none);
  internal::work_in_parts(threads, states.size(), internal::faces_in_part, [&] {
    return [&, spheres = internal::Orthospheres(points.ambient, points.weighted(), unit, corners),
            of_block = std::vector<const double*>(block * corners)](std::size_t first, std::size_t last,
                                                                    const internal::StopPoint& stop) mutable {
      std::size_t slots[block], count = 0;
      bool is_within[block];
      const auto flush = [&] {
        stop();
        if (count == 0) return;
        spheres.is_within_block(count, of_block.data(), bound, is_within);
        for (std::size_t i = 0; i < count; ++i) states[slots[i]] = is_within[i] ? in : out;
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

/// Whether facet i of c, which is no face of a cell of the complex, is in conflict with no vertex of its
/// cells.
bool AlphaComplex::Impl::has_no_conflict(internal::Orthospheres& of_cells, CellId c, int i) const {
  const Complex complex = triangulation->complex();
  const VertexPoints& points = internal::StoredPoints::of(*triangulation);
  const double* corners[64];
  const auto is_in_conflict = [&](CellId cell, int apex) {
    if (complex.is_infinite(cell)) return false;
    for (int m = 0; m <= k; ++m) corners[m] = points.point(index(complex.vertex(cell, m)));
    const auto answer = of_cells.find(corners, internal::Orthospheres::Want::beyond);
    return (answer.beyond >> apex & 1) != 0;
  };
  return !is_in_conflict(c, i) && !is_in_conflict(complex.neighbor(c, i), complex.mirror_index(c, i));
}

void AlphaComplex::Impl::find_boundary(unsigned threads) {
  const Complex complex = triangulation->complex();
  const VertexPoints& points = internal::StoredPoints::of(*triangulation);
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
        for (int i = 0; i <= k && k > 0; ++i) {
          const CellId across = complex.neighbor(c, i);
          const unsigned char state = states[index(across)];
          if (state == in) continue;
          if (states[slot] == in) {
            const std::size_t begin = to.boundary.size();
            for (int m = 0; m <= k; ++m)
              if (m != i) to.boundary.push_back(row(c, m));
            // A point inside put first takes i transpositions to its place in the cell.
            if (i % 2 == 1 && k > 1) std::swap(to.boundary[begin], to.boundary[begin + 1]);
            to.boundary_cells.push_back(number);
          } else if (c < across || state == none) {
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
  SignedIndex before = 0;
  for (const Found& some : found) {
    for (const SignedIndex c : some.cells) cells.push_back(before + c);
    for (const SignedIndex c : some.boundary_cells) boundary_cells.push_back(before + c);
    boundary.insert(boundary.end(), some.boundary.begin(), some.boundary.end());
    singular.insert(singular.end(), some.singular.begin(), some.singular.end());
    before += some.num_cells;
  }
}

Faces AlphaComplex::Impl::faces(int j, const FaceOptions& options) const {
  using namespace internal;
  require_face_dimension(*triangulation, j);
  if (j > k) return faces_by_rows(*triangulation, {}, j, options.threads);
  return guarded("the faces of the alpha complex", [&] {
    const ProgressMeter meter(options.progress);
    FaceLevel level = level_of_cells(*triangulation);
    std::vector<unsigned char> marks(level.size(), 0);
    for (const SignedIndex c : cells) marks[static_cast<std::size_t>(c)] = 1;
    while (level.dimension > j) {
      const std::size_t corners = level.corners();
      Masks masks(level.size(), corners);
      for_wanted_faces(
          *triangulation, level, unit, options.threads, [&](std::size_t face) { return marks[face] == 0; },
          [&](FaceBlocks& blocks, std::span<const std::size_t> some) {
            blocks.find(some, Orthospheres::Want::beyond,
                        [&](std::size_t face, const Orthospheres::Answer& answer) {
                          masks.set(face, answer.beyond);
                        });
          });
      FaceLevel below = facets_of(level, triangulation->complex().num_vertex_slots(), options.threads);
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
          *triangulation, level, unit, options.threads,
          [&](std::size_t face) { return next[face] == unknown; },
          [&](FaceBlocks& blocks, std::span<const std::size_t> some) {
            blocks.find_within(some, bound, [&](std::size_t face) { next[face] = contained; });
          });
      for (unsigned char& mark : next) mark = mark == contained ? 1 : 0;
      marks = std::move(next);
    }
    return faces_by_rows(*triangulation, std::move(level), j, options.threads, marks);
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

AlphaComplex::AlphaComplex(const Triangulation& triangulation, double radius, const FaceOptions& options)
    : impl_(internal::guarded("the alpha complex", [&] {
        return std::make_unique<Impl>(triangulation, bound_of_radius(radius), options);
      })) {}

AlphaComplex AlphaComplex::of_square(const Triangulation& triangulation, double square,
                                     const FaceOptions& options) {
  if (std::isnan(square)) throw Error(Errc::invalid_argument, "the squared radius is NaN");
  return AlphaComplex(internal::guarded("the alpha complex", [&] {
    return std::make_unique<Impl>(triangulation, internal::SquareBound::of_square(square), options);
  }));
}

AlphaComplex::AlphaComplex(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
AlphaComplex::AlphaComplex(AlphaComplex&&) noexcept = default;
AlphaComplex& AlphaComplex::operator=(AlphaComplex&&) noexcept = default;
AlphaComplex::~AlphaComplex() = default;

int AlphaComplex::dimension() const { return impl_->triangulation->dimension(); }
int AlphaComplex::affine_dimension() const { return impl_->k; }
std::span<const SignedIndex> AlphaComplex::cells() const { return impl_->cells; }
std::span<const SignedIndex> AlphaComplex::boundary() const { return impl_->boundary; }
std::span<const SignedIndex> AlphaComplex::boundary_cells() const { return impl_->boundary_cells; }
std::span<const SignedIndex> AlphaComplex::singular_facets() const { return impl_->singular; }

Faces AlphaComplex::faces(int j, const FaceOptions& options) const { return impl_->faces(j, options); }

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
    return data;
  });
}

ComplexData AlphaComplex::boundary_data() const {
  return internal::guarded("the boundary of the alpha complex", [&] {
    ComplexData data = impl_->triangulation->to_data();
    data.affine_dimension = std::max(impl_->k - 1, -1);
    data.cells = impl_->boundary;
    data.neighbors.clear();
    data.vertex_of_point.clear();
    return data;
  });
}

}  // namespace delone
