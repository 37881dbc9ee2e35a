// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/point_stream.hpp"

#include "../io/io_support.hpp"
#include "base/random.hpp"

#include <gtest/gtest.h>

#ifndef _WIN32
#include <sys/stat.h>
#endif

#include <cstring>
#include <thread>

namespace delone::tiles {
namespace {

class PointStreams : public delone_test::TemporaryDirectory {
 protected:
  /// All rows, read twice.
  std::vector<double> all(PointStream& stream, std::size_t* num_chunks = nullptr) {
    std::vector<double> rows, chunk, again;
    std::size_t count = 0;
    while (stream.next(chunk)) {
      EXPECT_FALSE(chunk.empty());
      EXPECT_LE(chunk.size(), std::size_t{1} << 19);
      rows.insert(rows.end(), chunk.begin(), chunk.end());
      ++count;
    }
    EXPECT_FALSE(stream.next(chunk));
    stream.rewind();
    while (stream.next(chunk)) again.insert(again.end(), chunk.begin(), chunk.end());
    stream.rewind();
    EXPECT_EQ(rows, again);
    if (num_chunks != nullptr) *num_chunks = count;
    return rows;
  }
  /// The stream of a file has what read_points() reads.
  void expect_as_read(const std::string& path, bool in_chunks) {
    SCOPED_TRACE(path);
    const PointTable table = read_points(path);
    const auto stream = open_point_stream(path);
    EXPECT_EQ(stream->dimension(), table.dimension);
    std::size_t num_chunks = 0;
    EXPECT_EQ(all(*stream, &num_chunks), table.coordinates);
    EXPECT_EQ(num_chunks > 1, in_chunks);
    if (const auto hint = stream->size_hint()) {
      EXPECT_EQ(*hint, table.num_points());
    }
  }
  /// The same error, which is found when the file is opened or read. Only read_points() leaves out rows, and
  /// says so.
  void expect_as_refused(const std::string& path) {
    SCOPED_TRACE(path);
    std::string expected, found;
    Errc expected_code{}, code{};
    std::vector<std::size_t> expected_rows, rows;
    try {
      read_points(path);
    } catch (const Error& error) {
      expected = error.what();
      expected = expected.substr(0, expected.find("; skip_missing"));
      expected_code = error.code();
      expected_rows = error.rows();
    }
    try {
      const auto stream = open_point_stream(path);
      all(*stream);
    } catch (const Error& error) {
      found = error.what();
      code = error.code();
      rows = error.rows();
    }
    EXPECT_NE(expected, "");
    EXPECT_EQ(found, expected);
    EXPECT_EQ(code, expected_code);
    EXPECT_EQ(rows, expected_rows);
  }

  PointTable random_table(std::size_t rows, int dimension) {
    random::Generator random(5);
    PointTable table;
    table.dimension = dimension;
    for (std::size_t i = 0; i < rows * static_cast<std::size_t>(dimension); ++i)
      table.coordinates.push_back(random.uniform() - 0.5);
    return table;
  }
};

TEST_F(PointStreams, ReadWhatReadPointsReads) {
  const PointTable table = random_table(60000, 3);
  for (const std::string extension : {"npy", "csv", "tsv", "txt", "xyz", "pts", "qhull"}) {
    write_points(path("many." + extension), table);
    expect_as_read(path("many." + extension), true);
  }
  std::string molecule = "40000\n# a comment\n";
  for (int i = 0; i < 40'000; ++i) molecule += "C " + std::to_string(i) + " 0.25 -1 0.5\n";
  expect_as_read(file("molecule.xyz", molecule), true);
  expect_as_refused(file("atoms.xyz", "3\n\nC 1 2 3\nC 1 2 3\n"));
  expect_as_refused(file("frames.xyz", "1\n\nC 1 2 3\n1\n\nC 1 2 3\n"));
  const PointTable few = random_table(7, 2);
  for (const std::string extension : {"npy", "csv", "txt", "off", "qhull"}) {
    write_points(path("few." + extension), few);
    expect_as_read(path("few." + extension), false);
  }
}

template <class T>
std::string npy(const std::string& type, bool fortran, std::size_t rows, std::size_t columns,
                const std::vector<T>& items) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") +
                       ", 'shape': (" + std::to_string(rows) + ", " + std::to_string(columns) + "), }\n";
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>(header.size() & 0xff);
  out += static_cast<char>(header.size() >> 8);
  out += header;
  return out.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
}

TEST_F(PointStreams, ReadNpyOfAnyType) {
  std::vector<float> floats;
  std::vector<double> doubles;
  std::vector<std::int64_t> integers;
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 180000; ++i) {
    floats.push_back(static_cast<float>(i) / 3);
    doubles.push_back(i / 7.0);
    integers.push_back(std::int64_t{1} << (i % 60));
    bytes.push_back(static_cast<std::uint8_t>(i));
  }
  for (const bool fortran : {false, true}) {
    expect_as_read(file("f4.npy", npy("<f4", fortran, 60000, 3, floats)), true);
    expect_as_read(file("f8.npy", npy("<f8", fortran, 90000, 2, doubles)), true);
    expect_as_read(file("i8.npy", npy(">i8", fortran, 180000, 1, integers)), true);
    expect_as_read(file("u1.npy", npy("|u1", fortran, 45000, 4, bytes)), true);
  }
  integers[170000] = (std::int64_t{1} << 60) + 1;
  expect_as_refused(file("bad.npy", npy("<i8", false, 60000, 3, integers)));
  doubles[170001] = std::numeric_limits<double>::infinity();
  expect_as_refused(file("bad.npy", npy("<f8", false, 60000, 3, doubles)));
  expect_as_refused(file("bad.npy", npy("<f8", false, 60001, 3, doubles)));
  expect_as_refused(file("bad.npy", npy("<f8", false, 0, 0, std::vector<double>())));
  expect_as_refused(file("bad.npy", "text"));
  expect_as_refused(file("bad.npy", ""));
  expect_as_read(file("none.npy", npy("<f8", false, 0, 3, std::vector<double>())), false);
}

TEST_F(PointStreams, ReadRaw) {
  const PointTable table = random_table(70000, 3);
  std::string bytes(table.coordinates.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), table.coordinates.data(), bytes.size());
  StreamOptions options;
  EXPECT_THROW(open_point_stream(file("a.raw", bytes)), Error);
  options.dimension = 3;
  const auto stream = open_point_stream(file("a.bin", bytes), options);
  EXPECT_EQ(all(*stream), table.coordinates);
  EXPECT_EQ(stream->size_hint(), 70000u);
  EXPECT_THROW(open_point_stream(file("b.raw", bytes + "1234"), options), Error);
  // Any bytes may be the first, those of gzip, too.
  bytes.replace(0, 3, "\x1f\x8b\x08");
  options.scratch_folder = path("");
  const std::vector<double> rows = all(*open_point_stream(file("a.bin", bytes), options));
  ASSERT_EQ(rows.size(), table.coordinates.size());
  EXPECT_EQ(std::memcmp(rows.data(), bytes.data(), bytes.size()), 0);
  EXPECT_THROW(open_point_stream(file("a.raw.gz", bytes), options), Error);  // it is not compressed
  write_points(path("flat.npy"), random_table(3, 2));
  EXPECT_THROW(open_point_stream(path("flat.npy"), options), Error);
}

