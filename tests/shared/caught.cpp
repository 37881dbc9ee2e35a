// SPDX-License-Identifier: BSD-3-Clause
// A program with hidden symbols catches the errors of the shared library, and those that headers throw.
#include <delone/delone.hpp>

#include <cstdio>
#include <limits>
#include <vector>

std::size_t cells_of_the_other_unit(const std::vector<double>& coordinates, int dimension);

int main() {
  int failures = 0;
  const auto expect = [&](delone::Errc code, const auto& call) {
    try {
      call();
      std::puts("no error");
    } catch (const delone::Error& error) {
      if (error.code() == code) return;
      std::puts(error.what());
    }
    ++failures;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect(delone::Errc::not_finite, [&] { cells_of_the_other_unit({0, 0, 1, 0, nan, 1}, 2); });
  expect(delone::Errc::bad_dimension, [&] { cells_of_the_other_unit({0, 0, 1, 0, 1}, 2); });
  expect(delone::Errc::cannot_open, [&] { delone::read_as<delone::HullData>("/nowhere/hull.json"); });
  const auto levels = delone::check_levels<delone::VoronoiData>();
  return failures + (levels.empty() ? 1 : 0) +
         (cells_of_the_other_unit({0, 0, 1, 0, 0, 1, 1, 1}, 2) == 2 ? 0 : 1);
}
