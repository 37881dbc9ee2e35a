// SPDX-License-Identifier: BSD-3-Clause
// Determinants by minors, of as many columns as are known to the compiler and of any number, against
// elimination in integers; and permanents.
#include "kernel/minors.hpp"

#include "base/random.hpp"
#include "brute_force.hpp"

#include <gtest/gtest.h>

#include <hwy/highway.h>

#include "kernel/minors-inl.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::kernel {
namespace {

/// Small integers: everything is exact in binary64.
template <int N>
void expect_determinant_and_permanent() {
  random::Generator generator(N);
  for (int round = 0; round < 50; ++round) {
    double a[N * N];
    Magnitude magnitudes[N * N];
    test::Matrix m(N, std::vector<test::Integer>(N));
    for (std::size_t i = 0; i < N * N; ++i) {
      a[i] = static_cast<double>(generator.below(9)) - 4;
      magnitudes[i].value = std::fabs(a[i]);
      m[i / N][i % N] = static_cast<int>(a[i]);
    }
    std::vector<double> table(std::size_t{1} << N);
    EXPECT_EQ(test::Integer(determinant_by_minors<N>(a)), test::determinant(m));
    EXPECT_EQ(test::Integer(determinant_by_minors(a, N, table.data())), test::determinant(m));
    double permanent = 0;
    std::vector<std::size_t> column(N);
    std::iota(column.begin(), column.end(), 0);
    do {
      double product = 1;
      for (std::size_t i = 0; i < N; ++i) product *= magnitudes[i * N + column[i]].value;
      permanent += product;
    } while (std::next_permutation(column.begin(), column.end()));
    EXPECT_EQ(determinant_by_minors<N>(magnitudes).value, permanent);
    std::vector<Magnitude> magnitude_table(std::size_t{1} << N);
    EXPECT_EQ(determinant_by_minors(magnitudes, N, magnitude_table.data()).value, permanent);
  }
}

TEST(Minors, MakeDeterminantsAndPermanents) {
  expect_determinant_and_permanent<1>();
  expect_determinant_and_permanent<2>();
  expect_determinant_and_permanent<3>();
  expect_determinant_and_permanent<4>();
  expect_determinant_and_permanent<6>();
}

/// The table for vectors, with one matrix in all lanes, and the cofactors made from two tables.
namespace hn = hwy::HWY_NAMESPACE;
namespace in_lanes = HWY_NAMESPACE;

HWY_BEFORE_NAMESPACE();
template <int N>
void expect_cofactors() {
  const hn::CappedTag<double, 8> d;
  using V = hn::Vec<decltype(d)>;
  using Entries = in_lanes::Entries<N, 8, decltype(d)>;
  random::Generator generator(N);
  for (int round = 0; round < 20; ++round) {
    HWY_ALIGN double entries[N * N * 8];
    test::Matrix m(N, std::vector<test::Integer>(N));
    for (std::size_t i = 0; i < N * N; ++i) {
      const double x = static_cast<double>(generator.below(9)) - 4;
      std::fill_n(entries + 8 * i, 8, x);
      m[i / N][i % N] = static_cast<int>(x);
    }
    const Entries matrix{d, entries};
    V above[std::size_t{1} << N], below[std::size_t{1} << N];
    in_lanes::tabulate_minors<N>(matrix, above);
    in_lanes::tabulate_minors<N>(in_lanes::FromLastRow<Entries>{matrix}, below);
    EXPECT_EQ(test::Integer(hn::GetLane(above[(1u << N) - 1])), test::determinant(m));
    // The cofactors of a row are proportional to the column of the inverse: their sum with the row is the
    // determinant, up to a sign, and that with any other row is 0.
    constexpr int row = 1;
    [&]<int... Column>(std::integer_sequence<int, Column...>) {
      const double cofactors[] = {hn::GetLane(in_lanes::cofactor<N, row, Column>(above, below))...};
      for (std::size_t i = 0; i < N; ++i) {
        test::Integer sum = 0;
        for (std::size_t j = 0; j < N; ++j) sum += m[i][j] * test::Integer(cofactors[j]);
        EXPECT_EQ(abs(sum), i == row ? test::Integer(abs(test::determinant(m))) : test::Integer(0));
      }
    }
    (std::make_integer_sequence<int, N>());
  }
}
HWY_AFTER_NAMESPACE();

TEST(Minors, MakeCofactorsInLanes) {
  expect_cofactors<2>();
  expect_cofactors<3>();
  expect_cofactors<5>();
}

}  // namespace
}  // namespace delone::kernel
