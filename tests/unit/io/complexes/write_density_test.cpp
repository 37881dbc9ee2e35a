// SPDX-License-Identifier: BSD-3-Clause
// Values on a grid, as a table and as arrays.
#include "../io_support.hpp"
#include "io/npy.hpp"
#include "io/zip.hpp"

#include <delone/density.hpp>

#include <string>
#include <vector>

namespace {

using namespace delone;
using delone_test::expect_error;
using Doubles = std::vector<double>;

class WriteDensity : public delone_test::TemporaryDirectory {
 protected:
  /// Two by three parts of a parallelogram, along (4, 1) and (0, 6) from (1, 10).
  const DensityGrid grid_{.origin = {1, 10}, .sides = {4, 1, 0, 6}, .shape = {2, 3}};
  const Doubles values_{0.5, 1, 2, 3, 4, 1e-300};
};

TEST_F(WriteDensity, TablesHaveTheCentersOfParts) {
  write(path("a.csv"), grid_, values_);
  const PointTable table = read_points(path("a.csv"));
  EXPECT_EQ(table.column_names, (std::vector<std::string>{"x0", "x1", "density"}));
  // The last axis first: along (0, 2), and then along (2, 1/2).
  EXPECT_EQ(table.coordinates, (Doubles{2, 11.25, 0.5, 2, 13.25, 1, 2, 15.25, 2,  //
                                        4, 11.75, 3, 4, 13.75, 4, 4, 15.75, 1e-300}));
}

TEST_F(WriteDensity, ArraysHaveTheShapeOfTheGrid) {
  write(path("a.npy"), grid_, values_);
  const std::string bytes = content("a.npy");
  const io::NpyArray array = io::parse_npy(bytes, "a.npy");
  EXPECT_EQ(array.shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(io::to_doubles(array, "a.npy"), values_);
  write(path("a.npz"), grid_, values_);
  const std::string archive = content("a.npz");
  const io::ZipReader zip(archive, "a.npz");
  const auto member = [&](const char* name) {
    return io::to_doubles(io::parse_npy(zip.find(name).value(), name), name);
  };
  EXPECT_EQ(member("density.npy"), values_);
  EXPECT_EQ(member("origin.npy"), grid_.origin);
  EXPECT_EQ(member("sides.npy"), grid_.sides);
  EXPECT_EQ(io::parse_npy(zip.find("sides.npy").value(), "sides").shape, (std::vector<std::size_t>{2, 2}));
}

TEST_F(WriteDensity, Faults) {
  expect_error(Errc::bad_dimension, {"a grid of 6 parts, and 5 values"},
               [&] { write(path("a.csv"), grid_, std::span(values_).first(5)); });
  DensityGrid other = grid_;
  other.sides.pop_back();
  expect_error(Errc::bad_dimension, {"a grid of 6 parts"}, [&] { write(path("a.csv"), other, values_); });
  expect_error(Errc::unsupported, {"'npy' is binary"}, [&] { write("-", grid_, values_, "npy"); });
  expect_error(Errc::unsupported, {"vtu"}, [&] { write(path("a.vtu"), grid_, values_); });
  EXPECT_EQ(num_files(), 0u);
}

}  // namespace
