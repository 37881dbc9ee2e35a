// SPDX-License-Identifier: BSD-3-Clause
#include "hull/complete_shell.hpp"

#include "base/compiled_dimension.hpp"
#include "base/progress_meter.hpp"
#include "hull/growing_shell.hpp"
#include "hull/hull_analysis.hpp"
#include "kernel/hull_stages.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::hull {
namespace {

/// A shell and the points that may be beyond it.
class Refinement {
 public:
  explicit Refinement(PointSieve& sieve) : sieve_(sieve) {}

  bool run() {
    drop_interior();
    if (few_are_undecided()) return false;
    if (grow_exactly()) return true;
    drop_interior();
    for (;; drop_interior()) {
      if (!pays()) return false;
      const std::vector<std::size_t> beyond = farthest_beyond();
      if (beyond.empty()) break;
      sieve_.add_to_shell(beyond);
    }
    // The others are in this shell, and in larger ones.
    sieve_.add_to_shell(exactly_beyond());
    return true;
  }

  /// The shell before points were added that may not be extreme, if it was kept.
  std::unique_ptr<HullState> take_before() { return std::move(before_); }

 private:
  /// The shell grows in binary64 until few points are beyond it by more than rounding; those that are beyond
  /// it exactly are added. Returns false if that fails; the shell may have grown.
  bool grow_exactly() {
    constexpr std::size_t most_products = 256;  // per point
    constexpr std::size_t most_open = 256;
    const auto& reach = sieve_.box().reach;
    const double tolerance = 0x1p-44 * std::accumulate(reach.begin(), reach.end(), 0.0);
    GrowingShell growth(sieve_, tolerance, [] { internal::cancellation_point(); });
    if (!growth.is_possible()) return false;
    if (!growth.run({.products = most_products * sieve_.num_remaining()}) && growth.open().size() > most_open)
      return false;
    std::vector<char> is_in_doubt(sieve_.num_remaining(), 0);
    for (const std::size_t i : growth.covered()) is_in_doubt[i] = 1;
    for (const std::size_t i : growth.open()) is_in_doubt[i] = 1;
    const HullState& shell = sieve_.shell();
    const HullLocator locator(shell.sites(), *shell.boundary());
    kernel::Grid grid = shell.sites().grid;
    grid.include(shell.boundary()->center().data());
    for (std::size_t i = 0; i < is_in_doubt.size(); ++i)
      if (is_in_doubt[i] != 0) grid.include(point(i).data());
    std::vector<std::size_t> beyond;
    // All rows of the shell stay, and so do those that are equal to one. Of other equal rows some may be
    // certainly inside and some in doubt, which are then found to be inside, too.
    std::vector<char> is_inside(sieve_.num_remaining(), 0);
    for (std::size_t i = 0; i < is_in_doubt.size(); ++i) {
      Sign side = Sign::positive;
      if (is_in_doubt[i] != 0) side = locator.locate_from(growth.cell_of(i), point(i).data(), grid).side;
      if (side == Sign::negative) beyond.push_back(i);
      if (side == Sign::positive) is_inside[i] = shell.find(point(i).data()) == invalid_index ? 1 : 0;
    }
    // The others are in this shell, and in larger ones.
    if (!beyond.empty()) {
      before_ = std::make_unique<HullState>(shell);
      sieve_.add_to_shell(beyond);
    }
    sieve_.remove(is_inside);
    return true;
  }

  std::size_t ambient() const { return static_cast<std::size_t>(sieve_.shell().sites().ambient); }
  std::span<const double> point(std::size_t i) const {
    return sieve_.remaining_points().subspan(i * ambient(), ambient());
  }

  /// One plane for each cell.
  void find_planes() {
    const HullState& shell = sieve_.shell();
    std::vector<Index> cells(shell.hull().num_cells());
    std::iota(cells.begin(), cells.end(), Index{0});
    planes_ = hull_planes(shell.sites(), shell.hull(), cells, sieve_.box());
  }

  void drop_interior() {
    find_planes();
    std::vector<char> is_inside(sieve_.num_remaining(), 0);
    find_below(sieve_.remaining_points(), planes_.functions, planes_.low, is_inside);
    sieve_.remove(is_inside);
  }

  /// Whether most points are certainly beyond the shell, in a sample.
  bool few_are_undecided() const {
    constexpr std::size_t sample = 256;
    const std::size_t n = sieve_.num_remaining(), step = n / sample + 1;
    std::size_t undecided = 0, seen = 0;
    for (std::size_t i = 0; i < n; i += step) {
      if (sieve_.is_in_shell(i)) continue;
      ++seen;
      std::size_t f = 0;
      while (f < planes_.low.size() && !(value(f, i) > planes_.high[f])) ++f;
      undecided += f == planes_.low.size() ? 1 : 0;
    }
    return undecided * 8 < seen;
  }

