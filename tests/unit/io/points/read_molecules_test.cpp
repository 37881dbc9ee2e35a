// SPDX-License-Identifier: BSD-3-Clause
// Molecules: the chemists' xyz, and pdb.
#include "../io_support.hpp"

#include <string>
#include <vector>

namespace {

using namespace delone;
using namespace delone_test;
using Doubles = std::vector<double>;
using ReadXyz = TemporaryDirectory;
using ReadPdb = TemporaryDirectory;

TEST_F(ReadXyz, AtomsWithElements) {
  const Doubles water{0, 0, 0.5, 0.25, -1e-3, 7};
  for (const char* text :
       {"2\nwater\nO 0 0 0.5\nH 0.25 -1e-3 7\n", "2\n\nO 0 0 0.5\nH 0.25 -1e-3 7",
        "  2  \r\n# a comment\r\n O\t0  0 0.5 -0.8 \r\n H\t0.25 -1e-3 7 0.4 x\r\n\r\n",
        "2\n1 2 3\nC1 0 0 0.5\n2 0.25 -1e-3 7\n", "2\nby number\n8 0 0 0.5\n1 0.25 -1e-3 7\n",
        "\xef\xbb\xbf"
        "2\nProperties=species:S:1:pos:R:3\nO* 0 0 0.5\nH# 0.25 -1e-3 7\n"}) {
    const PointTable table = read("a.xyz", text);
    EXPECT_EQ(table.dimension, 3) << text;
    EXPECT_EQ(table.coordinates, water) << text;
  }
  EXPECT_EQ(read("a.xyz", "1\n\nO 1 2 3\n", {"2", "0"}).coordinates, (Doubles{3, 1}));
}

TEST_F(ReadXyz, PlainRowsAndQhullsFormAreReadAsBefore) {
  EXPECT_EQ(read("a.xyz", "1 2 3\n4 5 6\n").coordinates, (Doubles{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(read("a.xyz", "1\n2\n3\n").dimension, 1);
  EXPECT_EQ(read("a.xyz", "4\n1\n1 2 3 4\n").dimension, 4);
  expect_error(Errc::bad_format, {"format = \"xyz\""}, [&] { read("a.txt", "1\nwater\nO 0 0 0\n"); });
}

TEST_F(ReadXyz, FaultsNameTheLine) {
  expect_error(Errc::bad_format, {"a.xyz:4: a second frame begins; keep one, the first ends in line 3"},
               [&] { read("a.xyz", "1\nwater\nO 0 0 0\n1\nwater\nO 0 0 1\n"); });
  expect_error(Errc::bad_format, {"a.xyz:4: more than the 1 atoms of the first line: 'H 0 0 1'"},
               [&] { read("a.xyz", "1\nwater\nO 0 0 0\nH 0 0 1\n"); });
  expect_error(Errc::bad_format, {"expected 3 atoms, the file ends after 1"},
               [&] { read("a.xyz", "3\nwater\nO 0 0 0\n"); });
  expect_error(Errc::bad_format, {"a.xyz:4: expected an element and 3 coordinates, found 3 fields"},
               [&] { read("a.xyz", "2\nwater\nO 0 0 0\nH 1 2\n"); });
  expect_error(Errc::bad_format, {"a.xyz:4: expected an element", "found 0 fields"},
               [&] { read("a.xyz", "2\nwater\nO 0 0 0\n\nH 1 2 3\n"); });
  expect_error(Errc::bad_format, {"a.xyz:4: a coordinate: 'x' is not a number"},
               [&] { read("a.xyz", "2\nwater\nO 0 0 0\nH 1 x 2\n"); });
  EXPECT_EQ(expect_error(Errc::not_finite, {"a.xyz:4: column 2: 'inf' is not finite"},
                         [&] { read("a.xyz", "2\nwater\nO 0 0 0\nH 1 inf 2\n"); }),
            std::vector<std::size_t>{1});
}

// Columns: 31 to 38, 39 to 46 and 47 to 54 are the coordinates, also where no blank is between them.
constexpr const char* atoms =
    "HEADER    TEST\n"
    "MODEL        1\n"
    "ATOM      1  N   MET A   1      27.340  24.430   2.614  1.00  9.67           N\n"
    "ATOM      2  CA BMET A   1    -100.123-200.456-300.789\r\n"
    "ANISOU    2  CA BMET A   1     2406   1892   1614    198    519   -328       C\n"
    "TER       3      MET A   1\n"
    "HETATM99999 ZN    ZN A 201       0.000   1.      -0.500  1.00  0.00          ZN\n"
    "ENDMDL\n";

TEST_F(ReadPdb, AtomsOfAllChains) {
  const PointTable table = read("a.pdb", std::string(atoms) + "END\n");
  EXPECT_EQ(table.dimension, 3);
  EXPECT_EQ(table.coordinates, (Doubles{27.34, 24.43, 2.614, -100.123, -200.456, -300.789, 0, 1, -0.5}));
  EXPECT_EQ(read("a.pdb", atoms, {"2"}).coordinates, (Doubles{2.614, -300.789, -0.5}));
}

TEST_F(ReadPdb, FaultsNameTheLine) {
  expect_error(Errc::bad_format, {"a.pdb:9: a second model begins", "awk '/^ENDMDL/ {exit} 1'"},
               [&] { read("a.pdb", std::string(atoms) + "MODEL        2\n"); });
  expect_error(Errc::bad_format, {"a.pdb:1: an atom's line ends in column 50", "columns 31 to 54"},
               [&] { read("a.pdb", "ATOM      1  N   MET A   1      27.340  24.430   2\n"); });
  expect_error(Errc::bad_format, {"a.pdb:1: columns 39 to 46: '24.x' is not a number"},
               [&] { read("a.pdb", "ATOM      1  N   MET A   1      27.340  24.x     2.614\n"); });
  expect_error(Errc::bad_format, {"a.pdb:1: columns 39 to 46: '' is not a number; skip_missing leaves"},
               [&] { read("a.pdb", "ATOM      1  N   MET A   1      27.340           2.614\n"); });
  expect_error(Errc::bad_format, {"no line of an atom"}, [&] { read("a.pdb", "HEADER    TEST\nEND\n"); });
  expect_error(Errc::bad_format, {"format = \"pdb\""}, [&] { read("a.txt", std::string(atoms).substr(30)); });
}

}  // namespace
