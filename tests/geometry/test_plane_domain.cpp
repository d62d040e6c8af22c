// SPDX-License-Identifier: BSD-3-Clause
// Domains: the enclosed region, the division of curves at corners, and each of the checks.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "domain/from_files.hpp"
#include "domain/plane/plane_domain.hpp"
#include "expect_error.hpp"
#include "run_suite.hpp"
#include "shapes.hpp"

using pnpbs::BoundaryCurve;
using pnpbs::PlaneDomain;
using shapes::add_chain;
using shapes::add_circle;
using shapes::add_loop;
using shapes::circle;
using shapes::Graph;
using shapes::pi;
using shapes::rectangle;

namespace {

void expect_domain_error(PlaneDomain& domain, std::initializer_list<const char*> parts) {
  expect_error(pnpbs::ErrorKind::domain, parts, [&domain] { domain.check(); });
}

void expect_argument_error(std::initializer_list<const char*> parts,
                           const std::function<void()>& action) {
  expect_error(pnpbs::ErrorKind::argument, parts, action);
}

void expect_area(PlaneDomain& domain, double area) {
  domain.check();
  ck_assert_double_eq_tol(domain.area(), area, 1e-9 * area);
}

bool warns(const PlaneDomain& domain, const std::string& part) {
  return std::any_of(domain.warnings().begin(), domain.warnings().end(),
                     [&part](const pnpbs::Warning& warning) {
                       return warning.message.text().find(part) != std::string::npos;
                     });
}

int inner_curves(const PlaneDomain& domain) {
  return static_cast<int>(
      std::count_if(domain.curves().begin(), domain.curves().end(),
                    [](const BoundaryCurve& c) { return c.left_inside && c.right_inside; }));
}

int curves(const PlaneDomain& domain) { return static_cast<int>(domain.curves().size()); }
int corners(const PlaneDomain& domain) { return static_cast<int>(domain.corners().size()); }

const BoundaryCurve& curve_named(const PlaneDomain& domain, const std::string& name) {
  for (const BoundaryCurve& curve : domain.curves()) {
    if (curve.name == name) return curve;
  }
  ck_abort_msg("no curve is named %s", name.c_str());
  return domain.curves()[0];
}

Graph square_graph(double size = 1) {
  Graph graph;
  graph.loop(rectangle(0, 0, size, size));
  return graph;
}

pnpbs::CurveFunction ellipse(double a, double b) {
  return [a, b](std::int64_t n, const double* t, pnpbs::Point<2>* xy) {
    for (std::int64_t i = 0; i < n; ++i) xy[i] = {a * std::cos(t[i]), b * std::sin(t[i])};
  };
}

const double nan_value = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

}  // namespace

// ---------------------------------------------------------------- inside and outside

START_TEST(square) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 2, 1));
  expect_area(domain, 2);
  ck_assert_int_eq(corners(domain), 4);
  ck_assert_int_eq(curves(domain), 4);
  ck_assert(domain.warnings().empty());
  for (const BoundaryCurve& curve : domain.curves()) {
    ck_assert(curve.left_inside && !curve.right_inside);
    ck_assert_int_eq(curve.tag, 1);
  }
  ck_assert_str_eq(domain.curves()[2].name.c_str(), "curve 0, segment 2");
  ck_assert_str_eq(domain.corners()[3].name.c_str(), "curve 0, vertex 3");
  ck_assert_double_eq(domain.bounds().low[0], 0);
  ck_assert_double_eq(domain.bounds().high[0], 2);
  ck_assert_double_eq(domain.bounds().high[1], 1);
}
END_TEST

START_TEST(clockwise_square) {
  PlaneDomain domain;
  const double xy[] = {0, 0, 0, 1, 1, 1, 1, 0};
  domain.add_polyline(pnpbs::CurveRole::boundary, true, 4, xy, nullptr, 0);
  expect_area(domain, 1);
  for (const BoundaryCurve& curve : domain.curves()) {
    ck_assert(!curve.left_inside && curve.right_inside);
  }
}
END_TEST

START_TEST(islands_nest_to_any_depth) {
  for (const bool reversed : {false, true}) {
    PlaneDomain domain;
    double area = 0;
    for (int k = 0; k < 5; ++k) {
      const int depth = reversed ? 4 - k : k;
      const double half = 10 - 2 * depth;
      add_loop(domain, rectangle(-half, -half, half, half));
      area += (depth % 2 == 0 ? 4 : -4) * half * half;
    }
    expect_area(domain, area);
    ck_assert_int_eq(inner_curves(domain), 0);
    for (const BoundaryCurve& curve : domain.curves()) {
      const double half = std::max(std::fabs(curve.points[0][0]), std::fabs(curve.points[0][1]));
      const bool outwards = static_cast<int>(10 - half) / 2 % 2 == 0;
      ck_assert_int_eq(curve.left_inside, outwards);
      ck_assert_int_eq(curve.right_inside, !outwards);
    }
  }
}
END_TEST

START_TEST(disjoint_pieces) {
  PlaneDomain domain;
  for (int k = 0; k < 10; ++k) add_loop(domain, rectangle(3 * k, k % 3, 3 * k + 2, k % 3 + 1));
  expect_area(domain, 20);
  std::vector<std::int32_t> faces;
  for (const BoundaryCurve& curve : domain.curves()) faces.push_back(curve.left_face);
  std::sort(faces.begin(), faces.end());
  ck_assert_int_eq(std::unique(faces.begin(), faces.end()) - faces.begin(), 10);
}
END_TEST

START_TEST(many_islands) {
  PlaneDomain domain;
  add_loop(domain, rectangle(-1, -1, 100, 100));
  for (int x = 0; x < 50; ++x) {
    for (int y = 0; y < 50; ++y) add_loop(domain, circle(2 * x + 0.5, 2 * y + 0.5, 0.5, 4));
  }
  expect_area(domain, 101. * 101 - 2500 * 0.5);
}
END_TEST

