// SPDX-License-Identifier: BSD-3-Clause
#include "shape/shape.hpp"

namespace pnpbs {
namespace {

ShapePiece<3> piece_on_sphere(const ShapePiece<2>& piece, const StereographicChart& chart) {
  const auto [a, b] = piece.corners;
  const double stretch = chart.stretch(middle_of<2>(a, b));
  ShapePiece<3> on_sphere;
  on_sphere.corners = {chart.on_sphere(a), chart.on_sphere(b), chart.on_sphere(b)};
  on_sphere.ends = {piece.ends[0], piece.ends[1], piece.ends[1]};
  on_sphere.tag = piece.tag;
  on_sphere.front_inside = piece.front_inside;
  on_sphere.back_inside = piece.back_inside;
  on_sphere.radius = piece.radius / stretch;
  on_sphere.edge = piece.edge / stretch;
  return on_sphere;
}

}  // namespace

Shape<3> shape_on_sphere(const PlaneDomain& domain) {
  Shape<3> shape;
  for (const ShapePiece<2>& piece : shape_of(domain))
    shape.push_back(piece_on_sphere(piece, domain.embedding().chart()));
  return shape;
}

}  // namespace pnpbs
