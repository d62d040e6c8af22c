// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cell of a node within a body whose wall can be anywhere around it. It extends over
// everything visible from the node up to the bisectors to its neighbours and the wall, and is
// integrated over directions.
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
  // Prepares the directions. The body must outlive this object.
  explicit CellInBody(const SignedDistance<Dim>& body);

  // Returns the volume of the cell of a node strictly inside the body. The cell extends at most to
  // `reach`, so that the node does not look through a gap at regions to which others are closer.
  // Neighbours can be in any order; those behind a wall do not limit the cell. The relative error
  // is about 1e-5 in the plane and 1e-3 in space. Several threads may call it at the same time.
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
  std::array<std::vector<double>, Dim> along_;  // Coordinates of directions_.
};

extern template class CellInBody<2>;
extern template class CellInBody<3>;

}  // namespace pnpbs
