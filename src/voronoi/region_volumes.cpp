// SPDX-License-Identifier: BSD-3-Clause
#include "voronoi/region_volumes.hpp"

#include "base/parallel_parts.hpp"
#include "base/quick_rounds.hpp"
#include "base/spread.hpp"
#include "particles/pass/cell_measure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace delone::voronoi {
namespace {

class RegionMeasurer {
 public:
  RegionMeasurer(const SitesAndCells& diagram, unsigned threads)
      : diagram_(diagram), threads_(threads), size_(diagram.k + 1), row_(diagram.d) {
    const std::size_t num_regions = diagram.sites.size() / diagram.d;
    points_ = diagram.sites;
    if (!diagram.weights.empty()) {
      row_ = diagram.d + 1;
      for (std::size_t r = 0; r < num_regions; ++r) {
        const auto site = diagram.sites.subspan(r * diagram.d, diagram.d);
        weighted_.insert(weighted_.end(), site.begin(), site.end());
        weighted_.push_back(diagram.weights[r]);
      }
      points_ = weighted_;
    }
    for (const double x : points_)
      if (std::abs(x) > 0x1p1000) unit_ = 8;
    list_cells(num_regions);
  }

  std::vector<double> run(const std::vector<unsigned char>& wanted) const {
    std::vector<double> volumes(wanted.size(), 0.0);
    constexpr std::size_t regions_in_part = 512;
    internal::work_in_parts(threads_, volumes.size(), regions_in_part, [&] {
      return [&, worker = Worker(*this)](std::size_t first, std::size_t last,
                                         const internal::StopPoint& stop) mutable {
        for (std::size_t r = first; r < last; ++r) {
          if (!wanted[r]) continue;
          stop();
          volumes[r] = measure(r, worker);
        }
      };
    });
    return volumes;
  }

 private:
  struct Worker {
    explicit Worker(const RegionMeasurer& m)
        : pass(m.diagram_.k, m.diagram_.d, m.row_ > m.diagram_.d, m.unit_), slots(m.offsets_.size(), 0) {}
    particles::CellMeasure pass;
    std::vector<SignedIndex> others;
    std::vector<std::uint32_t> slots;  // by region; 0 between sites
    std::vector<std::uint32_t> corners;
  };

  void list_cells(std::size_t num_regions) {
    internal::QuickRounds round;
    internal::spread(num_regions, offsets_, cells_, [&](const auto& put) {
      for (std::size_t i = 0; i < diagram_.cell_regions.size(); ++i) {
        round();
        put(static_cast<std::size_t>(diagram_.cell_regions[i]), static_cast<Index>(i / size_));
      }
    });
  }

  double measure(std::size_t region, Worker& worker) const {
    const auto cells = std::span(cells_).subspan(offsets_[region], offsets_[region + 1] - offsets_[region]);
    const auto for_others = [&](auto visit) {
      for (const Index c : cells)
        for (const SignedIndex r : diagram_.cell_regions.subspan(c * size_, size_))
          if (static_cast<std::size_t>(r) != region) visit(r);
    };
    worker.others.clear();
    for_others([&](SignedIndex r) {
      if (std::exchange(worker.slots[static_cast<std::size_t>(r)], 1) == 0) worker.others.push_back(r);
    });
    std::sort(worker.others.begin(), worker.others.end());
    const double* const site = points_.data() + region * row_;
    worker.pass.begin(site, worker.others.size());
    for (std::size_t i = 0; i < worker.others.size(); ++i) {
      const auto other = static_cast<std::size_t>(worker.others[i]);
      worker.slots[other] = static_cast<std::uint32_t>(i);
      worker.pass.set_neighbor(i, points_.data() + other * row_);
    }
    worker.corners.clear();
    for_others([&](SignedIndex r) { worker.corners.push_back(worker.slots[static_cast<std::size_t>(r)]); });
    for (auto first = worker.corners.begin(); first != worker.corners.end();
         first += static_cast<std::ptrdiff_t>(diagram_.k))
      std::sort(first, first + static_cast<std::ptrdiff_t>(diagram_.k));
    for (const SignedIndex r : worker.others) worker.slots[static_cast<std::size_t>(r)] = 0;
    worker.pass.measure(worker.corners);
    return worker.pass.volume();
  }

  const SitesAndCells& diagram_;
  unsigned threads_;
  std::size_t size_, row_;
  std::span<const double> points_;
  std::vector<double> weighted_;
  int unit_ = 0;
  std::vector<std::size_t> offsets_;
  std::vector<Index> cells_;  // of each region
};

}  // namespace

std::vector<double> measure_regions(const SitesAndCells& diagram, const std::vector<unsigned char>& wanted,
                                    unsigned threads) {
  return RegionMeasurer(diagram, threads).run(wanted);
}

}  // namespace delone::voronoi
