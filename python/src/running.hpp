// SPDX-License-Identifier: BSD-3-Clause
// Work without the GIL that Ctrl-C and a progress function can stop; errors of the library as Python
// exceptions.
#pragma once

#include "fair_mutex.hpp"
#include "messages.hpp"

#include <pybind11/pybind11.h>

#include <delone/arithmetic.hpp>
#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/progress.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace delone::python {

namespace py = pybind11;

/// Runs work of the library, in its floating-point state. Ten times a second Python decides whether it goes
/// on: signal handlers run (in the main thread), then the progress function. Both may raise. Their exception
/// is kept and replaces that of the library.
class Supervisor {
 public:
  /// `progress`: None or False; True, for a bar (delone._progress); or a function of the fraction done, which
  /// stops the work if it returns what counts as false, but None. Otherwise raises TypeError.
  explicit Supervisor(py::object progress = py::none()) : progress_(std::move(progress)) {
    if (progress_.ptr() == Py_False) progress_ = py::none();
    if (progress_.ptr() == Py_True) bar_ = progress_ = py::module_::import("delone._progress").attr("Bar")();
    if (!progress_.is_none() && PyCallable_Check(progress_.ptr()) == 0)
      throw py::type_error("progress: True, a function of the fraction done, or None, not " +
                           type_name(progress_));
  }
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;
  ~Supervisor() {
    if (bar_.is_none()) return;
    try {
      bar_.attr("close")(is_done_);
    } catch (py::error_already_set& error) {
      error.discard_as_unraisable("the progress bar");
    }
  }

  /// For options of calls that say what is done by a function of their own; refers to this object.
  std::function<bool(double)> callback() {
    return [this](double fraction) { return go_on(fraction); };
  }

  /// Asks another function of Python once, as the progress function: whether the work goes on. Call it
  /// without the GIL, within the work; make() returns the argument.
  template <class Make>
  bool agrees(const py::object& function, Make make) {
    const py::gil_scoped_acquire gil;
    return decide([&] { return py::object(function(make())); });
  }

  /// Runs `work` without the GIL. Its own loops call cancellation_point().
  template <class Work>
  auto run(Work work) {
    try {
      const py::gil_scoped_release no_gil;
      const ArithmeticScope arithmetic;
      const ProgressScope scope([this](double fraction) { return go_on(fraction); });
      if constexpr (std::is_void_v<decltype(work())>) {
        work();
        is_done_ = true;
      } else {
        auto result = work();
        is_done_ = true;
        return result;
      }
    } catch (const Error& error) {
      if (error.code() == Errc::cancelled && raised_) throw *std::exchange(raised_, std::nullopt);
      throw;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// Without the GIL.
  bool go_on(double fraction) {
    fraction_ = std::max(fraction_, fraction);
    const auto now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(100)) return true;
    last_ = now;
    const py::gil_scoped_acquire gil;
    return ask(fraction_);
  }
  bool ask(double fraction) {
    return decide([&]() -> py::object {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      return progress_.is_none() ? progress_ : progress_(fraction);
    });
  }
  /// With the GIL: what a function answers, of which None counts as true. Its exception is kept.
  template <class Ask>
  bool decide(Ask ask) {
    try {
      const py::object answer = ask();
      if (answer.is_none()) return true;
      const int is_true = PyObject_IsTrue(answer.ptr());
      if (is_true < 0) throw py::error_already_set();
      return is_true > 0;
    } catch (py::error_already_set& error) {
      raised_ = error;
      return false;
    }
  }

  py::object progress_, bar_ = py::none();
  bool is_done_ = false;
  std::optional<py::error_already_set> raised_;
  Clock::time_point last_ = Clock::now();
  double fraction_ = 0;
};

/// While it lives, the thread works on an object. A progress function or a signal handler that uses the
/// object would wait for a lock that its own thread holds; instead it gets RuntimeError.
class Use {
 public:
  Use(const void* object, const char* doing) : object_(object), doing_(doing), outer_(innermost) {
    for (const Use* use = innermost; use != nullptr; use = use->outer_)
      if (use->object_ == object) throw std::runtime_error(std::string("the object is being ") + use->doing_);
    innermost = this;
  }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;
  ~Use() { innermost = outer_; }

 private:
  static inline constinit thread_local const Use* innermost = nullptr;
  const void* object_;
  const char* doing_;
  const Use* outer_;
};

/// Lets threads share an object of the library: queries hold a lock together, a change holds it alone.
/// Nothing waits for the lock while it holds the GIL. Supervisor takes the GIL briefly under the lock, which
/// is safe because threads that wait for the lock have released the GIL. Call all members with the GIL.
class Guard {
 public:
  /// Returns question().
  template <class Question>
  auto ask(Question question) const {
    Supervisor supervisor;
    return supervisor.run([&] {
      const Use use(this, "used");
      const std::shared_lock lock(mutex_);
      return question();
    });
  }

  template <class Work>
  void change(const py::object& progress, Work work) {
    Supervisor supervisor(progress);
    supervisor.run([&] {
      const Use use(this, "changed");
      const std::unique_lock lock(mutex_);
      work();
    });
  }

 private:
  mutable FairMutex mutex_;
};

/// The keyword arguments of all constructors.
struct BuildArguments {
  std::uint64_t seed = 0;
  std::string order = "automatic";
  int threads = 0;
  std::size_t memory_limit = 0;  ///< 0: none
  double time_limit = 0;         ///< 0: none

  /// Raises ValueError for a bad argument.
  Options to_options() const;
};

/// The argument threads of what builds nothing. Raises ValueError for a bad one.
unsigned as_threads(int threads);

/// The arguments memory_limit and time_limit: None, which is 0, or a number above 0. Raise ValueError.
std::size_t as_memory_limit(const py::object& bytes);
double as_time_limit(const py::object& seconds);

/// Statistics with their names in Python.
py::dict as_dict(const Statistics& statistics);

/// delone.Error and its kinds.
void bind_errors(py::module_& module);

}  // namespace delone::python
