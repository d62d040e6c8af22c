// SPDX-License-Identifier: BSD-3-Clause
#include "check/result_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check/conformity.hpp"
#include "check/corner_check.hpp"
#include "check/node_check.hpp"
#include "level/plane/closed_sphere.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

// The check of plane domains and spheres. Triangles are checked only if `fills` is true.
class ResultCheck : public NodeCheck<2> {
 public:
  explicit ResultCheck(const Results<2>& results)
      : NodeCheck<2>(results),
        boundary_(level_.geometry.boundary()),
        closed_(level_.geometry.domain().closing() != nullptr) {
    sectors_.build(boundary_);
  }

  void check(bool fills) const {
    check_ids();
    check_places();
    check_sides();
    check_boundary_nodes();
    check_lists();
    if (!fills) return;
    check_stars();
    check_area();
  }

 private:
  const Point<2>& laid(std::size_t b) const { return boundary_.nodes[b].position; }
  void check_sides() const;
  void check_boundary_nodes() const;

  void check_stars() const;
  void check_star(std::int64_t i, CornerCheck<2, 2>& corners) const;
  void check_sides_of(std::int64_t i, std::int64_t j, bool left, bool right) const;
  void check_boundary_edges_of(std::int64_t i) const;

  double area_of_triangles(double unit) const;
  void check_area() const;

  const Boundary& boundary_;
  bool closed_;
  IncidentSectors sectors_;
};

// ------------------------------------------------------------------ nodes ----------------------

void ResultCheck::check_sides() const {
  for_owned([&](std::int64_t i) {
    const std::int32_t b = nodes_.boundary_node(i);
    if (b < 0)
      check_inside(i, level_.map());
    else
      check_placed(i, laid(static_cast<std::size_t>(b)));
  });
}

void ResultCheck::check_boundary_nodes() const {
  std::vector<std::int64_t> times(boundary_.nodes.size(), 0);
  for_owned([&](std::int64_t i) {
    if (nodes_.boundary_node(i) >= 0) ++times[static_cast<std::size_t>(nodes_.boundary_node(i))];
  });
  // The finish frees nodes in the margin of a patch that closes a sphere. They are no boundary
  // nodes any more.
  check_placed_once(
      std::move(times), [this](std::size_t b) { return laid(b); },
      [this](std::size_t b) {
        return !level_.geometry.boundary_node_in_cell(static_cast<std::int64_t>(b)) ||
               (level_.margin != PatchMargin::laid &&
                level_.geometry.domain().is_in_margin(laid(b)));
      });
}

// ------------------------------------------------------------------ stars ----------------------

void ResultCheck::check_stars() const {
  CornerCheck<2, 2> corners(*this);
  for_owned([&](std::int64_t i) {
    check_star(i, corners);
    check_boundary_edges_of(i);
  });
  corners.check_on_other_ranks();
}

void ResultCheck::check_star(std::int64_t i, CornerCheck<2, 2>& corners) const {
  std::vector<std::pair<std::int64_t, bool>> star;
  level_.stars.for_neighbours_in_order(
      i, [&](std::int64_t j, bool triangle) { star.emplace_back(j, triangle); });
  const std::size_t n = star.size();
  if (n < 2) fail_check("the star of node " + name(i) + " has less than two neighbours");
  for (std::size_t k = 0; k < n; ++k) {
    const auto [j, left] = star[k];
    check_sides_of(i, j, left, star[(k + n - 1) % n].second);
    for (std::size_t l = 0; l < k; ++l)
      if (star[l].first == j)
        fail_check("the star of node " + name(i) + " has " + name(j) + " twice");
    if (!left) continue;
    const std::int64_t next = star[(k + 1) % n].first;
    const int turn = orientation(position(i), position(j), position(next));
    if (turn == 0 || (turn > 0) == closes_sphere(level_, {i, j, next}))
      fail_check("the triangle of nodes " + name(i) + ", " + name(j) + " and " + name(next) +
                 " is not counter-clockwise");
    corners.look_at(j, {next, i});
    corners.look_at(next, {i, j});
  }
}

