// SPDX-License-Identifier: BSD-3-Clause
// Stands in for libFuzzer in ordinary builds: feeds the target files named on the command line, or else a fixed number of
// pseudo-random inputs. The fuzz target ends the program when it finds a fault.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    std::ifstream file(argv[i], std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  if (argc > 1) return 0;

  const char* scale = std::getenv("DELONE_TEST_SCALE");
  const std::string size = scale ? scale : "";
  const int rounds = size == "small" ? 500 : size == "large" ? 200000 : 5000;
  std::mt19937_64 random(20080813);
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::uint8_t> bytes(random() % 200);
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::uint8_t>(random()); });
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::printf("%d inputs\n", rounds);
  return 0;
}
