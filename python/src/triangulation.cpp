// SPDX-License-Identifier: BSD-3-Clause
// Insertion, edits and derived data; see triangulation.hpp.
#include "triangulation.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace delone::python {
namespace {

void insert(Engine& engine, std::span<const double> coordinates, std::span<const double> weights) {
  std::visit(
      [&](auto& product) {
        if constexpr (requires { product.insert_range(coordinates, weights); })
          product.insert_range(coordinates, weights);
        else
          product.insert_range(coordinates);
      },
      engine);
}

Triangulation& common(Engine& engine) {
  return std::visit([](Triangulation& product) -> Triangulation& { return product; }, engine);
}

/// Those of cells that have numbers: infinite ones have none.
Changes changes_with_numbers(const Triangulation& engine) {
  Changes changes = engine.changes();
  const Complex complex = engine.complex();
  std::erase_if(changes.created_cells, [&](CellId c) { return complex.is_infinite(c); });
  const std::vector<CellId>& removed_infinite_cells = engine.removed_infinite_cells();
  auto infinite = removed_infinite_cells.begin();
  std::size_t num_finite = 0;
  for (const CellId c : changes.removed_cells)
    if (infinite != removed_infinite_cells.end() && *infinite == c)
      ++infinite;
    else
      changes.removed_cells[num_finite++] = c;
  changes.removed_cells.resize(num_finite);
  return changes;
}

}  // namespace

HeldTriangulation::HeldTriangulation(Form form, int dimension, const BuildArguments& arguments)
    : form_(form), dimension_(dimension), arguments_(arguments), engine_(make_engine()) {
  common(*engine_).sort_cells_later();  // before the first question that depends on it, or the next change
}

std::unique_ptr<Engine> HeldTriangulation::make_engine() const {
  const Options options = arguments_.to_options();
  switch (form_) {
    case Form::regular:
      return std::make_unique<Engine>(std::in_place_type<Regular<>>, dimension_, options);
    case Form::furthest_site:
      return std::make_unique<Engine>(std::in_place_type<FurthestSite<>>, dimension_, options);
    case Form::delaunay:
      break;
  }
  return std::make_unique<Engine>(std::in_place_type<Delaunay<>>, dimension_, options);
}

/// If the insertion is broken off, the engine is as it was, with the same cells in the same slots.
void HeldTriangulation::add(std::span<const double> coordinates, std::span<const double> weights) {
  const Use use(this, "changed");
  const std::unique_lock lock(mutex_);
  if (coordinates.empty()) return;
  prepare_change();
  insert(*engine_, coordinates, weights);
  if (records_changes_ || records_undo_)
    forget_batches();
  else
    batches_.push_back(coordinates.size() / static_cast<std::size_t>(dimension_));
  complete_change();
}

/// The same holds for edits.
void HeldTriangulation::edit(const Edit<>& edit) {
  const Use use(this, "changed");
  const std::unique_lock lock(mutex_);
  if (edit.remove.empty() && edit.move.empty() && edit.reweight.empty() && edit.insert.coordinates().empty())
    return;
  prepare_change();
  std::visit([&](auto& product) { product.edit(edit); }, *engine_);
  forget_batches();
  complete_change();
}

void HeldTriangulation::undo() {
  const Use use(this, "changed");
  const std::unique_lock lock(mutex_);
  batches_.reserve(1);
  common(*engine_).undo();
  forget_batches();
  complete_change();
}

CompactedIds HeldTriangulation::compact_ids() {
  const Use use(this, "changed");
  const std::unique_lock lock(mutex_);
  batches_.reserve(1);
  CompactedIds ids = common(*engine_).compact_ids();
  forget_batches();
  forget_derived();
  forget_changes();
  return ids;
}

void HeldTriangulation::record_changes(bool wanted) {
  const Use use(this, "changed");
  const std::unique_lock lock(mutex_);
  common(*engine_).record_changes(wanted);
  records_changes_ = wanted;
  forget_changes();
}

void HeldTriangulation::record_undo(bool wanted) {
  const Use use(this, "changed");
  const std::unique_lock lock(mutex_);
  common(*engine_).record_undo(wanted);
  records_undo_ = wanted;
}

