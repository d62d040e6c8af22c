// SPDX-License-Identifier: BSD-3-Clause
// The spacing from values at scattered points, all of which every rank stores: a weighted mean of
// the values of the points nearest to x, with positive weights, so that d never leaves their range.
//
// - The weight of a point is 1/r - 1/R, with r its distance from x and R that of the nearest one
//   that is not used any more (the square root of that of R. Franke, G. Nielson, Int. J. Numer.
//   Methods Eng. 15 (1980) 1691-1704). So d equals the given value at each point and is continuous.
// - A point that lies behind another one, as seen from x, has a smaller weight or none. So many
//   points in one direction weigh no more than the first of them, and d beside a dense group of
//   points is that of its rim.
// - Twice the weights are changed to those of a plane fitted to the values, as far as they remain
//   positive. So linear functions are reproduced nearly where points lie all around x.
//
// The values of a fitted plane itself may leave the range of the values far from the points that it
// is fitted to, where these are close to each other. A triangulation of the points has long thin
// elements along its hull and none where all points are on a line, and natural neighbours take ten
// times as long in space.
//
// On a sphere ways from x are those of the azimuthal equidistant projection about x.
#pragma once

#include <cstdint>
#include <optional>

#include "spacing/given_field.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// Points in Dim dimensions; ways in Across of them, which are fewer on a sphere.
template <int Dim, int Across = Dim>
class ScatteredSpacing : public LocalSpacing<Dim> {
 public:
  // Of a checked field without elements. Throws Error(ErrorKind::spacing) where points in one place
  // have different values.
  explicit ScatteredSpacing(const GivenField<Dim, Across + 1>& field);
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;
  // With slopes from each point to the nearest ones.
  SpacingHints<Dim> spacing_hints() const override { return known_; }
  // The points' box, wider by the distance that they would have in it on a grid: few points are
  // meant for more than their box. A direction in which all have one coordinate has no end.
  std::optional<GivenExtent<Dim>> extent() const override;

  static constexpr int kNeighbours = Across == 2 ? 8 : 16;

 private:
  // One of the points nearest to x.
  struct Neighbour {
    double square;  // of its distance
    std::int32_t point;
    bool operator<(const Neighbour& other) const {
      return square != other.square ? square < other.square : point < other.point;
    }
  };
  // One more than count.
  struct Neighbours {
    std::array<Neighbour, kNeighbours + 1> nearest;
    int found = 0;
    int counting() const { return found < kNeighbours ? found : kNeighbours; }
  };

  void find_known();
  Neighbours nearest(const Point<Dim>& x) const;
  double at(const Point<Dim>& x) const;

  // By increasing coordinates, so that their order as given changes nothing.
  std::vector<Point<Dim>> points_;
  std::vector<double> values_;
  BoxTree<Dim> tree_;
  SpacingHints<Dim> known_;
};

extern template class ScatteredSpacing<2>;
extern template class ScatteredSpacing<3>;
extern template class ScatteredSpacing<3, 2>;  // on a sphere

// The spacing from values at scattered points of a sphere.
class SphereScatteredSpacing : public ScatteredSpacing<3, 2> {
 public:
  // Of a checked field without triangles, whose points lie on the sphere. Throws as
  // ScatteredSpacing.
  SphereScatteredSpacing(const SphereField& field, double radius);

  // The cap about the points' middle that holds them, wider by the distance that they would have in
  // it on a grid. One point is meant for the whole sphere.
  std::optional<GivenExtent<3>> extent() const override;
  void distance_to_extent(std::int64_t n, const Point<3>* x, double* distances) const override;

 private:
  double radius_;
  Point<3> middle_;  // a direction
  double angle_;     // radians
};

}  // namespace pnpbs