START_TEST(pinched_loop) {
  // A figure of eight that passes one vertex twice.
  PlaneDomain domain;
  const double xy[] = {0, 0, 1, 1, 2, 2, 2, 0, 1, 1, 0, 2};
  domain.add_polyline(pnpbs::CurveRole::boundary, true, 6, xy, nullptr, 0);
  expect_area(domain, 2);
  ck_assert_int_eq(corners(domain), 5);
}
END_TEST

START_TEST(hole_point_takes_out_a_region) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 4, 4));
  add_loop(domain, rectangle(1, 1, 2, 2), 0, pnpbs::CurveRole::inner);
  expect_area(domain, 16);
  ck_assert_int_eq(inner_curves(domain), 4);
  domain.add_hole({1.5, 1.5});
  expect_area(domain, 15);
  ck_assert_int_eq(inner_curves(domain), 0);
  domain.add_hole({1.25, 1.5});
  expect_area(domain, 15);
  ck_assert(warns(domain, "hole 1 at (1.25, 1.5) lies in the same region as hole 0"));
}
END_TEST

START_TEST(graph_rule) {
  Graph graph = square_graph(10);
  graph.loop(rectangle(1, 1, 3, 3), 2);  // a hole
  graph.loop(rectangle(5, 5, 9, 9), 3);  // no hole point: an inner curve
  graph.loop(rectangle(6, 6, 7, 7), 4);  // a hole in it
  const std::int64_t a = graph.vertex(4, 1), b = graph.vertex(4, 3);
  graph.segment(a, b, 5);  // dangling
  graph.hole(2, 2);
  graph.hole(6.5, 6.5);
  PlaneDomain domain;
  graph.add_to(domain);
  expect_area(domain, 100 - 4 - 1);
  ck_assert_int_eq(inner_curves(domain), 5);
  for (const BoundaryCurve& curve : domain.curves()) {
    const bool inner = curve.tag == 3 || curve.tag == 5;
    ck_assert_int_eq(curve.left_inside && curve.right_inside, inner);
  }
  ck_assert_str_eq(domain.curves()[4].name.c_str(), "segment 4");
}
END_TEST

START_TEST(hole_in_an_island) {
  Graph graph = square_graph(10);
  graph.loop(rectangle(1, 1, 9, 9));
  graph.loop(rectangle(3, 3, 7, 7));
  graph.hole(2, 2);  // between the two
  PlaneDomain domain;
  graph.add_to(domain);
  expect_area(domain, 100 - 64 + 16);
  ck_assert_int_eq(inner_curves(domain), 0);
}
END_TEST

START_TEST(graph_rule_holds_for_all_curves) {
  PlaneDomain domain;
  add_loop(domain, rectangle(2, 2, 4, 4));  // would be a hole by the even-odd rule
  square_graph(10).add_to(domain);
  expect_area(domain, 100);
  ck_assert_int_eq(inner_curves(domain), 4);
}
END_TEST

START_TEST(joined_regions_of_a_graph) {
  Graph graph;
  for (int k = 0; k < 3; ++k) {
    graph.vertex(k, 0);
    graph.vertex(k, 1);
  }
  graph.segment(0, 2);
  graph.segment(2, 4);
  graph.segment(4, 5);
  graph.segment(5, 3);
  graph.segment(3, 1);
  graph.segment(1, 0);
  graph.segment(2, 3, 7);
  PlaneDomain domain;
  graph.add_to(domain);
  expect_area(domain, 2);
  ck_assert_int_eq(inner_curves(domain), 1);
  const BoundaryCurve& inner = curve_named(domain, "segment 6");
  ck_assert_int_ne(inner.left_face, inner.right_face);
  ck_assert_int_eq(inner.tag, 7);
}
END_TEST

START_TEST(shorelines) {
  const struct {
    const char* file;
    double area;
    int corners;
  } lakes[] = {{"great_lakes", 207249.83485739975, 201},
               {"great_lakes_islands", 199371.08780924045, 1598},
               {"lake_victoria", 69331.85348015526, 138}};
  for (const auto& lake : lakes) {
    PlaneDomain domain;
    pnpbs::add_poly(domain, pnpbs::read_poly(std::string(PNPBS_SOURCE_DIR "/examples/data/") +
                                             lake.file + ".poly"));
    expect_area(domain, lake.area);
    ck_assert_int_eq(corners(domain), lake.corners);
    ck_assert_int_eq(curves(domain), lake.corners);
    ck_assert_int_eq(inner_curves(domain), 0);
    ck_assert(domain.warnings().empty());
  }
}
END_TEST

// ---------------------------------------------------------------- corners and curves

START_TEST(corner_angle) {
  // A rounded square: four corners of 90 degrees between dense sides that bulge slightly.
  shapes::Loop loop;
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < 20; ++i) {
      const double along = i / 20.0, out = -0.1 * std::sin(pi * along);
      const double x = side == 0 ? along : side == 1 ? 1 - out : side == 2 ? 1 - along : out;
      const double y = side == 0 ? out : side == 1 ? along : side == 2 ? 1 - out : 1 - along;
      loop.xy.insert(loop.xy.end(), {x, y});
    }
  }
  PlaneDomain domain;
  add_loop(domain, loop, 30);
  domain.check();
  ck_assert_int_eq(corners(domain), 4);
  ck_assert_int_eq(curves(domain), 4);
  ck_assert_str_eq(domain.curves()[1].name.c_str(), "curve 0, segments 20 to 39");
  ck_assert_uint_eq(domain.curves()[1].points.size(), 21);
  PlaneDomain all;
  add_loop(all, loop, 0);
  all.check();
  ck_assert_int_eq(corners(all), 80);
}
END_TEST

START_TEST(closed_polyline_without_corners) {
  PlaneDomain domain;
  add_loop(domain, circle(0, 0, 1, 100), 30);
  domain.check();
  ck_assert_int_eq(corners(domain), 1);
  ck_assert_int_eq(curves(domain), 1);
  const BoundaryCurve& curve = domain.curves()[0];
  ck_assert_int_eq(curve.corner_begin, curve.corner_end);
  ck_assert_uint_eq(curve.points.size(), 101);
  ck_assert(curve.points.front() == curve.points.back());
}
END_TEST

