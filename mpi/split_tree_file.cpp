// SPDX-License-Identifier: BSD-3-Clause
#include "split_tree_file.hpp"

#include "io/file.hpp"
#include "tiles/json_members.hpp"
#include "tiles/part_file.hpp"

#include <delone/io.hpp>

#include <filesystem>
#include <vector>

namespace delone::mpi {

namespace {

constexpr const char *file_name = "split.json", *format_name = "delone cut into tiles";

/// Whether every node and every tile is reached once from the root, children after their parents.
bool is_tree(const tiles::SplitTree& tree) {
  const std::size_t n = tree.axes.size();
  if (tree.below.size() != n || tree.beyond.size() != n ||
      tree.splitters.size() != n * static_cast<std::size_t>(tree.dimension) ||
      static_cast<std::size_t>(tree.num_tiles) != n + 1)
    return false;
  std::vector<bool> nodes(n, false), tiles(n + 1, false);
  for (std::size_t i = 0; i < n; ++i) {
    if (tree.axes[i] < 0 || tree.axes[i] >= tree.dimension) return false;
    for (const std::int32_t child : {tree.below[i], tree.beyond[i]}) {
      std::vector<bool>& seen = child >= 0 ? nodes : tiles;
      const auto at = static_cast<std::size_t>(child >= 0 ? child : -1 - child);
      if (at >= seen.size() || seen[at] || (child >= 0 && at <= i)) return false;
      seen[at] = true;
    }
  }
  return true;
}

}  // namespace

void write_split_tree(const std::string& work, const tiles::SplitTree& tree) {
  nlohmann::ordered_json json;
  json["format"] = format_name;
  json["axes"] = tree.axes;
  json["splitters"] = tree.splitters;
  json["below"] = tree.below;
  json["beyond"] = tree.beyond;
  tiles::write_json(tiles::path_in(work, file_name), json, true);
}

std::optional<tiles::SplitTree> read_split_tree(const std::string& work, int dimension,
                                                std::size_t num_tiles) {
  const std::string path = tiles::path_in(work, file_name), name = io::input_name(path);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  tiles::SplitTree tree;
  tree.dimension = dimension;
  tree.num_tiles = static_cast<std::int32_t>(num_tiles);
  try {
    const nlohmann::json json = tiles::read_json(path);
    if (json.at("format") != format_name) io::fail(Errc::bad_format, "{}: not a cut into tiles", name);
    json.at("axes").get_to(tree.axes);
    json.at("splitters").get_to(tree.splitters);
    json.at("below").get_to(tree.below);
    json.at("beyond").get_to(tree.beyond);
  } catch (const nlohmann::json::exception& error) {
    io::fail(Errc::bad_format, "{}: {}", name, printable(error.what(), 200));
  }
  if (!is_tree(tree))
    io::fail(Errc::bad_format, "{}: not a cut of space of dimension {} into {} tiles", name, dimension,
             num_tiles);
  return tree;
}

}  // namespace delone::mpi