// Checks that the edge from node i to node j has triangles exactly on the sides that lie inside the
// domain.
void ResultCheck::check_sides_of(std::int64_t i, std::int64_t j, bool left, bool right) const {
  bool left_inside = true, right_inside = true;
  const std::int32_t b = nodes_.boundary_node(i), c = nodes_.boundary_node(j);
  for (std::int32_t k = b < 0 ? 0 : sectors_.begin(b); b >= 0 && k < sectors_.end(b); ++k) {
    if (sectors_.edge(k).other != c) continue;
    const BoundaryEdge& e = boundary_.facets[static_cast<std::size_t>(sectors_.edge(k).edge)];
    if (closed_ && e.bounds()) continue;  // the sphere continues behind it
    left_inside = e.begin == b ? e.left_inside : e.right_inside;
    right_inside = e.begin == b ? e.right_inside : e.left_inside;
  }
  if (left == left_inside && right == right_inside) return;
  const auto side = [](bool is_left) { return is_left ? "left" : "right"; };
  const bool on_left = left != left_inside;
  fail_check("the edge from node " + name(i) + " to node " + name(j) + " has " +
             ((on_left ? left : right) ? "a triangle outside the domain, on its "
                                       : "no triangle on its ") +
             side(on_left));
}

// Checks that every boundary edge at node i is an edge of its star.
void ResultCheck::check_boundary_edges_of(std::int64_t i) const {
  const std::int32_t b = nodes_.boundary_node(i);
  if (b < 0) return;
  for (std::int32_t k = sectors_.begin(b); k < sectors_.end(b); ++k) {
    const std::int32_t other = sectors_.edge(k).other;
    if (other == b) continue;  // the edge of a fixed node
    bool found = false;
    level_.stars.for_neighbours(
        i, [&](std::int64_t j) { found = found || nodes_.boundary_node(j) == other; });
    if (!found)
      fail_check("the boundary's edge from node " + name(i) + " to " +
                 point_text(boundary_.nodes[static_cast<std::size_t>(other)].position) +
                 " is no edge of the triangulation");
  }
}

// ------------------------------------------------------------------ area -----------------------

double ResultCheck::area_of_triangles(double unit) const {
  double mine = 0;
  p_.for_elements([&](const std::array<std::int64_t, 3>& places) {
    const auto [a, b, c] = places;
    if (closes_sphere(level_, {p_.node_at(a), p_.node_at(b), p_.node_at(c)})) return;
    const Point<2> x = position(p_.node_at(a)), y = position(p_.node_at(b)),
                   z = position(p_.node_at(c));
    mine += 0.5 * ((y[0] - x[0]) * (z[1] - x[1]) - (y[1] - x[1]) * (z[0] - x[0]));
  });
  return sum_over_ranks(mine, unit);
}

// The area enclosed by the boundary edges, and a bound of its rounding error.
struct Enclosed {
  double area = 0, rounding = 0;
};

Enclosed enclosed_by(const Boundary& boundary, const Box<2>& bounds) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  Enclosed sum;
  for (const BoundaryEdge& e : boundary.facets) {
    if (!e.bounds()) continue;
    const Point<2>&a = boundary.nodes[static_cast<std::size_t>(e.begin)].position,
          &b = boundary.nodes[static_cast<std::size_t>(e.end)].position;
    const double left = (a[0] - bounds.low[0]) * (b[1] - bounds.low[1]);
    const double right = (a[1] - bounds.low[1]) * (b[0] - bounds.low[0]);
    sum.area += (e.left_inside ? 0.5 : -0.5) * (left - right);
    sum.rounding += 4 * kEpsilon * (std::fabs(left) + std::fabs(right));
  }
  return sum;
}

