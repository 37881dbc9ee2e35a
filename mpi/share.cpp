// SPDX-License-Identifier: BSD-3-Clause
#include "share.hpp"

#include "io/file.hpp"

#include <filesystem>

namespace delone::mpi {

Share::Share(const std::vector<std::string>& files, const Ranks& ranks, const TilesOptions& options) {
  tiles::StreamOptions how;
  how.format = options.format;
  how.dimension = options.columns;
  how.columns = options.coordinates;
  how.last_column = options.weights;
  const auto open = [&](const std::string& file) {
    streams_.push_back(
        io::guarded(io::input_name(file), [&] { return tiles::open_point_stream(file, how); }));
    if (streams_.back()->dimension() != streams_.front()->dimension())
      io::fail(Errc::bad_dimension, "{}: rows have {} numbers, not {}", io::input_name(file),
               streams_.back()->dimension(), streams_.front()->dimension());
  };
  const auto rank = static_cast<std::uint64_t>(ranks.rank()), size = static_cast<std::uint64_t>(ranks.size());
  if (files.size() > 1) {
    for (std::size_t i = files.size() * rank / size; i < files.size() * (rank + 1) / size; ++i)
      open(files[i]);
    return;
  }
  open(files.at(0));
  if (const auto n = streams_[0]->size_hint();
      n && streams_[0]->restrict_to(*n / size * rank + *n % size * rank / size,
                                    *n / size * (rank + 1) + *n % size * (rank + 1) / size))
    return;
  is_dealt_ = true;
  kept_ = rank;
  modulus_ = size;
}

Share::Share(PointsView rows) {
  if (rows.dimension() > 0) streams_.push_back(tiles::stream_of(rows));
}

int Share::dimension() const { return streams_.empty() ? 0 : streams_[0]->dimension(); }

bool Share::next(std::vector<double>& rows) {
  while (stream_ < streams_.size()) {
    if (!streams_[stream_]->next(rows)) {
      ++stream_;
      continue;
    }
    row_ = next_row_;
    next_row_ += static_cast<std::int64_t>(rows.size() / static_cast<std::size_t>(dimension()));
    if (chunk_++ % modulus_ == kept_) return true;
  }
  rows.clear();
  return false;
}

void Share::rewind() {
  for (const auto& stream : streams_) stream->rewind();
  stream_ = 0;
  chunk_ = 0;
  row_ = next_row_ = 0;
}

std::vector<std::string> files_of(const std::vector<std::string>& inputs) {
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    const std::size_t at = input.find("%d");
    if (at == std::string::npos) {
      files.push_back(input);
      continue;
    }
    const auto file = [&](std::size_t number) {
      return input.substr(0, at) + std::to_string(number) + input.substr(at + 2);
    };
    std::error_code ignored;
    std::size_t number = 0;
    for (; std::filesystem::exists(file(number), ignored); ++number) files.push_back(file(number));
    if (number == 0) io::fail(Errc::cannot_open, "{}: there is no file {}", io::input_name(input), file(0));
  }
  if (files.empty()) throw Error(Errc::invalid_argument, "no files of points were given");
  return files;
}

}  // namespace delone::mpi
