// SPDX-License-Identifier: BSD-3-Clause
// Simplification of boundaries finer than d: the omitted vertices, the distance of the result from
// the input, and the sides of all points, which are computed directly from the input.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "domain/plane/plane_domain.hpp"
#include "expect_error.hpp"
#include "geometry/plane/segments.hpp"
#include "run_suite.hpp"
#include "shapes.hpp"

using pnpbs::CurveRole;
using pnpbs::LeftOut;
using pnpbs::PlaneDomain;
using pnpbs::Point;
using shapes::Graph;
using shapes::pi;
using Points = std::vector<Point<2>>;

namespace {

pnpbs::LocalSpacingEvaluator<2> constant(double value) {
  return pnpbs::LocalSpacingEvaluator<2>(
      [value](std::int64_t n, const Point<2>*, double* d) { std::fill(d, d + n, value); });
}

LeftOut simplify(PlaneDomain& domain, double d, double tolerance, double smallest = 0) {
  return domain.simplify(constant(d), {tolerance, smallest});
}

// Returns a coast about a point: a circle with increasingly short waves and noise.
Points coast(const Point<2>& centre, double radius, int n, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> phases;
  for (int k = 0; k < 12; ++k)
    phases.push_back(2 * pi * static_cast<double>(random()) / std::mt19937::max());
  Points points;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * pi * i / n;
    double r = 1;
    for (int k = 0; k < 12; ++k) {
      const double waves = std::pow(2, k) + 1;
      if (waves < n / 4.0) r += 0.25 / waves * std::sin(waves * angle + phases[k]);
    }
    points.push_back(
        {centre[0] + radius * r * std::cos(angle), centre[1] + radius * r * std::sin(angle)});
  }
  return points;
}

void add_closed(PlaneDomain& domain, const Points& points) {
  domain.add_polyline(CurveRole::boundary, true, static_cast<std::int64_t>(points.size()),
                      points[0].data(), nullptr, 0);
}

double distance_to(const PlaneDomain& domain, const Point<2>& x) {
  double least = HUGE_VAL;
  for (const auto& curve : domain.curves())
    for (std::size_t k = 0; k + 1 < curve.points.size(); ++k)
      least = std::min(least, pnpbs::distance_to_segment(curve.points[k], curve.points[k + 1], x));
  return least;
}

bool has_vertex(const PlaneDomain& domain, const Point<2>& x) {
  return std::ranges::any_of(domain.corners(),
                             [&](const auto& corner) { return corner.position == x; });
}

std::size_t segments_of(const PlaneDomain& domain) {
  std::size_t n = 0;
  for (const auto& curve : domain.curves()) n += curve.points.size() - 1;
  return n;
}

START_TEST(a_coast_stays_within_the_tolerance) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Points given = coast({0, 0}, 1, 4000, seed);
    for (const double d : {0.02, 0.1}) {
      PlaneDomain domain;
      add_closed(domain, given);
      const LeftOut left_out = simplify(domain, d, 0.25);
      domain.check();  // no crossings
      ck_assert_int_eq(left_out.curves, 0);
      ck_assert_uint_eq(segments_of(domain) + static_cast<std::size_t>(left_out.vertices), 4000);
      ck_assert_uint_lt(segments_of(domain), static_cast<std::size_t>(16 / d));
      for (const Point<2>& x : given)
        ck_assert_double_le(distance_to(domain, x), 0.25 * d * 1.0001);
    }
  }
}
END_TEST

// Details that nodes can follow are kept: a dent beside pieces of length d. With a tolerance of 0
// everything is kept.
START_TEST(pieces_as_long_as_d_stay) {
  PlaneDomain domain;
  add_closed(domain, {{0, 0}, {0.5, 0.01}, {1, 0}, {1, 1}, {0, 1}});
  ck_assert_int_eq(simplify(domain, 0.4, 0.25).vertices, 0);
  ck_assert_int_eq(simplify(domain, 0.6, 0.25).vertices, 1);
  domain.check();
  ck_assert_double_eq(domain.area(), 1);
  PlaneDomain bent;
  add_closed(bent, coast({0, 0}, 1, 400, 5));
  ck_assert_int_eq(simplify(bent, 0.1, 0).vertices, 0);
}
END_TEST

// Straight parts become one segment, for vertices in any order and direction.
START_TEST(graphs_in_any_order) {
  std::mt19937 random(7);
  Points points;
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 32; ++i) {
      const double t = i / 32.0;
      const Point<2> on_side[] = {{t, 0}, {1, t}, {1 - t, 1}, {0, 1 - t}};
      points.push_back(on_side[k]);
    }
  std::vector<std::int64_t> ends;
  std::vector<std::int64_t> order(128);
  for (std::size_t i = 0; i < 128; ++i) order[i] = static_cast<std::int64_t>(i);
  std::ranges::shuffle(order, random);
  for (const std::int64_t s : order) {
    const bool turned = random() % 2 == 0;
    ends.push_back(turned ? (s + 1) % 128 : s);
    ends.push_back(turned ? s : (s + 1) % 128);
  }
  PlaneDomain domain;
  domain.add_pslg(128, points[0].data(), nullptr, 128, ends.data(), nullptr, 0, nullptr);
  ck_assert_int_eq(simplify(domain, 1, 1e-9).vertices, 124);
  domain.check();
  ck_assert_double_eq(domain.area(), 1);
  ck_assert_uint_eq(domain.corners().size(), 4);
}
END_TEST