TEST_F(PointStreams, SelectColumns) {
  const PointTable table = random_table(30000, 3);
  write_points(path("t.npy"), table);
  file("t.csv", "a,b,w,name\n1,2,3,x\n4,5,6,\"y,\nz\"\n7,8,9,nan\n");
  file("t.ply",
       "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
       "property float w\nend_header\n1 2 3 4\n5 6 7 8\n");
  const auto read = [&](const std::string& name, std::vector<std::string> columns, std::string last = {}) {
    StreamOptions options;
    options.columns = std::move(columns);
    options.last_column = std::move(last);
    const auto stream = open_point_stream(path(name), options);
    const std::vector<double> values = all(*stream);
    stream->rewind();
    EXPECT_EQ(all(*stream), values);
    EXPECT_EQ(values.size() % static_cast<std::size_t>(stream->dimension()), 0u);
    return values;
  };
  EXPECT_EQ(read("t.csv", {"b", "0"}), (std::vector<double>{2, 1, 5, 4, 8, 7}));
  EXPECT_EQ(read("t.csv", {"b"}, "a"), (std::vector<double>{2, 1, 5, 4, 8, 7}));
  EXPECT_EQ(read("t.csv", {"w", "a"}, "a"), (std::vector<double>{3, 1, 1, 6, 4, 4, 9, 7, 7}));
  EXPECT_THROW(read("t.csv", {}, "w"), Error);  // the other columns are not all numbers
  EXPECT_EQ(read("t.ply", {"x", "z"}, "w"), (std::vector<double>{1, 3, 4, 5, 7, 8}));
  EXPECT_EQ(read("t.ply", {}, "1"), (std::vector<double>{1, 3, 2, 5, 7, 6}));
  const std::vector<double> some = read("t.npy", {"2", "0"}), moved = read("t.npy", {}, "0");
  ASSERT_EQ(some.size(), 60000u);
  ASSERT_EQ(moved.size(), 90000u);
  for (std::size_t row = 0; row < 30000; ++row) {
    const double* const expected = table.coordinates.data() + 3 * row;
    EXPECT_TRUE(some[2 * row] == expected[2] && some[2 * row + 1] == expected[0]);
    EXPECT_TRUE(moved[3 * row] == expected[1] && moved[3 * row + 2] == expected[0]);
  }
  StreamOptions options;
  options.columns = {"2"};
  const auto stream = open_point_stream(path("t.npy"), options);
  ASSERT_TRUE(stream->restrict_to(10, 12));
  EXPECT_EQ(all(*stream), (std::vector<double>{table.coordinates[32], table.coordinates[35]}));
  for (const std::string wrong : {"3", "x", "-1", ""}) EXPECT_THROW(read("t.npy", {wrong}), Error);
  EXPECT_THROW(read("t.npy", {}, "3"), Error);
  EXPECT_THROW(read("t.csv", {"c"}), Error);
}

