// SPDX-License-Identifier: BSD-3-Clause
// Boundary nodes: equal steps of the integral of ds/d on the exact curves, and edges that divide
// the plane as the curves do.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "domain/from_files.hpp"
#include "domain/plane/boundary.hpp"
#include "expect_error.hpp"
#include "geometry/plane/faces.hpp"
#include "run_suite.hpp"
#include "shapes.hpp"

using pnpbs::Boundary;
using pnpbs::BoundaryEdge;
using pnpbs::PlaneDomain;
using pnpbs::SpacingEvaluator;
using shapes::add_chain;
using shapes::add_circle;
using shapes::add_loop;
using shapes::Graph;
using shapes::pi;
using shapes::rectangle;
using P = pnpbs::Point<2>;

namespace {

SpacingEvaluator<2> spacing(const std::function<double(double x, double y)>& d) {
  return [d](std::int64_t n, const P* x, double* values) {
    for (std::int64_t i = 0; i < n; ++i) values[i] = d(x[i][0], x[i][1]);
  };
}

SpacingEvaluator<2> constant(double d) {
  return spacing([d](double, double) { return d; });
}

Boundary lay(PlaneDomain& domain, const SpacingEvaluator<2>& d) {
  domain.check();
  return pnpbs::discretize_boundary(domain, d);
}

PlaneDomain lake(const char* name) {
  PlaneDomain domain;
  pnpbs::add_poly(
      domain, pnpbs::read_poly(std::string(PNPBS_SOURCE_DIR "/examples/data/") + name + ".poly"));
  return domain;
}

bool warns(const Boundary& boundary, const std::string& part) {
  return std::any_of(boundary.warnings.begin(), boundary.warnings.end(),
                     [&part](const pnpbs::Warning& warning) {
                       return warning.message.text().find(part) != std::string::npos;
                     });
}

double length(const Boundary& boundary, const BoundaryEdge& edge) {
  return pnpbs::distance<2>(boundary.nodes[edge.begin].position, boundary.nodes[edge.end].position);
}

// Expects that no two edges meet, that each face of the edges is inside or outside on all its
// sides, and that fixed nodes lie inside.
void expect_valid(const Boundary& boundary) {
  std::vector<P> points;
  std::vector<pnpbs::VertexPair> ends;
  for (const auto& node : boundary.nodes) points.push_back(node.position);
  for (const auto& edge : boundary.facets) ends.push_back({edge.begin, edge.end});
  const auto sweep = pnpbs::sweep_plane(points, ends);
  ck_assert(sweep.conflicts.empty());
  ck_assert(sweep.coincident.empty());
  const auto faces = pnpbs::find_faces(points, ends, sweep);
  std::vector<int> inside(faces.count, -1);
  inside[0] = 0;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    for (const int right : {0, 1}) {
      int& known = inside[faces.of_side[2 * e + right]];
      const int flag = right ? boundary.facets[e].right_inside : boundary.facets[e].left_inside;
      if (known < 0) known = flag;
      ck_assert_int_eq(known, flag);
    }
  }
  for (auto node = boundary.first_fixed; node < static_cast<std::int64_t>(points.size()); ++node) {
    const auto side = pnpbs::side_left_of(static_cast<std::int32_t>(node), points, ends, sweep);
    ck_assert_int_eq(inside[faces.of_side[side]], 1);
  }
}

// Returns the integral of ds/d over a straight edge, with a fine sum.
double integral(const P& a, const P& b, const std::function<double(double, double)>& d) {
  constexpr int kParts = 1000;
  double sum = 0;
  for (int i = 0; i < kParts; ++i) {
    const double t = (i + 0.5) / kParts;
    sum += 1 / d(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]));
  }
  return sum / kParts * pnpbs::distance<2>(a, b);
}

void expect_equal_steps(const std::function<double(double, double)>& d, double tolerance = 1e-4) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 3, 2));
  const Boundary boundary = lay(domain, spacing(d));
  expect_valid(boundary);
  std::size_t e = 0;
  for (const auto& curve : domain.curves()) {
    const double whole = integral(curve.points[0], curve.points[1], d);
    const double steps = std::max(1.0, std::round(whole));
    for (int k = 0; k < steps; ++k, ++e) {
      const auto& edge = boundary.facets[e];
      const double step =
          integral(boundary.nodes[edge.begin].position, boundary.nodes[edge.end].position, d);
      ck_assert_double_eq_tol(step, whole / steps, tolerance * whole / steps);
    }
    ck_assert_int_eq(boundary.facets[e - 1].end, curve.corner_end);
  }
  ck_assert_uint_eq(e, boundary.facets.size());
}

}  // namespace

