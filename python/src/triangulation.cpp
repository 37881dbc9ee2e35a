// SPDX-License-Identifier: BSD-3-Clause
// Insertion and derived data; see triangulation.hpp.
#include "triangulation.hpp"

#include <utility>

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

std::size_t num_rows(const Engine& engine) {
  return std::visit([](const Triangulation& product) { return product.num_rows(); }, engine);
}

}  // namespace

HeldTriangulation::HeldTriangulation(Form form, int dimension, const BuildArguments& arguments)
    : form_(form), dimension_(dimension), arguments_(arguments), engine_(make_engine()) {}

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
  batches_.reserve(batches_.size() + 1);
  const std::size_t before = num_rows(*engine_);
  insert(*engine_, coordinates, weights);
  if (num_rows(*engine_) == before) return;
  batches_.push_back(num_rows(*engine_) - before);
  is_sorted_ = false;
  ++version_;
  const std::lock_guard derived(derived_mutex_);
  cells_.reset();
  points_.reset();
  weights_.reset();
  locator_.reset();
}

void HeldTriangulation::sort_cells() const {
  const std::unique_lock lock(mutex_);
  if (is_sorted_) return;
  std::visit([](auto& product) { product.sort_cells(); }, *engine_);
  is_sorted_ = true;
}

std::shared_ptr<const Cells> HeldTriangulation::cells_of(const Triangulation& engine) const {
  const std::lock_guard lock(derived_mutex_);
  if (cells_) return cells_;
  auto cells = std::make_shared<Cells>();
  cells->data = engine.to_data(false);
  const Complex complex = engine.complex();
  cells->number_of_slot.assign(complex.num_cell_slots(), -1);
  SignedIndex count = 0;
  for (const CellId c : complex.finite_cells()) cells->number_of_slot[index(c)] = count++;
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

}  // namespace delone::python
