// SPDX-License-Identifier: BSD-3-Clause
// Curves of a plane domain that cross, touch or lie on each other, and the regions between them.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "domain/plane/plane_domain.hpp"
#include "expect_error.hpp"
#include "predicates/plane.hpp"
#include "run_suite.hpp"
#include "shapes.hpp"

using pnpbs::BoundaryCurve;
using pnpbs::CurveRole;
using pnpbs::OverlapRule;
using pnpbs::PlaneDomain;
using shapes::add_chain;
using shapes::add_circle;
using shapes::add_loop;
using shapes::Graph;
using shapes::Loop;
using shapes::pi;
using shapes::rectangle;

namespace {

using P = pnpbs::Point<2>;

using Areas = std::map<std::int32_t, double>;

// Returns the areas of the regions by their tags, from the curves around them.
Areas areas_of(const PlaneDomain& domain) {
  Areas areas;
  const P origin = domain.bounds().low;
  for (const BoundaryCurve& curve : domain.curves()) {
    double area = 0;
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
      const P &a = curve.points[i], &b = curve.points[i + 1];
      area +=
          ((a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0])) / 2;
    }
    if (curve.left_inside) areas[curve.left_region] += area;
    if (curve.right_inside) areas[curve.right_region] -= area;
  }
  return areas;
}

void expect_areas(PlaneDomain& domain, const Areas& expected, double tolerance = 1e-12) {
  domain.check();
  const Areas areas = areas_of(domain);
  ck_assert_int_eq(areas.size(), expected.size());
  double all = 0;
  for (const auto& [tag, area] : expected) {
    ck_assert_msg(areas.contains(tag), "no region has the tag %d", tag);
    ck_assert_double_eq_tol(areas.at(tag), area, tolerance);
    all += area;
  }
  ck_assert_double_eq_tol(domain.area(), all, tolerance);
}

// Checks by all pairs that segments of curves meet only in common ends.
void check_conforms(const PlaneDomain& domain) {
  std::vector<std::array<P, 2>> segments;
  for (const BoundaryCurve& curve : domain.curves())
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i)
      segments.push_back({curve.points[i], curve.points[i + 1]});
  for (std::size_t s = 0; s < segments.size(); ++s)
    for (std::size_t t = 0; t < s; ++t) {
      const auto& [a, b] = segments[s];
      const auto& [c, d] = segments[t];
      ck_assert(!pnpbs::cross_properly(a, b, c, d));
      ck_assert(!((a == c && b == d) || (a == d && b == c)));
    }
}

std::int64_t pieces(const PlaneDomain& domain) {
  std::int64_t count = 0;
  for (const BoundaryCurve& curve : domain.curves()) count += std::ssize(curve.points) - 1;
  return count;
}

void add_tagged_loop(PlaneDomain& domain, const Loop& loop, std::int32_t tag,
                     CurveRole role = CurveRole::boundary) {
  const std::vector<std::int32_t> tags(static_cast<std::size_t>(loop.count()), tag);
  domain.add_polyline(role, true, loop.count(), loop.xy.data(), tags.data(), 0);
}

Loop reversed(Loop loop) {
  Loop back;
  for (std::int64_t i = loop.count() - 1; i >= 0; --i)
    back.xy.insert(back.xy.end(), {loop.xy[2 * i], loop.xy[2 * i + 1]});
  return back;
}

void expect_crossing(PlaneDomain& domain) {
  try {
    domain.check();
    ck_abort_msg("the domain is accepted");
  } catch (const pnpbs::Error& error) {
    ck_assert(error.reason() == pnpbs::ErrorReason::crossing);
  }
}

}  // namespace

// ---------------------------------------------------------------- lines
START_TEST(lines_that_cross_share_a_corner) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 4, 4));
  add_chain(domain, {1, 1, 3, 3});
  add_chain(domain, {1, 3, 3, 1});
  expect_crossing(domain);
  domain.set_fragment(OverlapRule::last);
  expect_areas(domain, {{1, 16}});
  check_conforms(domain);
  ck_assert_int_eq(pieces(domain), 8);
  ck_assert_int_eq(domain.corners().size(), 9);
  ck_assert(std::ranges::any_of(domain.corners(), [](const auto& corner) {
    return corner.position == P{2, 2};
  }));
}
END_TEST

START_TEST(lines_across_the_boundary_are_left_out_outside) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 1, 1));
  add_chain(domain, {-1, 0.25, 2, 0.25});
  add_chain(domain, {0.5, 0.5, 0.5, 3});
  domain.set_fragment(OverlapRule::last);
  expect_areas(domain, {{1, 1}});
  ck_assert_int_eq(pieces(domain), 4 + 3 + 2);
  ck_assert_double_eq(domain.bounds().high[1], 1);
}
END_TEST