START_TEST(uniform_square) {
  PlaneDomain domain;
  const double xy[] = {0, 0, 1, 0, 1, 1, 0, 1};
  const std::int32_t tags[] = {5, 6, 7, 8};
  domain.add_polyline(pnpbs::CurveRole::boundary, true, 4, xy, tags, 0);
  const Boundary boundary = lay(domain, constant(0.1));
  expect_valid(boundary);
  ck_assert(boundary.warnings.empty());
  ck_assert_uint_eq(boundary.nodes.size(), 40);
  ck_assert_uint_eq(boundary.facets.size(), 40);
  ck_assert_int_eq(boundary.first_fixed, 40);
  for (std::size_t c = 0; c < 4; ++c) {
    ck_assert(boundary.nodes[c].position == domain.corners()[c].position);
    ck_assert_int_eq(boundary.nodes[c].tag, domain.corners()[c].tag);
  }
  for (std::size_t e = 0; e < 40; ++e) {
    ck_assert_double_eq_tol(length(boundary, boundary.facets[e]), 0.1, 1e-15);
    ck_assert_int_eq(boundary.facets[e].tag, 5 + static_cast<int>(e) / 10);
    ck_assert(boundary.facets[e].left_inside && !boundary.facets[e].right_inside);
  }
  ck_assert_int_eq(boundary.nodes[4].tag, 5);
  ck_assert_double_eq_tol(boundary.nodes[8].position[0], 0.5, 1e-15);
  ck_assert_double_eq(boundary.nodes[8].position[1], 0);
}
END_TEST

START_TEST(equal_steps_of_the_integral) {
  expect_equal_steps([](double x, double y) { return 0.01 + 0.05 * std::hypot(x, y); });
  expect_equal_steps([](double x, double) { return 0.02 * (1.5 + std::sin(3 * x)); });
  expect_equal_steps([](double x, double y) { return 0.001 + 0.3 * std::fabs(x - y); }, 1e-2);
  expect_equal_steps([](double, double) { return 0.37; });
  expect_equal_steps([](double x, double) { return x < 1.234567 ? 0.05 : 0.011; }, 1e-2);
  expect_equal_steps([](double, double) { return 1e6; });
}
END_TEST

START_TEST(number_of_steps_is_rounded) {
  const struct {
    double d;
    std::size_t edges;
  } cases[] = {{10, 4}, {1.5, 4}, {0.6667, 4}, {0.6666, 8}, {0.41, 8}, {0.399, 12}};
  for (const auto& with : cases) {
    PlaneDomain domain;
    add_loop(domain, rectangle(0, 0, 1, 1));
    ck_assert_uint_eq(lay(domain, constant(with.d)).facets.size(), with.edges);
  }
}
END_TEST

START_TEST(nodes_lie_on_the_true_curve) {
  PlaneDomain domain;
  add_circle(domain, 1, 2, 3, 9);
  const Boundary boundary = lay(domain, constant(0.123));
  expect_valid(boundary);
  const double steps = std::round(6 * pi / 0.123);
  ck_assert_uint_eq(boundary.nodes.size(), static_cast<std::size_t>(steps));
  for (const auto& node : boundary.nodes) {
    ck_assert_double_eq_tol(pnpbs::distance<2>(node.position, {1, 2}), 3, 1e-14);
    ck_assert_int_eq(node.tag, 9);
  }
  for (const auto& edge : boundary.facets) {
    ck_assert_double_eq_tol(length(boundary, edge), 6 * std::sin(pi / steps), 1e-12);
  }
}
END_TEST

