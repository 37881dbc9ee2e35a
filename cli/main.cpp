// SPDX-License-Identifier: BSD-3-Clause
// The command `delone`: runs the sub-command, and turns errors into one line on standard error and an exit
// status.
#include "command.hpp"
#include "interrupt.hpp"
#include "memory_limit.hpp"
#include "output.hpp"
#include "system.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace delone::cli {
namespace {

/// Joins the lines of a message. It may quote anything, and arguments of any length.
int complain(int status, std::string message) {
  constexpr std::size_t longest = 2000;
  for (char& c : message)
    if (c == '\n' || c == '\r') c = ' ';
  print_note(fmt::format("delone: {}\n", printable(message, longest)));
  return status;
}

/// What the parser says, with the arguments that it repeats made short and printable.
std::string message_of(const CLI::ParseError& error, int argc, char** argv) {
  std::string message = error.what();
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const std::string_view value = argument.substr(argument.starts_with("--") ? argument.find('=') + 1 : 0);
    const std::string shown = printable(value);
    if (shown == value) continue;
    for (std::size_t at = message.find(value); at != std::string::npos;
         at = message.find(value, at + shown.size()))
      message.replace(at, value.size(), shown);
  }
  return message;
}

int status_of(Errc code) {
  return code == Errc::out_of_memory || code == Errc::too_many ? exit_status::out_of_memory
                                                               : exit_status::bad_input;
}

/// Whether the limit of memory may have led to it: to a refusal, or to a stop by the progress callback.
bool was_memory(Errc code) { return code == Errc::out_of_memory || code == Errc::cancelled; }

int run_parsed(const std::vector<std::pair<CLI::App*, Run>>& commands) {
  for (const auto& [command, run] : commands)
    if (command->parsed()) return run();
  return exit_status::usage;  // not reached: the parser requires a sub-command
}

int run(int argc, char** argv) {
  CLI::App app{"Exact Delaunay triangulations of points in any dimension.", "delone"};
  app.set_version_flag("--version", "delone " DELONE_VERSION);
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.get_formatter()->column_width(34);
  app.allow_windows_style_options(false);  // a path may begin with a slash there too
  app.require_subcommand(1);
  std::vector<std::pair<CLI::App*, Run>> commands;
  const auto add = [&](const char* name, const char* description, Run (*setup)(CLI::App&)) {
    CLI::App* command = app.add_subcommand(name, description);
    commands.emplace_back(command, setup(*command));
  };
  add("delaunay", "Triangulate points", add_delaunay);
  add("hull", "Compute the convex hull of points, or its lower or upper part", add_hull);
  add("halfspaces", "Intersect halfspaces", add_halfspaces);
  add("voronoi", "Make the Voronoi diagram of points", add_voronoi);
  add("regular", "Triangulate weighted points", add_regular);
  add("power", "Make the power diagram of weighted points", add_power);
  add("alpha", "Find the alpha complex of points below a radius, or its boundary", add_alpha);
  add("locate", "Triangulate points, then say where query points lie", add_locate);
  add("check", "Check a triangulation exactly, whoever made it", add_check);
  add("generate", "Make a named set of points", add_generate);
  add("info", "Say what a file of points or a triangulation holds", add_info);
  app.footer(
      "Points are read from .npy .csv .tsv .txt .xyz .pts .off .ply files, or in Qhull's form from standard "
      "input (-).\n"
      "Exit status: 0 success, 1 a check failed, 2 bad input or output, 3 too large for memory or a limit, "
      "64 "
      "wrong usage,\n130 or 143 interrupted.");

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    for (const auto& [command, unused] : commands)
      if (command->parsed()) return print_output(command->help("delone")), exit_status::ok;
    return print_output(app.help()), exit_status::ok;
  } catch (const CLI::CallForVersion& e) {
    return print_output(std::string(e.what()) + "\n"), exit_status::ok;
  } catch (const CLI::ParseError& e) {
    std::string command = "delone";
    for (const auto& [sub, unused] : commands)
      if (sub->parsed()) command += " " + sub->get_name();
    return complain(exit_status::usage,
                    fmt::format("{} (see '{} --help')", message_of(e, argc, argv), command));
  }
  return run_parsed(commands);
}

int run_and_report(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const UsageError& e) {
    return complain(exit_status::usage, e.what());
  } catch (const Error& e) {
    // Any failure after Ctrl-C is a consequence of it.
    if (const int signal = caught_signal(); signal != 0) return complain(128 + signal, "interrupted");
    if (const std::string text = memory_message(); !text.empty() && was_memory(e.code()))
      return complain(exit_status::out_of_memory, text);
    return complain(status_of(e.code()), e.what());
  } catch (const std::bad_alloc&) {
    if (const std::string text = memory_message(); !text.empty())
      return complain(exit_status::out_of_memory, text);
    return complain(exit_status::out_of_memory, "not enough memory");
  } catch (const std::exception& e) {
    return complain(exit_status::bad_input, e.what());
  }
}

}  // namespace
}  // namespace delone::cli

int main(int argc, char** argv) {
  delone::cli::system::prepare_process();
  delone::cli::install_interrupt_handlers();
  return delone::cli::run_and_report(argc, argv);
}