START_TEST(markers_of_a_graph_stay) {
  Graph graph;
  graph.loop(rectangle(0, 0, 4, 4), 3);
  const std::int64_t a = graph.vertex(-1, 2), b = graph.vertex(5, 2), c = graph.vertex(2, 1),
                     d = graph.vertex(2, 5);
  graph.segment(a, b, 7);
  graph.segment(c, d, 8);
  PlaneDomain domain;
  graph.add_to(domain);
  domain.add_region({1, 1}, 50);
  domain.set_fragment(OverlapRule::last);
  expect_areas(domain, {{50, 8}, {1, 8}});
  std::map<std::int32_t, double> lengths;
  for (const BoundaryCurve& curve : domain.curves())
    lengths[curve.tag] += pnpbs::distance<2>(curve.points.front(), curve.points.back());
  ck_assert(lengths == (std::map<std::int32_t, double>{{3, 16}, {7, 4}, {8, 3}}));
}
END_TEST

START_TEST(random_lines_are_split_at_all_crossings) {
  Random random(7);
  // Far from the origin coordinates are rounded by more than the tolerance of given points.
  for (const P& origin : {P{0, 0}, P{5e8, 6e9}}) {
    PlaneDomain domain;
    const double x = origin[0], y = origin[1];
    add_loop(domain, rectangle(x, y, x + 1, y + 1));
    std::vector<std::array<P, 2>> lines;
    for (int k = 0; k < 60; ++k) {
      std::array<P, 2> line;
      for (P& end : line) end = random.point<2>({{x + 0.05, y + 0.05}, {x + 0.95, y + 0.95}});
      lines.push_back(line);
      add_chain(domain, {line[0][0], line[0][1], line[1][0], line[1][1]});
    }
    std::int64_t crossings = 0;
    for (std::size_t s = 0; s < lines.size(); ++s)
      for (std::size_t t = 0; t < s; ++t)
        crossings += pnpbs::cross_properly(lines[s][0], lines[s][1], lines[t][0], lines[t][1]);
    ck_assert_int_gt(crossings, 200);
    domain.set_fragment(OverlapRule::last);
    domain.check();
    check_conforms(domain);
    ck_assert_int_eq(pieces(domain), 4 + 60 + 2 * crossings);
    ck_assert_double_eq_tol(areas_of(domain).at(1), 1, 1e-5);
  }
}
END_TEST

START_TEST(lines_through_one_point_share_it) {
  PlaneDomain domain;
  add_circle(domain, 0, 0, 2);
  constexpr int kLines = 12;
  for (int k = 0; k < kLines; ++k) {
    const double angle = 0.1 + pi * k / kLines, x = std::cos(angle), y = std::sin(angle);
    add_chain(domain, {-x, -y, x, y});
  }
  domain.set_fragment(OverlapRule::last);
  domain.check();
  std::set<P> ends;
  for (const auto& corner : domain.corners()) ends.insert(corner.position);
  ck_assert_int_eq(ends.size(), 1 + 2 * kLines + 1);
}
END_TEST

START_TEST(lines_on_each_other_become_one_with_the_first_tag) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 4, 4));
  const double one[] = {1, 1, 3, 3}, two[] = {3.5, 3.5, 2, 2};
  const std::int32_t tag_of_one = 5, tag_of_two = 6;
  domain.add_polyline(CurveRole::inner, false, 2, one, &tag_of_one, 0);
  domain.add_polyline(CurveRole::inner, false, 2, two, &tag_of_two, 0);
  domain.check();
  check_conforms(domain);
  double of_one = 0, of_two = 0;
  for (const BoundaryCurve& curve : domain.curves()) {
    const double length = pnpbs::distance<2>(curve.points.front(), curve.points.back());
    of_one += curve.tag == 5 ? length : 0;
    of_two += curve.tag == 6 ? length : 0;
  }
  ck_assert_double_eq_tol(of_one, std::sqrt(8), 1e-12);
  ck_assert_double_eq_tol(of_two, std::sqrt(0.5), 1e-12);
}
END_TEST

// ---------------------------------------------------------------- solids
START_TEST(overlapping_squares_are_regions) {
  const auto domain_with = [](OverlapRule rule) {
    PlaneDomain domain;
    add_loop(domain, rectangle(0, 0, 2, 2));
    add_loop(domain, rectangle(1, 1, 4, 4));
    domain.set_fragment(rule);
    return domain;
  };
  PlaneDomain last = domain_with(OverlapRule::last), first = domain_with(OverlapRule::first),
              own = domain_with(OverlapRule::own);
  expect_areas(last, {{1, 3}, {2, 9}});
  expect_areas(first, {{1, 4}, {2, 8}});
  expect_areas(own, {{1, 3}, {2, 8}, {3, 1}});
}
END_TEST

