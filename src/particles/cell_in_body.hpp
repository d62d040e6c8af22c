// SPDX-License-Identifier: BSD-3-Clause
// A node's Voronoi cell within a body whose wall may be anywhere around: the place between the node
// and what is seen from it, up to its neighbours' bisectors and the wall. Integrated over
// directions.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shape/signed_distance.hpp"

namespace pnpbs {

template <int Dim>
class CellInBody {
 public:
  // The body must outlive it.
  explicit CellInBody(const SignedDistance<Dim>& body);

  // Of a node strictly inside the body, as far as `reach`, lest it looks through a narrow place at
  // what others are closer to. Neighbours may come in any order; those behind a wall take nothing
  // from the node. In the plane exact to some 1e-5 of the volume, in space to 1e-3. Any thread may
  // ask.
  double volume(const Point<Dim>& x, double reach, std::span<const Point<Dim>> neighbours) const;

 private:
  void products_with_directions(const Point<Dim>& vector, std::vector<double>& products) const;
  bool sees(const Point<Dim>& x, const Point<Dim>& neighbour,
            std::span<const std::int32_t> facets) const;
  std::vector<double> ends_at_bisectors(const Point<Dim>& x, double reach,
                                        std::span<const Point<Dim>> neighbours) const;
  void end_at_wall(const Point<Dim>& x, double reach, std::vector<double>& ends) const;

  const SignedDistance<Dim>& body_;
  std::vector<Point<Dim>> directions_;
  std::array<std::vector<double>, Dim> along_;  // the same, by coordinates
};

extern template class CellInBody<2>;
extern template class CellInBody<3>;

}  // namespace pnpbs
