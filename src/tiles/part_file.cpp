// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/part_file.hpp"

#include "base/require_dimension.hpp"
#include "io/atomic_file.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/write_npy.hpp"
#include "io/zip.hpp"
#include "tiles/file_content.hpp"
#include "tiles/npy_items.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <utility>

namespace delone::tiles {

namespace {

/// The arrays of a part, one after the other, without a copy of any.
class PartWriter {
 public:
  explicit PartWriter(io::AtomicFile& file) : zip_(file) {}

  template <class T>
  void add(const char* name, std::span<const T> items, std::initializer_list<std::size_t> shape) {
    const std::string header = io::npy_header(npy_type<T>, shape);
    zip_.add(std::string(name) + ".npy", header, io::little_endian_bytes(items, storage_));
  }
  template <class T>
  void add(const char* name, const std::vector<T>& items, std::initializer_list<std::size_t> shape) {
    add(name, std::span<const T>(items), shape);
  }
  void number(const char* name, std::int64_t value) {
    add(name, std::span<const std::int64_t>(&value, 1), {});
  }
  void finish() { zip_.finish(); }

 private:
  io::ZipWriter zip_;
  std::string storage_;
};

/// The arrays of a part by name.
class PartReader {
 public:
  PartReader(const std::string& path, const std::optional<io::FileContent>& expected)
      : name_(io::input_name(path)), bytes_(read(path, expected)), zip_(bytes_.view(), name_) {}

  bool has(const std::string& member) const {
    return std::any_of(zip_.members().begin(), zip_.members().end(),
                       [&](const io::ZipMember& m) { return m.name == member + ".npy"; });
  }
  /// A matrix of so many columns, or with `columns` = 0 a vector. A matrix may have no rows.
  template <class T>
  std::vector<T> read(const char* member, std::size_t columns = 0) const {
    const io::NpyArray array = parse(member);
    std::vector<T> items = npy_items<T>(array, columns == 0 ? 1 : 2, about(member));
    if (columns != 0 && array.shape[1] != columns)
      io::fail(Errc::bad_format, "{}: expected {} columns, found shape {}", about(member), columns,
               io::shape_text(array.shape));
    return items;
  }
  /// m×(k+1)·r numbers, and r.
  std::vector<std::int32_t> read_offsets(const char* member, std::size_t cells, std::size_t corners,
                                         int& rank) const {
    const io::NpyArray array = parse(member);
    std::vector<std::int32_t> items = npy_items<std::int32_t>(array, 2, about(member));
    const std::size_t r = array.shape[1] / corners;
    if (array.shape[0] != cells || array.shape[1] % corners != 0 || r < 1 || r > internal::largest_dimension)
      io::fail(Errc::bad_format, "{}: expected offsets of {} cells of {} vertices, found shape {}",
               about(member), cells, corners, io::shape_text(array.shape));
    rank = static_cast<int>(r);
    return items;
  }
  std::int64_t number(const char* member, std::int64_t least, std::int64_t largest) const {
    const std::vector<std::int64_t> items = npy_items<std::int64_t>(parse(member), 0, about(member));
    if (items[0] < least || items[0] > largest)
      io::fail(Errc::bad_format, "{}: expected a number from {} to {}, found {}", about(member), least,
               largest, items[0]);
    return items[0];
  }
  std::string about(const char* member) const { return name_ + ": " + member; }

 private:
  io::Bytes read(const std::string& path, const std::optional<io::FileContent>& expected) const {
    io::Bytes bytes =
        io::read_all(path, 0, [this](std::string_view opening, bool) { io::require_zip(opening, name_); });
    if (expected) require_content(bytes.view(), *expected, name_);
    return bytes;
  }
  io::NpyArray parse(const char* member) const {
    const auto bytes = zip_.find(std::string(member) + ".npy");
    if (!bytes) io::fail(Errc::bad_format, "{}: there is no member '{}'", name_, member);
    return io::parse_npy(*bytes, about(member));
  }

  std::string name_;
  io::Bytes bytes_;
  io::ZipReader zip_;
};

template <class T>
void require_size(const std::vector<T>& items, std::size_t expected, const std::string& what) {
  if (items.size() != expected)
    io::fail(Errc::bad_format, "{}: expected {} numbers, as of the other arrays, found {}", what, expected,
             items.size());
}

/// Throws bad_format for the first item that is outside [least, largest].
template <class T>
void require_range(const std::vector<T>& items, std::int64_t least, std::int64_t largest, std::size_t columns,
                   const std::string& what) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i] < least || items[i] > largest)
      io::fail(Errc::bad_format, "{}: row {}: expected a number from {} to {}, found {}", what, i / columns,
               least, largest, items[i]);
}

void require_finite(const std::vector<double>& items, std::size_t columns, const std::string& what) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (!std::isfinite(items[i]))
      io::fail(Errc::bad_format, "{}: row {}: a number that is not finite", what, i / columns);
}