START_TEST(steps_on_an_unevenly_parametrised_curve) {
  PlaneDomain domain;
  domain.add_curve(
      pnpbs::CurveRole::boundary,
      [](std::int64_t n, const double* t, P* xy) {
        for (std::int64_t i = 0; i < n; ++i) {
          const double angle = pi * t[i] * t[i] * t[i];
          xy[i] = {std::cos(angle), std::sin(angle)};
        }
      },
      -1, 1, 1);
  const Boundary boundary = lay(domain, constant(0.1));
  expect_valid(boundary);
  ck_assert_uint_eq(boundary.facets.size(), 63);
  for (const auto& edge : boundary.facets) {
    ck_assert_double_eq_tol(length(boundary, edge), 2 * std::sin(pi / 63), 3e-4);
  }
}
END_TEST

START_TEST(spacing_is_asked_on_the_curves_only_and_in_batches) {
  PlaneDomain domain;
  add_circle(domain, 0, 0, 1);
  int calls = 0;
  lay(domain, [&calls](std::int64_t n, const P* x, double* d) {
    ++calls;
    for (std::int64_t i = 0; i < n; ++i) {
      ck_assert_double_eq_tol(std::hypot(x[i][0], x[i][1]), 1, 1e-14);
      d[i] = 0.01;
    }
  });
  ck_assert_int_le(calls, 8);
  calls = 0;
  PlaneDomain lakes = lake("great_lakes_islands");
  lay(lakes, [&calls](std::int64_t n, const P* x, double* d) {
    ++calls;
    for (std::int64_t i = 0; i < n; ++i) d[i] = 0.3 + 0.006 * std::hypot(x[i][0], x[i][1]);
  });
  ck_assert_int_le(calls, 8);
}
END_TEST

START_TEST(closed_curves_have_three_edges) {
  PlaneDomain domain;
  add_circle(domain, 0, 0, 1);
  const Boundary boundary = lay(domain, constant(100));
  ck_assert_uint_eq(boundary.facets.size(), 3);
  expect_valid(boundary);
  ck_assert(warns(boundary, "3 boundary edges shorter than half of it"));
}
END_TEST

// Nodes on both sides of a slit see each other only if the domain lies between them.
START_TEST(nodes_beside_another_curve_are_named) {
  const double mouth = 1e-6;
  PlaneDomain wedge;
  add_loop(wedge, {{0, 0, 1, 0, 1, mouth}});
  const Boundary inside = lay(wedge, constant(0.1));
  expect_valid(inside);
  ck_assert(warns(inside, "boundary nodes closer than a tenth of it to another edge"));
  ck_assert(warns(inside, "(distance 1e-07, spacing 0.1, at ("));
  PlaneDomain slit;
  add_loop(slit, {{-1, -1, 1, -1, 1, 0, 0, 0, 1, mouth, 1, 1, -1, 1}});
  const Boundary outside = lay(slit, constant(0.1));
  expect_valid(outside);
  ck_assert(!warns(outside, "to another edge"));
}
END_TEST

START_TEST(two_arcs_do_not_collapse) {
  PlaneDomain domain;
  domain.add_arc(pnpbs::CurveRole::boundary, {0, 0}, 1, 0, pi, 1);
  domain.add_arc(pnpbs::CurveRole::boundary, {0, 0}, 1, pi, 2 * pi, 2);
  const Boundary boundary = lay(domain, constant(100));
  expect_valid(boundary);
  ck_assert_uint_ge(boundary.facets.size(), 3);
  ck_assert(warns(boundary, "halved, on curve 0"));
}
END_TEST

START_TEST(chords_that_would_cut_are_halved) {
  PlaneDomain domain;
  add_circle(domain, 0, 0, 1);
  domain.add_arc(pnpbs::CurveRole::boundary, {0, 0}, 0.99, 1, 1 + 2 * pi, 2);
  const Boundary boundary = lay(domain, constant(1));
  expect_valid(boundary);
  ck_assert_uint_ge(boundary.facets.size(), 30);
  ck_assert_uint_le(boundary.facets.size(), 150);
  ck_assert(warns(boundary, "would have crossed others"));
}
END_TEST

