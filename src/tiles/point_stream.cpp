// SPDX-License-Identifier: BSD-3-Clause
// Rows of points in chunks. See point_stream.hpp.
#include "tiles/point_stream.hpp"

#include "base/platform_files.hpp"
#include "base/progress_meter.hpp"
#include "base/random.hpp"
#include "io/collect.hpp"
#include "io/file.hpp"
#include "io/gzip.hpp"
#include "io/npy.hpp"
#include "io/points/read_points.hpp"
#include "io/points/text_rows.hpp"
#include "io/positioned_file.hpp"
#include "io/text_cursor.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <random>
#include <utility>

namespace delone::tiles {

namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 20;
/// The longest row of a text, and the line ends and comments around it.
constexpr std::size_t longest_row = std::size_t{1} << 26;

io::ColumnChoice choice_of(const StreamOptions& options) {
  io::ColumnChoice choice{.wanted = options.columns, .last = {}, .last_name = "weights"};
  if (!options.last_column.empty()) choice.last.push_back(options.last_column);
  return choice;
}

/// A file under `path`, which messages call `name`, removed at the end if it is a copy.
struct Source {
  std::string path, name;
  bool is_copy = false;
};

class FileStream : public PointStream {
 public:
  explicit FileStream(const Source& source)
      : source_(source), file_(source.path, io::PositionedFile::Mode::read, source.name) {}
  ~FileStream() override {
    if (source_.is_copy) platform::remove_file(source_.path);
  }

 protected:
  const io::PositionedFile& file() const { return file_; }
  const std::string& name() const { return file_.name(); }

 private:
  Source source_;
  io::PositionedFile file_;
};

/// Numbers of one type, one row after the other, or one column after the other: npy and raw.
class BinaryStream final : public FileStream {
 public:
  BinaryStream(const Source& source, io::NpyArray array, std::uint64_t data_begin)
      : FileStream(source), array_(std::move(array)), data_begin_(data_begin) {
    num_rows_ = last_ = array_.shape[0];
    width_ = array_.shape.size() == 1 ? 1 : array_.shape[1];
    rows_per_chunk_ = std::max<std::size_t>(chunk_bytes / sizeof(double) / width_, 1);
  }
  int dimension() const override { return static_cast<int>(width_); }
  std::optional<std::uint64_t> size_hint() const override { return last_ - first_; }
  void rewind() override { row_ = first_; }
  bool restrict_to(std::uint64_t first, std::uint64_t last) override {
    first_ = row_ = static_cast<std::size_t>(first);
    last_ = static_cast<std::size_t>(last);
    return true;
  }

  bool next(std::vector<double>& rows) override {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(rows_per_chunk_, last_ - row_));
    rows.clear();
    if (count == 0) return false;
    const std::size_t item = array_.item_size;
    if (is_native()) {
      rows.resize(count * width_);
      file().read(data_begin_ + row_ * width_ * item, rows.data(), rows.size() * item);
    } else {
      bytes_.resize(count * width_ * item);
      if (array_.fortran_order && width_ > 1) {
        for (std::size_t column = 0; column < width_; ++column)
          file().read(data_begin_ + (column * num_rows_ + row_) * item, bytes_.data() + column * count * item,
                      count * item);
      } else {
        file().read(data_begin_ + row_ * width_ * item, bytes_.data(), bytes_.size());
      }
      io::NpyArray chunk = array_;
      chunk.shape = {count, width_};
      chunk.data = bytes_;
      rows = io::to_doubles(chunk, name(), row_);
    }
    io::require_finite(rows, dimension(), name(), {}, row_);
    row_ += count;
    return true;
  }

 private:
  bool is_native() const {
    return array_.kind == 'f' && array_.item_size == sizeof(double) && !array_.big_endian &&
           (!array_.fortran_order || width_ == 1) && std::endian::native == std::endian::little;
  }

  io::NpyArray array_;  // without data
  std::uint64_t data_begin_;
  std::size_t num_rows_ = 0, first_ = 0, last_ = 0, row_ = 0, width_ = 0, rows_per_chunk_ = 0;
  std::string bytes_;
};

