// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/hdf5_file.hpp"

#include "base/platform_files.hpp"
#include "io/file.hpp"
#include "tiles/part_file.hpp"
#include "tiles/record_buckets.hpp"

#if DELONE_WITH_HDF5
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>
#endif

namespace delone::tiles {

namespace {

constexpr const char* file_name = "tiles.h5";

}  // namespace

#if !DELONE_WITH_HDF5

void require_hdf5(const std::string& folder) {
  io::fail(Errc::unsupported, "{}: this build of delone has no HDF5",
           io::output_name(path_in(folder, file_name)));
}

void write_hdf5(const std::string& folder, const std::string&, const TilesIndex&, std::uint64_t) {
  require_hdf5(folder);
}

#else

namespace {

/// HDF5 prints its errors unless it is told not to; for as long as this is there.
class SilentErrors {
 public:
  SilentErrors() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  SilentErrors(const SilentErrors&) = delete;
  SilentErrors& operator=(const SilentErrors&) = delete;
  ~SilentErrors() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// What an HDF5 identifier stands for, closed at the end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close_by)(hid_t)) : id_(id), close_(close_by) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t id() const { return id_; }
  /// Closes it now; false if that fails.
  bool close() { return close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

template <class T>
hid_t memory_type() {
  return std::is_same_v<T, double> ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
}
template <class T>
hid_t file_type() {
  return std::is_same_v<T, double> ? H5T_IEEE_F64LE : H5T_STD_I64LE;
}

/// A file under another name until it is complete.
class Hdf5File {
 public:
  /// Of `bytes` bytes at most. HDF5 cannot close a file that it could not write to the end, and ends the
  /// program when that is over: so whether there is room is found out before.
  Hdf5File(const std::string& folder, std::uint64_t bytes)
      : target_(path_in(folder, file_name)),
        temporary_(path_in(folder, std::string(".delone-partial-") + file_name)),
        file_(-1, H5Fclose) {
    if (const int error = platform::find_no_room(temporary_.c_str(), bytes); error != 0)
      io::fail(Errc::cannot_write, "{}: {}", io::output_name(target_), io::error_text(error));
    file_ = Handle(H5Fcreate(temporary_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    require(file_.id() >= 0);
  }
  ~Hdf5File() {
    if (file_.id() >= 0) file_.close();
    if (!temporary_.empty()) platform::remove_file(temporary_);
  }

  void require(bool success) const {
    if (!success)
      io::fail(Errc::cannot_write, "{}: HDF5 cannot write the file; is the disk full?",
               io::output_name(target_));
  }
  void attribute(const char* name, std::int64_t value) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(file_.id(), name, H5T_STD_I64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    require(attribute.id() >= 0 && H5Awrite(attribute.id(), H5T_NATIVE_INT64, &value) >= 0);
  }
  void commit() {
    require(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0);
    require(file_.close());
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) io::fail(Errc::cannot_write, "{}: {}", io::output_name(target_), error.message());
    temporary_.clear();
  }
  hid_t id() const { return file_.id(); }

 private:
  std::string target_, temporary_;
  Handle file_;
};

/// More than the file has, by all that is not in its arrays.
std::uint64_t most_bytes(const TilesIndex& index) {
  const auto v = static_cast<std::uint64_t>(index.num_vertices),
             n = static_cast<std::uint64_t>(index.num_points),
             m = static_cast<std::uint64_t>(index.num_cells), d = static_cast<std::uint64_t>(index.dimension),
             corners = static_cast<std::uint64_t>(index.affine_dimension + 1);
  return 8 * (v * (1 + d + (index.weighted ? 1 : 0)) + n + 2 * m * corners) + (std::uint64_t{1} << 16);
}

/// A dataset that is written from its first row on. `columns` = 0: a vector.
template <class T>
class Dataset {
 public:
  Dataset(const Hdf5File& file, const char* name, std::uint64_t rows, std::size_t columns)
      : file_(file), columns_(columns), space_(make_space(rows, columns)), data_(make(name)) {
    file_.require(data_.id() >= 0);
  }
  void append(std::span<const T> items) {
    const std::uint64_t rows = items.size() / std::max<std::size_t>(columns_, 1);
    if (rows == 0) return;
    const std::array<hsize_t, 2> start{next_, 0}, count{rows, columns_};
    const Handle memory = make_space(rows, columns_);
    file_.require(
        H5Sselect_hyperslab(space_.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0 &&
        H5Dwrite(data_.id(), memory_type<T>(), memory.id(), space_.id(), H5P_DEFAULT, items.data()) >= 0);
    next_ += rows;
  }

 private:
  static Handle make_space(std::uint64_t rows, std::size_t columns) {
    const std::array<hsize_t, 2> extent{rows, columns};
    return {H5Screate_simple(columns == 0 ? 1 : 2, extent.data(), nullptr), H5Sclose};
  }
  Handle make(const char* name) const {
    return {H5Dcreate2(file_.id(), name, file_type<T>(), space_.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
            H5Dclose};
  }

  const Hdf5File& file_;
  std::size_t columns_;
  Handle space_, data_;
  hsize_t next_ = 0;
};

/// Vertices and rows, which parts have in any order, dealt into ranges of rows.
class Rows {
 public:
  Rows(const TilesIndex& index, const std::string& work, std::uint64_t memory)
      : n_(index.num_points),
        row_size_(static_cast<std::size_t>(index.dimension) + (index.weighted ? 1 : 0)),
        rows_per_bucket_(rows_in_bucket(memory)),
        vertices_(work + "/hdf5-vertices", bucket_of(std::max<std::int64_t>(n_ - 1, 0)) + 1),
        owned_(work + "/hdf5-rows", vertices_.size()) {}

  void add(const TileData& part) {
    const std::size_t d = static_cast<std::size_t>(part.dimension);
    std::vector<std::int64_t> record(1 + row_size_);
    for (std::size_t v = 0; v < part.rows.size(); ++v) {
      record[0] = part.rows[v];
      for (std::size_t j = 0; j < row_size_; ++j)
        record[1 + j] = std::bit_cast<std::int64_t>(j < d ? part.points[v * d + j] : part.weights[v]);
      vertices_.append(bucket_of(part.rows[v]), record);
    }
    for (std::size_t i = 0; i < part.own_rows.size(); ++i)
      owned_.append(bucket_of(part.own_rows[i]), std::array{part.own_rows[i], part.vertex_of_row[i]});
  }

  void write(const Hdf5File& file, const TilesIndex& index) {
    const auto v = static_cast<std::uint64_t>(index.num_vertices);
    const auto d = static_cast<std::size_t>(index.dimension);
    Dataset<std::int64_t> rows(file, "rows", v, 0),
        vertex_of_row(file, "vertex_of_row", static_cast<std::uint64_t>(n_), 0);
    Dataset<double> points(file, "points", v, d);
    std::optional<Dataset<double> > weights;
    if (index.weighted) weights.emplace(file, "weights", v, 0);
    for (std::size_t bucket = 0; bucket < vertices_.size(); ++bucket) {
      const std::int64_t first = static_cast<std::int64_t>(bucket) * rows_per_bucket_;
      const auto size = static_cast<std::size_t>(std::min(rows_per_bucket_, n_ - first));
      std::vector<std::int64_t> vertex_of(size, -1), found_rows;
      const std::vector<std::int64_t> owned = owned_.take(bucket);
      for (std::size_t i = 0; i < owned.size(); i += 2)
        vertex_of[static_cast<std::size_t>(owned[i] - first)] = owned[i + 1];
      vertex_of_row.append(vertex_of);
      const std::vector<std::int64_t> seen = vertices_.take(bucket);
      std::vector<std::size_t> place(size, seen.size());
      for (std::size_t i = 0; i < seen.size(); i += 1 + row_size_)
        place[static_cast<std::size_t>(seen[i] - first)] = i;
      std::vector<double> coordinates, found_weights;
      for (const std::size_t at : place) {
        if (at == seen.size()) continue;
        found_rows.push_back(seen[at]);
        for (std::size_t j = 0; j < row_size_; ++j)
          (j < d ? coordinates : found_weights).push_back(std::bit_cast<double>(seen[at + 1 + j]));
      }
      rows.append(found_rows);
      points.append(coordinates);
      if (weights) weights->append(found_weights);
    }
  }

 private:
  std::size_t bucket_of(std::int64_t row) const { return static_cast<std::size_t>(row / rows_per_bucket_); }
  std::int64_t rows_in_bucket(std::uint64_t memory) const {
    const std::uint64_t bytes_of_row = 8 * (2 * row_size_ + 6);
    return static_cast<std::int64_t>(std::max<std::uint64_t>(memory / bytes_of_row, 1024));
  }

  std::int64_t n_;
  std::size_t row_size_;
  std::int64_t rows_per_bucket_;
  RecordBuckets vertices_, owned_;
};

void write_all(const std::string& folder, const std::string& work, const TilesIndex& index,
               std::uint64_t memory) {
  const SilentErrors silent;
  Hdf5File file(folder, most_bytes(index));
  const auto corners = static_cast<std::size_t>(index.affine_dimension + 1);
  file.attribute("dimension", index.dimension);
  file.attribute("affine_dimension", index.affine_dimension);
  Rows rows(index, work, memory);
  {
    // A matrix without columns is a vector without numbers.
    const std::uint64_t m = corners == 0 ? 0 : static_cast<std::uint64_t>(index.num_cells);
    Dataset<std::int64_t> cells(file, "cells", m, corners), neighbors(file, "neighbors", m, corners);
    std::vector<std::int64_t> items;
    constexpr std::size_t at_once = std::size_t{1} << 16;  // numbers of a hyperslab, about
    for (std::size_t i = 0; i < index.parts.size(); ++i) {
      const TileData part = read_tile_of(folder, index, i);
      rows.add(part);
      const std::int64_t first_cell = index.parts[i].first_cell;
      const std::size_t step =
          std::max<std::size_t>(at_once / std::max<std::size_t>(corners, 1), 1) * corners;
      for (std::size_t at = 0; at < part.cells.size(); at += step) {
        const std::size_t last = std::min(at + step, part.cells.size());
        items.clear();
        for (std::size_t j = at; j < last; ++j)
          items.push_back(part.rows[static_cast<std::size_t>(part.cells[j])]);
        cells.append(items);
        items.clear();
        for (std::size_t j = at; j < last; ++j) {
          const std::int64_t neighbor = part.neighbors[j];
          items.push_back(neighbor >= 0    ? first_cell + neighbor
                          : neighbor == -1 ? -1
                                           : part.seams[static_cast<std::size_t>(-2 - neighbor)]);
        }
        neighbors.append(items);
      }
    }
  }
  rows.write(file, index);
  file.commit();
}

}  // namespace

void require_hdf5(const std::string&) {}

void write_hdf5(const std::string& folder, const std::string& work, const TilesIndex& index,
                std::uint64_t memory) {
  io::guarded(io::output_name(path_in(folder, file_name)), [&] { write_all(folder, work, index, memory); });
}

#endif

}  // namespace delone::tiles
