// SPDX-License-Identifier: BSD-3-Clause
#include "shape/shape_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/space_vectors.hpp"
#include "geometry/plane/edges.hpp"
#include "geometry/volume/triangles.hpp"

namespace pnpbs {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A wedge of twice this angle counts as a corner and not as a gap.
constexpr double kCosAhead = 0.93969262078590838, kSinAhead = 0.34202014332566873;  // 20 degrees
constexpr double kCosFacing = 0.70710678118654752;                                  // 45 degrees
constexpr double kCosNear = 0.5;                                                    // 60 degrees

template <int Dim>
double product(const Point<Dim>& a, const Point<Dim>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < Dim; ++k) sum += a[k] * b[k];
  return sum;
}

template <int Dim>
Point<Dim> away(const Point<Dim>& x, double by, const Point<Dim>& direction) {
  Point<Dim> y;
  for (std::size_t k = 0; k < Dim; ++k) y[k] = x[k] + by * direction[k];
  return y;
}

template <int Dim>
Point<Dim> way_from(const Point<Dim>& a, const Point<Dim>& b) {
  return away<Dim>(b, -1, a);
}

Point<2> across(const FacetCorners<2>& f) { return {f[0][1] - f[1][1], f[1][0] - f[0][0]}; }
Point<3> across(const FacetCorners<3>& f) {
  return cross(difference(f[1], f[0]), difference(f[2], f[0]));
}

template <int Dim>
Box<Dim> box_of(const FacetCorners<Dim>& corners) {
  Box<Dim> box{corners[0], corners[0]};
  for (const Point<Dim>& corner : corners) box = joined(box, Box<Dim>{corner, corner});
  return box;
}

template <std::size_t Size>
bool share_one(const std::array<std::int32_t, Size>& a, const std::array<std::int32_t, Size>& b) {
  return std::ranges::find_first_of(a, b) != a.end();
}

// Returns true if a part of the box may lie within the angle ahead.
template <int Dim>
bool may_be_ahead(const Box<Dim>& box, const typename ShapeIndex<Dim>::Place& place) {
  const Point<Dim> middle = away<Dim>(box.low, 0.5, way_from<Dim>(box.low, box.high)),
                   way = way_from<Dim>(place.x, middle);
  const double radius = 0.5 * distance<Dim>(box.low, box.high);
  const double along = product<Dim>(way, place.ahead);
  const double aside = std::sqrt(std::max(0.0, product<Dim>(way, way) - along * along));
  return aside * kCosAhead - along * kSinAhead <= radius * (1 + 1e-12);
}

}  // namespace

template <int Dim>
ShapeIndex<Dim>::ShapeIndex(Shape<Dim> shape) : shape_(std::move(shape)) {
  if (shape_.empty()) return;
  const bool any = std::ranges::any_of(shape_, &ShapePiece<Dim>::bounds);
  boundary_ = select([any](const ShapePiece<Dim>& piece) { return piece.bounds() || !any; });
  facets_ = select([](const ShapePiece<Dim>& piece) { return piece.is_facet(); });
  for (const ShapePiece<Dim>& piece : shape_) tagged_[piece.tag];
  for (auto& tagged : tagged_)
    tagged.second =
        select([tag = tagged.first](const ShapePiece<Dim>& piece) { return piece.tag == tag; });
  Box<Dim> all = box_of<Dim>(shape_[0].corners);
  for (const ShapePiece<Dim>& piece : shape_) all = joined(all, box_of<Dim>(piece.corners));
  size_ = distance<Dim>(all.low, all.high);
}

template <int Dim>
template <class Wanted>
typename ShapeIndex<Dim>::Selection ShapeIndex<Dim>::select(const Wanted& wanted) const {
  Selection selection;
  std::vector<Box<Dim>> boxes;
  for (std::size_t p = 0; p < shape_.size(); ++p) {
    if (!wanted(shape_[p])) continue;
    selection.pieces.push_back(p);
    boxes.push_back(box_of<Dim>(shape_[p].corners));
  }
  selection.tree = BoxTree<Dim>(std::move(boxes));
  return selection;
}

template <int Dim>
std::vector<std::int32_t> ShapeIndex<Dim>::tags() const {
  std::vector<std::int32_t> tags;
  for (const auto& [tag, selection] : tagged_) tags.push_back(tag);
  return tags;
}

template <int Dim>
Point<Dim> ShapeIndex<Dim>::nearest_of(const Selection& selection, const Point<Dim>& x) const {
  constexpr double kRounding = 1 + 1e-12;  // so that boxes equally near are visited
  double best = kInfinity;
  Point<Dim> nearest;
  nearest.fill(kInfinity);
  selection.tree.for_near(
      x, [&] { return kRounding * best * best; },
      [&](std::int32_t i) {
        const ShapePiece<Dim>& piece = shape_[selection.pieces[static_cast<std::size_t>(i)]];
        const Point<Dim> point = nearest_on(piece.corners, x);
        const double gap = distance<Dim>(point, x);
        if (gap < best) best = gap, nearest = point;
      });
  return nearest;
}

