// SPDX-License-Identifier: BSD-3-Clause
// Parsing of Qhull's output names (separated by commas or blanks, order kept) and of lists of numbers.
#include "io/complexes/qhull_outputs.hpp"

#include "../io_support.hpp"

#include <filesystem>

namespace delone_test {
namespace {

using namespace delone;
using io::AtomicFile;

class QhullOutputs : public TemporaryDirectory {
 protected:
  std::string written(const std::string& wanted) const {
    io::write_qhull_outputs(path("a.txt"), wanted, "a test",
                            {{"F", [](AtomicFile& file) { file.write("[F]"); }},
                             {"FF", [](AtomicFile& file) { file.write("[FF]"); }},
                             {"o", [](AtomicFile& file) { file.write("[o]"); }}});
    return content("a.txt");
  }
};

TEST_F(QhullOutputs, AreWrittenInTheOrderOfTheirNames) {
  EXPECT_EQ(written("o"), "[o]");
  EXPECT_EQ(written("FF F,o"), "[FF][F][o]");
  EXPECT_EQ(written(" ,, o , F,"), "[o][F]");
  EXPECT_EQ(written("o o"), "[o][o]");
}

TEST_F(QhullOutputs, UnknownAndNoNamesWriteNothing) {
  expect_error(Errc::invalid_argument, {"'oF' is none of the outputs of a test in the form of Qhull: F FF o"},
               [&] { written("o,oF"); });
  for (const char* const none : {"", " ", ",,"})
    expect_error(Errc::invalid_argument,
                 {"no output in the form of Qhull is named; those of a test are F FF o"},
                 [&] { written(none); });
  EXPECT_FALSE(std::filesystem::exists(path("a.txt")));
}

TEST_F(QhullOutputs, NumbersAreInLines) {
  io::NumberLists lists;
  lists.add(std::vector<SignedIndex>{3, -1});
  lists.add({});
  lists.add(std::vector<SignedIndex>{7});
  EXPECT_EQ(lists.size(), 3u);
  EXPECT_EQ(lists.num_items(), 3u);
  EXPECT_EQ(lists[0][1], -1);
  EXPECT_TRUE(lists[1].empty());
  AtomicFile file(path("b.txt"));
  io::put_counted(file, lists);
  io::put_column(file, std::vector<SignedIndex>{4, 5});
  io::put_column(file, {});
  io::put_rows(file, std::vector<double>{1, 0.5, -2, 0.1}, 2);
  io::put_line(file, std::vector<double>{});
  file.commit();
  EXPECT_EQ(content("b.txt"), "2 3 -1\n0\n1 7\n2\n4\n5\n0\n1 0.5\n-2 0.1\n\n");
}

}  // namespace
}  // namespace delone_test
