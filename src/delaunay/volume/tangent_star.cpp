// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/tangent_star.hpp"

#include <algorithm>
#include <cmath>

#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

class TangentStar {
 public:
  TangentStar(const SurfaceStarPoint& centre, double reach, const Joined& joined)
      : centre_(centre), reach_(reach), joined_(joined) {}

  // Stores the points of the side's star in around_, including the first and last.
  bool find(const StarSide& side) {
    const TangentPlane plane(side.normal, centre_.position);
    const StarPoint centre{plane.centre(), centre_.id, centre_.node};
    around_.clear();
    for (const SurfaceStarPoint& p : side.around) {
      const Point<2> image = plane.image(p.position);
      if (image != centre.position) around_.push_back({image, p.id, p.node});
    }
    if (!sector_star(centre, side.first, side.last, around_)) return false;
    for (std::size_t k = 0; k + 1 < around_.size(); ++k) {
      const StarPoint &a = around_[k], &b = around_[k + 1];
      const FixedSides fixed{joined_(centre.node, a.node), joined_(centre.node, b.node),
                             joined_(a.node, b.node)};
      if (needed_reach(centre.position, a.position, b.position, fixed) > reach_) return false;
    }
    return true;
  }

  const std::vector<StarPoint>& around() const { return around_; }

 private:
  const SurfaceStarPoint& centre_;
  double reach_;
  const Joined& joined_;
  std::vector<StarPoint> around_;
};

// Returns an order of the sides in which each begins where the previous one ends, if there is such
// a side.
std::vector<std::size_t> chained(std::span<const StarSide> sides) {
  std::vector<std::size_t> order;
  std::vector<char> taken(sides.size(), 0);
  while (order.size() < sides.size()) {
    const auto next = [&](const auto& suits) {
      std::size_t k = 0;
      while (k < sides.size() && (taken[k] != 0 || !suits(sides[k]))) ++k;
      return k;
    };
    std::size_t k = sides.size();
    if (!order.empty()) {
      const std::int32_t last = sides[order.back()].last;
      k = next([last](const StarSide& side) { return side.first == last; });
    }
    if (k == sides.size()) k = next([](const StarSide&) { return true; });
    taken[k] = 1;
    order.push_back(k);
  }
  return order;
}

}  // namespace

// Method: Duff et al., "Building an orthonormal basis, revisited", J. Comput. Graph. Tech. 6
// (2017).
TangentPlane::TangentPlane(const Point<3>& normal, const Point<3>& centre) : origin_(centre) {
  const auto [x, y, z] = normal;
  const double sign = std::copysign(1.0, z), a = -1 / (sign + z), b = x * y * a;
  u_ = {1 + sign * x * x * a, sign * b, -sign * x};
  v_ = {b, sign + y * y * a, -y};
  centre_ = projection(centre);
}

Point<2> TangentPlane::projection(const Point<3>& x) const { return {dot(u_, x), dot(v_, x)}; }

// The projection is not scaled in a flat patch. All nodes then have bitwise the same points and
// break ties equally.
Point<2> TangentPlane::image(const Point<3>& x) const {
  constexpr double kFlat = 1 + 1e-6;
  const Point<2> at = projection(x);
  const double across = squared_distance<2>(at, centre_);
  const double squared = squared_distance<3>(x, origin_);
  if (squared <= kFlat * across || across == 0) return at;
  const double scale = squared / across;
  return {centre_[0] + scale * (at[0] - centre_[0]), centre_[1] + scale * (at[1] - centre_[1])};
}

bool tangent_star(const SurfaceStarPoint& centre, double reach, std::span<const StarSide> sides,
                  const Joined& joined, std::vector<SurfaceStarEntry>& star) {
  const std::size_t before = star.size();
  TangentStar one(centre, reach, joined);
  const std::vector<std::size_t> order = chained(sides);
  for (std::size_t n = 0; n < order.size(); ++n) {
    if (!one.find(sides[order[n]])) {
      star.resize(before);
      return false;
    }
    const std::vector<StarPoint>& around = one.around();
    for (std::size_t k = 0; k + 1 < around.size(); ++k) star.push_back({around[k].node, true});
    const bool follows = n + 1 < order.size() ? sides[order[n + 1]].first == sides[order[n]].last
                                              : star[before].node == around.back().node;
    if (!follows) star.push_back({around.back().node, false});
  }
  return true;
}

}  // namespace pnpbs
