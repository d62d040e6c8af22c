// SPDX-License-Identifier: BSD-3-Clause
// The images of the curves and surfaces of a periodic domain that lie near its cell.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/image_range.hpp"
#include "base/periodic_cell.hpp"
#include "domain/domain_base.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// Curves or surfaces that are connected, or a part of them if they are not closed.
template <int Dim>
struct ConnectedPart {
  Box<Dim> box;
  bool closed;    // they separate inside and outside by themselves
  Point<Dim> on;  // a point on them
  // Returns whether a point lies inside of them. Called for closed ones only.
  std::function<bool(const Point<Dim>&)> encloses;
};

// Selects the images of connected parts that a domain around the cell consists of. A closed part
// has the images that meet the points within `reach` of the cell, together with the images that
// they enclose. Any other part has all images in the copies of the cell, unless they extend
// beyond these; it may separate regions together with others.
template <int Dim>
class ImagesNearCell {
 public:
  // `cell` must outlive this object. `may_touch` is whether parts that are not closed may end at
  // the boundary around the copies; otherwise the outermost copies lack parts that do.
  ImagesNearCell(const PeriodicCell<Dim>& cell, double reach, bool has_regions, bool may_touch,
                 std::vector<ConnectedPart<Dim>> parts);

  // Returns the number of copies on each side that contain all these images of closed parts and
  // the points within the reach of the cell.
  const Image<Dim>& copies() const { return copies_; }
  // Returns whether some parts are not closed.
  bool any_open() const { return any_open_; }
  // Returns the box around these copies.
  Box<Dim> outer() const;
  // Returns whether a part has this image.
  bool has(std::size_t part, const Image<Dim>& image) const;
  // Returns whether this image of a part is the one that stands for it in the cell.
  bool is_home(std::size_t part, const Image<Dim>& image) const;

  // Return the images of points of regions and of fixed nodes. A point of a region has an image if
  // all parts around that image exist.
  std::vector<RegionPoint<Dim>> images_of(const std::vector<RegionPoint<Dim>>& points) const;
  std::vector<FixedNode<Dim>> images_of(const std::vector<FixedNode<Dim>>& nodes) const;

  // Calls visit(image) for the copies of the cell, in a fixed order.
  template <class Visit>
  void for_copies(const Visit& visit) const {
    Image<Dim> first;
    for (std::size_t k = 0; k < Dim; ++k) first[k] = -copies_[k];
    for_images(first, copies_, visit);
  }
  // Returns the image of a point.
  Point<Dim> moved(const Image<Dim>& image, const Point<Dim>& x) const {
    Image<Dim> opposite;
    for (std::size_t k = 0; k < Dim; ++k) opposite[k] = -image[k];
    return cell_.seen_from(opposite, cell_.rounded(x));
  }

 private:
  std::int32_t copies_along(std::size_t k, double reach, bool has_regions) const;
  Box<Dim> moved(const Image<Dim>& image, const Box<Dim>& box) const {
    return {moved(image, box.low), moved(image, box.high)};
  }
  template <class Visit>
  void for_parts_around(const Point<Dim>& x, const Visit& visit) const;
  bool all_around_exist(const Image<Dim>& image, const Point<Dim>& x) const;

  const PeriodicCell<Dim>& cell_;
  Image<Dim> copies_{};
  std::vector<ConnectedPart<Dim>> parts_;
  std::vector<Box<Dim>> extents_;  // of parts with those around them
  BoxTree<Dim> boxes_;             // of the parts
  Box<Dim> bounds_{};              // of all parts
  Box<Dim> near_{};                // contains the points within the reach of the cell
  bool any_open_ = false, may_touch_;
};

extern template class ImagesNearCell<2>;
extern template class ImagesNearCell<3>;

}  // namespace pnpbs