// Returns a square whose upper side is a dense polyline with a bump, which may contain small
// features.
static PlaneDomain bumpy_square() {
  PlaneDomain domain;
  add_chain(domain, {0, 1, 0, 0, 1, 0, 1, 1}, pnpbs::CurveRole::boundary);
  std::vector<double> top;
  for (int i = 200; i >= 0; --i) {
    const double x = i / 200.0;
    top.insert(top.end(), {x, 1 + 0.3 * std::exp(-std::pow((x - 0.4) / 0.1, 2)) * x * (1 - x) * 4});
  }
  top[1] = top[top.size() - 1] = 1;
  add_chain(domain, top, pnpbs::CurveRole::boundary, 90);
  return domain;
}

START_TEST(islands_stay_inside) {
  PlaneDomain domain = bumpy_square();
  add_loop(domain, rectangle(0.39, 1.1, 0.41, 1.12));
  const Boundary boundary = lay(domain, constant(10));
  expect_valid(boundary);
  ck_assert_uint_ge(boundary.facets.size(), 9);
}
END_TEST

START_TEST(fixed_nodes_stay_inside) {
  PlaneDomain domain = bumpy_square();
  const double xy[] = {0.4, 1.2, 0.5, 0.5};
  domain.add_fixed_nodes(2, xy, nullptr);
  const Boundary boundary = lay(domain, constant(10));
  expect_valid(boundary);
  ck_assert_int_eq(boundary.first_fixed + 2, static_cast<std::int64_t>(boundary.nodes.size()));
  ck_assert_double_eq(boundary.nodes[boundary.first_fixed].position[1], 1.2);
}
END_TEST

START_TEST(curves_keep_their_order_about_a_corner) {
  // Two arcs leave the origin in the same direction and bend apart, as do their chords. A third,
  // straight curve lies between them, and a chord may pass it.
  PlaneDomain domain;
  add_loop(domain, rectangle(-3, -3, 3, 3));
  domain.add_arc(pnpbs::CurveRole::inner, {0, 1}, 1, -pi / 2, pi / 2, 2);
  add_chain(domain, {0, 0, 0.05, 0.5});
  const Boundary boundary = lay(domain, constant(20));
  expect_valid(boundary);
  PlaneDomain passed;
  add_loop(passed, rectangle(-3, -3, 3, 3));
  passed.add_arc(pnpbs::CurveRole::inner, {0, 1}, 1, -pi / 2, pi / 2, 2);
  add_chain(passed, {0, 2, 0, 2.5});
  add_chain(passed, {0, 0, 0.6, 0.6});
  expect_valid(lay(passed, constant(20)));
}
END_TEST

START_TEST(lakes_at_any_spacing) {
  for (const char* name : {"great_lakes", "great_lakes_islands", "lake_victoria"}) {
    PlaneDomain domain = lake(name);
    for (const double d : {0.5, 5.0, 50.0, 5000.0}) {
      const Boundary boundary = lay(domain, constant(d));
      expect_valid(boundary);
      ck_assert_uint_ge(boundary.facets.size(), domain.curves().size());
    }
  }
}
END_TEST

START_TEST(smooth_lakes_at_any_spacing) {
  // The coasts are smooth curves whose nodes need not be the vertices.
  PlaneDomain lakes = lake("great_lakes_islands");
  lakes.check();
  PlaneDomain domain;
  shapes::Loop loop;
  for (const auto& curve : lakes.curves()) {
    loop.xy.insert(loop.xy.end(), curve.points[0].begin(), curve.points[0].end());
    const P first{loop.xy[0], loop.xy[1]};
    if (curve.points[1] != first) continue;
    add_loop(domain, loop, 180);
    loop.xy.clear();
  }
  domain.check();
  ck_assert_uint_eq(domain.curves().size(), 110);
  ck_assert_double_eq_tol(domain.area(), lakes.area(), 1e-6);
  for (const double d : {1.0, 10.0, 100.0, 1000.0}) expect_valid(lay(domain, constant(d)));
}
END_TEST

START_TEST(short_edges_are_told) {
  Graph graph;
  graph.loop({{0, 0, 10, 0, 10, 10, 0.1, 10, 0, 9.8}});
  PlaneDomain domain;
  graph.add_to(domain);
  const Boundary boundary = lay(domain, constant(1));
  ck_assert(warns(boundary, "at 1 boundary edges"));
  ck_assert(warns(boundary, "segment 3 (length 0.2236, spacing 1, at (0.1, 10))"));
  ck_assert(lay(domain, constant(0.2)).warnings.empty());
}
END_TEST

