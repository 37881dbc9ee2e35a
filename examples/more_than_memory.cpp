// SPDX-License-Identifier: BSD-3-Clause
// More points than memory: a survey is written piece by piece, triangulated in tiles, and read part by part.
//   example_more_than_memory [POINTS [BYTES_OF_MEMORY [FOLDER]]]
#include <delone/delone.hpp>
#include <delone/tiles.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace {

/// Galaxies of a survey, slice by slice along x, in groups; a row is x, y, z. Only one slice is in memory.
void write_survey(const std::string& path, std::int64_t num_points) {
  constexpr std::int64_t slice = 100000;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> anywhere(0, 1);
  std::normal_distribution<double> around(0, 0.003);
  std::ofstream file(path, std::ios::binary);
  std::vector<double> rows;
  for (std::int64_t begin = 0; begin < num_points; begin += slice) {
    const std::int64_t end = std::min(begin + slice, num_points);
    const double x = static_cast<double>(begin) / static_cast<double>(num_points),
                 width = static_cast<double>(end - begin) / static_cast<double>(num_points);
    rows.clear();
    double group[3] = {};
    for (std::int64_t i = begin; i < end; ++i) {
      if (i % 20 == 0 || i == begin) {
        group[0] = x + width * anywhere(random);
        group[1] = anywhere(random);
        group[2] = anywhere(random);
      }
      for (const double center : group) rows.push_back(center + around(random));
    }
    file.write(reinterpret_cast<const char*>(rows.data()),
               static_cast<std::streamsize>(rows.size() * sizeof(double)));
  }
}

/// Six times the volume of a cell.
double sixfold_volume(const delone::TileData& part, std::size_t cell) {
  const auto point = [&](std::size_t i) {
    return part.points.data() + 3 * static_cast<std::size_t>(part.cells[4 * cell + i]);
  };
  double e[3][3];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) e[i][j] = point(i + 1)[j] - point(0)[j];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

}  // namespace

int main(int argc, char** argv) {
  const std::int64_t num_points = argc > 1 ? std::stoll(argv[1]) : 20000;
  const std::string folder = argc > 3 ? argv[3] : "survey_tiles", input = "survey.raw";
  try {
    write_survey(input, num_points);

    delone::TilesOptions options;
    options.columns = 3;  // of a raw file
    if (argc > 2) options.memory = std::stoull(argv[2]);
    if (argc <= 2) options.tiles = 4;  // few points: as many as memory asks for would be one
    options.threads = 0;
    options.resume = argc > 3;
    options.forecast = [](const delone::TilesForecast& forecast) {
      std::cout << forecast.num_tiles << " tiles of about " << forecast.bytes_per_tile / 1000000
                << " MB each, " << std::lround(100 * forecast.foreign_share) << " % more points in each\n";
      return forecast.foreign_share < 1;  // otherwise tiles do not pay
    };
    const delone::TilesIndex index = delone::make_tiles(input, folder, options);
    std::cout << index.num_cells << " cells in " << index.parts.size() << " parts, hash " << index.hash
              << '\n';

    // One part after the other is in memory. Every cell is in one part.
    double volume = 0;
    std::int64_t num_cells = 0;
    for (std::size_t i = 0; i < index.parts.size(); ++i) {
      const delone::TileData part = delone::read_tile(folder, i);
      for (std::size_t cell = 0; cell < part.num_cells(); ++cell) volume += sixfold_volume(part, cell) / 6;
      num_cells += static_cast<std::int64_t>(part.num_cells());
    }
    std::cout << "the convex hull has the volume " << volume << '\n';
    if (num_cells != index.num_cells || num_points > 100000) return num_cells == index.num_cells ? 0 : 1;

    // So few points can be triangulated in memory, too: it is the same triangulation.
    std::vector<double> rows(static_cast<std::size_t>(3 * num_points));
    std::ifstream(input, std::ios::binary)
        .read(reinterpret_cast<char*>(rows.data()),
              static_cast<std::streamsize>(rows.size() * sizeof(double)));
    const delone::Delaunay<> whole(rows, 3);
    std::filesystem::remove_all(folder);
    std::filesystem::remove(input);
    return whole.hash() == index.hash ? 0 : 1;
  } catch (const delone::Error& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