// Walls with gaps of d/20: neither they nor points between them change sides.
START_TEST(nothing_comes_to_another_side) {
  const double gap = 0.05;
  Points comb;
  for (int k = 0; k < 12; ++k) {
    const double x = 2 * gap * k;
    for (int i = 0; i <= 20; ++i) comb.push_back({x, i / 20.0});
    for (int i = 20; i >= 0; --i) comb.push_back({x + gap, i / 20.0});
  }
  const double right = comb.back()[0];
  comb.insert(comb.end(), {{right, -0.3}, {0, -0.3}});
  PlaneDomain domain;
  add_closed(domain, comb);
  Points nodes;
  for (int k = 0; k < 12; ++k) nodes.push_back({2 * gap * k + 0.5 * gap, 0.9});
  domain.add_fixed_nodes(static_cast<std::int64_t>(nodes.size()), nodes[0].data(), nullptr);
  ck_assert_int_gt(simplify(domain, 1, 0.5).vertices, 300);
  domain.check();  // checks crossings and fixed nodes
  ck_assert_uint_eq(domain.fixed_nodes().size(), nodes.size());
  for (const Point<2>& x : comb) ck_assert_double_le(distance_to(domain, x), 0.5);
}
END_TEST

START_TEST(what_others_meet_stays) {
  Points side;
  std::vector<std::int32_t> tags;
  for (int i = 0; i < 100; ++i) {
    side.push_back({i / 100.0, 0});
    tags.push_back(i < 37 ? 3 : 4);
  }
  side.insert(side.end(), {{1, 0}, {1, 1}, {0, 1}});
  tags.insert(tags.end(), {5, 5, 5});
  PlaneDomain domain;
  domain.add_polyline(CurveRole::boundary, true, 103, side[0].data(), tags.data(), 0);
  const Points wall{{0.618, 0}, {0.618, 0.5}};  // on a segment
  domain.add_polyline(CurveRole::inner, false, 2, wall[0].data(), nullptr, 0);
  const Point<2> fixed{0.83, 0};
  domain.add_fixed_nodes(1, fixed.data(), nullptr);
  simplify(domain, 2, 0.25);
  domain.check();
  for (const Point<2>& x : Points{{0, 0}, {0.37, 0}, {0.618, 0}, {0.83, 0}, {1, 0}, {1, 1}})
    ck_assert(has_vertex(domain, x));
  ck_assert_uint_eq(domain.corners().size(), 8);
  ck_assert_double_eq_tol(domain.area(), 1, 1e-12);
}
END_TEST

// A lake with islands of many sizes, one with a lake of its own and one with a fixed node at its
// coast.
START_TEST(islands_too_small_for_nodes) {
  Graph graph;
  const auto add = [&](const Points& points) {
    const auto first = static_cast<std::int64_t>(graph.xy.size() / 2);
    const auto n = static_cast<std::int64_t>(points.size());
    for (std::int64_t i = 0; i < n; ++i) {
      graph.xy.insert(graph.xy.end(), points[i].begin(), points[i].end());
      graph.ends.insert(graph.ends.end(), {first + i, first + (i + 1) % n});
    }
  };
  add(coast({0, 0}, 10, 2000, 11));
  Points holes, islands{{-5, 0}, {-2, 3}, {0, -4}, {4, 4}, {5, -2}, {2, 0}};
  const double radii[] = {0.02, 0.04, 0.2, 0.6, 0.03, 0.3};
  for (std::size_t k = 0; k < islands.size(); ++k) {
    add(coast(islands[k], radii[k], 60, static_cast<unsigned>(k)));
    holes.push_back({islands[k][0] + 0.4 * radii[k], islands[k][1]});
    if (k == 3) holes.back() = {4.2, 4};
  }
  add(coast({4, 4}, 0.05, 30, 3));  // a lake on the fourth island
  PlaneDomain domain;
  const auto segments = static_cast<std::int64_t>(graph.ends.size() / 2);
  domain.add_pslg(static_cast<std::int64_t>(graph.xy.size() / 2), graph.xy.data(), nullptr,
                  segments, graph.ends.data(), nullptr, 6, holes[0].data());
  const Point<2> shore = coast(islands[4], radii[4], 60, 4)[0];
  domain.add_fixed_nodes(1, shore.data(), nullptr);
  const LeftOut left_out = simplify(domain, 0.1, 0.25, 2);  // curves with an extent below 0.2
  ck_assert_int_eq(left_out.curves, 3);
  domain.check();
  ck_assert(has_vertex(domain, shore));
  double area = 100 * pi;
  for (const std::size_t k : {2, 3, 4, 5}) area -= pi * radii[k] * radii[k];
  ck_assert_double_eq_tol(domain.area(), area, 0.05 * area);
  ck_assert(std::ranges::any_of(domain.warnings(), [](const pnpbs::Warning& warning) {
    return warning.code == pnpbs::WarningCode::simplified && warning.count > 0 &&
           warning.message.text().find("3 closed curves") != std::string::npos;
  }));
  // The whole lake is small, but the domain must not become empty.
  ck_assert_int_eq(simplify(domain, 1000, 0.25, 2).curves, 3);
  domain.check();
}
END_TEST

