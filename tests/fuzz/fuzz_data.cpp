// SPDX-License-Identifier: BSD-3-Clause
// Bytes → a few points and changes of the arrays of their triangulation, hull, intersection or diagram:
// check() must end with a report, the unchanged result must pass it, and what can be written must read back
// as the same.
// `--target=complex`, `hull`, `intersection` or `diagram`; without it the first byte chooses.
#include <delone/delone.hpp>

#include "memory_folder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace {

using delone::test::content;
using delone::test::MemoryFolder;

constexpr std::array<std::string_view, 4> targets{"complex", "hull", "intersection", "diagram"};
std::size_t chosen = targets.size();

void require(bool condition, const std::string& what) {
  if (condition) return;
  std::fprintf(stderr, "fuzz_data: %s\n", what.c_str());
  std::abort();
}

/// The input, byte after byte; zeros after its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}
  bool at_end() const { return next_ == end_; }
  std::size_t take() { return at_end() ? 0 : *next_++; }
  std::size_t below(std::size_t limit) { return take() % limit; }

 private:
  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

// Calls use(array) for every array.
template <class Use>
void for_each_array(delone::ComplexData& data, Use use) {
  use(data.points), use(data.cells), use(data.neighbors), use(data.vertex_of_point), use(data.weights);
}
template <class Use>
void for_each_array(delone::HullData& data, Use use) {
  use(data.points), use(data.cells), use(data.neighbors), use(data.facet_of_cell), use(data.facet_offsets);
  use(data.facet_vertices), use(data.ridge_facets), use(data.ridge_offsets), use(data.ridge_vertices);
  use(data.equations), use(data.equation_errors), use(data.vertices), use(data.vertex_of_point);
  use(data.point_kinds), use(data.axes);
}
template <class Use>
void for_each_array(delone::IntersectionData& data, Use use) {
  use(data.halfspaces), use(data.first_of_halfspace), use(data.witness), use(data.interior_point),
      use(data.axes);
  use(data.vertices), use(data.vertex_offsets), use(data.vertex_halfspaces), use(data.directions);
  use(data.direction_offsets), use(data.direction_halfspaces), use(data.edges), use(data.rays);
  use(data.facet_halfspaces), use(data.facet_offsets), use(data.facet_vertices);
  use(data.facet_direction_offsets), use(data.facet_directions), use(data.lineality), use(data.kinds);
  use(data.dual_points), use(data.dual_equations);
}
template <class Use>
void for_each_array(delone::VoronoiData& data, Use use) {
  use(data.points), use(data.weights), use(data.vertices), use(data.ridge_points), use(data.ridge_offsets);
  use(data.ridge_vertices), use(data.region_offsets), use(data.region_vertices), use(data.point_region);
  use(data.ray_vertices), use(data.ray_directions), use(data.ray_points);
}

template <class T>
T some_value(Bytes& bytes, T present) {
  const std::size_t choice = bytes.take();
  if constexpr (std::is_same_v<T, double>) {
    constexpr std::array<double, 8> values{0,
                                           1,
                                           -1,
                                           1e308,
                                           -1e308,
                                           5e-324,
                                           std::numeric_limits<double>::infinity(),
                                           std::numeric_limits<double>::quiet_NaN()};
    return choice < 8     ? values[choice]
           : choice < 64  ? -present
           : choice < 128 ? std::nextafter(present, 9e9)
                          : static_cast<double>(choice % 5);
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<T>(choice % 6);
  } else {
    constexpr std::array<T, 5> values{-1, -2, std::numeric_limits<T>::min(), std::numeric_limits<T>::max(),
                                      1 << 20};
    return choice < values.size() ? values[choice] : static_cast<T>(choice % 12);
  }
}

/// One change of one array: an item, two items exchanged, one left out or repeated, or no items at all.
template <class Data>
void change(Data& data, Bytes& bytes) {
  std::size_t arrays = 0, at = 0;
  for_each_array(data, [&](auto&) { ++arrays; });
  const std::size_t array = bytes.below(arrays), kind = bytes.below(8);
  for_each_array(data, [&](auto& items) {
    if (at++ != array || items.empty()) return;
    const std::size_t i = bytes.below(items.size()), j = bytes.below(items.size());
    const auto place = items.begin() + static_cast<std::ptrdiff_t>(i);
    if (kind < 4) items[i] = some_value(bytes, items[i]);
    if (kind == 4) std::swap(items[i], items[j]);
    if (kind == 5) items.erase(place);
    if (kind == 6) items.insert(place, items[j]);
    if (kind == 7) items.clear();
  });
}

