// SPDX-License-Identifier: BSD-3-Clause
// Work without the GIL that Ctrl-C and a progress function can stop; errors of the library as Python
// exceptions.
#pragma once

#include <pybind11/pybind11.h>

#include <delone/delaunay.hpp>
#include <delone/error.hpp>

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace delone::python {

namespace py = pybind11;

/// Ten times a second, lets Python decide whether work goes on: signal handlers run (in the main thread),
/// then the progress function. Both may raise. Their exception is kept and replaces that of the library.
class Supervisor {
 public:
  /// `progress`: None, or a function of the fraction done. It may return False to stop.
  explicit Supervisor(py::object progress = py::none()) : progress_(std::move(progress)) {}

  /// Returns false to stop. Call it without the GIL.
  bool go_on(double fraction) {
    const auto now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(100)) return true;
    last_ = now;
    const py::gil_scoped_acquire gil;
    return ask(fraction);
  }
  /// For loops over queries: looks at the clock only now and then. Only the thread that made this object
  /// counts; others that share the work may call it.
  void count(unsigned interval = 4096) {
    if (std::this_thread::get_id() != owner_) return;
    if (++count_ % interval == 0 && !go_on(0)) throw Error(Errc::cancelled, "cancelled");
  }

  /// Runs `work` without the GIL.
  template <class Work>
  auto run(Work work) {
    try {
      const py::gil_scoped_release no_gil;
      return work();
    } catch (const Error& error) {
      if (error.code() == Errc::cancelled && raised_) throw *std::exchange(raised_, std::nullopt);
      throw;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool ask(double fraction) {
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      return progress_.is_none() || progress_(fraction).ptr() != Py_False;
    } catch (py::error_already_set& error) {
      raised_ = error;
      return false;
    }
  }

  py::object progress_;
  std::optional<py::error_already_set> raised_;
  Clock::time_point last_ = Clock::now();
  unsigned count_ = 0;
  std::thread::id owner_ = std::this_thread::get_id();
};

/// Lets threads share an object of the library: queries hold a lock together, a change holds it alone.
/// Nothing waits for the lock while it holds the GIL. Supervisor takes the GIL briefly under the lock, which
/// is safe because threads that wait for the lock have released the GIL. Call all members with the GIL.
class Guard {
 public:
  /// For the options of the object: calls the Supervisor of the current change. Refers to the guard.
  std::function<bool(double)> progress() {
    return [this](double fraction) { return supervisor_ == nullptr || supervisor_->go_on(fraction); };
  }

  /// Returns question(supervisor).
  template <class Question>
  auto ask(Question question) const {
    Supervisor supervisor;
    return supervisor.run([&] {
      refuse_reentry();
      const std::shared_lock lock(mutex_);
      return question(supervisor);
    });
  }

  template <class Work>
  void change(const py::object& progress, Work work) {
    Supervisor supervisor(progress);
    supervisor.run([&] {
      refuse_reentry();
      const std::unique_lock lock(mutex_);
      const Change change(*this, supervisor);
      work();
    });
  }

 private:
  /// Marks the thread that is changing the object.
  class Change {
   public:
    Change(Guard& guard, Supervisor& supervisor) : guard_(guard) {
      guard_.supervisor_ = &supervisor;
      guard_.changing_ = std::this_thread::get_id();
    }
    Change(const Change&) = delete;
    Change& operator=(const Change&) = delete;
    ~Change() {
      guard_.supervisor_ = nullptr;
      guard_.changing_ = std::thread::id();
    }

   private:
    Guard& guard_;
  };

  /// A progress function that uses the object it reports on would deadlock.
  void refuse_reentry() const {
    if (changing_.load() == std::this_thread::get_id())
      throw std::runtime_error("the object is being changed");
  }

  Supervisor* supervisor_ = nullptr;
  std::atomic<std::thread::id> changing_;
  mutable std::shared_mutex mutex_;
};

/// The keyword arguments of all constructors.
struct BuildArguments {
  std::uint64_t seed = 0;
  std::string order = "automatic";
  int threads = 1;

  /// Raises ValueError for a bad argument.
  Options to_options() const;
  Options to_options(std::function<bool(double)> progress) const {
    Options options = to_options();
    options.progress = std::move(progress);
    return options;
  }
};

/// Statistics with their names in Python.
py::dict as_dict(const Statistics& statistics);

/// delone.Error and its kinds.
void bind_errors(py::module_& module);

}  // namespace delone::python
