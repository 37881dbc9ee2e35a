// SPDX-License-Identifier: BSD-3-Clause
#include "call.hpp"

#include <octave/quit.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace delone_octave {
namespace {

std::string identifier_of(int status) {
  std::string name = delone_status_name(status);
  std::replace(name.begin(), name.end(), '_', '-');
  return "delone:" + name;
}

/// The message, with the number of the first row that it is about counted from 1.
std::string counted_from_1(std::string message, std::size_t row) {
  const std::string number = std::to_string(row);
  const auto is_digit = [&](std::size_t i) {
    return i < message.size() && std::isdigit(static_cast<unsigned char>(message[i])) != 0;
  };
  for (std::size_t at = message.find(' ' + number); at != std::string::npos;
       at = message.find(' ' + number, at + 1)) {
    if (is_digit(at + 1 + number.size())) continue;
    return message.replace(at + 1, number.size(), std::to_string(row + 1));
  }
  return message;
}

bool is_integer(double value) {
  return value == std::floor(value) && std::fabs(value) < 0x1p53;  // not NaN, not infinite
}

int set_option(delone_options* options, const std::string& name, const octave_value& value) {
  if (value.is_string()) return delone_set_text(options, name.c_str(), value.string_value().c_str());
  const NDArray numbers = value.array_value();
  if (numbers.numel() != 1)
    return delone_set_reals(options, name.c_str(), numbers.data(), static_cast<std::size_t>(numbers.numel()));
  return is_integer(numbers(0)) ? delone_set_integer(options, name.c_str(), static_cast<int64_t>(numbers(0)))
                                : delone_set_real(options, name.c_str(), numbers(0));
}

}  // namespace

int Interruptible::ask(double, void* scope) noexcept {
  try {
    octave_quit();
    return 0;
  } catch (...) {
    static_cast<Interruptible*>(scope)->caught_ = std::current_exception();
    return 1;
  }
}

void raise(int status) {
  const std::size_t* rows = nullptr;
  std::string message = delone_error_message();
  if (delone_error_rows(&rows) > 0) message = counted_from_1(message, *rows);
  error_with_id(identifier_of(status).c_str(), "delone: %s", message.c_str());
}

octave_scalar_map& default_options() {
  static octave_scalar_map values;
  return values;
}

Options::Options(const octave_value& more) {
  if (const int status = delone_options_new(&options_)) raise(status);
  try {
    set(default_options());
    if (more.isstruct()) set(more.scalar_map_value());
  } catch (...) {
    delone_options_free(options_);
    throw;
  }
}

void Options::set(const octave_scalar_map& values) {
  for (octave_idx_type i = 0; i < values.nfields(); ++i) {
    const std::string name = values.fieldnames()(i);
    if (const int status = set_option(options_, name, values.getfield(name))) raise(status);
  }
}

}  // namespace delone_octave