START_TEST(a_square_in_another_one_is_a_region) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 3, 3));
  add_loop(domain, rectangle(1, 1, 2, 2));
  domain.check();
  ck_assert_double_eq(domain.area(), 8);  // a hole
  domain.set_fragment(OverlapRule::last);
  expect_areas(domain, {{1, 8}, {2, 1}});
  domain.add_hole({1.5, 1.5});
  expect_areas(domain, {{1, 8}});
}
END_TEST

// The cavity is part of the first solid, and another solid may lie in it.
START_TEST(a_square_around_which_the_curve_runs_back_is_a_cavity) {
  for (const bool clockwise : {false, true}) {
    const auto directed = [clockwise](const Loop& loop) {
      return clockwise ? reversed(loop) : loop;
    };
    PlaneDomain domain;
    add_loop(domain, directed(rectangle(0, 0, 5, 5)));
    add_loop(domain, directed(reversed(rectangle(1, 1, 4, 4))));
    add_loop(domain, directed(rectangle(2, 2, 3, 3)));
    add_loop(domain, directed(rectangle(4.5, 4.5, 6, 6)));
    domain.set_fragment(OverlapRule::last);
    expect_areas(domain, {{1, 16 - 0.25}, {2, 1}, {3, 2.25}});
  }
}
END_TEST

START_TEST(open_curves_joined_at_their_ends_are_a_solid) {
  PlaneDomain domain;
  domain.add_arc(CurveRole::boundary, {0, 0}, 1, 0, pi, 1);
  add_loop(domain, rectangle(0, -2, 2, 2));
  add_chain(domain, {-1, 0, 1, 0}, CurveRole::boundary);
  domain.set_fragment(OverlapRule::own);
  expect_areas(domain, {{1, pi / 4}, {2, 8 - pi / 4}, {3, pi / 4}}, 1e-3);
}
END_TEST

START_TEST(open_curves_that_cross_enclose_a_solid) {
  PlaneDomain domain;
  add_chain(domain, {0, 1, 5, 1}, CurveRole::boundary);
  add_chain(domain, {0, 4, 5, 4}, CurveRole::boundary);
  add_chain(domain, {1, 0, 1, 5}, CurveRole::boundary);
  add_chain(domain, {3, 0, 3, 5}, CurveRole::boundary);
  domain.set_fragment(OverlapRule::last);
  expect_areas(domain, {{1, 6}});
  PlaneDomain open;
  add_chain(open, {0, 0, 1, 1}, CurveRole::boundary);
  add_chain(open, {0, 1, 1, 0}, CurveRole::boundary);
  open.set_fragment(OverlapRule::last);
  expect_error(pnpbs::ErrorKind::domain, {"enclose nothing"}, [&] { open.check(); });
}
END_TEST

START_TEST(closed_groups_of_a_graph_are_solids) {
  Graph graph;
  graph.loop(rectangle(0, 0, 4, 4), 9);
  graph.loop(rectangle(3, 1, 5, 2), 2);
  const std::int64_t a = graph.vertex(-1, 3), b = graph.vertex(6, 3);
  graph.segment(a, b, 4);
  PlaneDomain domain;
  graph.add_to(domain);
  domain.set_fragment(OverlapRule::first);  // the groups are ordered by tag: 2, 9
  expect_areas(domain, {{1, 2}, {2, 15}});
  Graph sides;  // a box with a tag for each side, and a square in it
  for (const auto& [x, y] : {P{0, 0}, P{3, 0}, P{3, 3}, P{0, 3}}) sides.vertex(x, y);
  for (int k = 0; k < 4; ++k) sides.segment(k, (k + 1) % 4, k + 1);
  sides.loop(rectangle(1, 1, 2, 2), 9);
  PlaneDomain box;
  sides.add_to(box);
  box.set_fragment(OverlapRule::last);
  expect_areas(box, {{1, 1}, {2, 8}});
}
END_TEST