/// Entries of seams are −2, −3, …, each once.
void require_seams(const std::vector<std::int32_t>& neighbors, std::size_t corners, const std::string& what) {
  std::vector<bool> seen(static_cast<std::size_t>(
      std::count_if(neighbors.begin(), neighbors.end(), [](auto n) { return n < -1; })));
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    if (neighbors[i] >= -1) continue;
    const auto seam = static_cast<std::size_t>(-2 - static_cast<std::int64_t>(neighbors[i]));
    if (seam >= seen.size() || seen[seam])
      io::fail(Errc::bad_format, "{}: row {}: the number {} of a seam, of which there are {}, is {}", what,
               i / corners, seam, seen.size(), seam >= seen.size() ? "too large" : "there twice");
    seen[seam] = true;
  }
}

/// Gives a file its name, unless it should have become another one.
io::FileContent commit(io::AtomicFile& file, const std::optional<io::FileContent>& expected) {
  const io::FileContent content = file.content();
  if (expected && content != *expected)
    io::fail(Errc::bad_format,
             "{}: made again, it differs from what index.json says; make all tiles again with resume off",
             file.name());
  file.commit();
  return content;
}

constexpr std::int64_t largest_row = std::numeric_limits<std::int64_t>::max() - 1;

}  // namespace

std::string part_name(std::size_t number) { return fmt::format("part-{:04}.npz", number); }
std::string seams_name(std::size_t number) { return fmt::format("part-{:04}.seams.npy", number); }

