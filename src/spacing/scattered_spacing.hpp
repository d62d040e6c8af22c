// SPDX-License-Identifier: BSD-3-Clause
// The spacing from values at scattered points, all of which every rank stores: a weighted mean of
// the values of the points nearest to x. The weights are positive, so d never leaves the range of
// these values.
//
// - The weight of a point is 1/r - 1/R, where r is its distance from x and R that of the nearest
//   point not used any more (the square root of the weight of R. Franke, G. Nielson, Int. J. Numer.
//   Methods Eng. 15 (1980) 1691-1704). Hence d is continuous and equals the given value at each
//   point.
// - A point that lies behind another one, as seen from x, has a smaller weight or none. Hence many
//   points in one direction weigh no more than the first of them, and d beside a dense group of
//   points is that of its rim.
// - The weights are changed twice to those of a plane fitted to the values, as far as they remain
//   positive. Hence linear functions are nearly reproduced where points lie all around x.
//
// Alternatives are worse. A fitted plane leaves the range of the values far from its points, where
// these are close to each other. A triangulation of the points has long thin elements along its
// hull, and none where all points lie on a line. Natural neighbours take ten times as long in
// space.
//
// On a sphere, vectors from x are those of the azimuthal equidistant projection about x.
#pragma once

#include <cstdint>
#include <optional>

#include "spacing/given_field.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// A spacing from scattered points with Dim coordinates. Vectors between them have Across
// components, fewer than Dim on a sphere.
template <int Dim, int Across = Dim>
class ScatteredSpacing : public LocalSpacing<Dim> {
 public:
  // `field` must be checked and without elements. Throws Error(ErrorKind::spacing) if points at the
  // same position have different values.
  explicit ScatteredSpacing(const GivenField<Dim, Across + 1>& field);
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;
  // Returns the values at the points and the slopes from each point to its nearest ones.
  SpacingHints<Dim> spacing_hints() const override { return known_; }
  // Returns the bounding box of the points, enlarged by the distance that they would have in it on
  // a grid, because few points are meant for more than their box. The box is infinite in directions
  // in which all points have the same coordinate.
  std::optional<GivenExtent<Dim>> extent() const override;

  static constexpr int kNeighbours = Across == 2 ? 8 : 16;

 private:
  // One of the points near x.
  struct Neighbour {
    double square;  // squared distance from x
    std::int32_t point;
    bool operator<(const Neighbour& other) const {
      return square != other.square ? square < other.square : point < other.point;
    }
  };
  // The nearest points, sorted; one more than the number used, whose distance is R.
  struct Neighbours {
    std::array<Neighbour, kNeighbours + 1> nearest;
    int found = 0;
    int counting() const { return found < kNeighbours ? found : kNeighbours; }
  };

  void collect_hints();
  Neighbours nearest(const Point<Dim>& x) const;
  double at(const Point<Dim>& x) const;

  // Sorted by coordinates, so that the given order does not matter.
  std::vector<Point<Dim>> points_;
  std::vector<double> values_;
  BoxTree<Dim> tree_;
  SpacingHints<Dim> known_;
};

extern template class ScatteredSpacing<2>;
extern template class ScatteredSpacing<3>;
extern template class ScatteredSpacing<3, 2>;  // points on a sphere

// A spacing from values at scattered points of a sphere.
class SphereScatteredSpacing : public ScatteredSpacing<3, 2> {
 public:
  // `field` must be checked and without triangles, with points on the sphere. Throws like
  // ScatteredSpacing.
  SphereScatteredSpacing(const SphereField& field, double radius);

  // Returns the spherical cap around the points, enlarged by the distance that they would have in
  // it on a grid. A single point is meant for the whole sphere.
  std::optional<GivenExtent<3>> extent() const override;
  void distance_to_extent(std::int64_t n, const Point<3>* x, double* distances) const override;

 private:
  double radius_;
  Point<3> middle_;  // direction from the centre
  double angle_;     // half opening angle of the cap [radians]
};

}  // namespace pnpbs