// The boundary edges of one period of a periodic domain, from one node to the next. They begin in
// the cell and may leave it.
class EdgesOfPeriod {
 public:
  explicit EdgesOfPeriod(const LevelGeometry<2>& geometry)
      : geometry_(geometry),
        boundary_(geometry.boundary()),
        edges_(boundary_.nodes.size()),
        seen_(boundary_.nodes.size(), 0) {
    for (const BoundaryEdge& e : boundary_.facets) {
      if (!e.bounds()) continue;
      edges_[static_cast<std::size_t>(e.begin)].push_back(&e);
      edges_[static_cast<std::size_t>(e.end)].push_back(&e);
    }
  }

  // Calls visit(edge) for one of the images of each edge. Consecutive edges have common nodes.
  template <class Visit>
  void for_each(const Visit& visit) {
    for (std::size_t b = 0; b < boundary_.nodes.size(); ++b)
      if (geometry_.boundary_node_in_cell(static_cast<std::int64_t>(b)))
        follow(static_cast<std::int32_t>(b), visit);
  }

 private:
  template <class Visit>
  void follow(std::int32_t first, const Visit& visit) {
    std::vector<std::int32_t> open;
    reach(first, open);
    while (!open.empty()) {
      const std::int32_t b = open.back();
      open.pop_back();
      for (const BoundaryEdge* e : edges_[static_cast<std::size_t>(b)]) {
        if (e->begin == b) visit(*e);
        reach(e->begin == b ? e->end : e->begin, open);
      }
    }
  }
  void reach(std::int32_t b, std::vector<std::int32_t>& open) {
    char& seen = seen_[static_cast<std::size_t>(geometry_.images_of_boundary_nodes().number(b))];
    if (!seen) open.push_back(b);
    seen = 1;
  }

  const LevelGeometry<2>& geometry_;
  const Boundary& boundary_;
  std::vector<std::vector<const BoundaryEdge*>> edges_;  // by node
  std::vector<char> seen_;                               // by number of the node
};

// Returns the area of one period by Green's theorem, as the integral of one coordinate along the
// other, periodic one. Where both are periodic, it follows up to multiples of the cell's area.
Enclosed enclosed_in_period(const LevelGeometry<2>& geometry) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const PeriodicCell<2>& cell = geometry.cell();
  const std::size_t along = cell.periodic(0) ? 0 : 1, across = 1 - along;
  Enclosed sum;
  EdgesOfPeriod(geometry).for_each([&](const BoundaryEdge& e) {
    const Point<2>&a = geometry.boundary().nodes[static_cast<std::size_t>(e.begin)].position,
          &b = geometry.boundary().nodes[static_cast<std::size_t>(e.end)].position;
    const double height = 0.5 * (a[across] + b[across]) - cell.box().low[across];
    const double term = (along == 0 ? -height : height) * (b[along] - a[along]);
    sum.area += e.left_inside ? term : -term;
    sum.rounding += 8 * kEpsilon * std::fabs(term);
  });
  if (cell.periodic(0) && cell.periodic(1)) {
    const double all = cell.period(0) * cell.period(1);
    sum.area -= all * (std::ceil(sum.area / all) - 1);
    sum.rounding += 8 * kEpsilon * all;
  }
  return sum;
}

void ResultCheck::check_area() const {
  constexpr double kTolerance = 1e-9;
  const Enclosed enclosed = level_.geometry.cell().any()
                                ? enclosed_in_period(level_.geometry)
                                : enclosed_by(boundary_, level_.geometry.bounds());
  if (!(enclosed.area > enclosed.rounding)) return;  // too thin to be measured
  const double area = area_of_triangles(enclosed.area);
  if (std::fabs(area - enclosed.area) <= kTolerance * enclosed.area + enclosed.rounding) return;
  fail_check("the triangles have the area " + number_text(area) + ", the boundary encloses " +
             number_text(enclosed.area));
}

}  // namespace

std::optional<MessageText> check_results(Results<2>& results) {
  results.prepare_lists();
  results.prepare_stars();
  const Conformity<2> conformity = conformity_of(results);
  ResultCheck(results).check(conformity.fills());
  if (conformity.holds()) return std::nullopt;
  return text_of(conformity, results);
}

}  // namespace pnpbs