std::shared_ptr<const Changes> HeldTriangulation::changes() const {
  const auto is_recorded = [this](const Triangulation&) { return records_changes_; };
  if (!with_unsorted(is_recorded)) return nullptr;
  return with_engine([this](const Triangulation& engine) -> std::shared_ptr<const Changes> {
    if (!records_changes_) return nullptr;  // not any more
    const std::lock_guard derived(derived_mutex_);
    if (!changes_) changes_ = std::make_shared<const Changes>(changes_with_numbers(engine));
    return changes_;
  });
}

void HeldTriangulation::become_copy_of(const HeldTriangulation& other) {
  const std::unique_lock lock(mutex_);
  other.with_product([&](const auto& product) {
    *engine_ = product.clone();
    batches_ = other.batches_;
    records_changes_ = other.records_changes_;
    records_undo_ = other.records_undo_;
  });
  forget_derived();
  forget_changes();
}

/// Before an insertion or an edit. Cells whose ids are told must not be sorted later.
void HeldTriangulation::prepare_change() {
  batches_.reserve(batches_.size() + 1);
  if (!is_sorted_ && (records_changes_ || records_undo_)) sort_cells_alone();
}

void HeldTriangulation::complete_change() {
  is_sorted_ = false;
  forget_derived();
  forget_changes();
}

void HeldTriangulation::forget_changes() {
  const std::lock_guard derived(derived_mutex_);
  changes_.reset();
}

/// The same cells would not come of the same insertions again. REQUIRES memory for one batch.
void HeldTriangulation::forget_batches() {
  batches_.clear();
  if (const std::size_t rows = common(*engine_).num_rows(); rows > 0) batches_.push_back(rows);
}

void HeldTriangulation::forget_derived() {
  ++version_;
  const std::lock_guard derived(derived_mutex_);
  cells_.reset();
  points_.reset();
  weights_.reset();
  locator_.reset();
}

void HeldTriangulation::sort_cells() const {
  const std::unique_lock lock(mutex_);
  if (!is_sorted_) sort_cells_alone();
}

/// With the lock.
void HeldTriangulation::sort_cells_alone() const {
  common(*engine_).sort_cells();
  is_sorted_ = true;
}

std::shared_ptr<const Cells> HeldTriangulation::cells_of(const Triangulation& engine) const {
  const std::lock_guard lock(derived_mutex_);
  if (cells_) return cells_;
  auto cells = std::make_shared<Cells>();
  cells->data = engine.to_data(false);
  cells->numbers = CellNumbers(engine.complex());
  cells_ = std::move(cells);
  return cells_;
}

const PointLocator& HeldTriangulation::locator_of(const Triangulation& engine) const {
  const std::lock_guard lock(derived_mutex_);
  if (!locator_) locator_ = std::make_unique<PointLocator>(engine);
  return *locator_;
}

std::shared_ptr<const std::vector<double>> HeldTriangulation::row_data(bool want_weights) const {
  return with_unsorted([&](const Triangulation& engine) {
    const std::lock_guard lock(derived_mutex_);
    if (!points_) {
      ComplexData data = engine.to_data();
      weights_ = std::make_shared<const std::vector<double>>(std::move(data.weights));
      points_ = std::make_shared<const std::vector<double>>(std::move(data.points));
    }
    return want_weights ? weights_ : points_;
  });
}
std::shared_ptr<const std::vector<double>> HeldTriangulation::points() const { return row_data(false); }
std::shared_ptr<const std::vector<double>> HeldTriangulation::weights() const { return row_data(true); }

std::vector<std::size_t> HeldTriangulation::batches() const {
  const Use use(this, "used");
  const std::shared_lock lock(mutex_);
  return batches_;
}

py::array points_of(const HeldTriangulation& held) {
  Supervisor supervisor;
  const auto points = supervisor.run([&] { return held.points(); });
  const auto d = static_cast<std::size_t>(held.dimension());
  return rows_view(*points, points->size() / d, d, points);
}
py::array weights_of(const HeldTriangulation& held) {
  Supervisor supervisor;
  const auto weights = supervisor.run([&] { return held.weights(); });
  return list_view(*weights, weights);
}

}  // namespace delone::python