START_TEST(corner_not_at_the_first_vertex) {
  // A drop: round except for its tip, which is vertex 30.
  shapes::Loop loop;
  for (int i = 0; i < 100; ++i) {
    const double angle = 2 * pi * (i - 30) / 100;
    const double radius = std::fabs(angle) < 1 ? 1 + (1 - std::fabs(angle)) : 1;
    loop.xy.insert(loop.xy.end(), {radius * std::cos(angle), radius * std::sin(angle)});
  }
  PlaneDomain domain;
  add_loop(domain, loop, 45);
  domain.check();
  ck_assert_int_eq(corners(domain), 1);
  ck_assert_str_eq(domain.corners()[0].name.c_str(), "curve 0, vertex 30");
  ck_assert_int_eq(curves(domain), 1);
  ck_assert_uint_eq(domain.curves()[0].points.size(), 101);
}
END_TEST

START_TEST(corner_where_tags_change) {
  PlaneDomain domain;
  const shapes::Loop loop = circle(0, 0, 1, 60);
  std::vector<std::int32_t> tags(60, 4);
  std::fill(tags.begin() + 20, tags.begin() + 30, 5);
  domain.add_polyline(pnpbs::CurveRole::boundary, true, 60, loop.xy.data(), tags.data(), 30);
  domain.check();
  ck_assert_int_eq(corners(domain), 2);
  ck_assert_int_eq(curves(domain), 2);
  ck_assert_int_eq(domain.curves()[0].tag + domain.curves()[1].tag, 9);
}
END_TEST

START_TEST(vertex_tags) {
  Graph graph = square_graph();
  graph.vertex_tags[1] = 9;
  graph.segment_tags = {2, 3, 4, 5};
  PlaneDomain domain;
  graph.add_to(domain);
  domain.check();
  ck_assert_int_eq(domain.corners()[0].tag, 2);
  ck_assert_int_eq(domain.corners()[1].tag, 9);
  ck_assert_int_eq(domain.corners()[2].tag, 3);
  ck_assert_int_eq(domain.curves()[3].tag, 5);
}
END_TEST

START_TEST(t_junctions) {
  // Vertex 4 lies on segment 0; a segment leads from it into the square.
  Graph graph = square_graph(3);
  const std::int64_t on = graph.vertex(1, 0), inside = graph.vertex(1, 1);
  graph.segment(on, inside, 8);
  PlaneDomain domain;
  graph.add_to(domain);
  expect_area(domain, 9);
  ck_assert_int_eq(curves(domain), 6);
  ck_assert_int_eq(corners(domain), 6);
  ck_assert_int_eq(inner_curves(domain), 1);
  ck_assert_str_eq(domain.curves()[0].name.c_str(), "segment 0");
  ck_assert_str_eq(domain.curves()[1].name.c_str(), "segment 0");
  ck_assert_int_eq(domain.curves()[0].corner_end, domain.curves()[1].corner_begin);
}
END_TEST

START_TEST(t_junction_within_tolerance) {
  // The vertex is at one third of a slope, which no double represents exactly.
  Graph graph;
  graph.loop({{0, 0, 3, 1, 0, 4}});
  const std::int64_t on = graph.vertex(1 + 1e-13, 1 / 3.0), inside = graph.vertex(0.5, 1);
  graph.segment(on, inside);
  PlaneDomain domain;
  graph.add_to(domain);
  expect_area(domain, 6);
  ck_assert_int_eq(curves(domain), 5);
}
END_TEST

START_TEST(curve_ends_join_within_tolerance) {
  PlaneDomain domain;
  add_chain(domain, {0, 0, 1, 0, 1, 1}, pnpbs::CurveRole::boundary);
  add_chain(domain, {1 + 5e-10, 1, 0, 1, 0, 4e-10}, pnpbs::CurveRole::boundary);
  domain.check();
  ck_assert_double_eq_tol(domain.area(), 1, 1e-8);
  ck_assert_int_eq(corners(domain), 4);
}
END_TEST

namespace {

// Checks a domain in which `count` points are moved, and returns its only warning.
const pnpbs::Warning& warning_of_moved(PlaneDomain& domain, int count, double tolerance) {
  domain.check();
  ck_assert_uint_eq(domain.warnings().size(), 1);
  const pnpbs::Warning& warning = domain.warnings()[0];
  ck_assert(warning.code == pnpbs::WarningCode::vertices_merged);
  ck_assert_int_eq(warning.count, count);
  ck_assert_double_eq_tol(warning.value, tolerance, 1e-6 * tolerance);
  return warning;
}

bool has_corner_at(const PlaneDomain& domain, const pnpbs::Point<2>& x) {
  return std::ranges::any_of(domain.corners(),
                             [&](const pnpbs::Corner& corner) { return corner.position == x; });
}

}  // namespace

START_TEST(loose_ends_are_moved_onto_curves) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 1, 1));
  add_chain(domain, {3e-8, 0.5, 0.5, 0.5, 1 + 4e-8, 0.75});  // from side to side
  add_chain(domain, {0.25, 0.5 + 2e-8, 0.25, 1 - 5e-9});     // from that curve to a side
  add_chain(domain, {0.5, 0.5 - 1e-8, 0.75, 0.25});          // from its vertex to the inside
  const pnpbs::Warning& warning = warning_of_moved(domain, 5, 1e-7);
  ck_assert(warning.point()->x[0] == 3e-8);
  expect_area(domain, 1);
  for (const pnpbs::Point<2>& x : {pnpbs::Point<2>{0, 0.5}, {1, 0.75}, {0.25, 1}, {0.5, 0.5}})
    ck_assert(has_corner_at(domain, x));
  ck_assert_int_eq(corners(domain), 4 + 3 + 2 + 1);
  ck_assert_int_eq(inner_curves(domain), 3 + 1 + 1);
  domain.check();
  add_chain(domain, {0.75, 0.25, 0.75, 0.125});  // the warning remains after another check
  warning_of_moved(domain, 5, 1e-7);
}
END_TEST