std::unique_ptr<PointStream> open_npy(const Source& source) {
  const io::PositionedFile file(source.path, io::PositionedFile::Mode::read, source.name);
  const std::uint64_t size = file.size();
  std::string opening(static_cast<std::size_t>(std::min<std::uint64_t>(size, io::largest_npy_header)), '\0');
  opening.resize(file.read_some(0, opening.data(), opening.size()));
  auto [array, data_begin] = io::parse_npy_opening(opening, static_cast<std::size_t>(size), file.name());
  if (array.shape.empty())
    io::fail(Errc::bad_format, "{}: a single number; expected an array of shape (n, d)", file.name());
  const std::size_t width = array.shape.size() == 1 ? 1 : array.shape[1];
  if (width == 0 || width > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    io::fail(Errc::bad_dimension, "{}: shape {}: the dimension is {}", file.name(),
             io::shape_text(array.shape), width == 0 ? "0" : "too large");
  return std::make_unique<BinaryStream>(source, std::move(array), data_begin);
}

std::unique_ptr<PointStream> open_raw(const Source& source, int dimension) {
  if (dimension < 1)
    io::fail(Errc::bad_dimension,
             "{}: a raw file does not tell how many numbers a row has; name the dimension", source.name);
  const std::uint64_t size =
      io::PositionedFile(source.path, io::PositionedFile::Mode::read, source.name).size();
  const std::uint64_t row_bytes = static_cast<std::uint64_t>(dimension) * sizeof(double);
  if (size % row_bytes != 0)
    io::fail(Errc::bad_format, "{}: {} bytes are not a multiple of {}, those of a row of {} double{}",
             source.name, size, row_bytes, dimension, dimension == 1 ? "" : "s");
  io::NpyArray array;
  array.shape = {static_cast<std::size_t>(size / row_bytes), static_cast<std::size_t>(dimension)};
  return std::make_unique<BinaryStream>(source, std::move(array), 0);
}

/// csv, tsv, white space separated rows, and Qhull's form.
class TextStream final : public FileStream {
 public:
  TextStream(const Source& source, std::string format, const StreamOptions& options)
      : FileStream(source), format_(std::move(format)), choice_(choice_of(options)) {
    // The width is that of the first row or header.
    begin();
    std::vector<double> rows;
    while (reader_->width() == 0 && next(rows)) {
    }
    width_ = reader_->width();
    begin();
  }
  int dimension() const override { return static_cast<int>(width_); }
  std::optional<std::uint64_t> size_hint() const override { return {}; }
  void rewind() override { begin(); }

  bool next(std::vector<double>& rows) override {
    rows.clear();
    while (rows.empty() && !is_done_) {
      internal::cancellation_point();
      fetch();
      io::PointCollector collector;
      collector.table.dimension = dimension_so_far();
      collector.table.coordinates = std::move(rows);
      const std::string_view piece = std::string_view(text_).substr(0, whole_lines());
      const std::size_t size = piece.empty() && !at_end_ ? 0 : reader_->read(piece, at_end_, collector);
      collector.table.dimension = dimension_so_far();
      rows = collector.finish(row_).coordinates;
      text_.erase(0, size);
      is_done_ = at_end_;
      wanted_ = size == 0 ? 2 * wanted_ : chunk_bytes / 2;
      if (wanted_ > longest_row)
        io::fail(Errc::bad_format, "{}: row {} has more than {} bytes", name(), row_, longest_row);
    }
    if (reader_->width() > 0) row_ += rows.size() / reader_->width();
    return !rows.empty();
  }

 private:
  void begin() {
    reader_ = io::open_text_rows(format_, name(), choice_);
    text_.clear();
    offset_ = 0;
    row_ = 0;
    wanted_ = chunk_bytes / 2;
    at_end_ = is_done_ = false;
  }
  int dimension_so_far() const { return std::max(static_cast<int>(reader_->width()), 1); }

  /// Reads until there are as many bytes as are wanted, or the file ends.
  void fetch() {
    const std::size_t before = text_.size();
    if (before >= wanted_) return;
    text_.resize(wanted_);
    const std::size_t found = file().read_some(offset_, text_.data() + before, wanted_ - before);
    text_.resize(before + found);
    at_end_ = text_.size() < wanted_;
    if (offset_ == 0) io::require_text(std::string_view(text_).substr(0, std::size_t{1} << 16), name());
    offset_ += found;
  }
  /// The size of the text up to the last line end; of all text at the end of the file. A CR that may be half
  /// of a line end is not one.
  std::size_t whole_lines() const {
    if (at_end_) return text_.size();
    const std::size_t line_feed = text_.rfind('\n');
    if (line_feed != std::string::npos) return line_feed + 1;
    const std::size_t carriage_return =
        text_.size() < 2 ? std::string::npos : text_.rfind('\r', text_.size() - 2);
    return carriage_return == std::string::npos ? 0 : carriage_return + 1;
  }

  const std::string format_;
  const io::ColumnChoice choice_;
  std::unique_ptr<io::TextRows> reader_;
  std::string text_;  // read, and not yet parsed
  std::uint64_t offset_ = 0;
  std::size_t row_ = 0, wanted_ = 0, width_ = 0;
  bool at_end_ = false;   // nothing follows the text
  bool is_done_ = false;  // and it has been parsed
};

/// Points in memory.
class MemoryStream final : public PointStream {
 public:
  explicit MemoryStream(PointsView points) : points_(points) {}
  explicit MemoryStream(PointTable table)
      : table_(std::move(table)), points_(table_.coordinates, table_.dimension) {}
  int dimension() const override { return points_.dimension(); }
  std::optional<std::uint64_t> size_hint() const override { return points_.size(); }
  void rewind() override { at_ = 0; }

  bool next(std::vector<double>& rows) override {
    const auto width = static_cast<std::size_t>(points_.dimension());
    const std::size_t chunk =
        std::max<std::size_t>(chunk_bytes / sizeof(double) / std::max<std::size_t>(width, 1), 1);
    const std::size_t last = std::min(at_ + chunk, points_.size());
    const double* const values = points_.data();
    rows.assign(values + at_ * width, values + last * width);
    io::require_finite(rows, points_.dimension(), "the points", {}, at_);
    at_ = last;
    return !rows.empty();
  }

 private:
  PointTable table_;
  PointsView points_;
  std::size_t at_ = 0;  // a row
};

/// Some columns of another stream, by their numbers.
class SelectedColumns final : public PointStream {
 public:
  SelectedColumns(std::unique_ptr<PointStream> all, const StreamOptions& options, const std::string& name)
      : all_(std::move(all)), columns_(io::choose_columns(choice_of(options), {}, width(), name).columns) {}
  int dimension() const override { return static_cast<int>(columns_.size()); }
  std::optional<std::uint64_t> size_hint() const override { return all_->size_hint(); }
  void rewind() override { all_->rewind(); }
  bool restrict_to(std::uint64_t first, std::uint64_t last) override {
    return all_->restrict_to(first, last);
  }

  bool next(std::vector<double>& rows) override {
    rows.clear();
    if (!all_->next(whole_rows_)) return false;
    rows.reserve(whole_rows_.size() / width() * columns_.size());
    for (std::size_t row = 0; row < whole_rows_.size(); row += width())
      for (const std::size_t column : columns_) rows.push_back(whole_rows_[row + column]);
    return true;
  }

 private:
  std::size_t width() const { return static_cast<std::size_t>(all_->dimension()); }

  std::unique_ptr<PointStream> all_;
  const std::vector<std::size_t> columns_;
  std::vector<double> whole_rows_;
};

/// Raw numbers may begin with any bytes: whether they are compressed is told by the name alone.
bool is_raw(std::string_view format) { return format == "raw" || format == "bin"; }

/// Whether a regular file is compressed, so that it can be read from its beginning only.
bool is_compressed(const std::string& format, const std::string& path) {
  if (is_raw(format)) return io::has_gzip_name(path);
  const io::PositionedFile file(path);
  char opening[2] = {};
  return io::is_gzip({opening, file.read_some(0, opening, sizeof opening)});
}

/// Copies a stream to a file, decompressed, as it cannot be read twice.
Source copied(const std::string& format, const std::string& path, const StreamOptions& options) {
  namespace fs = std::filesystem;
  const std::string name = io::input_name(path);
  if (options.scratch_folder.empty())
    io::fail(Errc::unsupported, "{}: a stream cannot be read twice; save it as a file, decompressed", name);
  struct Close {
    void operator()(std::FILE* file) const {
      if (file != stdin) std::fclose(file);
    }
  };
  errno = 0;
  const std::unique_ptr<std::FILE, Close> from(path == "-" ? stdin : platform::open_file(path, "rb"));
  if (!from) io::fail(Errc::cannot_open, "{}: {}", name, io::error_text(errno));
  if (path == "-") platform::pass_bytes(stdin);
  const std::uint64_t tag =
      random::mix((std::uint64_t{std::random_device{}()} << 32) + std::random_device{}());
  Source copy{(fs::path(options.scratch_folder) / fmt::format(".delone-partial-{:016x}", tag)).string(), name,
              true};
  try {
    io::PositionedFile to(copy.path, io::PositionedFile::Mode::write);
    const io::ReadBytes as_it_is = [&](char* bytes, std::size_t size) {
      errno = 0;
      const std::size_t found = std::fread(bytes, 1, size, from.get());
      if (std::ferror(from.get()) != 0) io::fail(Errc::cannot_open, "{}: {}", name, io::error_text(errno));
      return found;
    };
    const io::ReadBytes read = !is_raw(format)           ? io::maybe_decompressed(as_it_is, name)
                               : io::has_gzip_name(path) ? io::decompressed(as_it_is, name)
                                                         : as_it_is;
    std::string piece(chunk_bytes, '\0');
    for (std::uint64_t size = 0;;) {
      internal::cancellation_point();
      const std::size_t found = read(piece.data(), piece.size());
      if (found == 0) break;
      to.write(size, piece.data(), found);
      size += found;
    }
    to.close();
  } catch (...) {
    platform::remove_file(copy.path);
    throw;
  }
  return copy;
}

std::unique_ptr<PointStream> open_format(const std::string& format, const std::string& path,
                                         const StreamOptions& options) {
  namespace fs = std::filesystem;
  if (format == "off" || format == "ply" || format == "pdb" || format == "las") {
    ReadOptions reading;
    reading.format = format;
    if (format == "ply" && !options.columns.empty()) {
      reading.columns = options.columns;
      if (!options.last_column.empty()) reading.columns.push_back(options.last_column);
    }
    reading.max_stream_bytes = options.max_stream_bytes;
    return std::make_unique<MemoryStream>(read_points(path, reading));
  }
  std::error_code ignored;
  const bool is_stream = path == "-" ||
                         (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored) &&
                          !fs::is_directory(path, ignored)) ||
                         (fs::is_regular_file(path, ignored) && is_compressed(format, path));
  const Source source = is_stream ? copied(format, path, options) : Source{path, io::input_name(path)};
  try {
    if (format == "npy") return open_npy(source);
    if (is_raw(format)) return open_raw(source, options.dimension);
    return std::make_unique<TextStream>(source, format, options);
  } catch (...) {
    if (source.is_copy) platform::remove_file(source.path);
    throw;
  }
}

}  // namespace

