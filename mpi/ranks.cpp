// SPDX-License-Identifier: BSD-3-Clause
#include "ranks.hpp"

#include <delone/error.hpp>

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>
#include <utility>

namespace delone::mpi {

namespace {

const char* at(const void* bytes, std::uint64_t offset) { return static_cast<const char*>(bytes) + offset; }
char* at(void* bytes, std::uint64_t offset) { return static_cast<char*>(bytes) + offset; }

/// An exception as numbers and a text.
struct Failure {
  Errc code = Errc::invalid_argument;
  std::string message;
  std::vector<std::uint64_t> rows;

  explicit Failure(const std::exception_ptr& exception) {
    if (!exception) return;
    try {
      std::rethrow_exception(exception);
    } catch (const Error& error) {
      code = error.code();
      message = error.what();
      rows.assign(error.rows().begin(), error.rows().end());
    } catch (const std::bad_alloc&) {
      code = Errc::out_of_memory;
      message = "not enough memory";
    } catch (const std::exception& error) {
      message = error.what();
    }
  }
};

}  // namespace

Ranks::Ranks(MPI_Comm others, std::uint64_t piece_bytes) : piece_bytes_(piece_bytes) {
  MPI_Comm_dup(others, &comm_);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}
Ranks::~Ranks() { MPI_Comm_free(&comm_); }

int Ranks::num_neighbors() const {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
  int size = 1;
  MPI_Comm_size(machine, &size);
  MPI_Comm_free(&machine);
  return size;
}

std::int64_t Ranks::sum(std::int64_t number) const {
  MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_INT64_T, MPI_SUM, comm_);
  return number;
}
std::uint64_t Ranks::sum_of_words(std::uint64_t word) const {
  MPI_Allreduce(MPI_IN_PLACE, &word, 1, MPI_UINT64_T, MPI_SUM, comm_);
  return word;
}
std::int64_t Ranks::max(std::int64_t number) const {
  MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_INT64_T, MPI_MAX, comm_);
  return number;
}
double Ranks::max_real(double number) const {
  MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return number;
}
std::vector<std::int64_t> Ranks::max(std::vector<std::int64_t> numbers) const {
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_INT64_T, MPI_MAX, comm_);
  return numbers;
}
std::int64_t Ranks::sum_before(std::int64_t number) const {
  std::int64_t before = 0;
  MPI_Exscan(&number, &before, 1, MPI_INT64_T, MPI_SUM, comm_);
  return rank_ == 0 ? 0 : before;  // MPI leaves that of rank 0 undefined
}
void Ranks::barrier() const { MPI_Barrier(comm_); }

std::uint64_t Ranks::broadcast_size(std::uint64_t size) const {
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, comm_);
  return size;
}
void Ranks::broadcast_bytes(void* bytes, std::size_t size) const {
  for (std::uint64_t done = 0; done < size; done += piece_bytes_)
    MPI_Bcast(at(bytes, done), static_cast<int>(std::min<std::uint64_t>(size - done, piece_bytes_)), MPI_BYTE,
              0, comm_);
}
void Ranks::broadcast(std::string& text) const {
  std::vector<char> characters(text.begin(), text.end());
  broadcast(characters);
  text.assign(characters.begin(), characters.end());
}

std::vector<std::uint64_t> Ranks::gather_sizes(std::uint64_t size) const {
  std::vector<std::uint64_t> sizes(static_cast<std::size_t>(size_));
  MPI_Allgather(&size, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, comm_);
  return sizes;
}
void Ranks::gather_bytes(const void* mine, const std::vector<std::uint64_t>& sizes, void* all) const {
  std::uint64_t bytes = 0;
  for (const std::uint64_t size : sizes) bytes += size;
  if (bytes <= piece_bytes_) {
    std::vector<int> counts, places;
    int place = 0;
    for (const std::uint64_t size : sizes) {
      places.push_back(place);
      counts.push_back(static_cast<int>(size));
      place += counts.back();
    }
    MPI_Allgatherv(mine, counts[static_cast<std::size_t>(rank_)], MPI_BYTE, all, counts.data(), places.data(),
                   MPI_BYTE, comm_);
    return;
  }
  std::uint64_t place = 0;
  for (std::size_t r = 0; r < sizes.size(); place += sizes[r++]) {
    if (static_cast<int>(r) == rank_ && sizes[r] > 0) std::memcpy(at(all, place), mine, sizes[r]);
    for (std::uint64_t done = 0; done < sizes[r]; done += piece_bytes_)
      MPI_Bcast(at(all, place + done), static_cast<int>(std::min(sizes[r] - done, piece_bytes_)), MPI_BYTE,
                static_cast<int>(r), comm_);
  }
}