START_TEST(loose_ends_are_moved_onto_smooth_curves) {
  PlaneDomain domain;
  add_circle(domain, 0, 0, 2);
  add_chain(domain, {0, 0, 2 * std::cos(1) - 1e-8, 2 * std::sin(1)});
  domain.add_arc(pnpbs::CurveRole::inner, {0, 0}, 1, 1.5 + 1e-8, 3, 1);
  add_chain(domain, {std::cos(1.5), std::sin(1.5), 0.5, 1.5});
  warning_of_moved(domain, 2, 4e-7);
  ck_assert_int_eq(corners(domain), 1 + 2 + 2 + 1);
}
END_TEST

START_TEST(fixed_nodes_are_moved_onto_curves) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 10, 10));
  const double xy[] = {2e-11, 0, 5, 5e-7, 10 + 1e-8, 10 - 1e-8, 5, 5};
  const std::int32_t tags[] = {2, 3, 4, 5};
  domain.add_fixed_nodes(4, xy, tags);
  warning_of_moved(domain, 3, 1e-6);
  ck_assert_int_eq(corners(domain), 5);
  ck_assert(has_corner_at(domain, {0, 0}));
  ck_assert(has_corner_at(domain, {5, 0}));
  ck_assert(has_corner_at(domain, {10, 10}));
  ck_assert_int_eq(domain.corners()[0].tag, 2);
  ck_assert_uint_eq(domain.fixed_nodes().size(), 1);
}
END_TEST

START_TEST(dangling_vertices_are_moved_onto_vertices_and_segments) {
  Graph graph = square_graph();
  const std::int64_t inside = graph.vertex(0.5, 0.5), beside_vertex = graph.vertex(1 - 1e-8, 1);
  graph.segment(inside, beside_vertex);
  graph.segment(inside, graph.vertex(1e-8, 0.25));
  graph.vertex(0.5 + 1e-8, 0.5);  // in no segment
  PlaneDomain domain;
  graph.add_to(domain);
  warning_of_moved(domain, 3, 1e-7);
  ck_assert_int_eq(corners(domain), 4 + 2);
  ck_assert_uint_eq(domain.fixed_nodes().size(), 0);
  expect_area(domain, 1);
}
END_TEST

START_TEST(points_that_are_apart_stay) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 1, 1));
  add_chain(domain, {2e-7, 0.5, 0.5, 0.5});
  add_chain(domain, {0.5, 0.25, 0.5 + 1e-8, 0.25});  // as short as the distance itself
  const double xy[] = {0.75, 2e-7};
  domain.add_fixed_nodes(1, xy, nullptr);
  domain.check();
  ck_assert(domain.warnings().empty());
  ck_assert_int_eq(corners(domain), 8);
}
END_TEST

// ---------------------------------------------------------------- arcs and general curves

START_TEST(full_circle) {
  PlaneDomain domain;
  add_circle(domain, 3, 4, 2, 6);
  domain.check();
  ck_assert_double_eq_tol(domain.area(), 4 * pi, 1e-7);
  ck_assert_int_eq(corners(domain), 1);
  ck_assert_int_eq(curves(domain), 1);
  const BoundaryCurve& curve = domain.curves()[0];
  ck_assert(curve.left_inside && !curve.right_inside);
  ck_assert_uint_ge(curve.points.size(), 65);
  ck_assert_uint_eq(curve.points.size(), curve.parameters.size());
  ck_assert_str_eq(curve.name.c_str(), "curve 0");
  ck_assert_int_eq(domain.corners()[0].tag, 6);
  ck_assert(domain.bounds().low[0] <= 1 && domain.bounds().low[0] > 0.999);
  ck_assert(domain.bounds().high[1] >= 6 && domain.bounds().high[1] < 6.001);
}
END_TEST

START_TEST(ring_of_clockwise_and_counter_clockwise_arcs) {
  PlaneDomain domain;
  add_circle(domain, 0, 0, 2);
  domain.add_arc(pnpbs::CurveRole::boundary, {0, 0}, 1, 2 * pi, 0, 2);
  domain.check();
  ck_assert_double_eq_tol(domain.area(), 3 * pi, 1e-6);
  ck_assert(domain.curves()[1].left_inside && !domain.curves()[1].right_inside);
}
END_TEST

START_TEST(narrow_ring_is_refined) {
  // The ring is narrower than the distance of the first samples' chords from the circle.
  PlaneDomain domain;
  add_circle(domain, 0, 0, 1);
  domain.add_arc(pnpbs::CurveRole::boundary, {0, 0}, 1 - 1e-5, 0.01, 0.01 + 2 * pi, 2);
  domain.check();
  ck_assert_double_eq_tol(domain.area(), pi * (2e-5 - 1e-10), 1e-7);
}
END_TEST

START_TEST(slot_of_arcs_and_segments) {
  PlaneDomain domain;
  domain.add_arc(pnpbs::CurveRole::boundary, {0, 0}, 1, pi / 2, 3 * pi / 2, 1);
  add_chain(domain, {0, -1, 5, -1}, pnpbs::CurveRole::boundary);
  domain.add_arc(pnpbs::CurveRole::boundary, {5, 0}, 1, -pi / 2, pi / 2, 1);
  add_chain(domain, {5, 1, 0, 1}, pnpbs::CurveRole::boundary);
  domain.check();
  ck_assert_double_eq_tol(domain.area(), 10 + pi, 1e-7);
  ck_assert_int_eq(corners(domain), 4);
  ck_assert_int_eq(curves(domain), 4);
}
END_TEST

START_TEST(closed_callback) {
  PlaneDomain domain;
  domain.add_curve(pnpbs::CurveRole::boundary, ellipse(3, 1), 0, 2 * pi, 2);
  domain.check();
  ck_assert_double_eq_tol(domain.area(), 3 * pi, 1e-6);
  ck_assert_int_eq(corners(domain), 1);
  ck_assert_int_eq(curves(domain), 1);
}
END_TEST

