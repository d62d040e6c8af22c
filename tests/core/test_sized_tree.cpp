// SPDX-License-Identifier: BSD-3-Clause
// The background tree of a domain: inside and outside, clearances and leaf sizes, against searches
// over all boundary edges; and keeping inner nodes off the boundary.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "geometry/clearance.hpp"
#include "geometry/expect_error.hpp"
#include "level_run.hpp"
#include "predicates/plane.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "spacing/sized_tree.hpp"

using pnpbs::Boundary;
using pnpbs::BoundaryEdge;
using pnpbs::PlaneDomain;
using shapes::add_chain;
using shapes::add_circle;
using shapes::add_loop;
using shapes::rectangle;
using P = pnpbs::Point<2>;

namespace {

struct Mapped {
  PlaneDomain domain;
  Boundary boundary;
  pnpbs::SizedTree<2> map;

  Mapped(const Build& build, const Plane& d, std::int64_t max_nodes = 1'000'000'000) {
    build(domain);
    domain.check();
    boundary = pnpbs::discretize_boundary(domain, evaluator_of(d), max_nodes);
    map.build(domain.bounds(), boundary, evaluator_of(d), max_nodes);
  }
  Mapped(const Mapped&) = delete;

  P begin(const BoundaryEdge& e) const { return boundary.nodes[e.begin].position; }
  P end(const BoundaryEdge& e) const { return boundary.nodes[e.end].position; }
};

// Returns the winding number of the boundary, with the domain on its left, around x.
int winding_number(const Mapped& m, const P& x) {
  int winding = 0;
  for (const BoundaryEdge& e : m.boundary.facets) {
    if (e.left_inside == e.right_inside) continue;
    const P a = e.left_inside ? m.begin(e) : m.end(e), b = e.left_inside ? m.end(e) : m.begin(e);
    if (a[1] <= x[1] && b[1] > x[1] && pnpbs::orientation(a, b, x) > 0) ++winding;
    if (b[1] <= x[1] && a[1] > x[1] && pnpbs::orientation(a, b, x) < 0) --winding;
  }
  return winding;
}

double gap_to_edge(const P& a, const P& b, const P& x) {
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  const double along = ((x[0] - a[0]) * (b[0] - a[0]) + (x[1] - a[1]) * (b[1] - a[1])) / length;
  if (along < 0) return std::hypot(x[0] - a[0], x[1] - a[1]);
  if (along > length) return std::hypot(x[0] - b[0], x[1] - b[1]);
  return std::fabs((b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0])) / length;
}

double gap_to_boundary(const Mapped& m, const P& x) {
  double min = std::numeric_limits<double>::infinity();
  for (const BoundaryEdge& e : m.boundary.facets)
    min = std::min(min, gap_to_edge(m.begin(e), m.end(e), x));
  return min;
}

