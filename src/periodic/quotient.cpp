// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/quotient.hpp"

#include "base/quick_rounds.hpp"

#include <algorithm>

namespace delone::periodic {

namespace {

class QuotientMaker {
 public:
  QuotientMaker(const GhostTriangulation& ghosts, const PeriodicSet& set, const CellClasses& classes)
      : ghosts_(ghosts),
        set_(set),
        complex_(ghosts.triangulation().complex()),
        classes_(classes),
        canonical_(classes.canonical()),
        has_wraps_(std::ranges::any_of(set.wraps, [](std::int32_t k) { return k != 0; })),
        r_(set.rank),
        corners_(static_cast<std::size_t>(complex_.affine_dimension() + 1)) {}

  Quotient make() {
    const std::size_t entries = canonical_.cells.size() * corners_;
    made_.cells.reserve(entries);
    made_.neighbors.reserve(entries);
    made_.cell_offsets.resize(entries * r_);
    made_.neighbor_offsets.resize(entries * r_);
    internal::QuickRounds round;
    Offset offset(r_);
    for (std::size_t number = 0; number < canonical_.cells.size(); ++number) {
      round();
      const CellId cell = canonical_.cells[number];
      const std::uint32_t smallest = classes_.row_of_smallest(number);
      for (std::size_t i = 0; i < corners_; ++i) {
        const int slot = classes_.slot(number, i);
        const VertexId v = complex_.vertex(cell, slot);
        const Image& image = ghosts_.image_of(v);
        if (image.shift != 0 || !is_wrapped_alike(image.row, smallest)) {
          for (std::size_t l = 0; l < r_; ++l)
            offset[l] = std::int64_t{ghosts_.offset_of(v)[l]} - wrap(image.row, l) + wrap(smallest, l);
          set_.to_given_basis(offset, made_.cell_offsets.data() + made_.cells.size() * r_);
        }
        made_.cells.push_back(static_cast<SignedIndex>(image.row));
        add_neighbor(cell, slot, smallest);
      }
    }
    return std::move(made_);
  }

 private:
  void add_neighbor(CellId cell, int slot, std::uint32_t smallest) {
    std::int32_t* const to = made_.neighbor_offsets.data() + made_.neighbors.size() * r_;
    const SignedIndex inner = find_inner_neighbor(cell, slot);
    Translate neighbor;
    if (inner < 0) neighbor = classes_.find_neighbor(cell, slot);
    const SignedIndex number = inner < 0 ? neighbor.number : inner;
    made_.neighbors.push_back(number);
    if (number < 0) return;
    const std::uint32_t of_neighbor = classes_.row_of_smallest(static_cast<std::size_t>(number));
    if (inner >= 0 && is_wrapped_alike(of_neighbor, smallest)) return;
    neighbor.offset.resize(r_);
    for (std::size_t l = 0; l < r_; ++l) neighbor.offset[l] += wrap(smallest, l) - wrap(of_neighbor, l);
    set_.to_given_basis(neighbor.offset, to);
  }
  /// The neighbor across a facet with a vertex in the box, if it is canonical: then it is next to the cell as
  /// it is. −1 otherwise.
  SignedIndex find_inner_neighbor(CellId cell, int slot) const {
    const VerticesOfCell vertices = complex_.vertices(cell);
    for (std::size_t l = 0; l < corners_; ++l)
      if (l != static_cast<std::size_t>(slot) && ghosts_.is_own(vertices[l]))
        return canonical_.number_of_slot[index(complex_.neighbor(cell, slot))];
    return -1;
  }
  bool is_wrapped_alike(std::uint32_t a, std::uint32_t b) const {
    if (!has_wraps_ || a == b) return true;
    const auto first = [&](std::uint32_t row) {
      return set_.wraps.begin() + static_cast<std::ptrdiff_t>(row * r_);
    };
    return std::equal(first(a), first(a) + static_cast<std::ptrdiff_t>(r_), first(b));
  }
  std::int64_t wrap(std::uint32_t row, std::size_t l) const { return set_.wraps[row * r_ + l]; }

  const GhostTriangulation& ghosts_;
  const PeriodicSet& set_;
  const Complex complex_;
  const CellClasses& classes_;
  const CanonicalCells& canonical_;
  const bool has_wraps_;
  const std::size_t r_, corners_;
  Quotient made_;
};

}  // namespace

Quotient make_quotient(const GhostTriangulation& ghosts, const PeriodicSet& set, const CellClasses& classes) {
  if (ghosts.triangulation().complex().affine_dimension() < 0) return {};
  return QuotientMaker(ghosts, set, classes).make();
}

bool is_simplicial(const GhostTriangulation& ghosts) {
  const Complex complex = ghosts.triangulation().complex();
  internal::QuickRounds round;
  std::vector<std::uint32_t> rows;
  for (std::size_t id = 1; id < complex.num_vertex_slots(); ++id) {
    const VertexId v{static_cast<Index>(id)};
    if (!complex.is_vertex(v) || !ghosts.is_own(v)) continue;
    round();
    rows.assign(1, ghosts.image_of(v).row);
    bool has_ghost = false;
    for (const VertexId w : complex.adjacent_vertices(v)) {
      rows.push_back(ghosts.image_of(w).row);
      has_ghost = has_ghost || !ghosts.is_own(w);
    }
    if (!has_ghost) continue;
    std::sort(rows.begin(), rows.end());
    if (std::adjacent_find(rows.begin(), rows.end()) != rows.end()) return false;
  }
  return true;
}

}  // namespace delone::periodic