START_TEST(callback_is_sampled_where_it_turns) {
  PlaneDomain domain;
  domain.add_curve(pnpbs::CurveRole::boundary, ellipse(100, 1), 0, 2 * pi, 2);
  domain.check();
  ck_assert_double_eq_tol(domain.area(), 100 * pi, 1e-4);
  const auto& points = domain.curves()[0].points;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double ux = points[i][0] - points[i - 1][0], uy = points[i][1] - points[i - 1][1];
    const double vx = points[i + 1][0] - points[i][0], vy = points[i + 1][1] - points[i][1];
    ck_assert_double_lt(std::fabs(std::atan2(ux * vy - uy * vx, ux * vx + uy * vy)), 0.05);
  }
}
END_TEST

START_TEST(uneven_parameter) {
  // x = t^3 moves slowly about 0: samples follow the curve, not the parameter.
  PlaneDomain domain;
  domain.add_curve(
      pnpbs::CurveRole::boundary,
      [](std::int64_t n, const double* t, pnpbs::Point<2>* xy) {
        for (std::int64_t i = 0; i < n; ++i) {
          const double x = t[i] * t[i] * t[i];
          xy[i] = {x, x * x};
        }
      },
      -1, 1, 2);
  add_chain(domain, {1, 1, -1, 1}, pnpbs::CurveRole::boundary);
  domain.check();
  ck_assert_double_eq_tol(domain.area(), 4 / 3.0, 1e-6);
}
END_TEST

START_TEST(segment_ends_on_a_circle) {
  // The ends of the inner segment lie on the exact circle, not on the chords of its samples.
  PlaneDomain domain;
  add_circle(domain, 0, 0, 1);
  add_chain(domain, {std::cos(1.0), std::sin(1.0), std::cos(4.0), std::sin(4.0)});
  domain.check();
  ck_assert_double_eq_tol(domain.area(), pi, 1e-6);
  ck_assert_int_eq(inner_curves(domain), 1);
  ck_assert_int_eq(curves(domain), 4);
  ck_assert_int_eq(corners(domain), 3);
  for (const BoundaryCurve& curve : domain.curves()) {
    for (std::size_t i = 0; curve.evaluate && i < curve.points.size(); ++i) {
      pnpbs::Point<2> there;
      curve.evaluate(1, &curve.parameters[i], &there);
      ck_assert_double_lt(pnpbs::distance<2>(there, curve.points[i]), 1e-9);
    }
  }
}
END_TEST

START_TEST(fixed_node_on_a_circle) {
  PlaneDomain domain;
  add_circle(domain, 0, 0, 1);
  const double xy[] = {std::cos(2.0), std::sin(2.0)};
  const std::int32_t tag = 77;
  domain.add_fixed_nodes(1, xy, &tag);
  domain.check();
  ck_assert_int_eq(corners(domain), 2);
  ck_assert(domain.fixed_nodes().empty());
  ck_assert_int_eq(domain.corners()[1].tag, 77);
  ck_assert_double_eq(domain.corners()[1].position[0], xy[0]);
  ck_assert_double_eq(domain.corners()[1].position[1], xy[1]);
}
END_TEST

// ---------------------------------------------------------------- fixed nodes

START_TEST(fixed_nodes) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 4, 4));
  const double xy[] = {1, 1, 4, 4, 2, 0, 3, 1};
  const std::int32_t tags[] = {11, 12, 13, 14};
  domain.add_fixed_nodes(4, xy, tags);
  domain.check();
  ck_assert_uint_eq(domain.fixed_nodes().size(), 2);
  ck_assert_int_eq(domain.fixed_nodes()[0].tag, 11);
  ck_assert_int_eq(domain.fixed_nodes()[1].tag, 14);
  ck_assert_int_eq(domain.fixed_node_faces()[0], domain.curves()[0].left_face);
  ck_assert_int_eq(corners(domain), 5);  // an additional one on the lower side
  ck_assert_int_eq(curves(domain), 5);
  ck_assert_int_eq(domain.corners()[2].tag, 12);
  ck_assert_int_eq(domain.corners()[4].tag, 13);
}
END_TEST

START_TEST(fixed_node_outside) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 4, 4));
  add_loop(domain, rectangle(1, 1, 2, 2));
  const double xy[] = {3, 3, 1.5, 1.25};
  domain.add_fixed_nodes(2, xy, nullptr);
  expect_domain_error(domain, {"fixed node 1 at (1.5, 1.25) lies outside the domain"});
}
END_TEST

START_TEST(fixed_nodes_twice) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 4, 4));
  const double xy[] = {3, 3, 2, 2, 3, 3};
  domain.add_fixed_nodes(3, xy, nullptr);
  expect_domain_error(domain, {"fixed node 0 and fixed node 2 are both at (3, 3)"});
}
END_TEST

START_TEST(lone_vertices_of_a_graph) {
  Graph graph = square_graph();
  graph.vertex(0.5, 0.5, 3);
  graph.vertex(5, 5);
  graph.vertex(0.5, 1);
  PlaneDomain domain;
  graph.add_to(domain);
  domain.check();
  ck_assert_uint_eq(domain.fixed_nodes().size(), 1);
  ck_assert_int_eq(domain.fixed_nodes()[0].tag, 3);
  ck_assert_int_eq(corners(domain), 5);
  ck_assert(warns(domain, "taken as fixed nodes: vertex 4"));
  ck_assert(warns(domain, "outside the domain and left out: vertex 5"));
}
END_TEST

// ---------------------------------------------------------------- invalid input

START_TEST(self_intersection) {
  PlaneDomain domain;
  const double xy[] = {0, 0, 2, 2, 2, 0, 0, 2};
  domain.add_polyline(pnpbs::CurveRole::boundary, true, 4, xy, nullptr, 0);
  expect_domain_error(domain, {"curve 0, segment 0", "curve 0, segment 2", "cross at (1, 1)"});
}
END_TEST

