// SPDX-License-Identifier: BSD-3-Clause
// What is used of MPI: numbers and arrays of all ranks, exchanges of arrays of any size, and errors that all
// ranks throw together. Arrays are sent as bytes: all processes run on machines of one kind.
#pragma once

#include <delone/arithmetic.hpp>

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace delone::mpi {

/// A communicator of our own with the ranks of another one. All members but the first two are collective.
class Ranks {
 public:
  /// Counts of MPI are ints: larger arrays go in pieces of so many bytes.
  explicit Ranks(MPI_Comm others, std::uint64_t piece_bytes = std::uint64_t{1} << 29);
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  ~Ranks();

  int rank() const { return rank_; }
  int size() const { return size_; }
  /// How many ranks share this machine.
  int num_neighbors() const;

  std::int64_t sum(std::int64_t number) const;
  std::uint64_t sum_of_words(std::uint64_t word) const;  ///< modulo 2^64
  std::int64_t max(std::int64_t number) const;
  double max_real(double number) const;
  std::int64_t min(std::int64_t number) const { return -max(-number); }
  double min_real(double number) const { return -max_real(-number); }
  /// Element by element.
  std::vector<std::int64_t> max(std::vector<std::int64_t> numbers) const;
  /// The sum over the ranks before this one.
  std::int64_t sum_before(std::int64_t number) const;
  void barrier() const;

  /// An array of rank 0, at all ranks.
  template <class T>
  void broadcast(std::vector<T>& items) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::uint64_t size = broadcast_size(items.size());
    items.resize(static_cast<std::size_t>(size));
    broadcast_bytes(items.data(), items.size() * sizeof(T));
  }
  void broadcast(std::string& text) const;

  /// The arrays of all ranks, one after the other, at all ranks.
  template <class T>
  std::vector<T> gather(std::span<const T> items) const {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::vector<std::uint64_t> sizes = gather_sizes(items.size_bytes());
    std::uint64_t bytes = 0;
    for (const std::uint64_t size : sizes) bytes += size;
    std::vector<T> all(static_cast<std::size_t>(bytes / sizeof(T)));
    gather_bytes(items.data(), sizes, all.data());
    return all;
  }
  template <class T>
  std::vector<T> gather(const std::vector<T>& items) const {
    return gather(std::span<const T>(items));
  }

  /// Sends an array to each rank, and returns those of all ranks for this one. Empty ones cost nothing but
  /// the exchange of their sizes; large ones go in pieces.
  template <class T>
  std::vector<std::vector<T>> exchange(const std::vector<std::vector<T>>& to_each) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto p = static_cast<std::size_t>(size_);
    std::vector<std::uint64_t> sizes(p);
    std::vector<const void*> from(p);
    for (std::size_t r = 0; r < p; ++r) sizes[r] = to_each[r].size() * sizeof(T), from[r] = to_each[r].data();
    const std::vector<std::uint64_t> sizes_in = exchange_sizes(sizes);
    std::vector<std::vector<T>> in(p);
    std::vector<void*> to(p);
    for (std::size_t r = 0; r < p; ++r) {
      in[r].resize(static_cast<std::size_t>(sizes_in[r] / sizeof(T)));
      to[r] = in[r].data();
    }
    exchange_bytes(from, sizes, to, sizes_in);
    return in;
  }

  /// Runs work() on every rank. If it throws on any, all ranks throw.
  template <class Work>
  void together(const Work& work) const {
    std::exception_ptr failure;
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    raise(failure);
  }
  /// All ranks throw if any has a failure: that of the lowest such rank.
  void raise(const std::exception_ptr& failure) const;
  /// Runs collective work in the floating-point state of the library. Ends all processes, after a message, if
  /// it throws anything on this rank that the others do not know of: they would wait for this one for ever.
  template <class Work>
  auto guarded(const Work& work) const {
    const ArithmeticScope arithmetic;
    try {
      return work();
    } catch (const std::exception& error) {
      if (!has_raised_) abort(error.what());
      throw;
    }
  }

  /// What exchange() has sent and received so far, what stays at this rank apart.
  std::int64_t num_messages() const { return num_messages_; }
  std::int64_t bytes_sent() const { return bytes_sent_; }
  std::int64_t bytes_received() const { return bytes_received_; }

 private:
  [[noreturn]] void abort(const char* message) const;
  std::uint64_t broadcast_size(std::uint64_t size) const;
  void broadcast_bytes(void* bytes, std::size_t size) const;
  std::vector<std::uint64_t> gather_sizes(std::uint64_t size) const;
  void gather_bytes(const void* mine, const std::vector<std::uint64_t>& sizes, void* all) const;
  std::vector<std::uint64_t> exchange_sizes(const std::vector<std::uint64_t>& sizes) const;
  void exchange_bytes(const std::vector<const void*>& from, const std::vector<std::uint64_t>& sizes_out,
                      const std::vector<void*>& to, const std::vector<std::uint64_t>& sizes_in);

  MPI_Comm comm_ = MPI_COMM_NULL;
  const std::uint64_t piece_bytes_;
  int rank_ = 0, size_ = 1;
  mutable bool has_raised_ = false;
  std::int64_t num_messages_ = 0, bytes_sent_ = 0, bytes_received_ = 0;
};

}  // namespace delone::mpi