bool on_boundary(const Mapped& m, const P& x) {
  for (const BoundaryEdge& e : m.boundary.facets) {
    const P a = m.begin(e), b = m.end(e);
    if (pnpbs::orientation(a, b, x) == 0 && std::min(a[0], b[0]) <= x[0] &&
        x[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= x[1] &&
        x[1] <= std::max(a[1], b[1]))
      return true;
  }
  return false;
}

// Adds islands in lakes on islands, nested and side by side, and an inner curve. Coordinates are on
// a coarse grid, so that many points are level with vertices.
void add_nested(PlaneDomain& domain) {
  add_loop(domain, rectangle(-1, -1, 3, 2));
  for (int k = 1; k <= 6; ++k)
    add_loop(domain, rectangle(-1 + k / 8.0, -1 + k / 8.0, 1 - k / 8.0, 1 - k / 16.0));
  const std::vector<double> diamond{2, -0.5, 2.5, 0, 2, 0.5, 1.5, 0};
  domain.add_polyline(pnpbs::CurveRole::boundary, true, 4, diamond.data(), nullptr, 0);
  const std::vector<double> inner{2, -0.25, 2.25, 0, 2, 0.25, 1.75, 0};
  domain.add_polyline(pnpbs::CurveRole::boundary, true, 4, inner.data(), nullptr, 0);
  add_circle(domain, 2, 1.25, 0.375);
  add_chain(domain, {1.25, -0.5, 1.25, 1.5, 0, 1.5});
}

void expect_sides(const Mapped& m, std::uint64_t seed) {
  Random random(seed);
  const pnpbs::Box<2> box = m.domain.bounds();
  const double size = std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
  pnpbs::Box<2> around = box;
  for (const int k : {0, 1}) {
    around.low[k] -= 0.01 * size;
    around.high[k] += 0.01 * size;
  }
  std::vector<P> points;
  for (int trial = 0; trial < 4000; ++trial) points.push_back(random.point<2>(around));
  for (int trial = 0; trial < 3000; ++trial) {  // near edges, on edges, and level with vertices
    const BoundaryEdge& e = m.boundary.facets[static_cast<std::size_t>(
        random.below(static_cast<std::int64_t>(m.boundary.facets.size())))];
    const double t = trial % 3 == 0 ? 0.5 : random.between(0, 1);
    P x{m.begin(e)[0] + t * (m.end(e)[0] - m.begin(e)[0]),
        m.begin(e)[1] + t * (m.end(e)[1] - m.begin(e)[1])};
    points.push_back(x);
    points.push_back({x[0] + random.between(-1, 1) * 1e-9 * size, x[1]});
    points.push_back({m.begin(e)[0], random.point<2>(around)[1]});
    points.push_back({random.point<2>(around)[0], m.begin(e)[1]});
    points.push_back(m.begin(e));
  }
  std::int64_t inside = 0, boundary = 0;
  for (const P& x : points) {
    const int winding = winding_number(m, x);
    quick_assert(winding == 0 || winding == 1 || on_boundary(m, x));
    const bool expected = winding == 1 && !on_boundary(m, x);
    quick_assert_msg(m.map.inside(x) == expected, "(%.17g, %.17g) is %s", x[0], x[1],
                     expected ? "inside" : "not inside");
    inside += expected;
    boundary += on_boundary(m, x);
  }
  ck_assert_int_gt(inside, 1000);
  ck_assert_int_gt(boundary, 1000);
}

void expect_clearances(const Mapped& m, std::uint64_t seed) {
  Random random(seed);
  const pnpbs::Box<2> box = m.domain.bounds();
  const double size = std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
  for (int trial = 0; trial < 1500; ++trial) {
    const P x = random.point<2>(box);
    const double gap = gap_to_boundary(m, x);
    for (const double reach : {0.002 * size, 0.05 * size, 2 * size, gap * 0.999, gap * 1.001})
      ck_assert_double_eq_tol(m.map.clearance(x, reach), std::min(gap, reach), 1e-12 * size);
  }
}

Plane graded_lake(double d) {
  return [d](double x, double y) { return d + 0.03 * std::hypot(x, y); };
}

}  // namespace

START_TEST(sides_of_nested_islands) {
  for (const double d : {0.03, 0.2, 3.0}) expect_sides(Mapped(add_nested, constant(d)), 81);
  expect_sides(
      Mapped(add_nested, [](double x, double y) { return 0.01 + 0.2 * std::hypot(x - 2, y); }), 82);
}
END_TEST

START_TEST(sides_of_lakes) {
  expect_sides(Mapped([](PlaneDomain& p) { add_lake(p, "lake_victoria"); }, graded_lake(1)), 83);
  expect_sides(Mapped([](PlaneDomain& p) { add_lake(p, "great_lakes_islands"); }, graded_lake(8)),
               84);
}
END_TEST

START_TEST(clearances) {
  expect_clearances(Mapped(add_nested, constant(0.1)), 85);
  expect_clearances(Mapped([](PlaneDomain& p) { add_lake(p, "lake_victoria"); }, graded_lake(4)),
                    86);
}
END_TEST