/// Headers, quotes around line ends and comments, where pieces end within them.
TEST_F(PointStreams, ReadTablesInPieces) {
  random::Generator random(1);
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string csv = "\xef\xbb\xbf\"the" + end + "first\",y" + end, text = "# points" + end;
    for (int i = 0; i < 40000; ++i) {
      const std::string x = std::to_string(random.uniform()), y = std::to_string(random.uniform());
      csv += random.below(3) == 0 ? "\"" + x + end + "\"," + y : x + "," + y;
      text += " " + x + "\t" + y;
      if (random.below(9) == 0) text += " # a comment";
      if (random.below(9) == 0) csv += end + "# \"a comment";
      if (random.below(9) == 0) text += end, csv += end;
      text += end;
      csv += end;
    }
    expect_as_read(file("many.csv", csv), true);
    expect_as_read(file("many.txt", text), true);
    expect_as_read(file("many.csv", csv + "1,2"), true);
    expect_as_refused(file("many.csv", csv + "1,2,3" + end));
    expect_as_refused(file("many.csv", csv + "1,\"2" + end + "3" + end));
    expect_as_refused(file("many.csv", csv + "1,1e999" + end));
    expect_as_refused(file("many.txt", text + "1 nan"));
    expect_as_refused(file("many.txt", text + "1 2 3"));
    expect_as_refused(file("many.txt", text + "1 word" + end));
  }
}

/// Rows of Qhull's form may be spread over lines, and end in another piece.
TEST_F(PointStreams, ReadQhullInPieces) {
  random::Generator random(2);
  for (const std::string end : {"\n", "\r"}) {
    const int n = 60000;
    std::string text = "# set" + end + "3 three dimensions" + end + std::to_string(n) + " ";
    for (int i = 0; i < 3 * n; ++i) {
      text += std::to_string(random.uniform()) + (random.below(3) == 0 ? end : " ");
      if (i == 150000) text += end + "# a comment" + end;
    }
    expect_as_read(file("a.qhull", text), true);
    expect_as_refused(file("a.qhull", text + " 7"));
    expect_as_refused(file("a.qhull", text.substr(0, text.size() - 20)));
    std::string changed = text;
    changed.replace(text.size() - 900, 8, " -1e999 ");
    expect_as_refused(file("a.qhull", changed.substr(0, text.size())));
  }
  for (const std::string bytes : {"", "3", "3\n", "0\n2\n", "2\n1\n1", "x", "2\nx", "2 c\n1\n1 nan"})
    expect_as_refused(file("a.qhull", bytes));
  expect_as_read(file("a.qhull", "2\n0\n"), false);
}

/// A field that is longer than a piece.
TEST_F(PointStreams, ReadLongFields) {
  const std::string field = "\"1" + std::string(900000, '\n') + "\"";
  expect_as_read(file("a.csv", "2,3\n4," + field + "\n5,6\n"), true);
  expect_as_refused(file("a.csv", "2,3\n4," + field + "\n5\n"));
}

TEST_F(PointStreams, RefuseWhatIsNoTable) {
  for (const std::string bytes : {"", "\n", "# nothing\n", "1 2\n3\n", "1 nan\n", "x 1\n", "\xff\xfe 1"})
    expect_as_refused(file("a.txt", bytes));
  for (const std::string bytes :
       {"", "\n", "# nothing\n", "1,2\n3\n", "1,2\n3,nan\n", "x\n\"a", "\xff\xfe 1"})
    expect_as_refused(file("a.csv", bytes));
  const std::string zero("1 2\n\0", 5);
  EXPECT_THROW(open_point_stream(file("zero.txt", zero)), Error);
  EXPECT_THROW(open_point_stream(path("nothing.npy")), Error);
  EXPECT_THROW(open_point_stream(path("nothing.txt")), Error);
  EXPECT_THROW(open_point_stream(path("nothing.what")), Error);
  expect_as_read(file("header.csv", "x,y\n"), false);
}

#ifndef _WIN32  // whose pipes are no files
TEST_F(PointStreams, CopyPipes) {
  const std::string pipe = path("pipe.txt");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(open_point_stream(pipe), Error);
  std::thread writer([&] { std::ofstream(pipe) << "1 2\n3 4\n"; });
  StreamOptions options;
  options.scratch_folder = path("");
  {
    const auto stream = open_point_stream(pipe, options);
    writer.join();
    EXPECT_EQ(all(*stream), (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(num_files(), 2u);
  }
  EXPECT_EQ(num_files(), 1u);
}
#endif

TEST_F(PointStreams, ReadMemory) {
  PointTable table = random_table(100000, 2);
  const auto stream = stream_of(PointsView(table.coordinates, 2));
  std::size_t num_chunks = 0;
  EXPECT_EQ(all(*stream, &num_chunks), table.coordinates);
  EXPECT_GT(num_chunks, 1u);
  table.coordinates[150001] = -std::numeric_limits<double>::infinity();
  try {
    all(*stream);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::not_finite);
    EXPECT_EQ(error.rows(), std::vector<std::size_t>{75000});
  }
}

}  // namespace
}  // namespace delone::tiles