START_TEST(close_fixed_nodes_are_told) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 10, 10));
  const double xy[] = {5, 5, 5, 0.3, 2, 2, 2.2, 2, 7, 7};
  domain.add_fixed_nodes(5, xy, nullptr);
  const Boundary boundary = lay(domain, constant(1));
  ck_assert(warns(boundary, "3 fixed nodes are closer than 0.4"));
  ck_assert(warns(boundary, "fixed node 1 (distance 0.3, spacing 1, at (5, 0.3))"));
  ck_assert_int_eq(boundary.nodes[boundary.first_fixed + 3].tag, 1);
  ck_assert(lay(domain, constant(0.4)).warnings.empty());
}
END_TEST

START_TEST(bad_spacing) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 1, 1));
  domain.check();
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    expect_error(pnpbs::ErrorKind::spacing, {"the spacing is ", " at (0, 0)"},
                 [&] { pnpbs::discretize_boundary(domain, constant(bad)); });
  }
  expect_error(pnpbs::ErrorKind::spacing,
               {"would need about 4e+12 nodes", "the spacing is 1e-12 at"},
               [&] { pnpbs::discretize_boundary(domain, constant(1e-12)); });
  expect_error(pnpbs::ErrorKind::spacing, {"would need about 400 nodes, more than 300"},
               [&] { pnpbs::discretize_boundary(domain, constant(1e-2), 300); });
  // Every rank stores the boundary, so its number of nodes has a limit of its own.
  expect_error(
      pnpbs::ErrorKind::spacing,
      {"would need about 2.5e+09 nodes, more than the 2000000000 that every rank can hold"},
      [&] { pnpbs::discretize_boundary(domain, constant(1.6e-9), std::int64_t{1} << 40); });
  expect_error(pnpbs::ErrorKind::spacing, {"would need about"}, [&] {
    pnpbs::discretize_boundary(domain, constant(std::numeric_limits<double>::denorm_min()));
  });
}
END_TEST

START_TEST(callbacks_that_change_their_mind) {
  // The callback returns finite values when the curve is added, but not when nodes are placed on
  // it.
  PlaneDomain domain;
  bool broken = false;
  domain.add_curve(
      pnpbs::CurveRole::boundary,
      [&broken](std::int64_t n, const double* t, P* xy) {
        for (std::int64_t i = 0; i < n; ++i) {
          xy[i] = {std::cos(t[i]), broken ? std::nan("") : std::sin(t[i])};
        }
      },
      0, 2 * pi, 1);
  domain.check();
  broken = true;
  expect_error(pnpbs::ErrorKind::argument, {"curve 0: the callback returned (", "nan"},
               [&] { pnpbs::discretize_boundary(domain, constant(0.1)); });
}
END_TEST

START_TEST(every_time_the_same) {
  PlaneDomain domain = lake("great_lakes_islands");
  const auto d = spacing([](double x, double y) { return 0.3 + 0.006 * std::hypot(x, y); });
  const Boundary first = lay(domain, d), second = lay(domain, d);
  ck_assert_uint_eq(first.nodes.size(), second.nodes.size());
  for (std::size_t i = 0; i < first.nodes.size(); ++i) {
    ck_assert(first.nodes[i].position == second.nodes[i].position);
  }
}
END_TEST

TEST_SUITE(test_boundary) {
  return run_suite("boundary", {uniform_square,
                                equal_steps_of_the_integral,
                                number_of_steps_is_rounded,
                                nodes_lie_on_the_true_curve,
                                steps_on_an_unevenly_parametrised_curve,
                                spacing_is_asked_on_the_curves_only_and_in_batches,
                                closed_curves_have_three_edges,
                                nodes_beside_another_curve_are_named,
                                two_arcs_do_not_collapse,
                                chords_that_would_cut_are_halved,
                                islands_stay_inside,
                                fixed_nodes_stay_inside,
                                curves_keep_their_order_about_a_corner,
                                lakes_at_any_spacing,
                                smooth_lakes_at_any_spacing,
                                short_edges_are_told,
                                close_fixed_nodes_are_told,
                                bad_spacing,
                                callbacks_that_change_their_mind,
                                every_time_the_same});
}
