// SPDX-License-Identifier: BSD-3-Clause
// A triangulation as Python holds it: the engine, data derived from it on demand, and the locks that let
// threads share it.
//
// Call everything below the line `Without the GIL` without it. Queries share a lock, a change holds it alone.
// Nothing waits for a lock while it holds the GIL. Supervisor takes the GIL briefly under a lock, which is
// safe because threads that wait for that lock have released the GIL.
#pragma once

#include "running.hpp"

#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/point_locator.hpp>
#include <delone/regular.hpp>

#include <atomic>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <span>
#include <stdexcept>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

namespace delone::python {

using Form = TriangulationKind;
using Engine = std::variant<Delaunay<>, Regular<>, FurthestSite<>>;

/// A plain copy of the combinatorics, which arrays are views of. Later insertions do not change it.
struct Cells {
  ComplexData data;                         // without points
  std::vector<SignedIndex> number_of_slot;  // the row in data.cells of each CellId, −1 for infinite cells
};

class HeldTriangulation {
 public:
  HeldTriangulation(Form form, int dimension, const BuildArguments& arguments);

  Form form() const { return form_; }
  int dimension() const { return dimension_; }
  const BuildArguments& arguments() const { return arguments_; }
  /// At most so many threads answer a batch of questions, as they build.
  unsigned threads() const { return static_cast<unsigned>(arguments_.threads); }

  // Without the GIL:

  /// Adds all points or none. REQUIRES one weight per point for a regular triangulation, otherwise none.
  void add(std::span<const double> coordinates, std::span<const double> weights, Supervisor& supervisor);

  /// Calls work(product) after recovering the engine if necessary, a Delaunay<>, Regular<> or FurthestSite<>.
  template <class Work>
  auto with_product(Supervisor& supervisor, Work work) const {
    refuse_reentry();
    for (;;) {
      {
        const std::shared_lock lock(mutex_);
        if (!is_stale_) return std::visit(work, std::as_const(*engine_));
      }
      rebuild(supervisor);
    }
  }
  /// The same, as what they have in common.
  template <class Work>
  auto with_engine(Supervisor& supervisor, Work work) const {
    return with_product(supervisor, [&](const Triangulation& engine) { return work(engine); });
  }
  /// Calls work(engine, locator, cells).
  template <class Work>
  auto with_locator(Supervisor& supervisor, Work work) const {
    return with_engine(supervisor, [&](const Triangulation& engine) {
      const std::shared_ptr<const Cells> numbers = cells_of(engine);
      return work(engine, locator_of(engine), *numbers);
    });
  }

  std::shared_ptr<const Cells> cells(Supervisor& supervisor) const {
    return with_engine(supervisor, [&](const Triangulation& engine) { return cells_of(engine); });
  }
  std::shared_ptr<const std::vector<double>> points(Supervisor& supervisor) const;
  std::shared_ptr<const std::vector<double>> weights(Supervisor& supervisor) const;
  std::vector<std::size_t> batches() const;

  /// Changes with every insertion, but never during with_engine().
  std::uint64_t version() const { return version_; }

 private:
  std::unique_ptr<Engine> make_engine() const;
  void rebuild(Supervisor& supervisor) const;
  void refuse_reentry() const;
  std::shared_ptr<const Cells> cells_of(const Triangulation& engine) const;
  const PointLocator& locator_of(const Triangulation& engine) const;
  std::shared_ptr<const std::vector<double>> row_data(Supervisor& supervisor, bool want_weights) const;

  /// The engine's progress function: calls the Supervisor of the current change.
  struct Watch {
    Supervisor* supervisor = nullptr;
  };

  Form form_;
  int dimension_;
  BuildArguments arguments_;
  std::shared_ptr<Watch> watch_ = std::make_shared<Watch>();

  mutable std::shared_mutex mutex_;  // of all members below
  mutable std::unique_ptr<Engine> engine_;
  std::size_t num_rows_ = 0;
  std::vector<std::size_t> batches_;
  /// The last insertion was interrupted: the engine has rows that are not ours. It is rebuilt without them
  /// before its next use.
  mutable bool is_stale_ = false;
  std::atomic<std::uint64_t> version_{0};
  mutable std::atomic<std::thread::id> changing_;

  mutable std::mutex derived_mutex_;  // of all members below, under mutex_
  mutable std::shared_ptr<const Cells> cells_;
  mutable std::shared_ptr<const std::vector<double>> points_, weights_;
  mutable std::unique_ptr<PointLocator> locator_;
};

}  // namespace delone::python
