// SPDX-License-Identifier: BSD-3-Clause
// The translates of a set that may have points in a ball.
//
// The part of a ball of center c and radius R between two planes orthogonal to a free direction
// is within √(R² − h²) of c along the lattice, h the distance of c from the planes. With c − p = λ(a + b), a
// along the lattice and b in the free directions, p between the planes and t from the one that c is beyond,
// that is λ²|a|² + Σ t(2λ|b_i| − t), where a free direction with λ|b_i| ≤ t adds λ²b_i² instead. So a huge
// ball that only just reaches the set is no reason to look far. Fractions of what it has are within that
// times |g_i| of those of c. All of this is rounded, and widened by much more than its errors.
//
// In a box of few points these are (2R)^r copies, and the ball is a small part of them. So translations are
// chosen from the last to the first, in orthonormal directions e_i in which a_j has no component for j < i.
// Once k_i … are chosen, the distance of c from the points of the copy along e_i … is fixed. Where it exceeds
// the radius, no choice of the others will do (Fincke and Pohst 1985, doi:10.1090/S0025-5718-1985-0777278-8).
#pragma once

#include "periodic/extent.hpp"
#include "periodic/periodic_set.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::periodic {

/// Of a ball around a center c, with a point p of the set on its sphere.
class ShiftsInBall {
 public:
  ShiftsInBall(const PeriodicSet& set, const Extent& extent);

  void set_ball(const double* p, const double* c);
  double radius() const { return radius_; }

  /// Calls visit(k) with all translations k, in numbers of vectors of the lattice, whose copies may have
  /// points in the ball around p + part·(c − p) with p on its sphere. 0 < part ≤ 1.
  template <class Visit>
  void each(double part, const Visit& visit) {
    find_range(part);
    each_from(
        set_.rank, 0,
        [](const void* context, std::span<const std::int32_t> k) {
          (*static_cast<const Visit*>(context))(k);
        },
        &visit);
  }

 private:
  double along(std::size_t i, const double* x) const;
  void find_range(double part);
  void each_from(std::size_t chosen, double squared,
                 void (*visit)(const void*, std::span<const std::int32_t>), const void* context);

  const PeriodicSet& set_;
  const Extent& extent_;
  std::vector<double> radial_;                        // c − p
  std::vector<double> fraction_of_p_, step_, slack_;  // of c − p, by the axes of the lattice
  std::vector<std::int32_t> k_, low_, high_;
  std::vector<double> steps_, of_p_, of_step_, at_;  // a_j, p, c − p and the center along e_i
  std::vector<double> beyond_, depth_;               // |b_i| and t, by free directions
  double radius_ = 0, along_ = 0, gain_ = 0, squared_radius_ = 0, slack_of_distance_ = 0, size_ = 0;
};

}  // namespace delone::periodic
