// SPDX-License-Identifier: BSD-3-Clause
// Insertion, derived data, and recovery from interrupted insertions; see triangulation.hpp.
#include "triangulation.hpp"

#include <algorithm>
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
    : form_(form), dimension_(dimension), arguments_(arguments), engine_(make_engine(true)) {}

std::unique_ptr<Engine> HeldTriangulation::make_engine(bool is_limited) const {
  Options options = arguments_.to_options();
  if (!is_limited) options.memory_limit = 0, options.time_limit = 0;
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

void HeldTriangulation::add(std::span<const double> coordinates, std::span<const double> weights) {
  const Use use(this, "changed");
  const std::unique_lock lock(mutex_);
  const bool has_limits = arguments_.memory_limit > 0 || arguments_.time_limit > 0;
  if (is_stale_ || (has_limits && !is_limited_)) rebuild(true);
  batches_.reserve(batches_.size() + 1);
  is_sorted_ = false;
  try {
    insert(*engine_, coordinates, weights);
  } catch (...) {
    is_stale_ = num_rows(*engine_) != num_rows_;
    throw;
  }
  if (num_rows(*engine_) == num_rows_) return;
  batches_.push_back(num_rows(*engine_) - num_rows_);
  num_rows_ = num_rows(*engine_);
  ++version_;
  const std::lock_guard derived(derived_mutex_);
  cells_.reset();
  points_.reset();
  weights_.reset();
  locator_.reset();
}

void HeldTriangulation::recover() const {
  const std::unique_lock lock(mutex_);
  if (is_stale_) rebuild(false);
}

/// The old engine goes first: there may be no memory for both. Until the new one is there, our rows are kept
/// aside, so that what breaks this off loses nothing. Rows are inserted batch by batch, so that cells keep
/// their numbers.
void HeldTriangulation::rebuild(bool is_limited) const {
  const auto points = row_data(false), weights = row_data(true);
  is_stale_ = true;
  {
    const std::lock_guard derived(derived_mutex_);
    locator_.reset();
  }
  engine_.reset();
  auto engine = make_engine(is_limited);
  std::size_t first = 0;
  const auto d = static_cast<std::size_t>(dimension_);
  for (const std::size_t rows : batches_) {
    insert(*engine, std::span(*points).subspan(first * d, rows * d),
           form_ == Form::regular ? std::span(*weights).subspan(first, rows) : std::span<const double>());
    first += rows;
  }
  engine_ = std::move(engine);
  is_limited_ = is_limited;
  is_stale_ = is_sorted_ = false;
  ++generation_;
}

void HeldTriangulation::sort_cells() const {
  const std::unique_lock lock(mutex_);
  if (is_stale_ || is_sorted_) return;
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
  const std::lock_guard lock(derived_mutex_);
  if (!points_) {
    ComplexData data =
        std::visit([](const Triangulation& engine) { return engine.to_data(); }, std::as_const(*engine_));
    data.points.resize(num_rows_ * static_cast<std::size_t>(dimension_));
    data.weights.resize(std::min(data.weights.size(), num_rows_));
    auto points = std::make_shared<const std::vector<double>>(std::move(data.points));
    weights_ = std::make_shared<const std::vector<double>>(std::move(data.weights));
    points_ = std::move(points);
  }
  return want_weights ? weights_ : points_;
}
std::shared_ptr<const std::vector<double>> HeldTriangulation::points() const {
  return with_unsorted([&](const Triangulation&) { return row_data(false); });
}
std::shared_ptr<const std::vector<double>> HeldTriangulation::weights() const {
  return with_unsorted([&](const Triangulation&) { return row_data(true); });
}

std::vector<std::size_t> HeldTriangulation::batches() const {
  const Use use(this, "used");
  const std::shared_lock lock(mutex_);
  return batches_;
}

}  // namespace delone::python
