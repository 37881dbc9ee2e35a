// SPDX-License-Identifier: BSD-3-Clause
// Arguments that are not points, one per value of MISUSE; 0 is the correct program.
#include <delone/points.hpp>

#include <array>
#include <complex>
#include <deque>
#include <list>
#include <string>
#include <vector>

struct Unknown {
  double x, y, z;
};
struct WithMass {
  double mass, x, y, z;
};
template <>
struct delone::PointTraits<WithMass> {
  static constexpr int dimension = 3;
  static constexpr bool is_contiguous = true;
};

template <int D>
void take(const delone::AnyPoints<D>&) {}
template <int D>
void take_one(const delone::AnyPoint<D>&) {}

void misuse() {
#if MISUSE == 0
  take<3>(std::vector<std::vector<double>>());
  take_one<3>({1, 2, 3});
#elif MISUSE == 1  // points of the plane
  take<3>(std::vector<std::array<double, 2>>());
#elif MISUSE == 2  // the same, copied
  take<3>(std::list<std::array<double, 2>>());
#elif MISUSE == 3  // integers
  take<1>(std::vector<long long>());
#elif MISUSE == 4  // rows of integers
  take<3>(std::vector<std::vector<int>>());
#elif MISUSE == 5  // more precision than will be used
  take<3>(std::vector<std::array<long double, 3>>());
#elif MISUSE == 6  // a structure that nobody vouches for
  take<3>(std::vector<Unknown>());
#elif MISUSE == 7
  take<2>(std::vector<std::complex<double>>());
#elif MISUSE == 8   // one point of the plane
  take_one<3>(std::array<double, 2>());
#elif MISUSE == 9   // text
  take<3>(std::vector<std::string>());
#elif MISUSE == 10  // not of the promised size
  take<3>(std::vector<WithMass>());
#elif MISUSE == 11  // two coordinates
  take_one<3>({1, 2});
#endif
}
