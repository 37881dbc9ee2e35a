// SPDX-License-Identifier: BSD-3-Clause
// Polyhedron: numbers of faces, volume, boxes.
#include "polyhedra/faces.hpp"
#include "polyhedra/fraction.hpp"
#include "polyhedra/polyhedron_impl.hpp"

#include <delone/polyhedron.hpp>

namespace delone {

using polyhedra::Description;
using polyhedra::Fraction;
using polyhedra::Integer;
using polyhedra::Row;

namespace {

/// The largest integer that is at most x.
Rational floor_of(const Rational& x) {
  const Fraction fraction = Fraction::of(x);
  Integer quotient, remainder;
  boost::multiprecision::divide_qr(fraction.numerator, fraction.denominator, quotient, remainder);
  return Fraction::to_rational(remainder < 0 ? Integer(quotient - 1) : quotient);
}
Rational negated(const Rational& x) {
  const Fraction fraction = Fraction::of(x);
  return Fraction::to_rational(-fraction.numerator, fraction.denominator);
}

}  // namespace

std::vector<std::size_t> Polyhedron::f_vector() const {
  if (is_empty()) return {};
  return internal::guarded(
      "the faces", [&] { return polyhedra::count_faces(impl_->description, impl_->generators_of_facets); });
}

std::optional<Rational> Polyhedron::volume() const {
  if (affine_dimension() < dimension()) return Rational();
  if (!is_bounded()) return std::nullopt;
  return internal::guarded("the volume", [&] {
    polyhedra::ExactVolume volume = polyhedra::volume_of(impl_->description, impl_->generators_of_facets);
    return std::optional(Fraction::to_rational(std::move(volume.numerator), std::move(volume.denominator)));
  });
}

std::optional<RationalBox> Polyhedron::bounding_box() const {
  if (is_empty()) return std::nullopt;
  return internal::guarded("the bounding box", [&] {
    RationalBox box;
    std::vector<Rational> function(static_cast<std::size_t>(dimension()));
    for (Rational& coefficient : function) {
      coefficient = 1;
      for (const bool is_upper : {false, true}) {
        const Optimum bound = is_upper ? maximize(function) : minimize(function);
        (is_upper ? box.upper : box.lower)
            .push_back(bound.state == Optimum::State::attained ? std::optional(bound.value) : std::nullopt);
      }
      coefficient = 0;
    }
    return std::optional(std::move(box));
  });
}

std::optional<RationalBox> Polyhedron::integer_bounding_box() const {
  std::optional<RationalBox> box = bounding_box();
  if (!box) return box;
  return internal::guarded("the bounding box", [&] {
    for (auto& bound : box->lower)
      if (bound) bound = floor_of(*bound);
    for (auto& bound : box->upper)
      if (bound) bound = negated(floor_of(negated(*bound)));
    return box;
  });
}

}  // namespace delone
