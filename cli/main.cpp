// SPDX-License-Identifier: BSD-3-Clause
// The command `delone`: runs the sub-command, and turns errors into one line on standard error and an exit
// status.
#include "command.hpp"
#include "help.hpp"
#include "interrupt.hpp"
#include "memory_limit.hpp"
#include "messages/in_quotes.hpp"
#include "numbers.hpp"
#include "output.hpp"
#include "system.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <delone/arithmetic.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace delone::cli {
namespace {

/// A message without what parts of the program put before their own: their names are nothing to a user.
std::string without_origins(std::string message) {
  constexpr std::string_view json = "[json.exception.";
  if (const std::size_t at = message.find(json); at != std::string::npos)
    if (const std::size_t end = message.find("] ", at); end != std::string::npos)
      message.erase(at, end + 2 - at);
  return message;
}

/// Joins the lines of a message. It may quote anything, and arguments of any length.
int complain(int status, std::string message) {
  message = without_origins(std::move(message));
  constexpr std::size_t longest = 2000;
  for (char& c : message)
    if (c == '\n' || c == '\r') c = ' ';
  print_note(fmt::format("delone: {}\n", printable(message, longest)));
  return status;
}

/// "--box: 'a' is not a number (item 3 of 4)" for the parser's "Could not convert: --box = 0,0,a,1".
std::optional<std::string> message_of_conversion(const std::string& message) {
  constexpr std::string_view beginning = "Could not convert: ", between = " = ";
  const std::size_t equal = message.find(between);
  if (!message.starts_with(beginning) || equal == std::string::npos) return std::nullopt;
  const std::string name = message.substr(beginning.size(), equal - beginning.size());
  const std::vector<std::string> items = split_list(message.substr(equal + between.size()));
  const auto wrong =
      std::find_if(items.begin(), items.end(), [](const auto& item) { return !parse_real(item); });
  if (wrong == items.end())
    return fmt::format("{}: {} is not a whole number that is possible here", name,
                       messages::in_quotes(items[0]));
  return fmt::format(
      "{}: {} is not a number{}", name, messages::in_quotes(*wrong),
      items.size() == 1 ? "" : fmt::format(" (item {} of {})", wrong - items.begin() + 1, items.size()));
}

/// "KIND: 'unifrom' is none of ball, …; did you mean 'uniform'?" for "KIND: unifrom not in {ball,…}", and
/// "-d: 'two' is no whole number from 1 to 9" for "-d: Value two not in range 1 to 9".
std::optional<std::string> message_of_choice(const std::string& message) {
  constexpr std::string_view range = " not in range ", set = " not in {", value = "Value ";
  const std::size_t colon = message.find(": ");
  if (colon == std::string::npos) return std::nullopt;
  const std::string name = message.substr(0, colon + 2);
  if (const std::size_t at = message.rfind(set); at != std::string::npos && message.ends_with('}')) {
    const std::string given = message.substr(colon + 2, at - colon - 2),
                      list = message.substr(at + set.size(), message.size() - at - set.size() - 1);
    const std::vector<std::string> words = split_list(list);
    return fmt::format("{}{} is none of {}{}", name, messages::in_quotes(given), fmt::join(words, ", "),
                       suggestion(given, words));
  }
  if (const std::size_t at = message.rfind(range);
      at != std::string::npos && message.compare(colon + 2, value.size(), value) == 0) {
    const std::size_t begin = colon + 2 + value.size();
    return fmt::format("{}{} is no whole number from {}", name,
                       messages::in_quotes(message.substr(begin, at - begin)),
                       message.substr(at + range.size()));
  }
  return std::nullopt;
}

/// What the parser says, with the arguments that it repeats made short and printable.
std::string message_of(const CLI::ParseError& error, int argc, char** argv) {
  std::string message = error.what();
  if (auto better = message_of_conversion(message)) return *better;
  if (auto better = message_of_choice(message)) return *better;
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
  const bool is_too_large = code == Errc::out_of_memory || code == Errc::too_many || code == Errc::time_limit;
  return is_too_large ? exit_status::out_of_memory : exit_status::bad_input;
}

/// Whether the limit of memory may have led to it: to a refusal, or to a stop by the progress callback.
bool was_memory(Errc code) { return code == Errc::out_of_memory || code == Errc::cancelled; }

using Commands = std::vector<std::pair<CLI::App*, Run>>;

std::vector<std::string> names_of(const Commands& commands) {
  std::vector<std::string> names{"help"};
  for (const auto& [command, unused] : commands) names.push_back(command->get_name());
  return names;
}

CLI::App* find_command(const Commands& commands, const std::string& name) {
  for (const auto& [command, unused] : commands)
    if (command->get_name() == name) return command;
  return nullptr;
}

int complain_of_command(const std::string& name, const Commands& commands) {
  return complain(exit_status::usage,
                  fmt::format("there is no command {}{} (see 'delone --help')", messages::in_quotes(name),
                              suggestion(name, names_of(commands))));
}

/// What is answered without a sub-command's options: help, and what is no sub-command. Nothing for all else.
std::optional<int> answer_at_once(const CLI::App& app, const Commands& commands,
                                  const std::vector<std::string>& arguments) {
  if (arguments.empty()) return print_note(app.help()), exit_status::usage;
  const std::string& first = arguments[0];
  if (first.starts_with("-")) return std::nullopt;
  if (first == "help") {
    if (arguments.size() == 1 || arguments[1].starts_with("-"))
      return print_output(app.help()), exit_status::ok;
    std::string text;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
      const CLI::App* command = find_command(commands, arguments[i]);
      if (command == nullptr && arguments[i] != "help") return complain_of_command(arguments[i], commands);
      text += (text.empty() ? "" : "\n") + (command == nullptr ? app.help() : command->help("delone"));
    }
    return print_output(text), exit_status::ok;
  }
  const CLI::App* command = find_command(commands, first);
  if (command == nullptr) return complain_of_command(first, commands);
  if (arguments.size() == 1) {
    print_note(command->help("delone"));
    for (const CLI::Option* option : command->get_options())
      if (option->get_positional() && option->get_required())
        return complain(exit_status::usage, option->get_name(true) + " is missing");
    return exit_status::usage;
  }
  return std::nullopt;
}