START_TEST(crossing_curves) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 2, 2));
  add_loop(domain, rectangle(1, 1, 3, 3));
  expect_domain_error(domain, {"curve 0, segment", "curve 1, segment", "cross at ("});
  PlaneDomain circles;
  add_circle(circles, 0, 0, 1);
  add_circle(circles, 1, 0, 1);
  expect_domain_error(circles, {"curve 0 and curve 1 ", "(0.5"});
  PlaneDomain by_chance;  // the samples of both coincide
  const auto zigzag = [](double sign) {
    return [sign](std::int64_t n, const double* t, pnpbs::Point<2>* xy) {
      for (std::int64_t i = 0; i < n; ++i) xy[i] = {t[i], sign * t[i]};
    };
  };
  by_chance.add_curve(pnpbs::CurveRole::boundary, zigzag(1), -1, 1, 1);
  by_chance.add_curve(pnpbs::CurveRole::boundary, zigzag(-1), -1, 1, 1);
  add_chain(by_chance, {-1, -1, -1, 1}, pnpbs::CurveRole::boundary);
  add_chain(by_chance, {1, -1, 1, 1}, pnpbs::CurveRole::boundary);
  expect_domain_error(by_chance, {"curve 0", "curve 1", "(0, 0)"});
}
END_TEST

START_TEST(crossing_in_a_graph_numbered_from_one) {
  Graph graph = square_graph(4);
  const std::int64_t a = graph.vertex(1, 1), b = graph.vertex(3, 3);
  const std::int64_t c = graph.vertex(1, 3), d = graph.vertex(3, 1);
  graph.segment(a, b);
  graph.segment(c, d);
  graph.first_number = 1;
  PlaneDomain domain;
  graph.add_to(domain);
  expect_domain_error(domain, {"segment 5 and segment 6 cross at (2, 2)"});
}
END_TEST

// A comb of 25 teeth across a segment.
START_TEST(up_to_twenty_crossings_are_listed) {
  Graph graph = square_graph(60);
  const std::int64_t west = graph.vertex(1, 30), east = graph.vertex(59, 30);
  graph.segment(west, east);
  for (int tooth = 0; tooth < 25; ++tooth) {
    const double x = 2 + 2 * tooth;
    const std::int64_t low = graph.vertex(x, 29), high = graph.vertex(x, 31);
    graph.segment(low, high);
  }
  PlaneDomain domain;
  graph.add_to(domain);
  expect_domain_error(domain, {" cross at (2, 30)", " cross at (40, 30)", "; and more"});
}
END_TEST

START_TEST(overlapping_segments) {
  Graph graph = square_graph(4);
  const std::int64_t a = graph.vertex(1, 0), b = graph.vertex(3, 0);
  graph.segment(a, b);
  PlaneDomain domain;
  graph.add_to(domain);
  expect_domain_error(domain, {"segment 0 and segment 4 overlap at (1, 0)"});
  Graph twice = square_graph();
  twice.segment(2, 1);
  PlaneDomain repeated;
  twice.add_to(repeated);
  expect_domain_error(repeated, {"segment 1 and segment 4 overlap"});
  // A spike that returns along itself.
  PlaneDomain spike;
  const double xy[] = {0, 0, 4, 0, 4, 4, 2, 4, 2, 6, 2, 5, 0, 4};
  spike.add_polyline(pnpbs::CurveRole::boundary, true, 7, xy, nullptr, 0);
  expect_domain_error(spike, {"curve 0, segment 3 and curve 0, segment 4 overlap"});
}
END_TEST

START_TEST(duplicate_vertices) {
  Graph graph = square_graph();
  const std::int64_t again = graph.vertex(1, 1), inside = graph.vertex(0.5, 0.5);
  graph.segment(again, inside);
  graph.first_number = 1;
  PlaneDomain domain;
  graph.add_to(domain);
  expect_domain_error(domain, {"vertex 3 and vertex 5 are both at (1, 1)"});
  Graph close = square_graph();
  const std::int64_t beside = close.vertex(1 + 5e-13, 1);
  close.segment(beside, close.vertex(0.5, 0.5));
  PlaneDomain near;
  close.add_to(near);
  expect_domain_error(near, {"vertex 2 and vertex 4 are too close"});
}
END_TEST

START_TEST(unclosed_boundary) {
  PlaneDomain domain;
  add_chain(domain, {0, 0, 1, 0, 1, 1, 0, 1}, pnpbs::CurveRole::boundary);
  expect_domain_error(domain, {"the boundary is not closed: it ends at curve 0, vertex 0 (0, 0)"});
  add_chain(domain, {0, 1, 0, 0.01}, pnpbs::CurveRole::boundary);
  expect_domain_error(domain, {"not closed"});
  add_chain(domain, {0, 0.01, 0, 0},
            pnpbs::CurveRole::boundary);  // the domain can be completed after a failed check
  expect_area(domain, 1);
  PlaneDomain inner;
  add_loop(inner, rectangle(0, 0, 1, 1), 0, pnpbs::CurveRole::inner);
  expect_domain_error(inner, {"no boundary curve"});
  PlaneDomain arc;
  arc.add_arc(pnpbs::CurveRole::boundary, {0, 0}, 1, 0, 3, 1);
  expect_domain_error(arc, {"not closed", "curve 0, begin (1, 0)"});
}
END_TEST

START_TEST(unclosed_graph) {
  Graph graph;
  graph.vertex(0, 0);
  graph.segment(0, graph.vertex(1, 0));
  graph.segment(1, graph.vertex(1, 1));
  PlaneDomain domain;
  graph.add_to(domain);
  expect_domain_error(domain, {"enclose nothing: they end at vertex 0 (0, 0)"});
}
END_TEST

START_TEST(empty_domain) {
  PlaneDomain domain;
  expect_domain_error(domain, {"no curves"});
  PlaneDomain graph;
  graph.add_pslg(0, nullptr, nullptr, 0, nullptr, nullptr, 0, nullptr);
  expect_domain_error(graph, {"no curves"});
  PlaneDomain tiny;
  add_loop(tiny, rectangle(0, 0, 1e-160, 1e-160));
  expect_domain_error(tiny, {"size is 1e-160"});
}
END_TEST

