// SPDX-License-Identifier: BSD-3-Clause
// Points and triangulations from OFF, COFF and nOFF. See off.hpp.
#include "io/collect.hpp"
#include "io/file.hpp"
#include "io/known_kind.hpp"
#include "io/points/off.hpp"
#include "io/points/read_points.hpp"
#include "io/text_cursor.hpp"
#include "messages/in_quotes.hpp"

#include <algorithm>
#include <limits>

namespace delone::io {

namespace {

/// No vertex and no cell takes less than two bytes: what the file cannot hold is never allocated.
void require_room(const TextCursor& at, std::uint64_t count, std::string_view what) {
  if (count > at.remaining() / 2 + 1)
    fail(Errc::bad_format, "{}: the header promises {} {}, more than the rest of the file can hold",
         at.place(), count, what);
}

/// What comments say that the file holds.
DataKind kind_in(std::string_view comments, const std::string& name) {
  const auto at = comments.find(off_kind_comment);
  if (at == std::string_view::npos) return DataKind::unknown;
  const std::string_view rest = comments.substr(at + off_kind_comment.size());
  const DataKind kind = known_kind(rest.substr(0, rest.find_first_of(" \t\r\n")), name);
  if (kind > DataKind::hull_boundary)
    fail(Errc::bad_format, "{}: the file says that it holds {}, which is not kept as OFF", name,
         description_of(kind));
  return kind;
}

}  // namespace

OffHeader read_off_header(TextCursor& at) {
  OffHeader header;
  const char* const start = at.position();
  const std::string_view keyword = at.next_token();
  if (keyword == "COFF") {
    header.colours = true;
  } else if (keyword == "nOFF") {
    header.dimension = static_cast<int>(at.count("the dimension", std::numeric_limits<int>::max()));
    if (header.dimension == 0) fail(Errc::bad_dimension, "{}: the dimension is 0", at.place());
  } else if (keyword != "OFF") {
    if (keyword.ends_with("OFF"))
      fail(Errc::unsupported, "{}: {} is not supported; use OFF, COFF or nOFF", at.place(),
           messages::in_quotes(keyword));
    fail(Errc::bad_format, "{}: expected 'OFF', 'COFF' or 'nOFF', found {}", at.place(),
         messages::in_quotes(keyword));
  }
  at.skip_blanks();
  if (std::string_view(at.position(), at.remaining()).starts_with("BINARY"))
    fail(Errc::unsupported, "{}: binary OFF is not supported", at.place());
  constexpr auto any = std::numeric_limits<std::uint64_t>::max();
  at.find_content();
  header.comments = {start, static_cast<std::size_t>(at.position() - start)};
  header.num_vertices = at.count("the number of vertices", any);
  header.num_cells = at.count("the number of faces", any);
  if (!at.skip_to_content()) at.count("the number of edges", any);
  if (!at.skip_to_content())
    fail(Errc::bad_format, "{}: unexpected {} after the counts", at.place(),
         messages::in_quotes(at.rest_of_line()));
  return header;
}

PointTable read_off_vertices(TextCursor& at, const OffHeader& header, Missing missing) {
  require_room(at, header.num_vertices, "vertices");
  PointCollector points(missing);
  points.table.dimension = header.dimension;
  const auto dimension = static_cast<std::size_t>(header.dimension);
  if (header.num_vertices <= (at.remaining() / 2 + 1) / dimension)
    points.table.coordinates.reserve(static_cast<std::size_t>(header.num_vertices) * dimension);
  for (std::uint64_t row = 0; row < header.num_vertices; ++row) {
    if (!at.find_content())
      fail(Errc::bad_format, "{}: expected {} vertices, the file ends after {}", at.place(),
           header.num_vertices, row);
    std::size_t found = 0;
    for (; found < dimension && !at.skip_to_content(); ++found) {
      const char* start = at.position();
      points.add(read_coordinate(at, points), [&] {
        return fmt::format("{}: column {}: {}", at.place(), found,
                           describe_not_finite({start, static_cast<std::size_t>(at.position() - start)}));
      });
    }
    if (found < dimension)
      fail(Errc::bad_format, "{}: vertex {}: expected {} coordinates, found {}", at.place(), row, dimension,
           found);
    if (header.colours) {
      at.skip_to_line_end();
    } else if (!at.skip_to_content()) {
      fail(Errc::bad_format, "{}: vertex {}: more than {} coordinates: {}", at.place(), row, dimension,
           messages::in_quotes(at.rest_of_line()));
    }
    at.take_line_end();
  }
  return points.finish();
}

PointTable read_off(std::string_view bytes, const std::string& name, Missing missing) {
  TextCursor at(text_of(bytes, name), name);
  const OffHeader header = read_off_header(at);
  at.take_line_end();
  return read_off_vertices(at, header, missing);
}

ComplexData read_off_complex(std::string_view bytes, const std::string& name) {
  TextCursor at(text_of(bytes, name), name);
  const OffHeader header = read_off_header(at);
  at.take_line_end();
  PointTable points = read_off_vertices(at, header);

  ComplexData data;
  data.dimension = points.dimension;
  data.points = std::move(points.coordinates);
  require_room(at, header.num_cells, "faces");
  std::uint64_t size = 0;
  for (std::uint64_t row = 0; row < header.num_cells; ++row) {
    if (!at.find_content())
      fail(Errc::bad_format, "{}: expected {} faces, the file ends after {}", at.place(), header.num_cells,
           row);
    const std::uint64_t found = at.count("the number of vertices of a face", std::numeric_limits<int>::max());
    if (row == 0) {
      size = found;
      if (size == 0) fail(Errc::bad_format, "{}: a face without vertices", at.place());
      if (size > static_cast<std::uint64_t>(data.dimension) + 1)
        fail(Errc::bad_format, "{}: a face of {} vertices is no simplex of dimension {}", at.place(), size,
             data.dimension);
      data.cells.reserve(
          static_cast<std::size_t>(std::min<std::uint64_t>(header.num_cells * size, at.remaining() / 2 + 1)));
    }
    if (found != size)
      fail(Errc::bad_format, "{}: face {}: expected {} vertices as before, found {}", at.place(), row, size,
           found);
    for (std::uint64_t i = 0; i < size; ++i) {
      if (at.skip_to_content())
        fail(Errc::bad_format, "{}: face {}: expected {} vertices, found {}", at.place(), row, size, i);
      data.cells.push_back(
          static_cast<SignedIndex>(at.count("a vertex of a face", std::numeric_limits<SignedIndex>::max())));
    }
    while (!at.skip_to_content()) at.number("the colour of a face");
    at.take_line_end();
  }
  const char* const end_of_faces = at.position();
  if (at.find_content())
    fail(Errc::bad_format, "{}: more than the {} faces promised: {}", at.place(), header.num_cells,
         messages::in_quotes(at.rest_of_line()));
  data.affine_dimension = static_cast<int>(size) - 1;
  data.kind = kind_in(header.comments, name);
  if (data.kind == DataKind::unknown)
    data.kind = kind_in({end_of_faces, static_cast<std::size_t>(at.end() - end_of_faces)}, name);
  return data;
}

}  // namespace delone::io