// ---------------------------------------------------------------- smooth curves
START_TEST(circles_that_cross_meet_in_points_of_both) {
  PlaneDomain domain;
  add_circle(domain, 0, 0, 1, 4);
  add_circle(domain, 1.2, 0.1, 0.7, 5);
  domain.set_fragment(OverlapRule::own);
  domain.check();
  int on_both = 0;
  for (const auto& corner : domain.corners()) {
    const double from_one = std::hypot(corner.position[0], corner.position[1]) - 1,
                 from_two = std::hypot(corner.position[0] - 1.2, corner.position[1] - 0.1) - 0.7;
    on_both += std::fabs(from_one) < 1e-14 && std::fabs(from_two) < 1e-14;
  }
  ck_assert_int_eq(on_both, 2);
  const double d = std::hypot(1.2, 0.1), r = 0.7;
  const double one = std::acos((d * d + 1 - r * r) / (2 * d)),
               two = std::acos((d * d + r * r - 1) / (2 * d * r));
  const double lens = one - std::sin(2 * one) / 2 + r * r * (two - std::sin(2 * two) / 2);
  ck_assert_double_eq_tol(domain.area(), pi + pi * r * r - lens, 1e-7);
  ck_assert_double_eq_tol(areas_of(domain).at(3), lens, 2e-4);
}
END_TEST

START_TEST(lines_cross_circles) {
  PlaneDomain domain;
  add_circle(domain, 0, 0, 1);
  for (int k = -4; k <= 4; ++k) add_chain(domain, {-2, 0.2 * k + 0.01, 2, 0.2 * k + 0.02});
  domain.set_fragment(OverlapRule::last);
  domain.check();
  ck_assert_int_eq(domain.curves().size(), 9 + 19);  // the circle begins in a corner
  ck_assert_double_eq_tol(domain.area(), pi, 1e-7);
  for (const auto& corner : domain.corners())
    if (corner.name.starts_with("a crossing"))
      ck_assert_double_eq_tol(std::hypot(corner.position[0], corner.position[1]), 1, 1e-14);
}
END_TEST

START_TEST(circles_cross_in_common_samples) {
  PlaneDomain domain;  // six around one, which cross in its centre and in pairs
  for (int k = 0; k < 6; ++k)
    add_circle(domain, std::cos(pi * k / 3), std::sin(pi * k / 3), 1, k + 1);
  domain.set_fragment(OverlapRule::last);
  domain.check();
  check_conforms(domain);
  ck_assert(std::ranges::any_of(domain.corners(), [](const auto& corner) {
    return std::hypot(corner.position[0], corner.position[1]) < 1e-12;
  }));
}
END_TEST

// ---------------------------------------------------------------- without the option
START_TEST(squares_with_a_common_edge_need_no_option) {
  PlaneDomain domain;
  add_tagged_loop(domain, rectangle(0, 0, 1, 2), 5);
  add_tagged_loop(domain, rectangle(1, -1, 3, 1), 6);
  expect_areas(domain, {{1, 2}, {2, 4}});
  check_conforms(domain);
  for (const BoundaryCurve& curve : domain.curves())
    if (curve.left_inside && curve.right_inside) ck_assert_int_eq(curve.tag, 5);
  add_loop(domain, rectangle(0.25, 0.25, 0.5, 0.5));  // would be a hole or a solid
  expect_crossing(domain);
}
END_TEST

START_TEST(inner_squares_with_a_common_edge_need_no_option) {
  PlaneDomain domain;
  add_loop(domain, rectangle(0, 0, 4, 4));
  add_loop(domain, rectangle(1, 1, 2, 2), 0, CurveRole::inner);
  add_loop(domain, rectangle(2, 1, 3, 2), 0, CurveRole::inner);
  domain.add_region({1.5, 1.5}, 10);
  domain.add_region({2.5, 1.5}, 20);
  expect_areas(domain, {{10, 1}, {20, 1}, {1, 14}});
}
END_TEST

START_TEST(crossing_and_overlapping_curves_need_the_option) {
  PlaneDomain notch;  // the inner square may be a notch or a solid
  add_loop(notch, rectangle(0, 0, 3, 3));
  add_loop(notch, rectangle(1, 0, 2, 1));
  expect_crossing(notch);
  notch.set_fragment(OverlapRule::last);
  expect_areas(notch, {{1, 8}, {2, 1}});
}
END_TEST

TEST_SUITE(test_curve_solids) {
  return run_suite(
      "curve_solids",
      {lines_that_cross_share_a_corner, lines_across_the_boundary_are_left_out_outside,
       markers_of_a_graph_stay, random_lines_are_split_at_all_crossings,
       lines_through_one_point_share_it, lines_on_each_other_become_one_with_the_first_tag,
       overlapping_squares_are_regions, a_square_in_another_one_is_a_region,
       a_square_around_which_the_curve_runs_back_is_a_cavity,
       open_curves_joined_at_their_ends_are_a_solid, open_curves_that_cross_enclose_a_solid,
       closed_groups_of_a_graph_are_solids, circles_that_cross_meet_in_points_of_both,
       lines_cross_circles, circles_cross_in_common_samples,
       squares_with_a_common_edge_need_no_option, inner_squares_with_a_common_edge_need_no_option,
       crossing_and_overlapping_curves_need_the_option});
}
