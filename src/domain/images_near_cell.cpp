// SPDX-License-Identifier: BSD-3-Clause
#include "domain/images_near_cell.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/limits.hpp"

namespace pnpbs {

namespace {

template <int Dim>
std::vector<Box<Dim>> boxes_of(const std::vector<ConnectedPart<Dim>>& parts) {
  std::vector<Box<Dim>> boxes;
  for (const ConnectedPart<Dim>& part : parts) boxes.push_back(part.box);
  return boxes;
}

}  // namespace

template <int Dim>
ImagesNearCell<Dim>::ImagesNearCell(const PeriodicCell<Dim>& cell, double reach, bool has_regions,
                                    bool may_touch, std::vector<ConnectedPart<Dim>> parts)
    : cell_(cell),
      parts_(std::move(parts)),
      extents_(boxes_of(parts_)),
      boxes_(extents_),
      bounds_(empty_box<Dim>()),
      near_(widened(cell.box(), reach)),
      may_touch_(may_touch) {
  for (const ConnectedPart<Dim>& part : parts_) {
    bounds_ = joined(bounds_, part.box);
    any_open_ = any_open_ || !part.closed;
  }
  for (std::size_t p = 0; p < parts_.size(); ++p)
    if (parts_[p].closed)
      for_parts_around(parts_[p].on, [&](std::size_t around, const Image<Dim>& image) {
        extents_[p] = joined(extents_[p], moved(image, parts_[around].box));
      });
  for (std::size_t k = 0; k < Dim; ++k)
    if (cell.periodic(static_cast<int>(k))) copies_[k] = copies_along(k, reach, has_regions);
}

template <int Dim>
std::int32_t ImagesNearCell<Dim>::copies_along(std::size_t k, double reach,
                                               bool has_regions) const {
  const Box<Dim>& box = cell_.box();
  const double period = cell_.period(static_cast<int>(k));
  // The outermost copies lack surfaces that are not closed, and other parts around points of
  // regions.
  const bool lack = (!may_touch_ && any_open_) || has_regions;
  double copies = std::max(1.0, std::ceil(reach / period)) + lack;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (!parts_[p].closed) continue;
    const Box<Dim>&part = parts_[p].box, &extent = extents_[p];
    const double up = std::floor((near_.high[k] - extent.low[k]) / period);
    const double down = std::ceil((near_.low[k] - extent.high[k]) / period);
    copies = std::max({copies, std::floor((part.high[k] - box.high[k]) / period + up) + 1,
                       std::floor((box.low[k] - part.low[k]) / period - down) + 1});
  }
  return static_cast<std::int32_t>(std::min<double>(copies, PeriodicCell<Dim>::kFarthest));
}

template <int Dim>
Box<Dim> ImagesNearCell<Dim>::outer() const {
  Box<Dim> box = cell_.box();
  for (std::size_t k = 0; k < Dim; ++k) {
    box.low[k] -= copies_[k] * cell_.period(static_cast<int>(k));
    box.high[k] += copies_[k] * cell_.period(static_cast<int>(k));
  }
  return box;
}

template <int Dim>
bool ImagesNearCell<Dim>::has(std::size_t part, const Image<Dim>& image) const {
  const bool closed = parts_[part].closed;
  const Box<Dim> box = moved(image, parts_[part].box), extent = moved(image, extents_[part]),
                 bounds = outer();
  for (std::size_t k = 0; k < Dim; ++k) {
    if (!cell_.periodic(static_cast<int>(k))) continue;
    const double room = std::min(box.low[k] - bounds.low[k], bounds.high[k] - box.high[k]);
    if (room < 0 || (room == 0 && (closed || !may_touch_))) return false;
    if (closed && (extent.low[k] > near_.high[k] || extent.high[k] < near_.low[k])) return false;
  }
  return true;
}

template <int Dim>
bool ImagesNearCell<Dim>::is_home(std::size_t part, const Image<Dim>& image) const {
  return parts_[part].closed ? cell_.image_of(moved(image, parts_[part].box.low)) == Image<Dim>{}
                             : image == Image<Dim>{};
}

// Calls visit(part, image) for the images of closed parts that enclose x.
template <int Dim>
template <class Visit>
void ImagesNearCell<Dim>::for_parts_around(const Point<Dim>& x, const Visit& visit) const {
  if (parts_.empty()) return;
  Image<Dim> first{}, last{};
  for (std::size_t k = 0; k < Dim; ++k) {
    if (!cell_.periodic(static_cast<int>(k))) continue;
    const double period = cell_.period(static_cast<int>(k));
    first[k] = static_cast<std::int32_t>(std::ceil((x[k] - bounds_.high[k]) / period));
    last[k] = static_cast<std::int32_t>(std::floor((x[k] - bounds_.low[k]) / period));
    if (first[k] > last[k]) return;
  }
  for_images(first, last, [&](const Image<Dim>& image) {
    const Point<Dim> at = cell_.seen_from(image, x);
    boxes_.for_holding(at, [&](std::int32_t p) {
      const ConnectedPart<Dim>& part = parts_[static_cast<std::size_t>(p)];
      if (part.closed && part.encloses(at)) visit(static_cast<std::size_t>(p), image);
    });
  });
}

// Returns whether the domain has all parts around a point in this copy of the cell. Parts that are
// not closed may be missing in the outermost copies.
template <int Dim>
bool ImagesNearCell<Dim>::all_around_exist(const Image<Dim>& image, const Point<Dim>& x) const {
  bool enclosed = false, exist = true;
  for_parts_around(x, [&](std::size_t part, const Image<Dim>& of_part) {
    enclosed = true;
    exist = exist && has(part, of_part);
  });
  if (enclosed && !any_open_) return exist;
  for (std::size_t k = 0; k < Dim; ++k)
    if (copies_[k] > 0 && std::abs(image[k]) == copies_[k]) return false;
  return exist;
}

template <int Dim>
std::vector<RegionPoint<Dim>> ImagesNearCell<Dim>::images_of(
    const std::vector<RegionPoint<Dim>>& points) const {
  std::vector<RegionPoint<Dim>> images;
  for_copies([&](const Image<Dim>& image) {
    for (RegionPoint<Dim> point : points) {
      point.point = moved(image, cell_.in_cell(cell_.rounded(point.point)));
      if (all_around_exist(image, point.point)) images.push_back(std::move(point));
    }
  });
  return images;
}

template <int Dim>
std::vector<FixedNode<Dim>> ImagesNearCell<Dim>::images_of(
    const std::vector<FixedNode<Dim>>& nodes) const {
  std::vector<FixedNode<Dim>> images;
  for_copies([&](const Image<Dim>& image) {
    for (FixedNode<Dim> node : nodes) {
      node.position = moved(image, cell_.in_cell(cell_.rounded(node.position)));
      images.push_back(std::move(node));
    }
  });
  return images;
}

template class ImagesNearCell<2>;
template class ImagesNearCell<3>;

}  // namespace pnpbs