/// A mistyped option comes before what the parser says, which is that another is missing, or that its value
/// is too many.
std::optional<std::string> message_of_option(const CLI::App& command,
                                             const std::vector<std::string>& arguments) {
  const std::optional<std::string> unknown = unknown_option(command, arguments);
  if (!unknown) return std::nullopt;
  const std::string given = unknown->starts_with("--") ? *unknown : "-" + *unknown;
  return fmt::format("there is no option {}{}", messages::in_quotes(*unknown),
                     suggestion(given, option_names(command)));
}

int run_parsed(const Commands& commands) {
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
  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  // Setting up the options of all commands takes more than a millisecond, those of one about a hundredth of
  // that. So if a command is named, only that one gets its options.
  const bool is_one_named = !arguments.empty() && !arguments[0].starts_with("-") && arguments[0] != "help";
  Commands commands;
  using Lines = std::initializer_list<std::string_view>;
  const auto add = [&](const char* name, const char* description, Run (*setup)(CLI::App&),
                       Lines examples = {}) {
    CLI::App* command = app.add_subcommand(name, description);
    commands.emplace_back(command, nullptr);
    if (is_one_named && arguments[0] != name) return;
    commands.back().second = setup(*command);
    add_examples(*command, examples);
  };
  add("delaunay", "Triangulate points", add_delaunay,
      {"delone delaunay points.csv -o cells.npz", "delone delaunay table.csv --columns 0-1 --stats"});
  add("hull", "Compute the convex hull of points, or its lower or upper part", add_hull,
      {"delone hull points.csv -o hull.npz", "delone generate sphere -d 3 -n 100 | delone hull -"});
  add("halfspaces", "Intersect halfspaces", add_halfspaces,
      {"printf '1 0 -1\\n-1 0 -1\\n0 1 -1\\n0 -1 -1\\n' > square.txt",
       "delone halfspaces square.txt -o square.json"});
  add("polyhedron", "Turn inequalities into vertices, rays and lines, or back", add_polyhedron,
      {"printf 'begin\\n3 3 integer\\n0 1 0\\n0 0 1\\n1 -1 -1\\nend\\n' > t.ine",
       "delone polyhedron t.ine -o t.ext"});
  add("voronoi", "Compute the Voronoi diagram of points", add_voronoi,
      {"delone voronoi points.csv -o regions.svg", "delone voronoi points.csv --volumes areas.csv"});
  add("regular", "Triangulate weighted points", add_regular,
      {"delone regular table.csv --columns x,y --weights w -o regular.npz"});
  add("power", "Compute the power diagram of weighted points", add_power,
      {"delone power table.csv --columns x,y --weights w -o power.svg"});
  add("cells", "Measure the cells of points: volumes, centroids, surfaces, neighbors", add_cells,
      {"delone cells points.csv -o cells.csv",
       "delone cells points.csv --box 0,0,1,1 --neighbors -o cells.npz"});
  add("density", "Estimate the density of particles on a grid (DTFE)", add_density,
      {"delone density particles.csv --lattice 1 --grid 128 -o density.npy",
       "delone density t.csv --columns x,y --masses m --grid 64 -o d.npy"});
  add("alpha", "Compute the alpha complex of points, or its boundary", add_alpha,
      {"delone alpha points.csv --radius 0.2 -o alpha.npz"});
  add("locate", "Locate query points in the triangulation of points", add_locate,
      {"delone locate points.csv --queries places.csv -o answers.csv"});
  add("interpolate", "Interpolate values that are given at points", add_interpolate,
      {"delone interpolate table.csv --values w --queries places.csv",
       "delone interpolate table.csv --values w --queries places.csv \\",
       "  --method natural -o values.npy"});
  add("check", "Check a result of any program exactly", add_check,
      {"delone check cells.npz", "delone check hull.npz --level 2"});
  add("generate", "Generate a named set of points", add_generate,
      {"delone generate uniform -d 3 -n 1e4 --seed 7 -o uniform.npy"});
  add("forecast", "Predict the cost of a Delaunay triangulation: cells, memory, time", add_forecast,
      {"delone forecast -d 6 -n 20000", "delone forecast points.csv"});
  add("info", "Describe a file of points or of a result", add_info,
      {"delone info cells.npz", "delone generate grid -d 2 -n 25 | delone info -"});
  add("view", "Show a result on a page for a browser", add_view,
      {"delone view points.csv -o page.html", "delone view cells.npz --title Cells -o cells.html",
       "delone view table.csv --values w --of voronoi -o areas.html"});
  app.footer(
      "Points are read from .npy .csv .tsv .txt .xyz .pts .off .ply .pdb .las files, or in Qhull's form\n"
      "from standard input (-); any of them may be compressed (.csv.gz). 'delone help COMMAND' or\n"
      "'delone COMMAND --help' shows the options of a command, with examples.\n"
      "Exit status: 0 success, 1 a check failed, 2 bad input or output, 3 too large for memory or a limit,\n"
      "64 wrong usage, 130 or 143 interrupted, 141 standard output closed.");
  add_examples(app, {"delone generate uniform -d 2 -n 1000 -o random.csv",
                     "delone delaunay random.csv -o random.svg", "delone help delaunay"});

  if (const std::optional<int> answered = answer_at_once(app, commands, arguments)) return *answered;
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    for (const auto& [command, unused] : commands)
      if (command->parsed()) return print_output(command->help("delone")), exit_status::ok;
    return print_output(app.help()), exit_status::ok;
  } catch (const CLI::CallForVersion& e) {
    return print_output(std::string(e.what()) + "\n"), exit_status::ok;
  } catch (const CLI::ParseError& e) {
    const CLI::App* sub = find_command(commands, arguments[0]);
    const std::string command = sub == nullptr ? "delone" : "delone " + sub->get_name();
    const std::string message =
        message_of_option(sub == nullptr ? app : *sub, arguments).value_or(message_of(e, argc, argv));
    return complain(exit_status::usage, fmt::format("{} (see '{} --help')", message, command));
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
    if (const std::string text = memory_message(e.what()); !text.empty() && was_memory(e.code()))
      return complain(exit_status::out_of_memory, text);
    return complain(status_of(e.code()), in_command_words(e.what()));
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
  const delone::ArithmeticScope arithmetic;  // for the numbers of the command line, too
  return delone::cli::run_and_report(argc, argv);
}
