// SPDX-License-Identifier: BSD-3-Clause
// Triangulations as objects: made ones, and those that are arrays only.
#pragma once

#include "object.hpp"

#include <delone/cell_numbers.hpp>
#include <delone/cell_search.hpp>
#include <delone/data.hpp>
#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/point_locator.hpp>
#include <delone/regular.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace delone::c {

/// What has the arrays of a triangulation.
class TriangulationObject : public delone_object {
 public:
  virtual const ComplexData& data() const = 0;
  virtual const std::string& hash() const = 0;
  // Of data(), without making it.
  virtual int dimension() const { return data().dimension; }
  virtual int affine_dimension() const { return data().affine_dimension; }
  virtual std::size_t num_points() const { return data().num_points(); }
  virtual std::size_t num_cells() const { return data().num_cells(); }
  virtual DataKind data_kind() const { return data().kind; }
  CheckReport check(const CheckOptions& options, const Execution& how) const override {
    return delone::check(data(), options, how);
  }
  void write(const std::string& path, const std::string& format) const override;

 protected:
  static Members members_of_data();
};

/// Arrays that were read or given, or are left of a trimmed triangulation.
class GivenTriangulation final : public TriangulationObject {
 public:
  explicit GivenTriangulation(ComplexData data, Members more = {});
  const char* kind() const override { return "triangulation"; }
  const Members& members() const override { return members_; }
  const ComplexData& data() const override { return data_; }
  const std::string& hash() const override;
  /// Throws unsupported unless the cells have the dimension of the space.
  const CellSearch& search() const;

 private:
  ComplexData data_;
  Members members_;
  Lazy<std::string> hash_;
  Lazy<CellSearch> search_;
};

using AnyTriangulation = std::variant<Delaunay<>, Regular<>, FurthestSite<>>;

/// A product, which what refers to it keeps alive, and the number of its changes.
struct Product {
  explicit Product(AnyTriangulation triangulation) : any(std::move(triangulation)) {}

  AnyTriangulation any;
  std::atomic<std::uint64_t> changes{0};

  const Triangulation& common() const {
    return std::visit([](const auto& one) -> const Triangulation& { return one; }, any);
  }
};

class MadeTriangulation final : public TriangulationObject {
 public:
  explicit MadeTriangulation(AnyTriangulation any, unsigned threads);

  const char* kind() const override;
  const Members& members() const override;
  std::unique_ptr<delone_object> clone() const override;
  void insert(const double* rows, std::size_t num_rows, const double* weights) override;
  void remove(std::span<const std::size_t> rows);
  /// Gives rows other points and weights, of which one may be empty.
  void change(std::span<const std::size_t> rows, const double* to, const double* weights);
  const ComplexData& data() const override { return ready().data; }
  const std::string& hash() const override;
  int dimension() const override { return product_->common().dimension(); }
  int affine_dimension() const override { return product_->common().affine_dimension(); }
  std::size_t num_points() const override { return product_->common().num_points(); }
  std::size_t num_cells() const override { return product_->common().num_finite_cells(); }
  DataKind data_kind() const override;

  /// The product once its cells have the numbers that they keep.
  const std::shared_ptr<Product>& product() const { return ready(), product_; }
  const Triangulation& triangulation() const { return product()->common(); }
  const PointLocator& locator() const;
  /// The rows of the cells in data().cells.
  const CellNumbers& numbers() const { return ready().numbers; }
  SignedIndex row_of(VertexId v) const {
    return v == invalid_vertex ? -1 : static_cast<SignedIndex>(product_->common().row_of(v));
  }

 private:
  struct Ready {
    ComplexData data;
    CellNumbers numbers;
  };
  const Ready& ready() const;
  void forget();
  std::vector<SignedIndex> rows_of(const std::vector<VertexId>& vertices) const;

  std::shared_ptr<Product> product_;
  unsigned threads_;
  Lazy<Ready> ready_;
  Lazy<PointLocator> locator_;
  Lazy<std::string> hash_;
  Lazy<std::vector<SignedIndex>> edges_, hull_facets_;
  Lazy<std::vector<int>> axes_;
  Lazy<std::vector<double>> circumcenters_, circumradii_;
};

inline const MadeTriangulation& as_made(const delone_object* object) {
  return as<const MadeTriangulation>(object, "a triangulation that was made");
}

}  // namespace delone::c
