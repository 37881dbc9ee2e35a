// SPDX-License-Identifier: BSD-3-Clause
// Stands in for libFuzzer in ordinary builds: feeds the target the files that are named on the command line,
// those of folders included, and with `--inputs N` that many pseudo-random inputs, scaled by
// DELONE_TEST_SCALE: changed copies of these files, or random bytes if there are none. Other arguments that
// begin with -- are left to the target. The fuzz target ends the program when it finds a fault.
#include "scale.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" __attribute__((weak)) int LLVMFuzzerInitialize(int* argc, char*** argv);

namespace {

using Input = std::vector<std::uint8_t>;

void add_files(const std::filesystem::path& path, std::vector<Input>& inputs) {
  std::vector<std::filesystem::path> files{path};
  if (std::filesystem::is_directory(path)) {
    files.clear();
    for (const auto& entry : std::filesystem::directory_iterator(path)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
  }
  for (const auto& name : files) {
    std::ifstream file(name, std::ios::binary);
    if (!file) {
      std::fprintf(stderr, "cannot open %s\n", name.c_str());
      std::exit(1);
    }
    inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
}

/// Changes a few bytes: another value, a piece left out, doubled, or taken from another input.
void change(Input& input, const std::vector<Input>& others, std::mt19937_64& random) {
  for (std::uint64_t changes = 1 + random() % 4; changes > 0 && !input.empty(); --changes) {
    const auto at = static_cast<std::ptrdiff_t>(random() % input.size());
    const auto length = static_cast<std::ptrdiff_t>(
        std::min<std::uint64_t>(1 + random() % 16, input.size() - static_cast<std::uint64_t>(at)));
    const Input& other = others[random() % others.size()];
    switch (random() % 5) {
      case 0:
        input[static_cast<std::size_t>(at)] ^= static_cast<std::uint8_t>(1u << random() % 8);
        break;
      case 1:
        input[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(random());
        break;
      case 2:
        input.erase(input.begin() + at, input.begin() + at + length);
        break;
      case 3: {
        const Input piece(input.begin() + at, input.begin() + at + length);
        input.insert(input.begin() + at, piece.begin(), piece.end());
        break;
      }
      default:
        if (!other.empty()) input.resize(static_cast<std::size_t>(at));
        input.insert(input.end(), other.begin() + static_cast<std::ptrdiff_t>(random() % (other.size() + 1)),
                     other.end());
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t num_random = 0;
  std::vector<Input> inputs;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--inputs" && i + 1 < argc)
      num_random = delone::test::scaled_count(std::stoul(argv[++i]));
    else if (!argument.starts_with("--"))
      add_files(argument, inputs);
  }
  if (LLVMFuzzerInitialize != nullptr) LLVMFuzzerInitialize(&argc, &argv);
  for (const Input& input : inputs) LLVMFuzzerTestOneInput(input.data(), input.size());

  std::mt19937_64 random(20080813);
  for (std::size_t i = 0; i < num_random; ++i) {
    Input input;
    if (inputs.empty()) {
      input.resize(random() % 200);
      std::generate(input.begin(), input.end(), [&] { return static_cast<std::uint8_t>(random()); });
    } else {
      input = inputs[random() % inputs.size()];
      change(input, inputs, random);
    }
    LLVMFuzzerTestOneInput(input.data(), input.size());
  }
  std::printf("%zu inputs\n", inputs.size() + num_random);
  return 0;
}
