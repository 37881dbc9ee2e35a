// SPDX-License-Identifier: BSD-3-Clause
// From a file of points to a file of cells, with every exact check in between.
//   example_read_check_write [POINTS [TRIANGULATION]]
#include <delone/delone.hpp>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  const char* from_environment = std::getenv("DELONE_EXAMPLE_INPUT");
  const char* input = argc > 1 ? argv[1] : from_environment ? from_environment : "data/bunny.csv";
  const char* output = argc > 2 ? argv[2] : "triangulation.npz";
  try {
    const delone::PointTable points = delone::read_points(input);
    const delone::Triangulation triangulation(points.coordinates, points.dimension);
    delone::write_complex(output, triangulation.to_data());

    // The file holds all that `check` needs; it would find a fault in a triangulation made by any other program as well.
    const delone::ComplexData data = delone::read_complex(output);
    const delone::CheckReport report = delone::check(data);
    std::printf("%s: %zu points, %zu cells\n", input, data.num_points(), data.num_cells());
    std::printf("%s: %s\n", output, report.ok ? "is the Delaunay triangulation" : report.violation.c_str());
    return report.ok && delone::canonical_hash(data) == triangulation.hash() ? 0 : 1;
  } catch (const delone::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
