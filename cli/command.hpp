// SPDX-License-Identifier: BSD-3-Clause
// What the sub-commands share: registration, exit statuses, and error messages that name the file in
// question.
#pragma once

#include <delone/delone.hpp>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace delone::cli {

/// The same as in docs/guide.md. 3 is also for streams and numbers of points and cells beyond a limit.
namespace exit_status {
inline constexpr int ok = 0, check_failed = 1, bad_input = 2, out_of_memory = 3, usage = 64;
}

/// An option whose value does not go together with the others: exit status 64.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Runs a sub-command after its options have been parsed; returns the exit status.
using Run = std::function<int()>;

/// Each adds one sub-command to the command line.
Run add_delaunay(CLI::App& app);
Run add_hull(CLI::App& app);
Run add_halfspaces(CLI::App& app);
Run add_polyhedron(CLI::App& app);
Run add_voronoi(CLI::App& app);
Run add_regular(CLI::App& app);
Run add_power(CLI::App& app);
Run add_cells(CLI::App& app);
Run add_density(CLI::App& app);
Run add_alpha(CLI::App& app);
Run add_locate(CLI::App& app);
Run add_interpolate(CLI::App& app);
Run add_check(CLI::App& app);
Run add_generate(CLI::App& app);
Run add_info(CLI::App& app);
Run add_view(CLI::App& app);
Run add_forecast(CLI::App& app);

/// The name of a path in messages and reports.
inline std::string input_name(const std::string& path) {
  return path == "-" ? "standard input" : printable(path, std::string::npos);
}

/// "1 point", "2 points".
inline std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// Runs `work`. Puts the name of the file in front of error messages that do not begin with it.
template <class Work>
auto about(const std::string& name, Work&& work) {
  try {
    return work();
  } catch (const Error& e) {
    if (std::string(e.what()).rfind(name + ":", 0) == 0) throw;
    throw Error(e.code(), name + ": " + e.what(), e.rows());
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, name + ": not enough memory");
  }
}

/// A message of the library, which names members of options, with the options of the command instead.
std::string in_command_words(std::string message, const std::string& format_option = "--format",
                             const std::string& columns_option = "--columns");

/// The options of all commands that read points.
struct PointInput {
  std::string path;
  ReadOptions options;
  /// The options that say so, for messages.
  std::string format_option = "--format", columns_option = "--columns";

  void add_to(CLI::App& command, const std::string& name, const std::string& description);
  /// By at most so many threads; 0: as many as gain.
  PointTable read(unsigned threads = 0) const;
  /// Another file with a row per point: its format is told by its extension.
  PointTable read_beside(const std::string& other_path, unsigned threads = 0) const;
};

/// Leaves the rows out of both tables that are skipped in one of them. REQUIRES files of as many rows.
void keep_common_rows(PointTable& points, PointTable& beside);
/// The number of rows of the file, skipped ones included.
inline std::size_t num_rows(const PointTable& table) {
  return table.num_points() + table.skipped_rows.size();
}

/// Whether an argument that is columns of points or else a file, which may be a pipe or -, is the file:
/// numbers are those of columns.
bool names_a_file(const std::string& columns_or_file);

/// Throws unless queries have as many coordinates as the points and, where both have names of columns and
/// --query-columns did not choose, the same names in the same order.
void require_fitting(const PointTable& queries, const PointTable& points, const PointInput& from);

/// --queries, --query-format and --query-columns.
void add_queries(CLI::App& command, PointInput& queries, const std::string& description);

/// What the file holds, if its format can hold anything but points. An OFF file without faces holds points.
std::optional<AnyData> try_read(const std::string& path, std::string format, std::uint64_t max_stream_bytes);

/// Options shared by several commands: the limit of streams, sizes, a list of columns, leave to
/// overwrite inputs, a seed.
void add_max_stream(CLI::App& command, std::uint64_t& bytes);
/// An option whose value is a size, as 500MB or 2G.
void add_size(CLI::App& command, const std::string& name, std::uint64_t& bytes,
              const std::string& description, std::uint64_t least = 0);
/// The same for a time, as 90, 10m or 2h; in seconds.
void add_duration(CLI::App& command, const std::string& name, double& seconds,
                  const std::string& description);
/// The value of -n, as 1000 or 1e6. Throws UsageError, and out_of_memory beyond all memory.
std::size_t count_of(const std::string& text);
void add_columns(CLI::App& command, const std::string& name, std::vector<std::string>& columns);
/// --skip-missing.
void add_skip_missing(CLI::App& command, bool& skip_missing);
void add_force(CLI::App& command, bool& force);
void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& description);

/// The format names that --format accepts: for points, and for triangulations to write and to read.
const std::vector<std::string>& point_formats();
const std::vector<std::string>& complex_formats();
const std::vector<std::string>& readable_complex_formats();

}  // namespace delone::cli