START_TEST(holes_outside) {
  Graph graph = square_graph();
  graph.hole(0.5, 2);
  graph.first_number = 1;
  PlaneDomain domain;
  graph.add_to(domain);
  expect_domain_error(domain, {"hole 1 at (0.5, 2) lies outside the domain"});
  PlaneDomain ring;
  add_circle(ring, 0, 0, 2);
  add_circle(ring, 0, 0, 1);
  ring.add_hole({0.5, 0});
  expect_domain_error(ring, {"hole 0 at (0.5, 0) lies outside the domain"});
}
END_TEST

START_TEST(holes_on_curves) {
  const struct {
    double x, y;
    const char* name;
  } cases[] = {{0.5, 0, "segment 0"},
               {1, 0.25, "segment 1"},
               {0, 0.5, "segment 3"},
               {0, 0, ""},
               {1, 1, ""},
               {0, 1, ""},
               {1, 0, ""}};
  for (const auto& at : cases) {
    Graph graph = square_graph();
    graph.hole(at.x, at.y);
    PlaneDomain domain;
    graph.add_to(domain);
    expect_domain_error(domain, {"hole 0 at (", " lies on ", at.name});
  }
}
END_TEST

START_TEST(holes_that_leave_nothing) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 1, 1));
  domain.add_hole({0.5, 0.5});
  expect_domain_error(domain, {"leave nothing"});
}
END_TEST

START_TEST(segments_outside_are_left_out) {
  Graph graph = square_graph(2);
  graph.segment(graph.vertex(3, 3), 2);
  graph.segment(1, graph.vertex(3, 0));
  PlaneDomain domain;
  graph.add_to(domain);
  expect_area(domain, 4);
  ck_assert(warns(domain, "outside the domain and left out: segment 4, segment 5"));
  ck_assert_int_eq(curves(domain), 4);
  ck_assert_int_eq(corners(domain), 4);
}
END_TEST

START_TEST(too_short_segments) {
  PlaneDomain domain;
  add_loop(domain, {{0, 0, 1e6, 0, 1e6, 1, 1e6 - 1e-7, 1, 0, 1}});
  expect_domain_error(domain, {"curve 0, segment 2 is too short at (1e+06, 1)"});
}
END_TEST

START_TEST(a_failed_check_keeps_the_last_result) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 1, 1));
  domain.check();
  const BoundaryCurve* before = domain.curves().data();
  domain.check();  // does nothing
  ck_assert_ptr_eq(domain.curves().data(), before);
  add_loop(domain, rectangle(0.5, 0.5, 2, 2));
  expect_domain_error(domain, {"cross"});
  expect_domain_error(domain, {"cross"});
  ck_assert_int_eq(curves(domain), 4);
}
END_TEST

// ---------------------------------------------------------------- arguments

START_TEST(bad_polylines) {
  PlaneDomain domain;
  const double xy[] = {0, 0, 1, 0, 1, 1, 0, 1};
  const double bad[] = {0, 0, 1, nan_value, 1, 1};
  const double huge[] = {0, 0, 1, 0, 1e151, 1};
  const double endless[] = {0, 0, 1, 0, 1, -infinity};
  const double twice[] = {0, 0, 1, 0, 1, 0, 0, 1};
  const double closing[] = {0, 0, 1, 0, 1, 1, 0, 0};
  const std::int32_t tags[] = {1, 2, 0, 4};
  const auto add = [&](std::int64_t n, const double* points, double angle = 0,
                       pnpbs::CurveRole role = pnpbs::CurveRole::boundary,
                       const std::int32_t* t = nullptr) {
    return [=, &domain] { domain.add_polyline(role, true, n, points, t, angle); };
  };
  expect_argument_error({"coordinates[1][1] is nan"}, add(3, bad));
  expect_argument_error({"coordinates[2][0] is 1e+151"}, add(3, huge));
  expect_argument_error({"coordinates[2][1] is -inf"}, add(3, endless));
  expect_argument_error({"vertices 1 and 2 are both (1, 0)"}, add(4, twice));
  expect_argument_error({"repeated as the last, vertex 3"}, add(4, closing));
  expect_argument_error({"tags[2] is 0"}, add(4, xy, 0, pnpbs::CurveRole::boundary, tags));
  expect_argument_error({"n is 2"}, add(2, xy));
  expect_argument_error({"n is -1"}, add(-1, xy));
  expect_argument_error({"coordinates is NULL"}, add(4, nullptr));
  expect_argument_error({"corner_angle is 181"}, add(4, xy, 181));
  expect_argument_error({"corner_angle is nan"}, add(4, xy, nan_value));
  add(4, xy)();
  expect_area(domain, 1);  // the rejected curves left no trace
  ck_assert_str_eq(domain.curves()[0].name.c_str(), "curve 0, segment 0");
}
END_TEST

START_TEST(bad_arcs) {
  PlaneDomain domain;
  const auto add = [&](double x, double radius, double begin, double end, std::int32_t tag = 1) {
    return [=, &domain] {
      domain.add_arc(pnpbs::CurveRole::boundary, {x, 0}, radius, begin, end, tag);
    };
  };
  expect_argument_error({"centre[0] is nan"}, add(nan_value, 1, 0, 1));
  expect_argument_error({"radius is 0"}, add(0, 0, 0, 1));
  expect_argument_error({"radius is -1"}, add(0, -1, 0, 1));
  expect_argument_error({"radius is inf"}, add(0, infinity, 0, 1));
  expect_argument_error({"begin and end are both 2"}, add(0, 1, 2, 2));
  expect_argument_error({"end is inf"}, add(0, 1, 2, infinity));
  expect_argument_error({"more than a full turn"}, add(0, 1, 0, 6.5));
  expect_argument_error({"tag is 0"}, add(0, 1, 0, 6, 0));
  expect_argument_error({"beyond 1e60"}, add(9e59, 9e59, 0, 6));
}
END_TEST

