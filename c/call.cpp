// SPDX-License-Identifier: BSD-3-Clause
#include "call.hpp"

#include <delone/config.hpp>

#include <array>
#include <exception>
#include <new>
#include <stdexcept>
#include <vector>

namespace delone::c {
namespace {

constexpr int status_of(Errc code) {
  return code == Errc::time_limit ? DELONE_TIME_LIMIT : static_cast<int>(code) + 1;
}
static_assert(status_of(Errc::not_finite) == DELONE_NOT_FINITE);
static_assert(status_of(Errc::bad_dimension) == DELONE_BAD_DIMENSION);
static_assert(status_of(Errc::too_many) == DELONE_TOO_MANY);
static_assert(status_of(Errc::out_of_memory) == DELONE_OUT_OF_MEMORY);
static_assert(status_of(Errc::cancelled) == DELONE_CANCELLED);
static_assert(status_of(Errc::invalid_argument) == DELONE_INVALID_ARGUMENT);
static_assert(status_of(Errc::cannot_open) == DELONE_CANNOT_OPEN);
static_assert(status_of(Errc::bad_format) == DELONE_BAD_FORMAT);
static_assert(status_of(Errc::cannot_write) == DELONE_CANNOT_WRITE);
static_assert(status_of(Errc::unsupported) == DELONE_UNSUPPORTED);
static_assert(status_of(Errc::time_limit) == DELONE_TIME_LIMIT);

constexpr std::array<const char*, 13> names{
    "ok",          "not_finite",       "bad_dimension", "too_many",   "out_of_memory",
    "cancelled",   "invalid_argument", "cannot_open",   "bad_format", "cannot_write",
    "unsupported", "internal_error",   "time_limit"};

/// What the calls of a thread leave behind.
struct ThreadState {
  std::string message;
  std::vector<std::size_t> rows;
  const char* fixed = nullptr;  // in place of a message for which there was no memory
  delone_progress progress = nullptr;
  void* user_data = nullptr;
  bool is_asking = false;  // the progress function is at work: calls that it makes do not ask it again
};

ThreadState& state() {
  thread_local ThreadState state;
  return state;
}

int remember(int status, const char* message, const std::vector<std::size_t>& rows = {}) noexcept {
  ThreadState& here = state();
  here.fixed = nullptr;
  here.rows.clear();
  try {
    here.message = message;
    here.rows = rows;
  } catch (...) {
    here.fixed = "there is not enough memory, not even for the message of the error";
  }
  return status;
}

}  // namespace

int remember_exception() noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return remember(status_of(error.code()), error.what(), error.rows());
  } catch (const std::bad_alloc&) {
    return remember(DELONE_OUT_OF_MEMORY, "there is not enough memory");
  } catch (const std::length_error&) {
    return remember(DELONE_TOO_MANY, "there is no memory of that size");
  } catch (const std::exception& error) {
    return remember(DELONE_INTERNAL_ERROR, error.what());
  } catch (...) {
    return remember(DELONE_INTERNAL_ERROR, "an exception of an unknown type");
  }
}

std::function<bool(double)> progress_of_thread() {
  const ThreadState& here = state();
  if (here.progress == nullptr) return {};
  return [progress = here.progress, user_data = here.user_data](double fraction) {
    ThreadState& asking = state();
    if (asking.is_asking) return true;
    asking.is_asking = true;
    const bool go_on = progress(fraction, user_data) == 0;
    asking.is_asking = false;
    return go_on;
  };
}

}  // namespace delone::c

using namespace delone::c;

const char* delone_version(void) { return DELONE_VERSION; }

int delone_index_bytes(void) { return static_cast<int>(sizeof(delone::Index)); }

const char* delone_status_name(int status) {
  return status < 0 || static_cast<std::size_t>(status) >= names.size()
             ? "unknown"
             : names[static_cast<std::size_t>(status)];
}

const char* delone_error_message(void) {
  const ThreadState& here = state();
  return here.fixed != nullptr ? here.fixed : here.message.c_str();
}

std::size_t delone_error_rows(const std::size_t** rows) {
  const ThreadState& here = state();
  if (rows != nullptr) *rows = here.rows.empty() ? nullptr : here.rows.data();
  return here.rows.size();
}

void delone_set_progress(delone_progress progress, void* user_data) {
  ThreadState& here = state();
  here.progress = progress;
  here.user_data = user_data;
}
