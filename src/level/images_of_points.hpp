// SPDX-License-Identifier: BSD-3-Clause
// Finds the points of the copies of a periodic domain that are images of each other.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "base/periodic_cell.hpp"

namespace pnpbs {

// The points are nodes of the boundary or centroids of its facets. Points of different copies were
// computed separately, and differ from exact images by rounding errors.
template <int Dim>
class ImagesOfPoints {
 public:
  ImagesOfPoints() = default;
  // Moves the points so that images differ exactly by the periods.
  ImagesOfPoints(const PeriodicCell<Dim>& cell, std::vector<Point<Dim>>& points);

  // Returns the point that has the place of point p where the copy `image` is seen as the cell, or
  // -1 if there is none.
  std::int32_t seen_from(const Image<Dim>& image, std::int32_t p) const;
  // Returns the number of a point, which is the same for all of its images.
  std::int32_t number(std::int32_t p) const { return places_[static_cast<std::size_t>(p)].number; }
  // Returns whether a point lies in the cell.
  bool in_cell(std::int32_t p) const {
    return places_.empty() || places_[static_cast<std::size_t>(p)].image == Image<Dim>{};
  }

 private:
  struct Place {
    std::int32_t number;  // of the point in the cell
    Image<Dim> image;
    auto operator<=>(const Place&) const = default;
  };
  std::vector<Place> places_;  // of all points
  std::map<Place, std::int32_t> at_;
};

extern template class ImagesOfPoints<2>;
extern template class ImagesOfPoints<3>;

}  // namespace pnpbs
