// SPDX-License-Identifier: BSD-3-Clause
#include "quality/plane/boundary_apexes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/execution.hpp"
#include "base/space_vectors.hpp"
#include "method/constants.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

constexpr double kEquilateralHeight = 0.8660254037844386;  // sqrt(3) / 2

// Heights over the edge at which other parts of the boundary must be far, in units of the apex
// height: half-way to the apex, at the apex, and in the second row.
constexpr std::array<double, 3> kLookedAt{0.5, 1, 2};

}  // namespace

BoundaryApexes::BoundaryApexes(const SizedTree<2>& map, const IncidentSectors& sectors,
                               const std::function<double(std::int32_t)>& spacing,
                               std::vector<std::int32_t> edges)
    : map_(map), sectors_(sectors), spacing_(spacing), edges_(std::move(edges)) {
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  apexes_.resize(2 * edges_.size());
  const auto apexes = static_cast<std::int64_t>(apexes_.size());
  for_each("pnpbs::BoundaryApexes::make", apexes, [&](std::int64_t k) {
    apexes_[static_cast<std::size_t>(k)] =
        made_over(edges_[static_cast<std::size_t>(k / 2)], k % 2 != 0);
  });
  std::vector<char> crowded(apexes_.size(), 0);
  for_each("pnpbs::BoundaryApexes::find_crowded", apexes, [&](std::int64_t k) {
    const auto at = static_cast<std::size_t>(k);
    crowded[at] = apexes_[at].stands && is_crowded(apexes_[at]);
  });
  for (std::size_t k = 0; k < apexes_.size(); ++k)
    if (crowded[k]) apexes_[k].stands = false;
}

std::int64_t BoundaryApexes::over(std::int32_t edge, bool left) const {
  const auto found = std::lower_bound(edges_.begin(), edges_.end(), edge);
  if (found == edges_.end() || *found != edge) return -1;
  const std::int64_t apex = 2 * (found - edges_.begin()) + (left ? 1 : 0);
  return apexes_[static_cast<std::size_t>(apex)].stands ? apex : -1;
}

// Returns whether the edge length agrees with d and neither end is a corner or an end of the curve.
bool BoundaryApexes::is_regular(std::int32_t edge) const {
  const BoundaryEdge& e = map_.facet(edge);
  const auto& [a, b] = map_.corners(edge);
  const double wanted = 0.5 * (spacing_(e.begin) + spacing_(e.end)), length = distance<2>(a, b);
  return length > method::kRegularEdgeMin * wanted && length < method::kRegularEdgeMax * wanted &&
         is_smooth_at(e.begin) && is_smooth_at(e.end);
}

// Returns whether exactly two edges meet at the boundary node, with a turn of less than 30 degrees.
bool BoundaryApexes::is_smooth_at(std::int32_t boundary_node) const {
  const std::int32_t first = sectors_.begin(boundary_node);
  if (sectors_.end(boundary_node) - first != 2) return false;
  const auto to = [&](std::int32_t other) {
    const Point<2>&x = map_.boundary().nodes[static_cast<std::size_t>(boundary_node)].position,
          &y = map_.boundary().nodes[static_cast<std::size_t>(other)].position;
    return Point<2>{y[0] - x[0], y[1] - x[1]};
  };
  const Point<2> back = to(sectors_.edge(first).other), ahead = to(sectors_.edge(first + 1).other);
  return -dot(back, ahead) >
         method::kRegularTurnCosine * std::sqrt(dot(back, back) * dot(ahead, ahead));
}

// Builds the apex on this side of the edge. It stands if the edge is regular and no other part of
// the boundary is near.
BoundaryApex BoundaryApexes::made_over(std::int32_t edge, bool left) const {
  const BoundaryEdge& e = map_.facet(edge);
  const auto& [a, b] = map_.corners(edge);
  BoundaryApex apex{edge, distance<2>(a, b)};
  if (e.begin == e.end || !(left ? e.left_inside : e.right_inside) || !is_regular(edge))
    return apex;
  const double share = left ? kEquilateralHeight : -kEquilateralHeight;
  const Point<2> middle = middle_of<2>(a, b), up{share * (a[1] - b[1]), share * (b[0] - a[0])};
  const auto at = [&](double heights) {
    return Point<2>{middle[0] + heights * up[0], middle[1] + heights * up[1]};
  };
  apex.place = at(1);
  apex.stands = is_visible(apex, middle) &&
                std::all_of(kLookedAt.begin(), kLookedAt.end(), [&](double heights) {
                  const double room =
                      method::kApexRoom * heights * kEquilateralHeight * apex.edge_length;
                  return map_.clearance(at(heights), room) >= room;
                });
  return apex;
}

// Returns whether no other boundary edge, such as the opposite side of a strait, crosses the
// segment from `middle` to the apex.
bool BoundaryApexes::is_visible(const BoundaryApex& apex, const Point<2>& middle) const {
  bool visible = true;
  const Point<2>& x = apex.place;
  map_.for_facets_near(middle_of<2>(middle, x), 0.5 * apex.edge_length, [&](std::int32_t f) {
    const FacetCorners<2>& c = map_.corners(f);
    if (f != apex.edge && orientation(middle, x, c[0]) * orientation(middle, x, c[1]) <= 0 &&
        orientation(c[0], c[1], middle) * orientation(c[0], c[1], x) <= 0)
      visible = false;
  });
  return visible;
}

// Returns whether another standing apex is too close to this one. Both are removed then: keeping
// either would leave an adjacent edge without an apex.
bool BoundaryApexes::is_crowded(const BoundaryApex& apex) const {
  const auto is_close = [&](std::int64_t k) {
    if (k < 0) return false;
    const BoundaryApex& other = apexes_[static_cast<std::size_t>(k)];
    return &other != &apex &&
           distance<2>(other.place, apex.place) <
               method::kApexesApart * 0.5 * (apex.edge_length + other.edge_length);
  };
  bool crowded = false;
  constexpr double kReach = 2;  // apexes of edges farther away are farther than kApexesApart
  map_.for_facets_near(apex.place, kReach * apex.edge_length, [&](std::int32_t edge) {
    crowded = crowded || is_close(over(edge, false)) || is_close(over(edge, true));
  });
  return crowded;
}

}  // namespace pnpbs
