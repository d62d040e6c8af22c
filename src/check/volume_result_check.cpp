// SPDX-License-Identifier: BSD-3-Clause
// The check of the results of bodies.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/mixed_hash.hpp"
#include "base/space_vectors.hpp"
#include "check/conformity.hpp"
#include "check/corner_check.hpp"
#include "check/element_measure.hpp"
#include "check/result_check.hpp"
#include "check/volume_node_check.hpp"
#include "comm/records.hpp"
#include "predicates/space.hpp"

namespace pnpbs {

namespace {

using Three = std::array<std::int64_t, 3>;

// An edge of a boundary triangle, with the orientation of the triangle.
struct TurningEdge {
  std::int64_t low, high;  // ids
  std::int64_t turn;       // 1 if the triangle runs from low to high, -1 otherwise
  Point<3> middle;
};

// The check of a body.
class VolumeResultCheck : public VolumeNodeCheck {
 public:
  VolumeResultCheck(const Results<3>& results, const Conformity<3>& conformity)
      : VolumeNodeCheck(results), conformity_(conformity) {}

  void check() const {
    check_nodes_and_lists();
    check_stars();
    check_boundary();
    check_volume(conformity_.fills());
  }

 private:
  using Corners = Stars<3>::Corners;

  void check_stars() const;
  void check_star(std::int64_t i, CornerCheck<3, 3>& corners) const;
  void check_faces(std::int64_t i) const;

  void check_boundary() const;

  void check_volume(bool fills) const;

  const Conformity<3>& conformity_;
};

// ------------------------------------------------------------------ stars ----------------------

void VolumeResultCheck::check_stars() const {
  CornerCheck<3, 3> corners(*this);
  for_owned([&](std::int64_t i) { check_star(i, corners); });
  for_owned([&](std::int64_t i) { check_faces(i); });
  corners.check_on_other_ranks();
}

void VolumeResultCheck::check_star(std::int64_t i, CornerCheck<3, 3>& corners) const {
  level_.stars.for_simplices(i, [&](const Corners& others) {
    const auto [a, b, c] = others;
    if (orientation(position(i), position(a), position(b), position(c)) <= 0)
      fail_check("the tetrahedron of nodes " + name(i) + ", " + name(a) + ", " + name(b) + " and " +
                 name(c) + " has no positive volume");
    corners.look_at(a, {i, b, c});
    corners.look_at(b, {i, a, c});
    corners.look_at(c, {i, a, b});
  });
}

// Checks that a face has at most one tetrahedron on either side, and one on both sides if its nodes
// are inner nodes. Where the surfaces are torn and lack nodes, inner nodes may be outermost.
void VolumeResultCheck::check_faces(std::int64_t i) const {
  using Side = std::pair<std::int32_t, std::int32_t>;  // other nodes of an oriented face at node i
  std::vector<Side> sides;
  level_.stars.for_simplices(i, [&](const Corners& corners) {
    const auto [a, b, c] = corners;
    sides.insert(sides.end(), {{a, b}, {b, c}, {c, a}});
  });
  std::ranges::sort(sides);
  const auto text = [&](const Side& side) {
    return "the face of nodes " + name(i) + ", " + name(side.first) + " and " + name(side.second);
  };
  const auto twice = std::ranges::adjacent_find(sides);
  if (twice != sides.end()) fail_check(text(*twice) + " has two tetrahedra on one side");
  if (nodes_.carrier(i) != Carrier::free || conformity_.boundary.torn_on_surfaces) return;
  for (const Side& side : sides)
    if (nodes_.carrier(side.first) == Carrier::free &&
        nodes_.carrier(side.second) == Carrier::free &&
        !std::ranges::binary_search(sides, Side{side.second, side.first}))
      fail_check(text(side) + " lies inside, but has a tetrahedron on one side only");
}

// ------------------------------------------------------------------ the boundary ---------------

// Checks that the open facets form closed surfaces: at each edge as many run in one direction as in
// the other.
void VolumeResultCheck::check_boundary() const {
  std::vector<TurningEdge> edges;
  p_.for_open_facets([&](const Three& places) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t i = p_.node_at(places[k]), j = p_.node_at(places[(k + 1) % 3]);
      TurningEdge edge{nodes_.id(i), nodes_.id(j), 1, position(i)};
      for (std::size_t axis = 0; axis < 3; ++axis)
        edge.middle[axis] += (nodes_.x[axis](j) - edge.middle[axis]) / 2;
      if (edge.low > edge.high) {
        std::swap(edge.low, edge.high);
        edge.turn = -1;
      }
      // In a periodic domain, as seen from the cell of the first node.
      const std::int64_t home = nodes_.cell.home_id(edge.low);
      edge.high += home - edge.low;
      edge.low = home;
      edges.push_back(edge);
    }
  });
  const auto ends = [](const TurningEdge& edge) { return std::tuple(edge.low, edge.high); };
  if (comm_.size() > 1)
    edges = redistribute(comm_, edges, [this](const TurningEdge& edge) {
      const std::uint64_t key =
          mixed(static_cast<std::uint64_t>(edge.low)) ^ static_cast<std::uint64_t>(edge.high);
      return static_cast<int>(mixed(key) % static_cast<std::uint64_t>(comm_.size()));
    });
  std::ranges::sort(edges, {}, ends);
  for (auto edge = edges.begin(); edge != edges.end();) {
    std::int64_t turns = 0;
    auto next = edge;
    for (; next != edges.end() && ends(*next) == ends(*edge); ++next) turns += next->turn;
    if (turns != 0)
      fail_check("the boundary of the tetrahedra is not closed at the edge of nodes " +
                 std::to_string(edge->low) + " and " + std::to_string(edge->high) + " around " +
                 point_text(edge->middle));
    edge = next;
  }
}

// ------------------------------------------------------------------ volume ---------------------

// A domain that is not filled is no error here: the run has reported it.
void VolumeResultCheck::check_volume(bool fills) const {
  const ElementMeasure measure = measure_of_elements(p_);
  if (!(measure.domain > measure.rounding)) return;  // too thin to be measured
  // The boundary of a periodic domain determines the volume only up to that of the cell.
  if (!nodes_.cell.any() && std::fabs(measure.elements - measure.enclosed) > measure.rounding)
    fail_check("the tetrahedra have the volume " + number_text(measure.elements) +
               ", their boundary encloses " + number_text(measure.enclosed));
  if (fills && !measure.agrees())
    fail_check("the tetrahedra have the volume " + number_text(measure.elements) + ", the domain " +
               number_text(measure.domain) +
               ", and the faces of their boundary cut off no more than " +
               rounded_text(measure.between));
}

}  // namespace

std::optional<MessageText> check_results(Results<3>& results) {
  results.prepare_stars();
  const Conformity<3> conformity = conformity_of(results);
  if (results.kind() == GeometryKind::surface)
    check_surfaces(results, conformity.fills());
  else
    VolumeResultCheck(results, conformity).check();
  if (conformity.holds()) return std::nullopt;
  return text_of(conformity, results);
}

}  // namespace pnpbs