std::string path_in(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

io::FileContent write_part(const std::string& folder, std::size_t number, const TileData& data,
                           const std::optional<io::FileContent>& expected) {
  const std::string path = path_in(folder, part_name(number));
  return io::guarded(io::output_name(path), [&] {
    io::AtomicFile file(path);
    file.track_content();
    PartWriter writer(file);
    const std::size_t v = data.num_points(), d = static_cast<std::size_t>(data.dimension),
                      m = data.num_cells(), corners = static_cast<std::size_t>(data.affine_dimension + 1);
    writer.number("dimension", data.dimension);
    writer.number("affine_dimension", data.affine_dimension);
    writer.add("rows", data.rows, {v});
    writer.add("points", data.points, {v, d});
    if (!data.weights.empty()) writer.add("weights", data.weights, {v});
    writer.add("cells", data.cells, {m, corners});
    if (data.rank > 0)
      writer.add("cell_offsets", data.cell_offsets, {m, corners * static_cast<std::size_t>(data.rank)});
    writer.add("neighbors", data.neighbors, {m, corners});
    writer.add("own_rows", data.own_rows, {data.own_rows.size()});
    writer.add("vertex_of_row", data.vertex_of_row, {data.own_rows.size()});
    writer.finish();
    return commit(file, expected);
  });
}

io::FileContent write_seams(const std::string& folder, std::size_t number,
                            std::span<const std::int64_t> seams, std::size_t rank,
                            const std::optional<io::FileContent>& expected) {
  const std::string path = path_in(folder, seams_name(number));
  return io::guarded(io::output_name(path), [&] {
    io::AtomicFile file(path);
    file.track_content();
    std::string storage;
    file.write(rank == 0 ? io::npy_header(npy_type<std::int64_t>, {seams.size()})
                         : io::npy_header(npy_type<std::int64_t>, {seams.size() / (1 + rank), 1 + rank}));
    file.write(io::little_endian_bytes(seams, storage));
    return commit(file, expected);
  });
}

TileData read_part(const std::string& folder, std::size_t number,
                   const std::optional<io::FileContent>& expected) {
  const std::string path = path_in(folder, part_name(number));
  return io::guarded(io::input_name(path), [&] {
    const PartReader part(path, expected);
    TileData data;
    data.dimension = static_cast<int>(part.number("dimension", 1, internal::largest_dimension));
    data.affine_dimension = static_cast<int>(part.number("affine_dimension", -1, data.dimension));
    const auto d = static_cast<std::size_t>(data.dimension);
    const auto corners = static_cast<std::size_t>(data.affine_dimension + 1);
    data.rows = part.read<std::int64_t>("rows");
    const std::size_t v = data.rows.size();
    require_range(data.rows, 0, largest_row, 1, part.about("rows"));
    data.points = part.read<double>("points", d);
    require_size(data.points, v * d, part.about("points"));
    require_finite(data.points, d, part.about("points"));
    if (part.has("weights")) {
      data.weights = part.read<double>("weights");
      require_size(data.weights, v, part.about("weights"));
      require_finite(data.weights, 1, part.about("weights"));
    }
    if (corners > 0) {
      data.cells = part.read<std::int32_t>("cells", corners);
      require_range(data.cells, 0, static_cast<std::int64_t>(v) - 1, corners, part.about("cells"));
      data.neighbors = part.read<std::int32_t>("neighbors", corners);
      require_size(data.neighbors, data.cells.size(), part.about("neighbors"));
      require_range(data.neighbors, std::numeric_limits<std::int32_t>::min(),
                    static_cast<std::int64_t>(data.num_cells()) - 1, corners, part.about("neighbors"));
      require_seams(data.neighbors, corners, part.about("neighbors"));
      if (part.has("cell_offsets"))
        data.cell_offsets = part.read_offsets("cell_offsets", data.num_cells(), corners, data.rank);
    }
    data.own_rows = part.read<std::int64_t>("own_rows");
    require_range(data.own_rows, 0, largest_row, 1, part.about("own_rows"));
    for (std::size_t i = 1; i < data.own_rows.size(); ++i)
      if (data.own_rows[i - 1] >= data.own_rows[i])
        io::fail(Errc::bad_format, "{}: row {}: {} does not increase", part.about("own_rows"), i,
                 data.own_rows[i]);
    data.vertex_of_row = part.read<std::int64_t>("vertex_of_row");
    require_size(data.vertex_of_row, data.own_rows.size(), part.about("vertex_of_row"));
    require_range(data.vertex_of_row, -1, largest_row, 1, part.about("vertex_of_row"));
    return data;
  });
}

std::size_t count_seams(const TileData& data) {
  return static_cast<std::size_t>(std::count_if(data.neighbors.begin(), data.neighbors.end(),
                                                [](std::int32_t neighbor) { return neighbor < -1; }));
}

void read_seams(const std::string& folder, std::size_t number, std::int64_t first_cell,
                std::int64_t num_cells, TileData& data, const std::optional<io::FileContent>& expected) {
  const std::size_t num_seams = count_seams(data), r = static_cast<std::size_t>(data.rank);
  const std::string path = path_in(folder, seams_name(number)), name = io::input_name(path);
  io::guarded(name, [&] {
    const io::Bytes bytes =
        io::read_all(path, 0, [&](std::string_view opening, bool) { io::require_npy(opening, name); });
    if (expected) require_content(bytes.view(), *expected, name);
    const io::NpyArray array = io::parse_npy(bytes.view(), name);
    std::vector<std::int64_t> numbers = npy_items<std::int64_t>(array, r == 0 ? 1 : 2, name);
    if (array.shape[0] != num_seams || (r > 0 && array.shape[1] != 1 + r))
      io::fail(Errc::bad_format, "{}: expected {} numbers, the seams of {}{}, found {}", name, num_seams,
               part_name(number), r == 0 ? "" : fmt::format(", and {} offsets of each", r),
               r == 0 ? fmt::format("{}", numbers.size()) : "shape " + io::shape_text(array.shape));
    if (r > 0) {
      std::vector<std::int64_t> offsets;
      for (std::size_t at = 0; at < numbers.size(); ++at)
        (at % (1 + r) == 0 ? data.seams : offsets).push_back(numbers[at]);
      require_range(offsets, std::numeric_limits<std::int32_t>::min(),
                    std::numeric_limits<std::int32_t>::max(), r, name);
      data.seam_offsets.assign(offsets.begin(), offsets.end());
    } else {
      data.seams = std::move(numbers);
    }
    require_range(data.seams, -1, num_cells - 1, 1, name);
    if (r > 0) return;
    for (std::size_t s = 0; s < num_seams; ++s)
      if (data.seams[s] >= first_cell &&
          data.seams[s] < first_cell + static_cast<std::int64_t>(data.num_cells()))
        io::fail(Errc::bad_format, "{}: row {}: the cell {} is of the part itself", name, s, data.seams[s]);
  });
}

TileData read_tile_of(const std::string& folder, const TilesIndex& index, std::size_t i) {
  const TilePart& part = index.parts.at(i);
  TileData data = read_part(folder, i, content_of_part(part));
  const std::string name = io::input_name(path_in(folder, part_name(i)));
  const auto expect = [&](const char* what, std::int64_t found, std::int64_t expected) {
    if (found != expected)
      io::fail(Errc::bad_format, "{}: {}: found {}, but index.json says {}", name, what, found, expected);
  };
  expect("dimension", data.dimension, index.dimension);
  expect("affine_dimension", data.affine_dimension, index.affine_dimension);
  expect("cells", static_cast<std::int64_t>(data.num_cells()), part.num_cells);
  expect("own_rows", static_cast<std::int64_t>(data.own_rows.size()), part.num_points);
  if (data.num_points() > 0) expect("weights", data.weights.empty() ? 0 : 1, index.weighted ? 1 : 0);
  require_range(data.rows, 0, index.num_points - 1, 1, name + ": rows");
  require_range(data.own_rows, 0, index.num_points - 1, 1, name + ": own_rows");
  require_range(data.vertex_of_row, index.weighted ? -1 : 0, index.num_points - 1, 1,
                name + ": vertex_of_row");
  if (data.rank == 0) data.rank = index.lattice.rank();  // a part without cells does not say
  expect("cell_offsets", data.rank, index.lattice.rank());
  require_size(data.cell_offsets, data.cells.size() * static_cast<std::size_t>(data.rank),
               name + ": cell_offsets");
  read_seams(folder, i, part.first_cell, index.num_cells, data, content_of_seams(part));
  return data;
}

}  // namespace delone::tiles