START_TEST(bad_callbacks) {
  PlaneDomain domain;
  const auto add = [&](pnpbs::CurveFunction curve) {
    return [&domain, curve] { domain.add_curve(pnpbs::CurveRole::boundary, curve, 0, 1, 1); };
  };
  const auto fill = [](auto f) {
    return [f](std::int64_t n, const double* t, pnpbs::Point<2>* xy) {
      for (std::int64_t i = 0; i < n; ++i) xy[i] = f(t[i]);
    };
  };
  using P = pnpbs::Point<2>;
  expect_argument_error({"curve is NULL"}, add(nullptr));
  expect_argument_error({"curve 0: the callback returned (nan, 0) at t = 0.5"},
                        add(fill([](double t) {
                          return P{t == 0.5 ? nan_value : t, 0};
                        })));
  expect_argument_error({"curve 0 is a single point, (1, 2)"}, add(fill([](double) {
                          return P{1, 2};
                        })));
  expect_argument_error({"curve 0 turns too often"}, add(fill([](double t) {
                          return P{t, 0.1 * std::sin(1e7 * t)};
                        })));
  expect_error(pnpbs::ErrorKind::callback, {"told so"}, add([](std::int64_t, const double*, P*) {
                 throw pnpbs::Error(pnpbs::ErrorKind::callback, "told so");
               }));
}
END_TEST

START_TEST(bad_graphs) {
  PlaneDomain domain;
  const double xy[] = {0, 0, 1, 0, 1, 1};
  const std::int64_t beyond[] = {0, 1, 1, 3};
  const std::int64_t negative[] = {0, 1, -1, 2};
  const std::int64_t same[] = {0, 1, 2, 2};
  const std::int64_t good[] = {0, 1, 1, 2, 2, 0};
  const double hole[] = {0, infinity};
  expect_argument_error({"segment_ends[1][1] is 3", "0 to 2"},
                        [&] { domain.add_pslg(3, xy, nullptr, 2, beyond, nullptr, 0, nullptr); });
  expect_argument_error({"segment_ends[1][0] is -1"},
                        [&] { domain.add_pslg(3, xy, nullptr, 2, negative, nullptr, 0, nullptr); });
  expect_argument_error({"segment_ends[1] are both 2"},
                        [&] { domain.add_pslg(3, xy, nullptr, 2, same, nullptr, 0, nullptr); });
  expect_argument_error({"hole_points[0][1] is inf"},
                        [&] { domain.add_pslg(3, xy, nullptr, 3, good, nullptr, 1, hole); });
  expect_argument_error({"segment_ends is NULL"},
                        [&] { domain.add_pslg(3, xy, nullptr, 3, nullptr, nullptr, 0, nullptr); });
  expect_argument_error({"vertices is -3"},
                        [&] { domain.add_pslg(-3, xy, nullptr, 3, good, nullptr, 0, nullptr); });
  expect_argument_error({"point[1] is nan"}, [&] { domain.add_hole({0, nan_value}); });
  expect_argument_error({"coordinates[0][1] is inf"},
                        [&] { domain.add_fixed_nodes(1, hole, nullptr); });
  domain.add_pslg(3, xy, nullptr, 3, good, nullptr, 0, nullptr);
  expect_area(domain, 0.5);
}
END_TEST

START_TEST(large_and_far_domains) {
  for (const double scale : {1e-50, 1e-9, 1e9, 1e50}) {
    PlaneDomain domain;
    add_loop(domain, rectangle(0, 0, scale, scale));
    add_loop(domain, rectangle(0.25 * scale, 0.25 * scale, 0.5 * scale, 0.5 * scale));
    expect_area(domain, scale * scale * 15 / 16);
  }
  PlaneDomain far;
  add_loop(far, rectangle(1e9, 1e9, 1e9 + 1, 1e9 + 1));
  expect_area(far, 1);
}
END_TEST

TEST_SUITE(test_plane_domain) {
  return run_suite("plane_domain", {square,
                                    clockwise_square,
                                    islands_nest_to_any_depth,
                                    disjoint_pieces,
                                    many_islands,
                                    pinched_loop,
                                    hole_point_takes_out_a_region,
                                    graph_rule,
                                    hole_in_an_island,
                                    graph_rule_holds_for_all_curves,
                                    joined_regions_of_a_graph,
                                    shorelines,
                                    corner_angle,
                                    closed_polyline_without_corners,
                                    corner_not_at_the_first_vertex,
                                    corner_where_tags_change,
                                    vertex_tags,
                                    t_junctions,
                                    t_junction_within_tolerance,
                                    curve_ends_join_within_tolerance,
                                    loose_ends_are_moved_onto_curves,
                                    loose_ends_are_moved_onto_smooth_curves,
                                    fixed_nodes_are_moved_onto_curves,
                                    dangling_vertices_are_moved_onto_vertices_and_segments,
                                    points_that_are_apart_stay,
                                    full_circle,
                                    ring_of_clockwise_and_counter_clockwise_arcs,
                                    narrow_ring_is_refined,
                                    slot_of_arcs_and_segments,
                                    closed_callback,
                                    callback_is_sampled_where_it_turns,
                                    uneven_parameter,
                                    segment_ends_on_a_circle,
                                    fixed_node_on_a_circle,
                                    fixed_nodes,
                                    fixed_node_outside,
                                    fixed_nodes_twice,
                                    lone_vertices_of_a_graph,
                                    self_intersection,
                                    crossing_curves,
                                    crossing_in_a_graph_numbered_from_one,
                                    up_to_twenty_crossings_are_listed,
                                    overlapping_segments,
                                    duplicate_vertices,
                                    unclosed_boundary,
                                    unclosed_graph,
                                    empty_domain,
                                    holes_outside,
                                    holes_on_curves,
                                    holes_that_leave_nothing,
                                    segments_outside_are_left_out,
                                    too_short_segments,
                                    a_failed_check_keeps_the_last_result,
                                    bad_polylines,
                                    bad_arcs,
                                    bad_callbacks,
                                    bad_graphs,
                                    large_and_far_domains});
}