std::vector<std::uint64_t> Ranks::exchange_sizes(const std::vector<std::uint64_t>& sizes) const {
  std::vector<std::uint64_t> in(sizes.size());
  MPI_Alltoall(sizes.data(), 1, MPI_UINT64_T, in.data(), 1, MPI_UINT64_T, comm_);
  return in;
}
void Ranks::exchange_bytes(const std::vector<const void*>& from, const std::vector<std::uint64_t>& sizes_out,
                           const std::vector<void*>& to, const std::vector<std::uint64_t>& sizes_in) {
  constexpr int tag = 1;  // pieces between two ranks arrive in their order
  std::vector<MPI_Request> requests;
  const auto for_pieces = [&](std::uint64_t size, const auto& each) {
    for (std::uint64_t done = 0; done < size; done += piece_bytes_) {
      requests.push_back(MPI_REQUEST_NULL);
      each(done, static_cast<int>(std::min(size - done, piece_bytes_)), &requests.back());
    }
  };
  for (int r = 0; r < size_; ++r) {
    const auto i = static_cast<std::size_t>(r);
    if (r == rank_) continue;
    for_pieces(sizes_in[i], [&](std::uint64_t done, int size, MPI_Request* request) {
      MPI_Irecv(at(to[i], done), size, MPI_BYTE, r, tag, comm_, request);
    });
    bytes_received_ += static_cast<std::int64_t>(sizes_in[i]);
  }
  for (int step = 1; step < size_; ++step) {  // not all to the same rank first
    const int r = (rank_ + step) % size_;
    const auto i = static_cast<std::size_t>(r);
    for_pieces(sizes_out[i], [&](std::uint64_t done, int size, MPI_Request* request) {
      MPI_Isend(at(from[i], done), size, MPI_BYTE, r, tag, comm_, request);
      ++num_messages_;
    });
    bytes_sent_ += static_cast<std::int64_t>(sizes_out[i]);
  }
  const auto self = static_cast<std::size_t>(rank_);
  if (sizes_out[self] > 0) std::memcpy(to[self], from[self], sizes_out[self]);
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

void Ranks::abort(const char* message) const {
  std::fprintf(stderr, "delone: rank %d: %s\n", rank_, message);
  MPI_Abort(comm_, 3);
  std::abort();  // not reached
}

void Ranks::raise(const std::exception_ptr& failure) const {
  // The lowest rank that failed, and how many did.
  const std::int64_t first = min(failure ? rank_ : std::numeric_limits<int>::max());
  if (first == std::numeric_limits<int>::max()) return;
  const bool all_failed = sum(failure ? 1 : 0) == size_;  // as all see the same input
  Failure mine(first == rank_ ? failure : nullptr);
  // In these gatherings all other ranks have nothing.
  const std::vector<char> message = gather(std::span<const char>(mine.message.data(), mine.message.size()));
  const std::vector<std::uint64_t> rows = gather(mine.rows);
  const auto code = static_cast<Errc>(max(first == rank_ ? static_cast<std::int64_t>(mine.code) : -1));
  std::string text(message.begin(), message.end());
  if (!all_failed) text = "rank " + std::to_string(first) + ": " + text;
  has_raised_ = true;
  throw Error(code, text, {rows.begin(), rows.end()});
}

}  // namespace delone::mpi
