// SPDX-License-Identifier: BSD-3-Clause
// The command `delone-mpi`: every process runs it with the same arguments. Rank 0 alone prints.
#include "../cli/command.hpp"
#include "../cli/lattice_input.hpp"
#include "../cli/numbers.hpp"
#include "ranks.hpp"

#include <delone/delone.hpp>
#include <delone/mpi/tiles.hpp>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace delone::mpi {
namespace {

namespace exit_status = cli::exit_status;

int rank_of() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

void print(std::FILE* to, const std::string& text) {
  if (rank_of() == 0) std::fwrite(text.data(), 1, text.size(), to);
}

int complain(int status, std::string message) {
  constexpr std::size_t longest = 2000;
  for (char& c : message)
    if (c == '\n' || c == '\r') c = ' ';
  print(stderr, fmt::format("delone-mpi: {}\n", printable(message, longest)));
  return status;
}

struct Arguments {
  std::vector<std::string> inputs;
  std::string folder, memory, tiles;
  cli::LatticeInput lattice;
  TilesOptions options;
  int raw = 0;
  bool no_resume = false, stats = false;
};

/// The efforts of all ranks, at rank 0.
std::vector<RankEffort> gathered(const RankEffort& mine) {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  std::vector<RankEffort> all(static_cast<std::size_t>(size));
  MPI_Gather(&mine, sizeof(mine), MPI_BYTE, all.data(), sizeof(mine), MPI_BYTE, 0, MPI_COMM_WORLD);
  return all;
}

using Json = nlohmann::ordered_json;

Json stats_of(const TilesIndex& index, const std::vector<RankEffort>& efforts) {
  Json json{{"command", "delaunay"},
            {"dimension", index.dimension},
            {"affine_dimension", index.affine_dimension},
            {"points", index.num_points},
            {"vertices", index.num_vertices},
            {"duplicates", index.num_duplicates},
            {"hidden", index.num_hidden},
            {"cells", index.num_cells},
            {"hull_facets", index.num_hull_facets}};
  if (index.lattice.rank() > 0) json["lattice_vectors"] = index.lattice.rank();
  json["hash"] = index.hash.hex();
  json["tiles"] = index.parts.size();
  json["ranks"] = Json::array();
  for (const RankEffort& one : efforts)
    json["ranks"].push_back({{"tiles", one.num_tiles},
                             {"points", one.num_points},
                             {"foreign", one.num_foreign},
                             {"rounds", one.num_rounds},
                             {"pages_received", one.num_pages_received},
                             {"messages", one.num_messages},
                             {"bytes_sent", one.bytes_sent},
                             {"bytes_received", one.bytes_received},
                             {"seconds",
                              {{"reading", one.reading},
                               {"inserting", one.inserting},
                               {"asking", one.asking},
                               {"exchanging", one.exchanging},
                               {"waiting", one.waiting},
                               {"writing", one.writing},
                               {"total", one.total}}}});
  return json;
}

/// All ranks get the lattice, or all throw, as a file may be missing on some machines.
void read_lattice(Arguments& arguments) {
  bool is_usage = false;
  try {
    Ranks(MPI_COMM_WORLD).together([&] {
      try {
        arguments.options.lattice = arguments.lattice.of_tiles();
        arguments.options.unit = arguments.lattice.unit_or_0();
      } catch (const cli::UsageError&) {
        is_usage = true;
        throw;
      }
    });
  } catch (const Error& error) {
    if (is_usage) throw cli::UsageError(error.what());
    throw;
  }
}

int run_delaunay(const Arguments& arguments) {
  RankEffort effort;
  const TilesIndex index =
      make_tiles(arguments.inputs, arguments.folder, MPI_COMM_WORLD, arguments.options, &effort);
  const std::vector<RankEffort> efforts = gathered(effort);
  if (arguments.stats)
    print(stdout, stats_of(index, efforts).dump(2) + "\n");
  else
    print(stdout,
          fmt::format("{} points in dimension {}: {} cells in {} parts, by {} rank{}, in {:.1f} s\n"
                      "hash {}\n",
                      index.num_points, index.dimension, index.num_cells, index.parts.size(), efforts.size(),
                      efforts.size() == 1 ? "" : "s", effort.total, index.hash.hex()));
  return exit_status::ok;
}

int run(int argc, char** argv) {
  CLI::App app{"Exact Delaunay triangulations of more points than one machine holds.", "delone-mpi"};
  app.set_version_flag("--version", "delone-mpi " DELONE_VERSION);
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.get_formatter()->column_width(34);
  app.require_subcommand(1);
  app.footer(
      "Run it by mpirun -n RANKS delone-mpi …; all ranks must see the same files.\n"
      "Exit status: 0 success, 2 bad input or output, 3 too large for memory or a limit, 64 wrong usage.");
  Arguments arguments;
  TilesOptions& options = arguments.options;
  CLI::App& delaunay = *app.add_subcommand("delaunay", "Triangulate points, into a folder of parts");
  delaunay
      .add_option("IN", arguments.inputs,
                  "Points: one file, or several, each read by one rank; %d in a name stands for 0, 1, 2, …")
      ->required();
  delaunay.add_option("-o,--output", arguments.folder, "The folder to make")->required()->type_name("OUT/");
  delaunay.add_flag("--weighted", options.weighted, "The last column has weights: the regular triangulation");
  arguments.lattice.add_to(delaunay);
  delaunay.add_option("--memory", arguments.memory, "The most memory of one rank, such as 2GiB")
      ->type_name("SIZE");
  delaunay.add_option("--tiles", arguments.tiles, "The number of tiles; if not given, one per rank or more")
      ->type_name("N");
  delaunay.add_option("-t,--threads", options.threads, "Threads of each rank; 1 if not given")
      ->type_name("N");
  delaunay.add_option("--format", options.format, "The format of the input, if its name does not tell it")
      ->type_name("FORMAT");
  delaunay
      .add_option("--raw", arguments.raw,
                  "IN consists of little-endian doubles, N per row, the weight included")
      ->type_name("N")
      ->check(CLI::Range(1, 1 << 20));
  delaunay.add_flag("--vtu", options.vtu, "Also write tiles.pvtu and a .vtu per part, for ParaView (d <= 3)");
  delaunay.add_flag("--no-resume", arguments.no_resume,
                    "Start again instead of continuing from what is in the folder");
  delaunay.add_flag("--stats", arguments.stats, "Print a report as JSON, with the effort of every rank");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    print(stdout, delaunay.parsed() ? delaunay.help("delone-mpi") : app.help());
    return exit_status::ok;
  } catch (const CLI::CallForVersion& version) {
    print(stdout, std::string(version.what()) + "\n");
    return exit_status::ok;
  } catch (const CLI::ParseError& error) {
    return complain(exit_status::usage, fmt::format("{} (see 'delone-mpi --help')", error.what()));
  }
  options.resume = !arguments.no_resume;
  options.damage = [](const std::vector<std::string>& files) {  // on the rank that finds it
    for (const std::string& file : files)
      std::fputs(fmt::format("delone-mpi: {}; made again\n", file).c_str(), stderr);
    return true;
  };
  if (arguments.raw > 0) {
    options.format = "raw";
    options.columns = arguments.raw;
  }
  if (!arguments.memory.empty()) {
    const auto bytes = cli::parse_size(arguments.memory);
    if (!bytes || *bytes == 0) return complain(exit_status::usage, "--memory: a size was expected, as 2GiB");
    options.memory = *bytes;
  }
  if (!arguments.tiles.empty()) {
    const auto number = cli::parse_count(arguments.tiles);
    if (!number || *number == 0 || *number > 1000000)
      return complain(exit_status::usage, "--tiles: a number from 1 to 1000000 was expected");
    options.tiles = static_cast<std::size_t>(*number);
  }
  if (options.vtu && arguments.lattice.is_wanted())
    return complain(exit_status::usage, "--vtu does not go together with --lattice");
  read_lattice(arguments);
  return run_delaunay(arguments);
}

/// Errors of make_tiles() are thrown by all ranks: the job ends as a whole.
int run_and_report(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const cli::UsageError& error) {
    return complain(exit_status::usage, error.what());
  } catch (const Error& error) {
    const bool is_too_large = error.code() == Errc::out_of_memory || error.code() == Errc::too_many;
    return complain(is_too_large ? exit_status::out_of_memory : exit_status::bad_input, error.what());
  } catch (const std::exception& error) {  // of this rank alone
    std::fputs(fmt::format("delone-mpi: rank {}: {}\n", rank_of(), error.what()).c_str(), stderr);
    MPI_Abort(MPI_COMM_WORLD, exit_status::out_of_memory);
    return exit_status::out_of_memory;
  }
}

}  // namespace
}  // namespace delone::mpi

int main(int argc, char** argv) {
  int threads = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
  const delone::ArithmeticScope arithmetic;
  const int status = delone::mpi::run_and_report(argc, argv);
  MPI_Finalize();
  return status;
}
