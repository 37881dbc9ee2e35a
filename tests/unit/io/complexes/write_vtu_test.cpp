// SPDX-License-Identifier: BSD-3-Clause
// The arrays of .vtu files.
#include "complex_support.hpp"

namespace {

using namespace delone;
using namespace delone_test;

using WriteVtu = ResultFiles;

/// The attribute `name` of the `which`-th array of a .vtu file.
std::string attribute(const std::string& text, const std::string& array, const std::string& name) {
  const std::size_t at = text.find("Name=\"" + array + "\"");
  const std::size_t start = text.rfind('<', at), stop = text.find('>', at);
  const std::string tag = text.substr(start, stop - start);
  const std::size_t value = tag.find(" " + name + "=\"") + name.size() + 3;
  return tag.substr(value, tag.find('"', value) - value);
}

template <class T>
std::vector<T> appended(const std::string& text, const std::string& array) {
  const std::size_t at =
      text.find("\n_") + 2 + static_cast<std::size_t>(std::stoull(attribute(text, array, "offset")));
  std::uint64_t size = 0;
  std::memcpy(&size, text.data() + at, sizeof(size));
  std::vector<T> out(size / sizeof(T));
  if (size > 0) std::memcpy(out.data(), text.data() + at + sizeof(size), size);
  return out;
}

TEST_F(WriteVtu, Vtu) {
  if (std::endian::native != std::endian::little) GTEST_SKIP() << "reads the arrays as native";
  write(path("a.vtu"), square());
  const std::string text = content("a.vtu");
  EXPECT_NE(text.find("header_type=\"UInt64\""), std::string::npos);
  EXPECT_NE(text.find("NumberOfPoints=\"5\" NumberOfCells=\"2\""), std::string::npos);
  EXPECT_EQ(attribute(text, "connectivity", "type"), sizeof(SignedIndex) == 4 ? "Int32" : "Int64");
  EXPECT_EQ(appended<double>(text, "Points"),
            (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1.5, 0, 0, 0, 0}));
  EXPECT_EQ(appended<SignedIndex>(text, "connectivity"), (Indices{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(appended<std::int64_t>(text, "offsets"), (std::vector<std::int64_t>{3, 6}));
  EXPECT_EQ(appended<std::uint8_t>(text, "types"), (std::vector<std::uint8_t>{5, 5}));
  const std::vector<int> types{1, 3, 5, 10};
  for (int k = -1; k <= 3; ++k) {
    write(path("b.vtu"), one_cell(k, 3));
    const std::string other = content("b.vtu");
    EXPECT_TRUE(other.ends_with("</AppendedData>\n</VTKFile>\n"));
    if (k >= 0) {
      EXPECT_EQ(appended<std::uint8_t>(other, "types").at(0), types[static_cast<std::size_t>(k)]);
      EXPECT_EQ(appended<std::int64_t>(other, "offsets").at(0), k + 1);
    }
  }
  expect_error(Errc::unsupported, {"c.vtu", "at most 3"}, [&] { write(path("c.vtu"), one_cell(2, 4)); });
  EXPECT_FALSE(std::filesystem::exists(path("c.vtu")));
}

}  // namespace