// All edges within the distance of a point are reported.
START_TEST(edges_near_points) {
  const Mapped m(add_nested, constant(0.15));
  Random random(87);
  for (int trial = 0; trial < 500; ++trial) {
    const P x = random.point<2>(m.domain.bounds());
    const double reach = random.between(0, 0.5);
    std::vector<char> named(m.boundary.facets.size(), 0);
    m.map.for_facets_near(x, reach, [&](std::int32_t e) { named[e] = 1; });
    for (std::size_t e = 0; e < named.size(); ++e) {
      const BoundaryEdge& edge = m.boundary.facets[e];
      quick_assert(named[e] || gap_to_edge(m.begin(edge), m.end(edge), x) >= reach);
    }
  }
}
END_TEST

START_TEST(leaf_sizes_follow_d) {
  const Mapped uniform([](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 3, 2)); }, constant(0.05));
  for (std::int32_t leaf = 0; leaf < uniform.map.tree().leaf_count(); ++leaf) {
    const double side = uniform.map.tree().cell_side(uniform.map.tree().leaf_cell(leaf));
    if (uniform.map.leaf_outside(leaf)) continue;
    ck_assert_double_le(side, 4 * 0.05);
    ck_assert_double_gt(side, 2 * 0.05);
    ck_assert_double_eq_tol(uniform.map.leaf_spacing(leaf), 0.05, 1e-15);
    quick_assert(uniform.map.leaf_min_spacing(leaf) == 0.05);
    quick_assert(uniform.map.leaf_max_spacing(leaf) == 0.05);
  }

  const Plane d = [](double x, double y) { return 0.004 + 0.2 * std::hypot(x - 0.7, y - 0.4); };
  const Mapped graded(add_nested, d);
  const pnpbs::BackgroundTree<2>& tree = graded.map.tree();
  double nodes = 0, area = 0;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const std::int32_t c = tree.leaf_cell(leaf);
    const pnpbs::Box<2> box = tree.cell_box(c);
    const double side = tree.cell_side(c);
    if (graded.map.leaf_outside(leaf)) {
      quick_assert(!graded.map.inside(tree.cell_centre(c)));
      quick_assert(!graded.map.leaf_has_facets(leaf));
      continue;
    }
    const double min = graded.map.leaf_min_spacing(leaf);
    const double max = graded.map.leaf_max_spacing(leaf);
    ck_assert_double_le(side, 4 * min);
    ck_assert_double_le(min, graded.map.leaf_spacing(leaf) * (1 + 1e-12));
    ck_assert_double_le(graded.map.leaf_spacing(leaf), max * (1 + 1e-12));
    // d grows by 0.2 per unit of length, so the samples determine it up to 0.2 times the diagonal.
    ck_assert_double_le(max - min, 0.2 * 1.42 * side);
    for (const double fx : {0.1, 0.6})
      for (const double fy : {0.3, 0.9}) {
        const P x{box.low[0] + fx * side, box.low[1] + fy * side};
        if (!graded.map.inside(x)) continue;
        ck_assert_double_ge(d(x[0], x[1]), min - 0.2 * 1.42 * side);
        ck_assert_double_le(d(x[0], x[1]), max + 0.2 * 1.42 * side);
      }
    if (graded.map.leaf_has_facets(leaf)) continue;
    // Leaves are no finer than necessary: a leaf of twice the width would violate the limit.
    ck_assert_double_gt(2 * side, 4 * (min - 0.2 * 1.42 * 2 * side));
    nodes += side * side / std::pow(graded.map.leaf_spacing(leaf), 2);
    constexpr int kFine = 8;
    for (int i = 0; i < kFine; ++i)
      for (int j = 0; j < kFine; ++j)
        area +=
            side * side / (kFine * kFine) /
            std::pow(
                d(box.low[0] + (i + 0.5) * side / kFine, box.low[1] + (j + 0.5) * side / kFine), 2);
  }
  ck_assert_double_eq_tol(nodes, area, 0.02 * area);
}
END_TEST

// Here d would require a deeper tree than is possible.
START_TEST(finest_leaves_there_can_be) {
  const Mapped m([](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 3, 2)); },
                 [](double x, double y) { return 1e-10 + 0.2 * std::hypot(x, y); });
  const pnpbs::BackgroundTree<2>& tree = m.map.tree();
  const std::int32_t finest = tree.leaf_at({0, 0});
  ck_assert_int_eq(tree.cell(tree.leaf_cell(finest)).depth, pnpbs::BackgroundTree<2>::kMaxDepth);
  ck_assert_double_eq_tol(m.map.leaf_min_spacing(finest), 1e-10, 1e-12);
  for (const double way : {1e-9, 1e-5, 0.1}) {
    quick_assert(m.map.inside({way, 2 * way}) && !m.map.inside({way, -way}));
    ck_assert_double_eq_tol(m.map.clearance({2 * way, way}, 1), way, 1e-20);
  }
}
END_TEST

