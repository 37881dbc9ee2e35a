// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/index_file.hpp"

#include "base/require_dimension.hpp"
#include "io/file.hpp"
#include "messages/in_quotes.hpp"
#include "tiles/json_members.hpp"
#include "tiles/part_file.hpp"

#include <filesystem>

namespace delone::tiles {

namespace {

constexpr const char* format_name = "delone tiles";
/// Programs that know version 1 alone would take the parts of a periodic set for those of an open one.
constexpr std::int64_t version = 1, version_of_periodic = 2;

/// Adds up numbers of parts. Throws bad_format for a sum that is not as expected.
class Sum {
 public:
  void add(std::int64_t number) { sum_ += static_cast<std::uint64_t>(number); }
  void expect(std::int64_t total, const char* member, const std::string& name) const {
    if (sum_ != static_cast<std::uint64_t>(total))
      io::fail(Errc::bad_format, "{}: {}: found {}, but those of the parts are {}", name, member, total,
               sum_);
  }

 private:
  std::uint64_t sum_ = 0;
};

}  // namespace

void write_tiles_index(const std::string& folder, const TilesIndex& index, const std::string& fingerprint) {
  nlohmann::ordered_json json;
  json["format"] = format_name;
  json["version"] = index.lattice.rank() > 0 ? version_of_periodic : version;
  json["dimension"] = index.dimension;
  json["affine_dimension"] = index.affine_dimension;
  json["weighted"] = index.weighted;
  if (index.lattice.rank() > 0) json["lattice"] = index.lattice.vectors;
  if (index.unit > 0) json["unit"] = index.unit;
  json["num_points"] = index.num_points;
  json["num_vertices"] = index.num_vertices;
  json["num_duplicates"] = index.num_duplicates;
  json["num_hidden"] = index.num_hidden;
  json["num_cells"] = index.num_cells;
  json["num_hull_facets"] = index.num_hull_facets;
  json["hash"] = index.hash.hex();
  json["input"] = fingerprint;
  json["parts"] = nlohmann::ordered_json::array();
  for (const TilePart& part : index.parts)
    json["parts"].push_back({{"file", part.file},
                             {"first_cell", part.first_cell},
                             {"num_cells", part.num_cells},
                             {"num_points", part.num_points},
                             {"num_vertices", part.num_vertices},
                             {"num_foreign", part.num_foreign},
                             {"num_rounds", part.num_rounds},
                             {"num_bytes", part.num_bytes},
                             {"crc32", part.crc32},
                             {"num_seam_bytes", part.num_seam_bytes},
                             {"seam_crc32", part.seam_crc32}});
  write_json(path_in(folder, index_name), json, true);
}

TilesIndex read_tiles_index(const std::string& folder, std::string& fingerprint) {
  const std::string path = path_in(folder, index_name), name = io::input_name(path);
  return io::guarded(name, [&] {
    const nlohmann::json json = read_json(path);
    const JsonMembers members(json, name);
    members.require_format(format_name, version_of_periodic, "an index of tiles");
    TilesIndex index;
    index.dimension = static_cast<int>(members.number("dimension", 1, internal::largest_dimension));
    index.affine_dimension = static_cast<int>(members.number("affine_dimension", -1, index.dimension));
    index.weighted = members.flag("weighted");
    index.lattice = members.lattice(index.dimension);
    index.unit = members.unit();
    index.num_points = members.number("num_points", 0, largest_count);
    index.num_vertices = members.number("num_vertices", 0, index.num_points);
    index.num_duplicates = members.number("num_duplicates", 0, index.num_points);
    index.num_hidden = members.number("num_hidden", 0, index.weighted ? index.num_points : 0);
    Sum kinds;
    for (const std::int64_t number : {index.num_vertices, index.num_duplicates, index.num_hidden})
      kinds.add(number);
    kinds.expect(index.num_points, "num_points", name);
    index.num_cells = members.number("num_cells", 0, largest_count);
    index.num_hull_facets = members.number("num_hull_facets", 0, largest_count);
    const auto hash = members.words<2>("hash");
    index.hash = {hash[0], hash[1]};
    fingerprint = members.text("input");

    Sum cells, points, vertices;
    std::int64_t next = 0;
    for (const nlohmann::json& entry : members.array("parts")) {
      const std::string file = part_name(index.parts.size());
      const JsonMembers given(entry, fmt::format("{}: parts[{}]", name, index.parts.size()));
      TilePart part;
      part.file = given.text("file");
      if (part.file != file)
        io::fail(Errc::bad_format, "{}: file: expected {}, found {}", given.name(), file,
                 messages::in_quotes(part.file));
      part.first_cell = given.number("first_cell", next, next);
      part.num_cells = given.number("num_cells", 0, index.num_cells - next);
      part.num_points = given.number("num_points", 0, index.num_points);
      part.num_vertices = given.number("num_vertices", 0, part.num_points);
      part.num_foreign = given.number("num_foreign", 0, largest_count);
      part.num_rounds = given.number("num_rounds", 0, largest_count);
      part.num_bytes = given.number("num_bytes", 0, largest_count);
      part.crc32 = given.number("crc32", 0, largest_crc32);
      part.num_seam_bytes = given.number("num_seam_bytes", 0, largest_count);
      part.seam_crc32 = given.number("seam_crc32", 0, largest_crc32);
      next += part.num_cells;
      cells.add(part.num_cells);
      points.add(part.num_points);
      vertices.add(part.num_vertices);
      index.parts.push_back(std::move(part));
    }
    cells.expect(index.num_cells, "num_cells", name);
    points.expect(index.num_points, "num_points", name);
    vertices.expect(index.num_vertices, "num_vertices", name);
    return index;
  });
}

bool has_tiles_index(const std::string& folder) {
  std::error_code error;
  return std::filesystem::exists(path_in(folder, index_name), error);
}

bool is_damaged_index(const std::string& folder) {
  std::error_code error;
  if (!std::filesystem::exists(path_in(folder, part_name(0)), error)) return false;
  const io::Bytes bytes = io::read_all(path_in(folder, index_name), 0, [](std::string_view, bool) {});
  const nlohmann::json json = nlohmann::json::parse(bytes.view(), nullptr, false);
  if (json.is_discarded()) return true;
  const auto format = json.find("format");
  return format != json.end() && *format == format_name;
}

}  // namespace delone::tiles

namespace delone {

TilesIndex read_tiles_index(const std::string& folder) {
  std::string fingerprint;
  return tiles::read_tiles_index(folder, fingerprint);
}

TileData read_tile(const std::string& folder, std::size_t i) {
  const TilesIndex index = read_tiles_index(folder);
  if (i >= index.parts.size())
    io::fail(Errc::invalid_argument, "{}: there is no part {}; the folder has {}", io::input_name(folder), i,
             index.parts.size());
  return tiles::read_tile_of(folder, index, i);
}

}  // namespace delone
