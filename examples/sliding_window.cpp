// SPDX-License-Identifier: BSD-3-Clause
// A stream of points in a sliding window: each new one is inserted, and those that have become too old are
// removed. The points are earthquakes in space and time.
//   example_sliding_window [HOURS]
#include <delone/delone.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace {

using Window = delone::Delaunay<4>;
using Point = Window::Point;

constexpr double km_per_hour = 1;  // an hour counts as much as a kilometer

/// The earthquakes of a file in the order of time: hypocenters in km from the center of the earth, and time.
std::vector<Point> read_events(const std::string& path) {
  delone::ReadOptions options;
  options.columns = {"longitude", "latitude", "depth_km", "time_ms"};
  const delone::PointTable table = delone::read_points(path, options);
  std::vector<Point> events;
  for (std::size_t i = 0; i < table.num_points(); ++i) {
    const double* const row = table.coordinates.data() + 4 * i;
    const double degree = std::acos(-1.0) / 180, longitude = row[0] * degree, latitude = row[1] * degree;
    const double radius = 6371 - row[2], hour = row[3] / 3600000;
    events.push_back({radius * std::cos(latitude) * std::cos(longitude),
                      radius * std::cos(latitude) * std::sin(longitude), radius * std::sin(latitude),
                      hour * km_per_hour});
  }
  std::sort(events.begin(), events.end(), [](const Point& a, const Point& b) { return a[3] < b[3]; });
  return events;
}

/// The volume of a cell, by elimination; 0 for cells of fewer than five points.
double volume(const Window& window, delone::CellId cell) {
  const delone::VerticesOfCell corners = window.vertices(cell);
  if (corners.size() != 5 || window.complex().is_infinite(cell)) return 0;
  double edges[4][4], product = 1;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      edges[i][j] = window.point(corners[i + 1])[j] - window.point(corners[0])[j];
  for (std::size_t j = 0; j < 4; ++j) {
    std::size_t pivot = j;
    for (std::size_t i = j + 1; i < 4; ++i)
      if (std::fabs(edges[i][j]) > std::fabs(edges[pivot][j])) pivot = i;
    std::swap(edges[j], edges[pivot]);
    product *= edges[j][j];
    for (std::size_t i = j + 1; i < 4 && product != 0; ++i)
      for (std::size_t l = 4; l-- > j;) edges[i][l] -= edges[i][j] / edges[j][j] * edges[j][l];
  }
  return std::fabs(product) / 24;
}

double distance(const Point& a, const Point& b) {
  double square = 0;
  for (std::size_t j = 0; j < a.size(); ++j) square += (a[j] - b[j]) * (a[j] - b[j]);
  return std::sqrt(square);
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
  const char* from_environment = std::getenv("DELONE_EXAMPLE_INPUT");
  const std::string input = from_environment != nullptr ? from_environment : "data/earthquakes.csv";
  const double width = (argc > 1 ? std::stod(argv[1]) : 48) * km_per_hour;
  try {
    const std::vector<Point> events = read_events(input);
    Window window;
    window.record_changes();
    std::vector<double> volumes;  // by id of a cell
    std::size_t oldest = 0, num_close = 0, num_new_cells = 0, num_compared = 0;
    double milliseconds = 0, milliseconds_rebuilt = 0;
    for (std::size_t i = 0; i < events.size(); ++i) {
      // Row i is event i: numbers are not used again, until compact_ids(), which a stream without an end
      // needs now and then. One edit: the event comes, and those go that are too old.
      const auto start = std::chrono::steady_clock::now();
      std::vector<std::size_t> gone;
      while (events[oldest][3] < events[i][3] - width) gone.push_back(oldest++);
      window.edit({.remove = gone, .insert = std::span(&events[i], 1)});

      // What belongs to cells follows: only that of new ones is computed.
      volumes.resize(window.complex().num_cell_slots());
      for (const delone::CellId cell : window.changes().removed_cells) volumes[index(cell)] = 0;
      for (const delone::CellId cell : window.changes().created_cells)
        volumes[index(cell)] = volume(window, cell);
      num_new_cells += window.changes().created_cells.size();

      // The nearest other event is a neighbor.
      double nearest = std::numeric_limits<double>::infinity();
      const delone::VertexId here = window.vertex_at(i);
      for (const delone::CellId cell : window.complex().star(here))
        for (const delone::VertexId v : window.vertices(cell))
          if (v != here && v != delone::infinite_vertex)
            nearest = std::min(nearest, distance(events[i], events[window.row_of(v)]));
      num_close += nearest < 20 ? 1 : 0;
      milliseconds += milliseconds_since(start);

      // Now and then, the window is triangulated from nothing, to compare.
      if (i % 10 != 0) continue;
      const auto again = std::chrono::steady_clock::now();
      const Window rebuilt(std::span<const Point>(events.data() + oldest, i + 1 - oldest));
      milliseconds_rebuilt += milliseconds_since(again);
      ++num_compared;
      if (rebuilt.hash() != window.hash()) {
        std::cerr << "event " << i << ": not the triangulation of the window\n";
        return 1;
      }
    }
    std::cout << events.size() << " events, " << num_close << " of them within 20 km of another; in the end "
              << window.num_points() << " are in the window, whose cells have a mean volume of "
              << std::accumulate(volumes.begin(), volumes.end(), 0.0) / window.num_finite_cells() << " km^4\n"
              << "per event: " << num_new_cells / events.size() << " new cells, "
              << milliseconds / static_cast<double>(events.size())
              << " ms; a rebuild: " << milliseconds_rebuilt / static_cast<double>(num_compared) << " ms\n"
              << num_compared << " hashes are equal\n";
    return 0;
  } catch (const delone::Error& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