START_TEST(too_many_nodes) {
  const Build square = [](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 1, 1)); };
  expect_error(pnpbs::ErrorKind::spacing,
               {"spacing d = 0.001 near (", "would mean about ", " nodes or more",
                "max_nodes allows 100000"},
               [&] { Mapped(square, constant(0.001), 100'000); });
  Mapped(square, constant(0.001), 1'160'000);
  // Only a small part of the domain is too fine, and the message gives its location.
  expect_error(
      pnpbs::ErrorKind::spacing, {"spacing d = ", " near (0.2", ", 0.7", "max_nodes allows 50000"},
      [&] {
        Mapped(
            square,
            [](double x, double y) { return std::hypot(x - 0.25, y - 0.75) < 0.05 ? 1e-4 : 0.01; },
            50'000);
      });
}
END_TEST

// ------------------------------------------------------------------ clearance ------------------

namespace {

// Returns all edges, in order, as nodes have those near them.
std::vector<std::int32_t> all_edges(const Mapped& m) {
  std::vector<std::int32_t> edges(m.boundary.facets.size());
  std::iota(edges.begin(), edges.end(), 0);
  return edges;
}

// Returns the chamber of the box in expect_walls_hold that contains x.
int chamber(const P& x) { return (x[0] > 1) + 2 * (x[1] > 0.4 + 0.1 * x[0]); }

}  // namespace

// Inner walls divide the box into four chambers. A node stays in its own chamber, whatever its goal
// is.
START_TEST(walls_hold) {
  const Mapped m(
      [](PlaneDomain& p) {
        add_loop(p, rectangle(0, 0, 2, 1));
        add_chain(p, {0, 0.4, 1, 0.5, 2, 0.6});
        add_chain(p, {1, 0, 1, 0.5});
        add_chain(p, {1, 0.5, 1, 1});
      },
      constant(0.11));
  const std::vector<std::int32_t> edges = all_edges(m);
  Random random(88);
  std::int64_t held = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const P from = random.point<2>(m.domain.bounds());
    if (gap_to_boundary(m, from) == 0) continue;
    const double reach = random.between(0, 0.5);
    const P to{from[0] + random.between(-reach, reach), from[1] + random.between(-reach, reach)};
    const pnpbs::ClearPosition<2> kept = pnpbs::clear_position<2>(m.map, edges, from, to, 0.11);
    quick_assert(m.map.inside(kept.position));
    ck_assert_int_eq(chamber(kept.position), chamber(from));
    const double gap = gap_to_boundary(m, kept.position);
    quick_assert(kept.clear == (gap >= 0.35 * 0.11) || std::fabs(gap - 0.35 * 0.11) < 1e-12);
    if (m.map.inside(to) && chamber(to) == chamber(from) && gap_to_boundary(m, to) >= 0.4 * 0.11)
      quick_assert(kept.position == to);
    else
      ++held;
    // The corners of the chambers have angles of at least 84 degrees.
    quick_assert(kept.clear);
  }
  ck_assert_int_gt(held, 5000);
}
END_TEST

START_TEST(clearance_is_reached_where_there_is_room) {
  const double d = 0.1;
  const Mapped m([](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 1, 1)); }, constant(d));
  const std::vector<std::int32_t> edges = all_edges(m);
  const auto keep = [&](const P& from, const P& to) {
    return pnpbs::clear_position<2>(m.map, edges, from, to, d);
  };
  for (const double y : {0.3, 0.51, 0.777}) {
    pnpbs::ClearPosition<2> kept = keep({0.06, y}, {0.01, y + 0.02});  // too near to a side
    quick_assert(kept.clear);
    ck_assert_double_eq_tol(kept.position[0], 0.04, 1e-15);
    ck_assert_double_eq_tol(kept.position[1], y + 0.02, 1e-15);
    kept = keep({0.06, y}, {-0.05, y});  // beyond the side: back to the old position
    quick_assert(kept.clear);
    quick_assert(kept.position == (P{0.06, y}));
    kept = keep({0.06, y}, {0, y});  // onto the side
    quick_assert(kept.position == (P{0.06, y}));
  }
  const pnpbs::ClearPosition<2> corner = keep({0.05, 0.05}, {0.01, 0.02});
  quick_assert(corner.clear);
  ck_assert_double_eq_tol(corner.position[0], 0.04, 1e-15);
  ck_assert_double_eq_tol(corner.position[1], 0.04, 1e-15);
}
END_TEST

