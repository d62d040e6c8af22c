// SPDX-License-Identifier: BSD-3-Clause
// Questions about the shape of a domain, answered by trees of its pieces: how far is it to the
// boundary, or to what has a tag; how wide is the domain there?
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "shape/shape.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

template <int Dim>
class ShapeIndex {
 public:
  // A place on a piece, and the way into the domain there: a unit vector at right angles to it.
  struct Place {
    Point<Dim> x;
    Point<Dim> ahead;
    std::array<std::int32_t, Dim> ends;  // of the piece
  };

  explicit ShapeIndex(Shape<Dim> shape);

  const Shape<Dim>& shape() const { return shape_; }
  double size() const { return size_; }  // of a box around all

  // To what bounds the domain, or if nothing does, to all of it.
  double distance_to_boundary(const Point<Dim>& x) const {
    return distance<Dim>(nearest_on_boundary(x), x);
  }
  Point<Dim> nearest_on_boundary(const Point<Dim>& x) const { return nearest_of(boundary_, x); }
  bool has_tag(std::int32_t tag) const { return tagged_.contains(tag); }
  std::vector<std::int32_t> tags() const;
  // To the pieces with that tag, of which there are some.
  double distance_to_tag(std::int32_t tag, const Point<Dim>& x) const {
    return distance<Dim>(nearest_with_tag(tag, x), x);
  }
  Point<Dim> nearest_with_tag(std::int32_t tag, const Point<Dim>& x) const {
    return nearest_of(tagged_.at(tag), x);
  }

  // The diameter of the largest ball that touches the shape at the place, lies ahead of it, and
  // holds nothing of what is ahead within 20 degrees and faces it within 45; infinity if there is
  // none. Too large by up to 3 percent where the ball comes near to thousands of facets. Pieces
  // that touch that of the place do not count: in a sharp corner there is no room for anything.
  double width(const Place& place) const;
  // The distance to what is ahead within 60 degrees, but at most `reach`.
  double clearance_ahead(const Place& place, double reach) const;

  // The same seen from the other side: a point of a facet that has x ahead within 20 degrees, with
  // nothing of the shape in the ball between.
  struct Foot {
    double gap;    // the distance from x, or `reach` if there is none so near
    double width;  // diameter of the ball that touches there and reaches x
    Point<Dim> x{};
  };
  // The nearest to x, a point of a piece with these ends.
  Foot foot_of(const Point<Dim>& x, const std::array<std::int32_t, Dim>& ends, double reach) const;

 private:
  struct Selection {
    std::vector<std::size_t> pieces;
    BoxTree<Dim> tree;
  };

  template <class Wanted>
  Selection select(const Wanted& wanted) const;
  // Infinitely far away if nothing is selected.
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
