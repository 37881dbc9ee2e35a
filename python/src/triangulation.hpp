// SPDX-License-Identifier: BSD-3-Clause
// A triangulation as Python holds it: the engine, data derived from it on demand, and the locks that let
// threads share it.
//
// Call everything below the line `Without the GIL` without it. Queries share a lock, a change holds it alone.
// Nothing waits for a lock while it holds the GIL. Supervisor takes the GIL briefly under a lock, which is
// safe because threads that wait for that lock have released the GIL.
#pragma once

#include "arrays.hpp"
#include "running.hpp"

#include <delone/cell_numbers.hpp>
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
#include <utility>
#include <variant>
#include <vector>

namespace delone::python {

using Form = TriangulationKind;
using Engine = std::variant<Delaunay<>, Regular<>, FurthestSite<>>;

/// A plain copy of the combinatorics, which arrays are views of. Later insertions and edits do not change it.
struct Cells {
  ComplexData data;  // without points
  CellNumbers numbers;
};

class HeldTriangulation {
 public:
  HeldTriangulation(Form form, int dimension, const BuildArguments& arguments);

  Form form() const { return form_; }
  int dimension() const { return dimension_; }
  const BuildArguments& arguments() const { return arguments_; }
  /// At most so many threads answer a batch of questions, as they build.
  unsigned threads() const { return static_cast<unsigned>(arguments_.threads); }
  /// The labels of the columns of the DataFrame that it was made of, a tuple, or None. With the GIL.
  const py::object& columns() const { return columns_; }
  void set_columns(py::object columns) { columns_ = std::move(columns); }
  /// The index of the DataFrame, see index_of(); None once rows were added. With the GIL.
  const py::object& row_index() const { return index_; }
  void set_row_index(py::object index) { index_ = std::move(index); }

  // Without the GIL, in Supervisor::run():

  /// Adds all points or none. REQUIRES one weight per point for a regular triangulation, otherwise none.
  void add(std::span<const double> coordinates, std::span<const double> weights);
  /// Makes all of the edit or nothing.
  void edit(const Edit<>& edit);
  void undo();
  CompactedIds compact_ids();
  void record_changes(bool wanted);
  void record_undo(bool wanted);
  /// What the last change did, with the cells that have numbers only; nullptr unless it was to be recorded.
  std::shared_ptr<const Changes> changes() const;
  /// Takes over the points, cells and ids of another one of the same form and dimension.
  void become_copy_of(const HeldTriangulation& other);

  /// Calls work(product), a Delaunay<>, Regular<> or FurthestSite<>.
  template <class Work>
  auto with_product(Work work) const {
    const Use use(this, "used");
    for (;;) {
      {
        const std::shared_lock lock(mutex_);
        if (is_sorted_) return std::visit(work, std::as_const(*engine_));
      }
      sort_cells();
    }
  }
  /// The same, as what they have in common.
  template <class Work>
  auto with_engine(Work work) const {
    return with_product([&](const Triangulation& engine) { return work(engine); });
  }
  /// Calls work(engine), for what does not depend on the numbers of cells: they may have none yet.
  template <class Work>
  auto with_unsorted(Work work) const {
    const Use use(this, "used");
    const std::shared_lock lock(mutex_);
    return std::visit([&](const Triangulation& engine) { return work(engine); }, std::as_const(*engine_));
  }
  /// Calls work(engine, locator, cells).
  template <class Work>
  auto with_locator(Work work) const {
    return with_engine([&](const Triangulation& engine) {
      const std::shared_ptr<const Cells> numbers = cells_of(engine);
      return work(engine, locator_of(engine), *numbers);
    });
  }

  std::shared_ptr<const Cells> cells() const {
    return with_engine([&](const Triangulation& engine) { return cells_of(engine); });
  }
  std::shared_ptr<const std::vector<double>> points() const;
  std::shared_ptr<const std::vector<double>> weights() const;
  std::vector<std::size_t> batches() const;

  /// Changes with every insertion and edit, but never during with_engine().
  std::uint64_t version() const { return version_; }
  /// The cells of the engine, within with_engine().
  std::shared_ptr<const Cells> cells_of(const Triangulation& engine) const;

 private:
  std::unique_ptr<Engine> make_engine() const;
  void sort_cells() const;
  void sort_cells_alone() const;
  void prepare_change();
  void complete_change();
  void forget_batches();
  void forget_derived();
  void forget_changes();
  const PointLocator& locator_of(const Triangulation& engine) const;
  std::shared_ptr<const std::vector<double>> row_data(bool want_weights) const;

  Form form_;
  int dimension_;
  BuildArguments arguments_;
  py::object columns_ = py::none(), index_ = py::none();

  mutable FairMutex mutex_;  // of all members below
  const std::unique_ptr<Engine> engine_;
  std::vector<std::size_t> batches_;  // the sizes of insertions that make these rows; one, after edits
  bool records_changes_ = false, records_undo_ = false;
  /// Cells have numbers that do not depend on threads. The first question that needs them sorts the cells.
  mutable bool is_sorted_ = true;
  std::atomic<std::uint64_t> version_{0};

  mutable std::mutex derived_mutex_;  // of all members below, under mutex_
  mutable std::shared_ptr<const Cells> cells_;
  mutable std::shared_ptr<const Changes> changes_;  // after the first call of changes()
  mutable std::shared_ptr<const std::vector<double>> points_, weights_;
  mutable std::unique_ptr<PointLocator> locator_;
};

// With the GIL:

/// Forwards a question without arguments to the engine, one that does not depend on the numbers of cells.
template <class Question>
auto count(const HeldTriangulation& held, Question question) {
  Supervisor supervisor;
  return supervisor.run([&] { return held.with_unsorted(question); });
}
/// The same for other questions.
template <class Question>
auto ask(const HeldTriangulation& held, Question question) {
  Supervisor supervisor;
  return supervisor.run([&] { return held.with_engine(question); });
}

/// (n, d), and (n,).
py::array points_of(const HeldTriangulation& held);
py::array weights_of(const HeldTriangulation& held);

}  // namespace delone::python
