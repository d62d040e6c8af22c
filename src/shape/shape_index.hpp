// SPDX-License-Identifier: BSD-3-Clause
// Answers queries about the shape of a domain from trees of its pieces: distances to the boundary
// or to pieces with a tag, and local widths.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "shape/shape.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// An index of the pieces of a shape. All queries are local.
template <int Dim>
class ShapeIndex {
 public:
  // A point on a piece, and the unit normal there that points into the domain.
  struct Place {
    Point<Dim> x;
    Point<Dim> ahead;
    std::array<std::int32_t, Dim> ends;  // corner numbers of the piece
  };

  explicit ShapeIndex(Shape<Dim> shape);

  const Shape<Dim>& shape() const { return shape_; }
  double size() const { return size_; }  // diagonal of the bounding box

  // Return the distance to the boundary, or to all pieces if nothing bounds the domain.
  double distance_to_boundary(const Point<Dim>& x) const {
    return distance<Dim>(nearest_on_boundary(x), x);
  }
  Point<Dim> nearest_on_boundary(const Point<Dim>& x) const { return nearest_of(boundary_, x); }
  bool has_tag(std::int32_t tag) const { return tagged_.contains(tag); }
  std::vector<std::int32_t> tags() const;
  // Return the distance to the pieces with a tag, which must exist.
  double distance_to_tag(std::int32_t tag, const Point<Dim>& x) const {
    return distance<Dim>(nearest_with_tag(tag, x), x);
  }
  Point<Dim> nearest_with_tag(std::int32_t tag, const Point<Dim>& x) const {
    return nearest_of(tagged_.at(tag), x);
  }

  // Returns the local width at a point of the shape: the diameter of the largest ball that touches
  // the shape there, lies ahead, and contains nothing of the facets ahead within 20 degrees that
  // face the point within 45 degrees. Infinity if no facet limits it. Too large by up to 3 percent
  // where thousands of facets come near the ball. Pieces that touch the piece of the point are
  // ignored, since the width in a sharp corner is 0.
  double width(const Place& place) const;
  // Returns the distance to the nearest facet within 60 degrees of `ahead`, but at most `reach`.
  double clearance_ahead(const Place& place, double reach) const;

  // A point of a facet that has x ahead within 20 degrees, with an empty ball between. It is the
  // counterpart of width(), seen from the other side.
  struct Foot {
    double gap;    // distance from x, or `reach` if there is no such point
    double width;  // diameter of the ball that touches the facet and reaches x
    Point<Dim> x{};
  };
  // Returns the nearest such point. x must lie on a piece with the corner numbers `ends`.
  Foot foot_of(const Point<Dim>& x, const std::array<std::int32_t, Dim>& ends, double reach) const;

 private:
  struct Selection {
    std::vector<std::size_t> pieces;
    BoxTree<Dim> tree;
  };

  template <class Wanted>
  Selection select(const Wanted& wanted) const;
  // Returns the nearest point of the selection; infinity if it is empty.
  Point<Dim> nearest_of(const Selection& selection, const Point<Dim>& x) const;
  bool is_empty(const Point<Dim>& centre, double radius) const;
  double width_below(const Place& place, const FacetCorners<Dim>& facet, double max) const;

  Shape<Dim> shape_;
  double size_ = 0;
  Selection boundary_, facets_;
  std::map<std::int32_t, Selection> tagged_;
};

extern template class ShapeIndex<2>;
extern template class ShapeIndex<3>;

}  // namespace pnpbs
