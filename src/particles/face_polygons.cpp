// SPDX-License-Identifier: BSD-3-Clause
#include "particles/face_polygons.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace delone::particles {

void FacePolygons::find(Index v, const Star& star) {
  number_vertices(star);
  collect_links(v, star);
}

void FacePolygons::number_vertices(const Star& star) {
  const auto slots_precede = [&](const Corner& a, const Corner& b) {
    return std::ranges::lexicographical_compare(star.slots_of(a.in_star), star.slots_of(b.in_star));
  };
  corners_.clear();
  for (std::size_t c = star.num_infinite(); c < star.num_cells(); ++c) {
    const CellId cell = star.cell(c);
    corners_.push_back(
        {classes_ == nullptr ? index(cell) : classes_->of(cell), index(cell), static_cast<std::uint32_t>(c)});
  }
  std::sort(corners_.begin(), corners_.end(), [&](const Corner& a, const Corner& b) {
    return a.name != b.name ? a.name < b.name : slots_precede(a, b);
  });
  representatives_.clear();
  std::unique_copy(corners_.begin(), corners_.end(), std::back_inserter(representatives_),
                   [](const Corner& a, const Corner& b) { return a.name == b.name; });
  // Centers of one class are the same to the last bit.
  std::sort(representatives_.begin(), representatives_.end(), [&](const Corner& a, const Corner& b) {
    const double* const x = centers_.data() + static_cast<std::size_t>(a.cell) * d_;
    const double* const y = centers_.data() + static_cast<std::size_t>(b.cell) * d_;
    if (!std::equal(x, x + d_, y)) return std::lexicographical_compare(x, x + d_, y, y + d_);
    return slots_precede(a, b);
  });
  number_of_name_.clear();
  for (std::size_t i = 0; i < representatives_.size(); ++i)
    number_of_name_.emplace_back(representatives_[i].name, static_cast<SignedIndex>(i));
  std::sort(number_of_name_.begin(), number_of_name_.end());
  numbers_.assign(star.num_cells(), -1);
  auto at = number_of_name_.begin();
  for (const Corner& corner : corners_) {  // both by name
    while (at->first != corner.name) ++at;
    numbers_[corner.in_star] = at->second;
  }
}

/// Cells are positively oriented. With v moved to the front, and two others exchanged if that took an odd
/// number of steps, so are (v, a, b, c), (v, b, c, a) and (v, c, a, b): seen from a, the way around the edge
/// to it leads counterclockwise from b to c.
void FacePolygons::collect_links(Index v, const Star& star) {
  const std::size_t n = star.neighbors().size();
  offsets_.assign(n + 1, 0);
  for (std::size_t c = 0; c < star.num_cells(); ++c)
    for (const std::uint32_t slot : star.slots_of(c)) ++offsets_[slot + 1];
  for (std::size_t i = 0; i < n; ++i) offsets_[i + 1] += offsets_[i];
  next_.assign(offsets_.begin(), offsets_.end() - 1);
  links_.resize(offsets_[n]);
  const auto add = [&](std::uint32_t slot, Link link) {
    if (slot < n) links_[next_[slot]++] = link;
  };
  const auto at_infinity = static_cast<std::uint32_t>(n);
  for (std::size_t c = 0; c < star.num_cells(); ++c) {
    const SignedIndex number = numbers_[c];
    const std::span<const std::uint32_t> of_cell = star.slots_of(c);
    if (k_ != 2 && k_ != 3) {
      for (const std::uint32_t slot : of_cell) add(slot, {0, 0, number});
      continue;
    }
    slots_.clear();
    bool is_odd = false;
    const VerticesOfCell vertices = complex_.vertices(star.cell(c));
    for (std::size_t i = 0; i <= k_; ++i) {
      const Index w = index(vertices[i]);
      if (w == v) {
        is_odd = i % 2 == 1;
        continue;
      }
      const auto slot =
          std::ranges::find_if(of_cell, [&](std::uint32_t s) { return star.neighbors()[s] == w; });
      slots_.push_back(slot == of_cell.end() ? at_infinity : *slot);
    }
    if (is_odd) std::swap(slots_[0], slots_[1]);
    if (k_ == 2) {
      add(slots_[0], {0, 1, number});
      add(slots_[1], {0, 0, number});
    } else {
      for (std::size_t i = 0; i < 3; ++i) add(slots_[i], {slots_[(i + 1) % 3], slots_[(i + 2) % 3], number});
    }
  }
}

std::span<const SignedIndex> FacePolygons::face(std::size_t slot) {
  const std::span<const Link> links =
      std::span(links_).subspan(offsets_[slot], offsets_[slot + 1] - offsets_[slot]);
  face_.clear();
  if (k_ == 2) {
    face_.resize(2);
    for (const Link& link : links) face_[link.to] = link.vertex;
    return face_;
  }
  if (k_ != 3) {
    for (const Link& link : links) face_.push_back(link.vertex);
    std::sort(face_.begin(), face_.end());
    face_.erase(std::unique(face_.begin(), face_.end()), face_.end());
    return face_;
  }
  // The two infinite cells are neighbors, and so are the cells of one class.
  link_from_.resize(offsets_.size());
  for (std::uint32_t i = 0; i < links.size(); ++i) link_from_[links[i].from] = i;
  std::uint32_t at = 0;
  for (std::size_t i = 0; i < links.size(); ++i, at = link_from_[links[at].to])
    if (face_.empty() || face_.back() != links[at].vertex) face_.push_back(links[at].vertex);
  if (face_.size() > 1 && face_.back() == face_.front()) face_.pop_back();
  std::rotate(face_.begin(), std::min_element(face_.begin(), face_.end()), face_.end());
  return face_;
}

}  // namespace delone::particles