  /// The cost of a pass grows with points and facets, that of insertions with the points alone.
  bool pays() const {
    constexpr std::size_t most_work = std::size_t{1} << 22;
    return planes_.low.size() * sieve_.num_remaining() < most_work;
  }

  double value(std::size_t f, std::size_t i) const {
    const double *normal = planes_.functions.normals.data() + f * ambient(), *x = point(i).data();
    double sum = 0;
    for (std::size_t j = 0; j < ambient(); ++j) sum += normal[j] * (x[j] - planes_.functions.origin[j]);
    return sum;
  }

  /// For each facet the farthest point, if it is certainly beyond.
  std::vector<std::size_t> farthest_beyond() const {
    const std::vector<std::size_t> farthest = sieve_.extremes(planes_.functions);
    std::vector<std::size_t> beyond;
    for (std::size_t f = 0; f < farthest.size(); ++f)
      if (farthest[f] != Extreme::nowhere && value(f, farthest[f]) > planes_.high[f])
        beyond.push_back(farthest[f]);
    return beyond;
  }

  /// A facet, as one of its cells.
  struct Facet {
    Index cell;
    std::size_t axis;  ///< the hyperplane is that of a coordinate with a constant value; d if it is not
    double value;
    bool inside_is_above;
  };

  std::vector<Facet> facets() const {
    const HullState& shell = sieve_.shell();
    const HullAnalysis analysis(shell);
    const Lists& cells_of_facet = analysis.faces().cells_of_facet;
    std::vector<Facet> facets;
    for (std::size_t f = 0; f < cells_of_facet.size(); ++f) {
      Facet facet{cells_of_facet[f][0], 0, 0, false};
      const auto cell = shell.hull().cell(facet.cell);
      for (; facet.axis < ambient(); ++facet.axis) {
        facet.value = shell.sites().point(cell[0])[facet.axis];
        if (std::all_of(cell.begin(), cell.end(),
                        [&](Index site) { return shell.sites().point(site)[facet.axis] == facet.value; }))
          break;
      }
      if (facet.axis < ambient())
        facet.inside_is_above = std::any_of(shell.basis().begin(), shell.basis().end(), [&](Index site) {
          return shell.sites().point(site)[facet.axis] > facet.value;
        });
      facets.push_back(facet);
    }
    return facets;
  }

  /// All points that are beyond a facet, where that needs exact arithmetic.
  std::vector<std::size_t> exactly_beyond() const {
    return internal::with_compiled_dimension(ambient(), [&](auto d) { return exactly_beyond<d()>(); });
  }
  template <int D>
  std::vector<std::size_t> exactly_beyond() const {
    const BoundarySites& sites = sieve_.shell().sites();
    const std::vector<Facet> all = facets();
    std::vector<const double*> corners(ambient());
    std::vector<std::size_t> beyond;
    kernel::Grid grid = sites.grid;
    for (std::size_t i = 0; i < sieve_.num_remaining(); ++i) grid.include(point(i).data());
    internal::StageCounts uncounted;
    const auto is_beyond = [&](const Facet& facet, std::size_t i) {
      if (value(facet.cell, i) < planes_.low[facet.cell]) return false;
      const double* x = point(i).data();
      if (facet.axis < ambient())
        return facet.inside_is_above ? x[facet.axis] < facet.value : x[facet.axis] > facet.value;
      const auto cell = sieve_.shell().hull().cell(facet.cell);
      for (std::size_t j = 0; j < ambient(); ++j) corners[j] = sites.point(cell[j]);
      return kernel::hull_side<D>(sites.flat(), corners.data(), x, grid, uncounted) == Sign::negative;
    };
    for (std::size_t i = 0; i < sieve_.num_remaining(); ++i)
      if (!sieve_.is_in_shell(i) &&
          std::any_of(all.begin(), all.end(), [&](const Facet& facet) { return is_beyond(facet, i); }))
        beyond.push_back(i);
    return beyond;
  }

  PointSieve& sieve_;
  HullPlanes planes_;
  std::unique_ptr<HullState> before_;
};

}  // namespace

bool complete_shell(PointSieve& sieve, std::unique_ptr<HullState>* before) {
  Refinement refinement(sieve);
  const bool is_complete = refinement.run();
  if (before) *before = refinement.take_before();
  return is_complete;
}

}  // namespace delone::hull