START_TEST(bad_arguments) {
  PlaneDomain domain;
  add_closed(domain, coast({0, 0}, 1, 100, 1));
  using pnpbs::ErrorKind;
  expect_error(ErrorKind::argument, {"tolerance", "-1"}, [&] { simplify(domain, 1, -1); });
  expect_error(ErrorKind::argument, {"smallest"}, [&] { simplify(domain, 1, 0, -2); });
  expect_error(ErrorKind::argument, {"tolerance"}, [&] { simplify(domain, 1, NAN); });
  const pnpbs::LocalSpacingEvaluator<2> failing([](std::int64_t, const Point<2>*, double*) {
    throw pnpbs::Error(ErrorKind::callback, "no d today");
  });
  expect_error(ErrorKind::callback, {"no d today"}, [&] { domain.simplify(failing, {1, 1}); });
  domain.check();
  ck_assert_uint_eq(segments_of(domain), 100);
}
END_TEST

// ---------------------------------------------------------------- corners of graphs

// A graph of a square with three rounded corners, with segments in any order.
START_TEST(corners_of_a_graph) {
  Points points{{1, 0}};
  for (int i = 0; i < 90; ++i) {
    const double angle = pi / 2 * (i + 1) / 90;
    points.push_back({0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::sin(angle)});
  }
  points.push_back({0, 1});
  points.push_back({0, 0});
  points[0] = {1, 0};
  const auto n = static_cast<std::int64_t>(points.size());
  std::vector<std::int64_t> ends, order;
  for (std::int64_t s = 0; s < n; ++s) order.push_back(s);
  std::mt19937 random(3);
  std::ranges::shuffle(order, random);
  for (const std::int64_t s : order) {
    const std::int64_t next = (s + 1) % n;
    ends.insert(ends.end(), {random() % 2 == 0 ? s : next, 0});
    ends.back() = ends[ends.size() - 2] == s ? next : s;
  }
  PlaneDomain domain;
  domain.set_corner_angle(30);
  domain.add_pslg(n, points[0].data(), nullptr, n, ends.data(), nullptr, 0, nullptr);
  domain.check();
  ck_assert_uint_eq(domain.corners().size(), 3);
  ck_assert_uint_eq(domain.curves().size(), 3);
  ck_assert_uint_eq(segments_of(domain), static_cast<std::size_t>(n));
  const double area = domain.area();
  domain.set_corner_angle(0);
  domain.check();
  ck_assert_uint_eq(domain.corners().size(), static_cast<std::size_t>(n));
  ck_assert_double_eq_tol(domain.area(), area, 1e-12);
}
END_TEST

// A closed curve without corners begins at an arbitrary vertex. Tags of segments and vertices make
// corners.
START_TEST(round_graphs) {
  Points points;
  std::vector<std::int64_t> ends;
  std::vector<std::int32_t> vertex_tags, tags;
  for (int ring = 0; ring < 2; ++ring)
    for (int i = 0; i < 100; ++i) {
      const double angle = 2 * pi * i / 100, r = ring == 0 ? 1 : 0.5;
      points.push_back({r * std::cos(angle), r * std::sin(angle)});
      ends.insert(ends.end(), {100 * ring + i, 100 * ring + (i + 1) % 100});
      vertex_tags.push_back(0);
      tags.push_back(7);
    }
  const Point<2> hole{0, 0};
  const auto curves_with = [&](double angle) {
    PlaneDomain domain;
    domain.add_pslg(200, points[0].data(), vertex_tags.data(), 200, ends.data(), tags.data(), 1,
                    hole.data());
    domain.set_corner_angle(angle);
    domain.check();
    ck_assert_double_eq_tol(domain.area(), 0.75 * 50 * std::sin(2 * pi / 100), 1e-12);
    return domain.curves().size();
  };
  ck_assert_uint_eq(curves_with(20), 2);
  ck_assert_uint_eq(curves_with(3), 200);  // each turns by 3.6 degrees
  vertex_tags[130] = 9;
  vertex_tags[140] = 7;  // the tag of the segments
  ck_assert_uint_eq(curves_with(20), 2);
  vertex_tags[170] = 9;
  tags[20] = 8;
  ck_assert_uint_eq(curves_with(20), 4);
  expect_error(pnpbs::ErrorKind::argument, {"corner_angle", "181"}, [&] { curves_with(181); });
}
END_TEST

}  // namespace

TEST_SUITE(test_simplify) {
  return run_suite("simplify",
                   {a_coast_stays_within_the_tolerance, pieces_as_long_as_d_stay,
                    graphs_in_any_order, nothing_comes_to_another_side, what_others_meet_stays,
                    islands_too_small_for_nodes, bad_arguments, corners_of_a_graph, round_graphs});
}
