// SPDX-License-Identifier: BSD-3-Clause
// Parts are read as they were written, and whatever else a file holds is refused with the name of the array.
#include "tiles/part_file.hpp"

#include "../io/io_support.hpp"
#include "io/atomic_file.hpp"
#include "io/zip.hpp"
#include "tiles_support.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <functional>

namespace {

using namespace delone;
using namespace delone_test;

class PartFile : public TemporaryDirectory {
 protected:
  PartFile() {
    const ComplexData data = Delaunay<>(make_point_set("uniform", 3, 60), 3).to_data();
    part_ = cut_into_tiles(data, scattered_tiles(data, 2), 2)[0].data;
  }
  void expect_refused(const std::vector<std::string>& parts, const std::function<void(TileData&)>& change) {
    TileData changed = part_;
    change(changed);
    tiles::write_part(path("."), 7, changed);
    expect_error(Errc::bad_format, parts, [&] { tiles::read_part(path("."), 7); });
  }
  TileData part_;
};

TEST_F(PartFile, IsReadAsWritten) {
  const io::FileContent written = tiles::write_part(path("."), 7, part_);
  io::FileContent found;
  found.add(content("part-0007.npz"));
  EXPECT_EQ(written, found);
  const TileData read = tiles::read_part(path("."), 7);
  EXPECT_EQ(read.rows, part_.rows);
  EXPECT_EQ(read.points, part_.points);
  EXPECT_EQ(read.cells, part_.cells);
  EXPECT_EQ(read.neighbors, part_.neighbors);
  EXPECT_EQ(read.own_rows, part_.own_rows);
  EXPECT_EQ(read.vertex_of_row, part_.vertex_of_row);
  EXPECT_TRUE(read.weights.empty());
}

TEST_F(PartFile, WithoutPointsIsAPart) {
  for (int k = -1; k <= 3; ++k) {
    TileData empty;
    empty.dimension = 3;
    empty.affine_dimension = k;
    tiles::write_part(path("."), 0, empty);
    EXPECT_EQ(tiles::read_part(path("."), 0).num_cells(), 0u);
  }
}

TEST_F(PartFile, TruncatedAnywhereIsRefused) {
  tiles::write_part(path("."), 7, part_);
  const std::string whole = content("part-0007.npz");
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    file("part-0007.npz", whole.substr(0, size));
    expect_error(Errc::bad_format, {"part-0007.npz"}, [&] { tiles::read_part(path("."), 7); });
  }
  std::filesystem::remove(path("part-0007.npz"));
  expect_error(Errc::cannot_open, {"part-0007.npz"}, [&] { tiles::read_part(path("."), 7); });
}

TEST_F(PartFile, ChangedBytesAreSeen) {
  tiles::write_part(path("."), 7, part_);
  std::string changed = content("part-0007.npz");
  changed[changed.size() / 2] ^= 1;
  file("part-0007.npz", changed);
  expect_error(Errc::bad_format, {"part-0007.npz"}, [&] { tiles::read_part(path("."), 7); });
}

TEST_F(PartFile, NumbersOutOfRangeAreRefused) {
  const auto v = static_cast<std::int32_t>(part_.rows.size());
  expect_refused({"cells", "row 0"}, [&](TileData& part) { part.cells[2] = v; });
  expect_refused({"cells"}, [](TileData& part) { part.cells[5] = -1; });
  expect_refused({"neighbors", "row 1"},
                 [](TileData& part) { part.neighbors[4] = static_cast<std::int32_t>(part.num_cells()); });
  expect_refused({"neighbors", "too large"}, [](TileData& part) {
    *std::find_if(part.neighbors.begin(), part.neighbors.end(), [](auto n) { return n < -1; }) = -1000000;
  });
  expect_refused({"neighbors"}, [](TileData& part) {
    for (auto& neighbor : part.neighbors)
      if (neighbor == -3) neighbor = -2;
  });
  expect_refused({"neighbors", "truncated"},
                 [](TileData& part) { part.neighbors.resize(part.neighbors.size() - 4); });
  expect_refused({"rows"}, [](TileData& part) { part.rows[3] = -1; });
  expect_refused({"points", "finite"},
                 [](TileData& part) { part.points[3] = std::numeric_limits<double>::infinity(); });
  expect_refused({"own_rows", "increase"},
                 [](TileData& part) { std::swap(part.own_rows[1], part.own_rows[2]); });
  expect_refused({"vertex_of_row"}, [](TileData& part) { part.vertex_of_row[1] = -2; });
}

TEST_F(PartFile, HasTheArraysOfAPart) {
  const auto npz = [&](const std::function<void(io::ZipWriter&)>& write) {
    io::AtomicFile output(path("part-0007.npz"));
    io::ZipWriter zip(output);
    write(zip);
    zip.finish();
    output.commit();
  };
  npz([](io::ZipWriter&) {});
  expect_error(Errc::bad_format, {"no member 'dimension'"}, [&] { tiles::read_part(path("."), 7); });
  npz([](io::ZipWriter& zip) { zip.add("dimension.npy", npy_of<std::int32_t>("<i4", "()", {3}), ""); });
  expect_error(Errc::bad_format, {"dimension", "<i8"}, [&] { tiles::read_part(path("."), 7); });
  npz([](io::ZipWriter& zip) { zip.add("dimension.npy", npy_of<std::int64_t>("<i8", "(1,)", {3}), ""); });
  expect_error(Errc::bad_format, {"dimension", "0-D"}, [&] { tiles::read_part(path("."), 7); });
  npz([](io::ZipWriter& zip) { zip.add("dimension.npy", npy_of<std::int64_t>("<i8", "()", {0}), ""); });
  expect_error(Errc::bad_format, {"dimension", "found 0"}, [&] { tiles::read_part(path("."), 7); });
}

TEST_F(PartFile, SeamsAreChecked) {
  const auto read = [&] {
    TileData part;
    part.affine_dimension = 0;
    part.cells.resize(5);
    part.neighbors = {-2, -3, -4, -1, -1};
    tiles::read_seams(path("."), 7, 10, 30, part);
    return part.seams;
  };
  tiles::write_seams(path("."), 7, std::vector<std::int64_t>{-1, 9, 29}, 0);
  EXPECT_EQ(read(), (std::vector<std::int64_t>{-1, 9, 29}));
  tiles::write_seams(path("."), 7, std::vector<std::int64_t>{-1, 9}, 0);
  expect_error(Errc::bad_format, {"part-0007.seams.npy", "expected 3"}, read);
  for (const std::int64_t wrong : {-2, 30, 12}) {
    tiles::write_seams(path("."), 7, std::vector<std::int64_t>{-1, 9, wrong}, 0);
    expect_error(Errc::bad_format, {"part-0007.seams.npy", "row 2"}, read);
  }
  std::filesystem::remove(path("part-0007.seams.npy"));
  expect_error(Errc::cannot_open, {"part-0007.seams.npy"}, read);
}

}  // namespace