/// The cells of an alpha complex, or the facets around them.
delone::ComplexData part_of(const std::vector<double>& points, int dimension) {
  const delone::Delaunay<> triangulation(points, dimension);
  const delone::AlphaComplex complex(triangulation, 1.5);
  return triangulation.num_rows() % 2 == 0 ? complex.to_data() : complex.boundary_data();
}

template <class Data>
void examine(Data data, Bytes& bytes) {
  static const MemoryFolder folder;
  bool changed = false;
  for (int changes = 0; !bytes.at_end() && changes < 8; ++changes, changed = true) change(data, bytes);
  if (changed && bytes.below(16) == 1) data.dimension = static_cast<int>(bytes.below(6)) - 1;

  const delone::CheckReport report = delone::check(data);
  require(report.ok == report.violation.empty(), "a report without a reason");
  require(changed || report.ok, "a right result: " + report.violation);
  const std::string json = folder.file("a.json"), npz = folder.file("a.npz"),
                    again = folder.file("again.json");
  for (const std::string& path :
       {json, npz, folder.file("a.off"), folder.file("a.svg"), folder.file("a.vtu")}) {
    try {
      delone::write(path, data);
    } catch (const delone::Error& error) {
      require(changed || (path != json && path != npz), std::string("a right result: ") + error.what());
      if (path == json || path == npz) return;
    }
  }
  const std::string expected = content(json);
  for (const std::string& path : {json, npz}) {
    Data read;
    try {
      read = delone::read_as<Data>(path);
    } catch (const delone::Error& error) {
      require(changed,
              std::string("a right result: ") + error.what());  // a writer may know less than the reader
      continue;
    }
    delone::write(again, read);
    require(content(again) == expected, "another result after " + path);
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view option = "--target=";
  for (int i = 1; i < *argc; ++i) {
    const std::string_view argument = (*argv)[i];
    if (!argument.starts_with(option)) continue;
    const auto found = std::find(targets.begin(), targets.end(), argument.substr(option.size()));
    require(found != targets.end(), "no such target");
    chosen = static_cast<std::size_t>(found - targets.begin());
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const std::size_t target = chosen < targets.size() ? chosen : bytes.below(targets.size());
  const int dimension = 1 + static_cast<int>(bytes.below(3));
  const auto width = static_cast<std::size_t>(target == 2 ? dimension + 1 : dimension);
  std::vector<double> numbers(bytes.below(10) * width);
  for (double& x : numbers) x = static_cast<double>(bytes.below(7)) - 3;
  std::vector<double> weights(numbers.size() / width);
  const std::size_t choice = bytes.below(8);
  const bool weighted = choice % 2 == 1;
  if (weighted)
    for (double& w : weights) w = static_cast<double>(bytes.below(5));
  switch (target) {
    case 0:
      examine(weighted                       ? delone::Regular<>(numbers, weights, dimension).to_data()
              : choice == 2                  ? delone::FurthestSite<>(numbers, dimension).to_data()
              : choice == 4                  ? part_of(numbers, dimension)
              : choice == 6 && dimension > 1 ? delone::LowerHull<>(numbers, dimension).to_data()
                                             : delone::Delaunay<>(numbers, dimension).to_data(),
              bytes);
      break;
    case 1:
      examine(delone::ConvexHull<>(numbers, dimension).to_data(), bytes);
      break;
    case 2:
      try {
        examine(delone::HalfspaceIntersection<>(numbers, dimension).to_data(), bytes);
      } catch (const delone::Error& error) {
        require(error.code() == delone::Errc::invalid_argument, error.what());
      }
      break;
    default:
      if (weighted)
        examine(delone::PowerDiagram<>(delone::Regular<>(numbers, weights, dimension)).to_data(), bytes);
      else if (choice == 2)
        examine(delone::FurthestVoronoi<>(delone::FurthestSite<>(numbers, dimension)).to_data(), bytes);
      else
        examine(delone::Voronoi<>(delone::Delaunay<>(numbers, dimension)).to_data(), bytes);
  }
  return 0;
}
