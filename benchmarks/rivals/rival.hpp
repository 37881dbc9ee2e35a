// SPDX-License-Identifier: BSD-3-Clause
// The one interface of all programs that are measured against each other:
//   PROGRAM points.npy [--repeat K] [--cells out.npy] [--NAME VALUE ...]
// Only the construction is timed, not reading, conversion to the peer's types, or counting. Writes one line
// of JSON to standard output: program, version, flags, points, dimension, seconds [K], cpu_seconds [K] (user
// and system time of all threads), cells, peak_bytes, input_bytes (the peak before the first construction),
// and the adapter's own members. Exit status 2 and one line on standard error if the input is refused or the
// peer gives up.
#pragma once

#include <delone/complex.hpp>
#include <delone/error.hpp>
#include <delone/io.hpp>

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <chrono>
#include <concepts>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rival {

/// The command line.
struct Arguments {
  std::string points;
  int repeat = 1;
  std::string cells;                        ///< where to write the cells; empty: nowhere
  std::map<std::string, std::string> more;  ///< options of this adapter, by name

  /// The value of an adapter's option.
  std::string option(const std::string& name, const std::string& if_absent) const {
    const auto found = more.find(name);
    return found == more.end() ? if_absent : found->second;
  }
};

/// The cells of a result: `size` rows of points each, in a flat array.
struct Cells {
  int size = 0;
  std::vector<std::int64_t> rows;
};

/// The program that is measured.
struct Program {
  std::string name, version, flags;
};

/// An adapter is made from the points, which it may take over, and brings them to the peer's form.
/// construct() is what is timed; reset() forgets its result and is not timed.
template <class A>
concept Adapter = std::constructible_from<A, const Arguments&, delone::PointTable&&> &&
    requires(A a, const A c) {
  { c.program() } -> std::convertible_to<Program>;
  a.construct();
  a.reset();
  { c.num_cells() } -> std::convertible_to<std::size_t>;
  { c.cells() } -> std::convertible_to<Cells>;
  { c.details() } -> std::convertible_to<nlohmann::json>;  // an object, merged into the output; may be empty
};

/// User and system time of this process, all threads, in seconds.
inline double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// How long something took: by the clock, and as processor time of all threads.
struct Seconds {
  double clock = 0, cpu = 0;
};

template <std::invocable Action>
Seconds time(Action&& action) {
  const double cpu = cpu_seconds();
  const auto start = std::chrono::steady_clock::now();
  action();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return {elapsed.count(), cpu_seconds() - cpu};
}

/// The largest resident size of this process so far. Linux hands ru_maxrss of the parent down through exec,
/// so that a small program started by a large one would report the size of its parent; VmHWM starts afresh.
inline std::size_t peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (std::size_t kilobytes = 0; word == "VmHWM:" && status >> kilobytes) return kilobytes * 1024;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

inline Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.rfind("--", 0) != 0) {
      if (!arguments.points.empty())
        throw std::invalid_argument("one file of points, please, not also " + word);
      arguments.points = word;
      continue;
    }
    if (i + 1 == argc) throw std::invalid_argument(word + " needs a value");
    const std::string value = argv[++i];
    if (word == "--repeat")
      arguments.repeat = std::stoi(value);
    else if (word == "--cells")
      arguments.cells = value;
    else
      arguments.more[word.substr(2)] = value;
  }
  if (arguments.points.empty() || arguments.repeat < 1)
    throw std::invalid_argument(
        "usage: PROGRAM points.npy [--repeat K] [--cells out.npy] [--NAME VALUE ...]");
  return arguments;
}

/// Writes an (m, size) array of int64.
inline void write_cells(const std::string& path, const Cells& cells) {
  const std::size_t count = cells.size == 0 ? 0 : cells.rows.size() / static_cast<std::size_t>(cells.size);
  std::string header = "{'descr': '<i8', 'fortran_order': False, 'shape': (" + std::to_string(count) + ", " +
                       std::to_string(cells.size) + "), }";
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  const char start[] = {'\x93',
                        'N',
                        'U',
                        'M',
                        'P',
                        'Y',
                        1,
                        0,
                        static_cast<char>(header.size() & 255U),
                        static_cast<char>(header.size() >> 8U)};
  std::ofstream out(path, std::ios::binary);
  out.write(start, sizeof start).write(header.data(), static_cast<std::streamsize>(header.size()));
  out.write(reinterpret_cast<const char*>(cells.rows.data()),
            static_cast<std::streamsize>(8 * cells.rows.size()));
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

/// What a report says of the program before the first construction.
inline void add_program(nlohmann::json& report, const Program& program) {
  report.update({{"program", program.name}, {"version", program.version}, {"flags", program.flags}});
  report["input_bytes"] = peak_bytes();
}

/// What all main functions do: reads the points, has `measure` add to the report, writes it.
template <std::invocable<const Arguments&, delone::PointTable&&, nlohmann::json&> Measure>
int run_main(int argc, char** argv, Measure&& measure) {
  try {
    const Arguments arguments = parse(argc, argv);
    delone::PointTable table = delone::read_points(arguments.points);
    nlohmann::json report = {{"points", table.num_points()}, {"dimension", table.dimension}};
    measure(arguments, std::move(table), report);
    std::puts(report.dump().c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 2;
  }
}

/// The main function of an adapter.
template <Adapter A>
int run(int argc, char** argv) {
  return run_main(argc, argv, [](const Arguments& arguments, delone::PointTable&& table, auto& report) {
    A adapter(arguments, std::move(table));
    add_program(report, adapter.program());
    for (int round = 0; round < arguments.repeat; ++round) {
      if (round > 0) adapter.reset();
      const Seconds seconds = time([&] { adapter.construct(); });
      report["seconds"].push_back(seconds.clock);
      report["cpu_seconds"].push_back(seconds.cpu);
    }
    report["peak_bytes"] = peak_bytes();
    report["cells"] = adapter.num_cells();
    report.update(adapter.details());
    if (!arguments.cells.empty()) write_cells(arguments.cells, adapter.cells());
  });
}

}  // namespace rival
