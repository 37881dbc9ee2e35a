// SPDX-License-Identifier: BSD-3-Clause
// From a file of points to a file of cells, with every exact check in between.
//   example_read_check_write [POINTS [TRIANGULATION]]
#include <delone/delone.hpp>

#include <cstdlib>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
  const char* from_environment = std::getenv("DELONE_EXAMPLE_INPUT");
  const std::string input = argc > 1                      ? argv[1]
                            : from_environment != nullptr ? from_environment
                                                          : "data/protein.csv";
  const std::string output = argc > 2 ? argv[2] : "triangulation.npz";
  try {
    const delone::PointTable points = delone::read_points(input);
    const delone::Delaunay<> triangulation(points.coordinates, points.dimension);
    delone::write(output, triangulation.to_data());

    // The file holds all that `check` needs; it finds faults in the triangulations of other programs just as
    // well.
    const delone::ComplexData data = delone::read_as<delone::ComplexData>(output);
    const delone::CheckReport report = delone::check(data);
    std::cout << input << ": " << data.num_points() << " points, " << data.num_cells() << " cells\n";
    std::cout << output << ": " << (report.ok ? "is the Delaunay triangulation" : report.violation) << '\n';
    return report.ok && delone::canonical_hash(data) == triangulation.hash() ? 0 : 1;
  } catch (const delone::Error& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
