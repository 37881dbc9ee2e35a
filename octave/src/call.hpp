// SPDX-License-Identifier: BSD-3-Clause
// Calls of the C interface: interrupts, errors and options as Octave has them.
#pragma once

#include "object.hpp"

#include <delone/delone.h>
#include <octave/oct-map.h>
#include <octave/oct.h>

#include <exception>
#include <utility>

namespace delone_octave {

/// While it lives, long calls of this thread ask whether the user has pressed Ctrl-C. No exception passes
/// through frames of C: it is kept here, and thrown by rethrow() after the call.
class Interruptible {
 public:
  Interruptible() { delone_set_progress(ask, this); }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
  ~Interruptible() { delone_set_progress(nullptr, nullptr); }

  void rethrow() const {
    if (caught_) std::rethrow_exception(caught_);
  }

 private:
  static int ask(double fraction, void* scope) noexcept;

  std::exception_ptr caught_;
};

/// Raises the error of a status, which is not DELONE_OK: with the identifier "delone:not-finite" or alike,
/// and with points and queries counted from 1.
[[noreturn]] void raise(int status);

/// Does the work of a function of the C interface.
template <class Work>
void call(Work work) {
  int status;
  {
    const Interruptible scope;
    status = work();
    scope.rethrow();
  }
  if (status != DELONE_OK) raise(status);
}

/// A function that makes an object.
template <class Work>
octave_value make(Work work) {
  delone_object* made = nullptr;
  call([&] { return work(&made); });
  return octave_value(new Object(made));
}

/// Options of calls: those of delone.options(), and those of the struct, which come before them.
class Options {
 public:
  explicit Options(const octave_value& more = octave_value());
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;
  ~Options() { delone_options_free(options_); }

  delone_options* get() const { return options_; }

 private:
  void set(const octave_scalar_map& values);

  delone_options* options_ = nullptr;
};

/// What delone.options() has set.
octave_scalar_map& default_options();

}  // namespace delone_octave