std::unique_ptr<PointStream> open_point_stream(const std::string& path, const StreamOptions& options) {
  io::refuse_folder(path, "a file of points");
  const std::string format = io::choose_format(
      path, options.format, "qhull",
      {"npy", "raw", "bin", "csv", "tsv", "txt", "xyz", "pts", "dat", "off", "ply", "pdb", "las", "qhull"},
      io::Use::reading, "points");
  return io::guarded(io::input_name(path), [&] {
    std::unique_ptr<PointStream> points = open_format(format, path, options);
    // Of these formats the readers have selected columns, by their names.
    const bool is_selected =
        format == "csv" || format == "tsv" || (format == "ply" && !options.columns.empty());
    if (!is_selected && !(options.columns.empty() && options.last_column.empty()))
      return std::unique_ptr<PointStream>(
          std::make_unique<SelectedColumns>(std::move(points), options, io::input_name(path)));
    if (options.dimension != 0 && points->dimension() != options.dimension)
      io::fail(Errc::bad_dimension, "{}: rows have {} numbers, not {}", io::input_name(path),
               points->dimension(), options.dimension);
    return points;
  });
}

std::unique_ptr<PointStream> stream_of(PointsView rows) { return std::make_unique<MemoryStream>(rows); }

}  // namespace delone::tiles