// The ball grows by doubling until a facet limits it, and is then shrunk: first as long as it
// shrinks by a certain fraction, then exactly within a limited number of boxes. The limit is needed
// because 100 000 facets may touch a ball, such as those of a sphere around it.
template <int Dim>
double ShapeIndex<Dim>::width(const Place& place) const {
  constexpr double kFirst = 1.0 / 1024, kPart = 0.03;
  constexpr int kMaxBoxes = 1 << (Dim == 2 ? 16 : 11);
  double best = kFirst * size_;
  int boxes = 0;
  const auto shrink = [&](double part, int max_boxes) {
    boxes = 0;
    facets_.tree.for_entered(
        [&](const Box<Dim>& box) {
          const double radius = 0.5 * (1 - part) * best;
          return ++boxes <= max_boxes && may_be_ahead<Dim>(box, place) &&
                 squared_gap_to(box, away<Dim>(place.x, radius, place.ahead)) <= radius * radius;
        },
        [&](std::int32_t i) {
          const ShapePiece<Dim>& piece = shape_[facets_.pieces[static_cast<std::size_t>(i)]];
          if (!share_one(piece.ends, place.ends))
            best = std::min(best, width_below(place, piece.corners, best));
        });
  };
  for (; best < 4 * size_; best *= 2) {
    const double reach = best;
    shrink(kPart, std::numeric_limits<int>::max());
    if (best == reach) continue;
    shrink(0, kMaxBoxes);
    return best;
  }
  return kInfinity;
}

// Returns the width that a single facet allows, or `max` if that is smaller. The ball shrinks until
// it contains nothing of the facet (Ma, Bae and Choi, The Visual Computer 28 (2012) 7).
template <int Dim>
double ShapeIndex<Dim>::width_below(const Place& place, const FacetCorners<Dim>& facet,
                                    double max) const {
  constexpr int kMaxSteps = 60;
  constexpr double kStill = 1 - 1e-14;
  double radius = 0.5 * max, along = 0;
  Point<Dim> way;
  for (int step = 0; step < kMaxSteps; ++step) {
    way = way_from<Dim>(place.x, nearest_on(facet, away<Dim>(place.x, radius, place.ahead)));
    along = product<Dim>(way, place.ahead);
    const double touching = along > 0 ? 0.5 * product<Dim>(way, way) / along : kInfinity;
    if (!(touching < kStill * radius)) break;
    radius = touching;
  }
  if (!(2 * radius < max)) return max;
  const double far = std::sqrt(product<Dim>(way, way));
  const Point<Dim> normal = across(facet);
  const double steep = kCosFacing * std::sqrt(product<Dim>(normal, normal));
  // Beside a corner the other side is ahead but does not face this one.
  if (along >= kCosAhead * far)
    return std::fabs(product<Dim>(way, normal)) >= steep * far ? 2 * radius : max;
  // The nearest point of contact is not ahead, but another point of the facet may lie straight
  // ahead.
  const double slope = product<Dim>(normal, place.ahead);
  const double hit = product<Dim>(normal, way_from<Dim>(place.x, facet[0])) / slope;
  if (!(std::fabs(slope) >= steep) || slope == 0 || !(hit > 0 && hit < max)) return max;
  const Point<Dim> there = away<Dim>(place.x, hit, place.ahead);
  return distance<Dim>(nearest_on(facet, there), there) <= 1e-12 * size_ ? hit : max;
}

// Returns true if the ball contains no part of a facet.
template <int Dim>
bool ShapeIndex<Dim>::is_empty(const Point<Dim>& centre, double radius) const {
  bool empty = true;
  facets_.tree.for_near(
      centre, [&] { return empty ? radius * radius : -1; },
      [&](std::int32_t i) {
        const ShapePiece<Dim>& piece = shape_[facets_.pieces[static_cast<std::size_t>(i)]];
        if (empty) empty = !(distance<Dim>(nearest_on(piece.corners, centre), centre) < radius);
      });
  return empty;
}

template <int Dim>
double ShapeIndex<Dim>::clearance_ahead(const Place& place, double reach) const {
  double best = reach;
  facets_.tree.for_near(
      place.x, [&] { return best * best; },
      [&](std::int32_t i) {
        const ShapePiece<Dim>& piece = shape_[facets_.pieces[static_cast<std::size_t>(i)]];
        if (share_one(piece.ends, place.ends)) return;
        const Point<Dim> way = way_from<Dim>(place.x, nearest_on(piece.corners, place.x));
        const double far = std::sqrt(product<Dim>(way, way));
        if (product<Dim>(way, place.ahead) > kCosNear * far) best = std::min(best, far);
      });
  return best;
}

template <int Dim>
typename ShapeIndex<Dim>::Foot ShapeIndex<Dim>::foot_of(const Point<Dim>& x,
                                                        const std::array<std::int32_t, Dim>& ends,
                                                        double reach) const {
  Foot foot{reach, kInfinity};
  facets_.tree.for_near(
      x, [&] { return foot.gap * foot.gap; },
      [&](std::int32_t i) {
        const ShapePiece<Dim>& piece = shape_[facets_.pieces[static_cast<std::size_t>(i)]];
        if (share_one(piece.ends, ends)) return;
        const Point<Dim> on = nearest_on(piece.corners, x), way = way_from<Dim>(on, x),
                         normal = across(piece.corners);
        const double gap = std::sqrt(product<Dim>(way, way)), slope = product<Dim>(way, normal);
        if (!(slope > 0 ? piece.front_inside : piece.back_inside)) return;
        const double along = std::fabs(slope) / std::sqrt(product<Dim>(normal, normal));
        if (along < kCosAhead * gap || !(along > 0)) return;
        if (!(gap < foot.gap || (gap == foot.gap && on < foot.x))) return;
        // Beside a corner the ball contains a part of the adjacent sides and is rejected.
        constexpr double kRoom = 1 - 1e-6;
        const double width = gap * gap / along, whole = std::fabs(slope) / along;
        const double to_centre = std::copysign(0.5 * width / whole, slope);
        const Point<Dim> centre = away<Dim>(on, to_centre, normal);
        if (is_empty(centre, 0.5 * kRoom * width)) foot = {gap, width, on};
      });
  return foot;
}

template class ShapeIndex<2>;
template class ShapeIndex<3>;

}  // namespace pnpbs
