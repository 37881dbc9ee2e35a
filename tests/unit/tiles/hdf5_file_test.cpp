// SPDX-License-Identifier: BSD-3-Clause
// The HDF5 file of a folder of tiles, read back by the HDF5 library.
#include "tiles/hdf5_file.hpp"

#include "../io/io_support.hpp"
#include "file_size_limit.hpp"
#include "tiles_support.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#if DELONE_WITH_HDF5
#include <hdf5.h>
#endif

namespace {

using namespace delone;
using namespace delone_test;

class Hdf5Test : public TemporaryDirectory {
 protected:
  std::string folder() const { return path("out"); }
  void write(std::uint64_t memory = 4096) {
    tiles::write_hdf5(folder(), path(""), read_tiles_index(folder()), memory);
  }
};

#if !DELONE_WITH_HDF5

TEST_F(Hdf5Test, IsUnsupported) {
  expect_error(Errc::unsupported, {"tiles.h5", "no HDF5"}, [&] { tiles::require_hdf5(folder()); });
  write_folder(folder(), Delaunay<>(make_point_set("uniform", 2, 30), 2).to_data(), 2);
  expect_error(Errc::unsupported, {"tiles.h5", "no HDF5"}, [&] { write(); });
}

#else

/// A dataset, and its shape.
template <class T>
std::vector<T> items(const std::string& path, const char* name, std::vector<hsize_t> expected) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t data = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(data);
  std::vector<hsize_t> shape(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  EXPECT_EQ(shape, expected) << name;
  std::vector<T> result(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  const hid_t type = std::is_same_v<T, double> ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
  EXPECT_GE(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.data()), 0) << name;
  H5Sclose(space);
  H5Dclose(data);
  H5Fclose(file);
  return result;
}

TEST_F(Hdf5Test, HoldsTheWhole) {
  std::vector<double> weights = make_point_set("uniform", 1, 3000, 5);
  for (double& weight : weights) weight *= 0.01;
  std::vector<double> points = make_point_set("uniform", 2, 3000);
  for (std::size_t i = 0; i < 10; ++i) points[i] = points[i + 10], weights[i] = weights[i / 2 + 5];
  const ComplexData data = Regular<>(points, weights, 2).to_data();
  write_folder(folder(), data, 3);
  write();
  EXPECT_FALSE(std::filesystem::exists(path("out/.delone-partial-tiles.h5")));
  const ComplexData whole = glue(folder());
  const std::string file = path("out/tiles.h5");
  const hsize_t m = whole.num_cells(), v = static_cast<hsize_t>(read_tiles_index(folder()).num_vertices);
  const auto cells = items<std::int64_t>(file, "cells", {m, 3}),
             neighbors = items<std::int64_t>(file, "neighbors", {m, 3}),
             rows = items<std::int64_t>(file, "rows", {v}),
             vertex_of_row = items<std::int64_t>(file, "vertex_of_row", {3000});
  EXPECT_TRUE(std::equal(cells.begin(), cells.end(), whole.cells.begin(), whole.cells.end()));
  EXPECT_TRUE(std::equal(neighbors.begin(), neighbors.end(), whole.neighbors.begin(), whole.neighbors.end()));
  EXPECT_TRUE(std::equal(vertex_of_row.begin(), vertex_of_row.end(), whole.vertex_of_point.begin(),
                         whole.vertex_of_point.end()));
  const auto coordinates = items<double>(file, "points", {v, 2}),
             found_weights = items<double>(file, "weights", {v});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<std::size_t>(rows[i]);
    EXPECT_EQ(whole.vertex_of_point[row], static_cast<SignedIndex>(row));
    EXPECT_EQ(coordinates[2 * i], points[2 * row]);
    EXPECT_EQ(coordinates[2 * i + 1], points[2 * row + 1]);
    EXPECT_EQ(found_weights[i], weights[row]);
  }
}

TEST_F(Hdf5Test, TinySetsAreWritten) {
  for (const std::vector<double>& points :
       {std::vector<double>{}, std::vector<double>{1, 2}, std::vector<double>{1, 2, 3, 4}}) {
    write_folder(folder(), Delaunay<>(points, 2).to_data(), 2);
    write();
    EXPECT_GT(std::filesystem::file_size(path("out/tiles.h5")), 0u);
    std::filesystem::remove_all(folder());
  }
}

TEST_F(Hdf5Test, FullDiskIsAnError) {
  write_folder(folder(), Delaunay<>(make_point_set("uniform", 2, 3000), 2).to_data(), 2);
  if (!test::FileSizeLimit::exists) GTEST_SKIP();
  {
    const test::FileSizeLimit full(20000);
    expect_error(Errc::cannot_write, {"tiles.h5"}, [&] { write(std::uint64_t{1} << 24); });
  }
  EXPECT_FALSE(std::filesystem::exists(path("out/tiles.h5")));
  EXPECT_FALSE(std::filesystem::exists(path("out/.delone-partial-tiles.h5")));
}

#endif

}  // namespace
