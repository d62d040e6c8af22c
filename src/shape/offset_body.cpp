// SPDX-License-Identifier: BSD-3-Clause
#include "shape/offset_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "base/started_execution.hpp"
#include "domain/given_values.hpp"
#include "implicit/level_curves.hpp"
#include "shape/signed_distance.hpp"

namespace pnpbs {

namespace {

using given_values::reject;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();
// Default resolution. [smallest d] It is finer in the plane, where nodes lie on chords of the level
// curves; in space nodes are projected to f = 0.
template <int Dim>
constexpr double kFineness = Dim == 2 ? 0.125 : 0.5;
constexpr double kRoom = 2;  // margin of the box around the body [resolution]
// Smallest extent of loops in the plane. [d, resolution] Smaller ones have room for no particle, or
// only for particles that are too close.
constexpr double kSmallestLoop = 0.5, kSmallestLoopOnLattice = 2;

template <int Dim>
void require_limits(const Offset<Dim>& offset) {
  const double low = offset.low, high = offset.high;
  if (!(low < high))
    reject("low is " + number_text(low) + ", expected less than high, which is " +
           number_text(high));
  if (!std::isfinite(high) || low == kNoLimit)
    reject("high is " + number_text(high) + ", expected a finite number");
  if (!(offset.resolution >= 0 && std::isfinite(offset.resolution)))
    reject("resolution is " + number_text(offset.resolution) +
           ", expected a positive number, or 0 for one that suits the least spacing");
  given_values::require_tag("tag", offset.tag);
}

template <int Dim>
std::string name_of(const Offset<Dim>& offset) {
  const std::string unit = offset.spacing ? " d" : "";
  const std::string low = std::isfinite(offset.low) ? number_text(offset.low) + unit : "-infinity";
  return "the body at distances from " + low + " to " + number_text(offset.high) + unit;
}

template <int Dim>
class OffsetFunction {
 public:
  OffsetFunction(const Domain<Dim>& body, Offset<Dim> offset)
      : distance_(std::make_shared<const SignedDistance<Dim>>(body)), offset_(std::move(offset)) {
    const auto [least, most] = std::ranges::minmax(spacing_at_corners());
    most_ = most;
    resolution_ = offset_.resolution > 0 ? offset_.resolution : suitable_resolution(least);
  }

  // Evaluates f: negative between the limits, and approximately a distance near them.
  void operator()(std::int64_t n, const Point<Dim>* x, double* f) const {
    const std::vector<double> d = spacing_at(n, x);
    for_each_if_started("pnpbs::shape::offset", n, [&](std::int64_t i) {
      const double s = (*distance_)(x[i]), here = d[static_cast<std::size_t>(i)];
      f[i] = s - offset_.high * here;
      if (offset_.low > -kNoLimit) f[i] = std::max(f[i], offset_.low * here - s);
    });
  }

  double resolution() const { return resolution_; }

  // Returns true if a loop with this bounding box is large enough.
  bool is_worth_keeping(const Box<Dim>& box) const {
    double smallest = kSmallestLoopOnLattice * resolution_;
    const Point<Dim> middle = middle_of<Dim>(box.low, box.high);
    if (offset_.spacing) smallest = std::max(smallest, kSmallestLoop * spacing_at(1, &middle)[0]);
    return size_of(box) >= smallest;
  }

  // Returns a box that contains the offset body, with a margin.
  Box<Dim> box() const {
    const double room = kRoom * resolution_;
    if (offset_.high <= 0) return widened(distance_->bounds(), room);
    const Box<Dim> near = widened(distance_->bounds(), offset_.high * most_);
    std::vector<Point<Dim>> corners;
    for (int corner = 0; corner < 1 << Dim; ++corner) {
      Point<Dim>& x = corners.emplace_back();
      for (int k = 0; k < Dim; ++k) x[k] = corner >> k & 1 ? near.high[k] : near.low[k];
    }
    const std::vector<double> beyond = spacing_at(1 << Dim, corners.data());
    const double most = std::max(most_, std::ranges::max(beyond));
    return widened(distance_->bounds(), offset_.high * most + room);
  }

 private:
  // Returns the default resolution. `least` is the smallest d at the boundary.
  double suitable_resolution(double least) const {
    if (offset_.spacing) return kFineness<Dim> * least;
    least = kNoLimit;
    for (const double limit : {std::fabs(offset_.low), std::fabs(offset_.high)})
      if (limit > 0) least = std::min(least, limit);
    if (least == kNoLimit)
      reject(
          "resolution is 0, and neither a spacing nor a limit other than 0 determines one: "
          "expected a positive number");
    return kFineness<Dim> * least;
  }

  std::vector<double> spacing_at(std::int64_t n, const Point<Dim>* x) const {
    std::vector<double> d(static_cast<std::size_t>(n), 1);
    if (offset_.spacing) (*offset_.spacing)(n, x, d.data());
    return d;
  }

  // Returns d at the corners of the boundary pieces.
  std::vector<double> spacing_at_corners() const {
    std::vector<Point<Dim>> corners;
    for (const ShapePiece<Dim>& piece : distance_->shape())
      if (piece.bounds()) corners.insert(corners.end(), piece.corners.begin(), piece.corners.end());
    return spacing_at(std::ssize(corners), corners.data());
  }

  std::shared_ptr<const SignedDistance<Dim>> distance_;
  Offset<Dim> offset_;
  double most_, resolution_;  // largest d at the boundary, and resolution of the level set
};

Box<2> box_of(const std::vector<LevelCurve>& loop) {
  Box<2> box = empty_box<2>();
  for (const LevelCurve& curve : loop)
    for (const Point<2>& x : curve.points) include<2>(box, x);
  return box;
}

}  // namespace

void add_offset(PlaneDomain& domain, const PlaneDomain& body, const Offset<2>& offset) {
  require_limits(offset);
  const OffsetFunction<2> f(body, offset);
  const Box<2> box = f.box();
  const LevelSet set(
      name_of(offset),
      [&f](std::int64_t n, const Point<3>* x, double* values) {
        std::vector<Point<2>> flat;
        for (std::int64_t i = 0; i < n; ++i) flat.push_back({x[i][0], x[i][1]});
        f(n, flat.data(), values);
      },
      {{box.low[0], box.low[1], 0}, {box.high[0], box.high[1], 0}}, f.resolution());
  constexpr double kNoCorners = 180;  // [degrees] only ends of curves are corners
  for (const std::vector<LevelCurve>& loop : level_curves(set)) {
    if (!f.is_worth_keeping(box_of(loop))) continue;
    for (const LevelCurve& curve : loop) {
      const auto n = std::ssize(curve.points);
      const std::vector<std::int32_t> tags(curve.points.size(), offset.tag);
      domain.add_polyline(CurveRole::boundary, curve.closed, n, curve.points.data()->data(),
                          tags.data(), kNoCorners);
    }
  }
}

void add_offset(VolumeDomain& domain, const VolumeDomain& body, const Offset<3>& offset) {
  require_limits(offset);
  const OffsetFunction<3> f(body, offset);
  domain.add_level_set(
      std::make_shared<const LevelSet>(name_of(offset), f, f.box(), f.resolution()), offset.tag);
  domain.take_repair_of(body);
}

}  // namespace pnpbs
