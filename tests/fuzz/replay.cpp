// SPDX-License-Identifier: BSD-3-Clause
// Stands in for libFuzzer in ordinary builds: feeds the target the files named on the command line, or with
// `--inputs N` that many pseudo-random inputs, scaled by DELONE_TEST_SCALE. The fuzz target ends the program
// when it finds a fault.
#include "scale.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() != 2 || arguments[0] != "--inputs") {
    for (const std::string& path : arguments) {
      std::ifstream file(path, std::ios::binary);
      const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    return 0;
  }

  const std::size_t inputs = delone::test::scaled_count(std::stoul(arguments[1]));
  std::mt19937_64 random(20080813);
  for (std::size_t i = 0; i < inputs; ++i) {
    std::vector<std::uint8_t> bytes(random() % 200);
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::uint8_t>(random()); });
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::printf("%zu inputs\n", inputs);
  return 0;
}