// A corner that points into the domain, and the end of an open curve: the node moves around them.
START_TEST(tips_are_kept_off) {
  const double d = 0.1;
  const Mapped m(
      [](PlaneDomain& p) {
        const std::vector<double> xy{0, 0, 1, 0, 1, 1, 0.5, 0.5, 0, 1};
        p.add_polyline(pnpbs::CurveRole::boundary, true, 5, xy.data(), nullptr, 0);
        add_chain(p, {0.5, 0.1, 0.5, 0.2});
      },
      constant(d));
  const std::vector<std::int32_t> edges = all_edges(m);
  for (const double y : {0.5, 0.2}) {
    const double side = y == 0.5 ? -1 : 1;  // the side with room
    const P to{0.503, y + side * 0.02};
    const pnpbs::ClearPosition<2> kept =
        pnpbs::clear_position<2>(m.map, edges, {0.46, y + side * 0.05}, to, d);
    quick_assert(kept.clear);
    const double gap = std::hypot(kept.position[0] - 0.5, kept.position[1] - y);
    ck_assert_double_eq_tol(gap, 0.4 * d, 1e-15);
    // The node moves straight away from the tip.
    ck_assert_double_eq_tol((kept.position[0] - 0.5) * (to[1] - y),
                            (kept.position[1] - y) * (to[0] - 0.5), 1e-15);
  }
}
END_TEST

START_TEST(no_room_in_wedges_and_gaps) {
  const double d = 0.1;
  const Mapped wedge(
      [](PlaneDomain& p) {
        const std::vector<double> xy{0, 0, 1, 0, 1, 0.05};
        p.add_polyline(pnpbs::CurveRole::boundary, true, 3, xy.data(), nullptr, 0);
      },
      constant(d));
  const std::vector<std::int32_t> edges = all_edges(wedge);
  Random random(89);
  for (int trial = 0; trial < 1000; ++trial) {
    const double x = random.between(0.01, 0.99), y = random.between(0.01, 0.99) * 0.05 * x;
    const P to{x + random.between(-0.02, 0.02), y + random.between(-0.02, 0.02)};
    const pnpbs::ClearPosition<2> kept = pnpbs::clear_position(wedge.map, edges, {x, y}, to, d);
    quick_assert(!kept.clear);
    quick_assert(wedge.map.inside(kept.position));
  }
  // A node between two walls that is pushed to 0.4 d off one wall must keep 0.35 d off the other.
  for (const double width : {0.068, 0.074, 0.076, 0.081}) {
    const Mapped gap([&](PlaneDomain& p) { add_loop(p, rectangle(0, 0, 1, width)); }, constant(d));
    const pnpbs::ClearPosition<2> kept =
        pnpbs::clear_position(gap.map, all_edges(gap), {0.5, width / 2}, {0.52, width / 2}, d);
    quick_assert(kept.clear == (width > 0.075));
    quick_assert(gap.map.inside(kept.position));
  }
}
END_TEST

TEST_SUITE(test_sized_tree) {
  return run_kernel_suite(
      "domain_map",
      {sides_of_nested_islands, sides_of_lakes, clearances, edges_near_points, leaf_sizes_follow_d,
       finest_leaves_there_can_be, too_many_nodes, walls_hold,
       clearance_is_reached_where_there_is_room, tips_are_kept_off, no_room_in_wedges_and_gaps});
}
