// SPDX-License-Identifier: BSD-3-Clause
// The HDF5 file of a folder of tiles, read back by the program h5dump where there is one.
#include "tiles/hdf5_file.hpp"

#include "../io/io_support.hpp"
#include "tiles_support.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <cstdlib>

namespace {

using namespace delone;
using namespace delone_test;

class Hdf5Test : public TemporaryDirectory {
 protected:
  Hdf5Test() {
    try {
      tiles::require_hdf5("");
      available_ = true;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Errc::unsupported);
    }
  }
  std::string folder() const { return path("out"); }
  void write(std::uint64_t memory = 4096) {
    tiles::write_hdf5(folder(), path(""), read_tiles_index(folder()), memory);
  }
  /// Items of a dataset; nothing where they cannot be read.
  template <class T>
  std::vector<T> items(const std::string& dataset) const {
    const std::string raw = path("raw");
    const std::string command = "h5dump -d /" + dataset + " -b NATIVE -o " + raw + " " +
                                path("out/tiles.h5") + " > " + path("log") + " 2>&1";
    if (std::system(command.c_str()) != 0) return {};
    const std::string bytes = content("raw");
    std::vector<T> result(bytes.size() / sizeof(T));
    if (!result.empty()) std::memcpy(result.data(), bytes.data(), bytes.size());
    return result;
  }
  bool available_ = false;
};

TEST_F(Hdf5Test, IsUnsupportedOrHoldsTheWhole) {
  std::vector<double> weights = make_point_set("uniform", 1, 3000, 5);
  for (double& weight : weights) weight *= 0.01;
  std::vector<double> points = make_point_set("uniform", 2, 3000);
  for (std::size_t i = 0; i < 10; ++i) points[i] = points[i + 10], weights[i] = weights[i / 2 + 5];
  const ComplexData data = Regular<>(points, weights, 2).to_data();
  write_folder(folder(), data, 3);
  if (!available_) {
    expect_error(Errc::unsupported, {"tiles.h5", "no HDF5"}, [&] { write(); });
    GTEST_SKIP() << "a build without HDF5";
  }
  write();
  EXPECT_FALSE(std::filesystem::exists(path("out/.delone-partial-tiles.h5")));
  if (std::system("h5dump --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no h5dump";
  const ComplexData whole = glue(folder());
  const auto cells = items<std::int64_t>("cells"), neighbors = items<std::int64_t>("neighbors"),
             rows = items<std::int64_t>("rows"), vertex_of_row = items<std::int64_t>("vertex_of_row");
  EXPECT_TRUE(std::equal(cells.begin(), cells.end(), whole.cells.begin(), whole.cells.end()));
  EXPECT_TRUE(std::equal(neighbors.begin(), neighbors.end(), whole.neighbors.begin(), whole.neighbors.end()));
  EXPECT_TRUE(std::equal(vertex_of_row.begin(), vertex_of_row.end(), whole.vertex_of_point.begin(),
                         whole.vertex_of_point.end()));
  const auto coordinates = items<double>("points"), found_weights = items<double>("weights");
  ASSERT_EQ(coordinates.size(), 2 * rows.size());
  ASSERT_EQ(found_weights.size(), rows.size());
  EXPECT_EQ(static_cast<std::int64_t>(rows.size()), read_tiles_index(folder()).num_vertices);
  for (std::size_t v = 0; v < rows.size(); ++v) {
    const auto row = static_cast<std::size_t>(rows[v]);
    EXPECT_EQ(whole.vertex_of_point[row], static_cast<SignedIndex>(row));
    EXPECT_EQ(coordinates[2 * v], points[2 * row]);
    EXPECT_EQ(coordinates[2 * v + 1], points[2 * row + 1]);
    EXPECT_EQ(found_weights[v], weights[row]);
  }
}

TEST_F(Hdf5Test, TinySetsAreWritten) {
  if (!available_) GTEST_SKIP() << "a build without HDF5";
  for (const std::vector<double>& points :
       {std::vector<double>{}, std::vector<double>{1, 2}, std::vector<double>{1, 2, 3, 4}}) {
    write_folder(folder(), Delaunay<>(points, 2).to_data(), 2);
    write();
    EXPECT_GT(std::filesystem::file_size(path("out/tiles.h5")), 0u);
    std::filesystem::remove_all(folder());
  }
}

TEST_F(Hdf5Test, FullDiskIsAnError) {
  if (!available_) GTEST_SKIP() << "a build without HDF5";
  write_folder(folder(), Delaunay<>(make_point_set("uniform", 2, 3000), 2).to_data(), 2);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{20000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  expect_error(Errc::cannot_write, {"tiles.h5"}, [&] { write(std::uint64_t{1} << 24); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_FALSE(std::filesystem::exists(path("out/tiles.h5")));
  EXPECT_FALSE(std::filesystem::exists(path("out/.delone-partial-tiles.h5")));
}

}  // namespace
