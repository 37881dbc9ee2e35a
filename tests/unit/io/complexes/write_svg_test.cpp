// SPDX-License-Identifier: BSD-3-Clause
// Pictures.
#include "complex_support.hpp"

#include <cmath>

namespace {

using namespace delone;
using namespace delone_test;

using WriteSvg = ResultFiles;

TEST_F(WriteSvg, Svg) {
  write(path("a.svg"), square());
  const std::string text = content("a.svg");
  // 1 × 1.5 → 666.67 × 1000 and the margin; the origin is at the lower left
  EXPECT_NE(text.find("viewBox=\"0 0 706.67 1040.00\""), std::string::npos) << text;
  EXPECT_NE(text.find("M20.00,1020.00L686.67,1020.00L20.00,353.33Z"), std::string::npos) << text;
  EXPECT_NE(text.find("<circle cx=\"686.67\" cy=\"20.00\""), std::string::npos) << text;
  for (int k = -1; k <= 2; ++k) {
    write(path("b.svg"), one_cell(k, 2));
    const std::string other = content("b.svg");
    EXPECT_EQ(other.find("nan"), std::string::npos);
    EXPECT_EQ(other.find("inf"), std::string::npos);
    EXPECT_EQ(other.find("<path") != std::string::npos, k >= 1);
    EXPECT_EQ(other.find("<circle") != std::string::npos, k >= 0);
    EXPECT_TRUE(other.ends_with("</svg>\n"));
  }
  ComplexData huge = square();
  for (double& x : huge.points) x = x > 0 ? 1.7e308 : -1.7e308;
  write(path("c.svg"), huge);
  EXPECT_NE(content("c.svg").find("M20.00,1020.00L1020.00,1020.00L20.00,20.00Z"), std::string::npos)
      << content("c.svg");
  expect_error(Errc::unsupported, {"d.svg", "dimension 3"}, [&] { write(path("d.svg"), one_cell(2, 3)); });
}

}  // namespace
