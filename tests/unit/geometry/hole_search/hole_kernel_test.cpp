// SPDX-License-Identifier: BSD-3-Clause
// The kernels of hole searches against plain loops in long double.
#include "geometry/hole_search/hole_kernel.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace delone::geometry {
namespace {

/// An affine function by its coefficients, at an image.
long double at_image(const std::vector<double>& functions, int k, int f, const double* image) {
  const std::size_t width = width_of_functions(k);
  const auto coefficient = [&](int r) {
    return static_cast<long double>(
        functions[static_cast<std::size_t>(r) * width + static_cast<std::size_t>(f)]);
  };
  long double sum = coefficient(k);
  for (int r = 0; r < k; ++r) sum += coefficient(r) * image[r];
  return sum;
}

/// The simplex of the origin and the unit vectors, whose coordinates are known.
std::vector<double> functions_of_unit_simplex(int k) {
  const std::size_t width = width_of_functions(k);
  std::vector<double> functions(size_of_functions(k), 0.0);
  for (int r = 0; r < k; ++r) {
    functions[static_cast<std::size_t>(r) * width] = -1;
    functions[static_cast<std::size_t>(r) * width + static_cast<std::size_t>(r) + 1] = 1;
    functions[static_cast<std::size_t>(r) * width + static_cast<std::size_t>(k) + 1] = -1;  // lifts are |x|²
  }
  functions[static_cast<std::size_t>(k) * width] = 1;
  return functions;
}

TEST(HoleKernel, AnotherVertexTakesASlot) {
  test::Random random(6);
  for (int k = 1; k <= 9; ++k) {
    const auto corners = static_cast<std::size_t>(k) + 1;
    std::vector<double> functions = functions_of_unit_simplex(k), replaced(functions.size());
    std::vector<std::vector<double>> vertices(corners, std::vector<double>(corners, 0.0));
    for (std::size_t i = 1; i < corners; ++i) vertices[i][i - 1] = vertices[i].back() = 1;
    for (int slot = 0; slot <= k; ++slot) {
      std::vector<double> apex(corners, 0.0);
      for (std::size_t r = 0; r + 1 < corners; ++r) {
        apex[r] = random.real();
        apex.back() += apex[r] * apex[r];
      }
      replace_vertex(k, functions.data(), slot, apex.data(), replaced.data());
      vertices[static_cast<std::size_t>(slot)] = apex;
      for (int f = 0; f <= k; ++f)
        for (std::size_t i = 0; i < corners; ++i)
          EXPECT_NEAR(static_cast<double>(at_image(replaced, k, f, vertices[i].data())),
                      static_cast<std::size_t>(f) == i ? 1 : 0, 1e-6)
              << k << " " << slot;
      for (const auto& vertex : vertices)
        EXPECT_NEAR(static_cast<double>(at_image(replaced, k, k + 1, vertex.data())) + vertex.back(), 0, 1e-6)
            << k << " " << slot;
      functions = replaced;
    }
  }
}

template <class T>
struct Search {
  int k;
  std::size_t stride;
  std::vector<double> functions = functions_of_unit_simplex(k);
  std::vector<T> rows = {}, heights = {}, distances = {};
  std::vector<int> slots = {};
  std::vector<std::uint32_t> own = {};
  std::array<bool, 16> are_certain = {};

  PencilTask<T> task(double side, double largest_lift) {
    return {k,           functions.data(), slots.data(),      slots.size(),   side,
            rows.data(), stride,           largest_lift,      heights.data(), distances.data(),
            own.data(),  own.size(),       are_certain.data()};
  }
};

/// The candidate with the least ratio must be found. What is certainly on the other side, or has a ratio far
/// above one that is certainly there, must not. `near`: a distance far larger than its error; `gap`: the same
/// of ratios.
template <class T>
void expect_first_found(double near, double gap) {
  constexpr long double infinity = std::numeric_limits<long double>::infinity();
  test::Random random(7);
  for (int k = 1; k <= 9; ++k)
    for (const std::size_t count : {1, 15, 16, 17, 64, 130})
      for (const double side : {-1.0, 1.0}) {
        Search<T> search{k, (count + 15) / 16 * 16};
        const auto corners = static_cast<std::size_t>(k) + 1;
        search.rows.assign(search.stride * corners, T{0});
        search.heights.resize(search.stride);
        search.distances.resize(search.stride);
        for (int slot = 0; slot <= k; ++slot) search.slots.push_back(slot);
        const auto entry = [&](std::size_t r, std::size_t i) -> T& {
          return search.rows[r * search.stride + i];
        };
        double largest_lift = 1;
        for (std::size_t i = 0; i < search.stride; ++i) {
          double lift = 0;
          for (std::size_t r = 0; r + 1 < corners; ++r) {
            entry(r, i) = i < count ? static_cast<T>(1.5 * random.real() - 0.5) : 0;
            lift += double{entry(r, i)} * double{entry(r, i)};
          }
          entry(corners - 1, i) = i < count ? static_cast<T>(lift) : std::numeric_limits<T>::infinity();
          if (i < count) largest_lift = std::max(largest_lift, lift);
        }
        if (count > 20) search.own = {3, 20};
        const std::size_t words = words_of_candidates(search.stride);
        std::vector<std::uint64_t> found(words * search.slots.size(), ~std::uint64_t{0});
        find_first(search.task(side, largest_lift), found.data());

        for (std::size_t facet = 0; facet < search.slots.size(); ++facet) {
          std::vector<long double> ratios(search.stride, infinity), distances(search.stride, -infinity);
          std::vector<double> image(corners);
          long double least = infinity, least_of_certain = infinity;
          for (std::size_t i = 0; i < count; ++i) {
            if (std::find(search.own.begin(), search.own.end(), i) != search.own.end()) continue;
            for (std::size_t r = 0; r < corners; ++r) image[r] = entry(r, i);
            distances[i] = static_cast<long double>(side) *
                           at_image(search.functions, k, search.slots[facet], image.data());
            if (distances[i] <= 0) continue;
            ratios[i] = (at_image(search.functions, k, k + 1, image.data()) + image.back()) / distances[i];
            least = std::min(least, ratios[i]);
            if (distances[i] > near) least_of_certain = std::min(least_of_certain, ratios[i]);
          }
          const long double most = least_of_certain + gap * (1 + std::fabs(least_of_certain));
          for (std::size_t i = 0; i < search.stride; ++i) {
            const bool is_found = (found[facet * words + i / 64] >> (i % 64) & 1) != 0;
            if (distances[i] < -near || (distances[i] > near && ratios[i] > most)) {
              EXPECT_FALSE(is_found) << k << " " << i;
            } else if (ratios[i] < infinity && ratios[i] == least) {
              EXPECT_TRUE(is_found) << k << " " << i;
            }
          }
          if (search.are_certain[facet])
            EXPECT_LT(least, infinity) << k;
          else
            EXPECT_EQ(least_of_certain, infinity) << k;
        }
      }
}

TEST(HoleKernel, TheFirstVertexIsFound) {
  expect_first_found<double>(1e-9, 1e-2);
  expect_first_found<float>(0.02, 0.02);
}

}  // namespace
}  // namespace delone::geometry
