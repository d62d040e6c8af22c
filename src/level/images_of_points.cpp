// SPDX-License-Identifier: BSD-3-Clause
#include "level/images_of_points.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/mixed_hash.hpp"

namespace pnpbs {

namespace {

// Distance within which points of different copies are images of each other. [side of the cell]
constexpr double kSame = 1e-9;

// Points in the cell, found by their positions up to the periods.
template <int Dim>
class PointsInCell {
 public:
  explicit PointsInCell(const PeriodicCell<Dim>& cell) : cell_(cell) {
    for (int k = 0; k < Dim; ++k) same_[k] = kSame * (cell.box().high[k] - cell.box().low[k]);
  }

  const Point<Dim>& position(std::int32_t n) const { return points_[static_cast<std::size_t>(n)]; }

  // Returns the number of the point at x or at an image of it. Adds it if there is none.
  std::int32_t number_at(const Point<Dim>& x) {
    const Point<Dim> home = cell_.in_cell(x);
    std::int32_t found = -1;
    for_boxes_around(home, [&](std::uint64_t key) {
      const auto [begin, end] = boxes_.equal_range(key);
      for (auto n = begin; n != end; ++n)
        if (found < 0 && is_at(n->second, home)) found = n->second;
    });
    if (found >= 0) return found;
    found = static_cast<std::int32_t>(points_.size());
    points_.push_back(home);
    boxes_.emplace(key(home), found);
    return found;
  }

 private:
  // Calls visit(key) for the boxes of the hash that points at x can be in.
  template <class Visit>
  void for_boxes_around(const Point<Dim>& x, const Visit& visit) const {
    constexpr int kCorners = Dim == 2 ? 4 : 8;
    std::array<std::uint64_t, kCorners> keys;
    for (int corner = 0; corner < kCorners; ++corner) {
      Point<Dim> near = x;
      for (int k = 0; k < Dim; ++k) near[k] += (corner >> k & 1) != 0 ? same_[k] : -same_[k];
      keys[static_cast<std::size_t>(corner)] = key(cell_.in_cell(near));
    }
    std::ranges::sort(keys);
    const auto end = std::unique(keys.begin(), keys.end());
    std::for_each(keys.begin(), end, visit);
  }

  std::uint64_t key(const Point<Dim>& x) const {
    constexpr double kBox = 16;  // side of a box in units of the distance of the same points
    std::uint64_t hash = 0;
    for (int k = 0; k < Dim; ++k)
      hash = mixed(hash ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(
                              std::floor((x[k] - cell_.box().low[k]) / (kBox * same_[k])))));
    return hash;
  }

  bool is_at(std::int32_t n, const Point<Dim>& x) const {
    for (int k = 0; k < Dim; ++k) {
      double gap = std::fabs(position(n)[k] - x[k]);
      if (cell_.periodic(k)) gap = std::min(gap, std::fabs(cell_.period(k) - gap));
      if (gap > same_[k]) return false;
    }
    return true;
  }

  const PeriodicCell<Dim>& cell_;
  Point<Dim> same_{};
  std::vector<Point<Dim>> points_;
  std::unordered_multimap<std::uint64_t, std::int32_t> boxes_;
};

}  // namespace

template <int Dim>
ImagesOfPoints<Dim>::ImagesOfPoints(const PeriodicCell<Dim>& cell,
                                    std::vector<Point<Dim>>& points) {
  PointsInCell<Dim> in_cell(cell);
  for (Point<Dim>& x : points) {
    const std::int32_t number = in_cell.number_at(cell.rounded(x));
    const Point<Dim>& home = in_cell.position(number);
    Image<Dim> image{};
    for (int k = 0; k < Dim; ++k) {
      if (cell.periodic(k))
        image[k] = static_cast<std::int32_t>(std::lround((x[k] - home[k]) / cell.period(k)));
      x[k] = home[k] + image[k] * cell.period(k);
    }
    at_.emplace(Place{number, image}, static_cast<std::int32_t>(places_.size()));
    places_.push_back({number, image});
  }
}

template <int Dim>
std::int32_t ImagesOfPoints<Dim>::seen_from(const Image<Dim>& image, std::int32_t p) const {
  if (p < 0 || image == Image<Dim>{}) return p;
  Place place = places_[static_cast<std::size_t>(p)];
  for (std::size_t k = 0; k < Dim; ++k) place.image[k] -= image[k];
  const auto found = at_.find(place);
  return found == at_.end() ? -1 : found->second;
}

template class ImagesOfPoints<2>;
template class ImagesOfPoints<3>;

}  // namespace pnpbs
