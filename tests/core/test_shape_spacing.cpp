// SPDX-License-Identifier: BSD-3-Clause
// A spacing that follows the shape: distances against loops over all segments and triangles,
// curvature of circles, balls and cylinders, widths of channels, slabs and annuli, and growth.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <vector>

#include "base/error.hpp"
#include "base/space_vectors.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "spacing/shape_spacing.hpp"

using pnpbs::BoundaryMesh;
using pnpbs::CurveRole;
using pnpbs::Point;
using pnpbs::ShapeIndex;
using pnpbs::ShapeLimits;
using pnpbs::ShapeRequirements;
using pnpbs::ShapeSpacing;
using std::numbers::pi;

namespace {

constexpr double kGrowth = 0.15;
constexpr ShapeRequirements kTurn{20, 0, 0}, kAcross{0, 3, 0}, kEdge{0, 0, 1};

template <class Domain>
auto index_of(Domain& domain) {
  domain.check();
  return ShapeIndex(pnpbs::shape_of(domain));
}

template <int Dim>
double at(const ShapeSpacing<Dim>& spacing, const std::type_identity_t<Point<Dim>>& x) {
  double d;
  spacing.evaluate(1, &x, &d);
  return d;
}

std::vector<double> regular(std::int64_t n, double radius) {
  std::vector<double> xy;
  for (std::int64_t k = 0; k < n; ++k) {
    const double t = 2 * pi * static_cast<double>(k) / static_cast<double>(n);
    xy.insert(xy.end(), {radius * std::cos(t), radius * std::sin(t)});
  }
  return xy;
}

void add_polygon(pnpbs::PlaneDomain& domain, const std::vector<double>& xy) {
  domain.add_polyline(CurveRole::boundary, true, std::ssize(xy) / 2, xy.data(), nullptr, 0);
}

// Reference distances: the distance from x to a segment.
double to_segment(const Point<2>& a, const Point<2>& b, const Point<2>& x) {
  const Point<2> u{b[0] - a[0], b[1] - a[1]}, v{x[0] - a[0], x[1] - a[1]};
  const double t = std::clamp((u[0] * v[0] + u[1] * v[1]) / (u[0] * u[0] + u[1] * u[1]), 0.0, 1.0);
  return std::hypot(v[0] - t * u[0], v[1] - t * u[1]);
}

double to_segment(const Point<3>& a, const Point<3>& b, const Point<3>& x) {
  const Point<3> u = pnpbs::difference(b, a), v = pnpbs::difference(x, a);
  const double t = std::clamp(pnpbs::dot(u, v) / pnpbs::dot(u, u), 0.0, 1.0);
  return pnpbs::length(pnpbs::shifted(v, -t, u));
}

// Returns the distance to the foot of the perpendicular if it lies in the triangle, and to the
// nearest edge otherwise.
double to_triangle(const pnpbs::FacetCorners<3>& f, const Point<3>& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) least = std::min(least, to_segment(f[k], f[(k + 1) % 3], x));
  const Point<3> n = pnpbs::unit_vector(
      pnpbs::cross(pnpbs::difference(f[1], f[0]), pnpbs::difference(f[2], f[0])));
  bool in = true;
  for (std::size_t k = 0; k < 3; ++k)
    in = in && pnpbs::dot(pnpbs::cross(pnpbs::difference(f[(k + 1) % 3], f[k]),
                                       pnpbs::difference(x, f[k])),
                          n) >= 0;
  return in ? std::min(least, std::fabs(pnpbs::dot(n, pnpbs::difference(x, f[0])))) : least;
}

template <int Dim>
void expect_growth_below(const ShapeSpacing<Dim>& spacing, const pnpbs::Box<Dim>& box) {
  Random random(7);
  for (int n = 0; n < 2000; ++n) {
    const Point<Dim> a = random.point<Dim>(box);
    Point<Dim> b = random.point<Dim>(box);
    const double part = std::pow(10.0, -random.between(0, 5));
    for (std::size_t k = 0; k < Dim; ++k) b[k] = a[k] + part * (b[k] - a[k]);
    const double apart = pnpbs::distance<Dim>(a, b);
    ck_assert_double_le(std::fabs(at(spacing, a) - at(spacing, b)),
                        kGrowth * apart * (1 + 1e-9) + 1e-14);
  }
}

}  // namespace

START_TEST(distances_in_the_plane) {
  pnpbs::PlaneDomain domain;
  const std::vector<double> outer = regular(37, 2), hole = regular(11, 0.7);
  std::vector<std::int32_t> tags(37);
  for (std::size_t k = 0; k < tags.size(); ++k) tags[k] = 1 + static_cast<std::int32_t>(k % 3);
  domain.add_polyline(CurveRole::boundary, true, 37, outer.data(), tags.data(), 0);
  add_polygon(domain, hole);
  const double inner[] = {-1.2, 0.1, -0.9, 0.6}, fixed[] = {1.1, -0.3};
  const std::int32_t five = 5, seven = 7;
  domain.add_polyline(CurveRole::inner, false, 2, inner, &five, 0);
  domain.add_fixed_nodes(1, fixed, &seven);
  const ShapeIndex<2> index = index_of(domain);
  ck_assert(index.tags() == (std::vector<std::int32_t>{1, 2, 3, 5, 7}));
  Random random(1);
  for (int n = 0; n < 1000; ++n) {
    const Point<2> x = random.point<2>({{-2.5, -2.5}, {2.5, 2.5}});
    double all = std::numeric_limits<double>::infinity(), tagged = all;
    const auto look = [&](const std::vector<double>& xy, auto tag_of) {
      const std::size_t count = xy.size() / 2;
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t next = (k + 1) % count;
        const double gap =
            to_segment({xy[2 * k], xy[2 * k + 1]}, {xy[2 * next], xy[2 * next + 1]}, x);
        all = std::min(all, gap);
        if (tag_of(k) == 3) tagged = std::min(tagged, gap);
      }
    };
    look(outer, [&](std::size_t k) { return tags[k]; });
    look(hole, [](std::size_t) { return 1; });
    ck_assert_double_eq_tol(index.distance_to_boundary(x), all, 1e-14);
    ck_assert_double_eq_tol(index.distance_to_tag(3, x), tagged, 1e-14);
    ck_assert_double_eq_tol(index.distance_to_tag(5, x), to_segment({-1.2, 0.1}, {-0.9, 0.6}, x),
                            1e-14);
    ck_assert_double_eq_tol(index.distance_to_tag(7, x), std::hypot(x[0] - 1.1, x[1] + 0.3), 1e-14);
  }
}
END_TEST

// Distances are to the circle itself, not to its chords.
START_TEST(distances_to_arcs) {
  pnpbs::PlaneDomain domain;
  domain.add_arc(CurveRole::boundary, {1, 2}, 3, 0, 2 * pi, 4);
  const ShapeIndex<2> index = index_of(domain);
  Random random(2);
  for (int n = 0; n < 1000; ++n) {
    const Point<2> x = random.point<2>({{-2, -1}, {4, 5}});
    ck_assert_double_eq_tol(index.distance_to_tag(4, x),
                            std::fabs(std::hypot(x[0] - 1, x[1] - 2) - 3), 1e-7 * index.size());
  }
}
END_TEST

START_TEST(distances_in_space) {
  pnpbs::VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 2, 3}, {1, 2, 3, 4, 5, 6});
  domain.add_cylinder({0.5, 0.5, 0.5}, {0.5, 1.5, 1}, 0.2, 9);
  const double curve[] = {0.2, 0.2, 2, 0.8, 1.2, 2.5, 0.8, 1.8, 2.4}, fixed[] = {0.5, 1, 2.8};
  const std::int32_t tags[] = {12, 12}, ten = 10;
  domain.add_polyline(false, 3, curve, tags);
  domain.add_fixed_nodes(1, fixed, &ten);
  const ShapeIndex<3> index = index_of(domain);
  const BoundaryMesh<3>& mesh = domain.mesh();
  Random random(3);
  for (int n = 0; n < 300; ++n) {
    const Point<3> x = random.point<3>({{-0.2, -0.2, -0.2}, {1.2, 2.2, 3.2}});
    double all = std::numeric_limits<double>::infinity(), tagged = all;
    for (const pnpbs::BoundaryTriangle& facet : mesh.facets) {
      if (!facet.bounds()) continue;
      const double gap = to_triangle(corners_of(mesh, facet), x);
      all = std::min(all, gap);
      if (facet.tag == 9) tagged = std::min(tagged, gap);
    }
    ck_assert_double_eq_tol(index.distance_to_boundary(x), all, 1e-13);
    ck_assert_double_eq_tol(index.distance_to_tag(9, x), tagged, 1e-13);
    ck_assert_double_eq_tol(index.distance_to_tag(12, x),
                            std::min(to_segment({0.2, 0.2, 2}, {0.8, 1.2, 2.5}, x),
                                     to_segment({0.8, 1.2, 2.5}, {0.8, 1.8, 2.4}, x)),
                            1e-13);
    ck_assert_double_eq_tol(index.distance_to_tag(10, x), pnpbs::distance<3>(x, {0.5, 1, 2.8}),
                            1e-13);
  }
}
END_TEST

START_TEST(curvature_of_circles) {
  constexpr double kRadius = 2.5;
  pnpbs::PlaneDomain polygon, circle;
  const std::vector<double> xy = regular(40, kRadius);
  add_polygon(polygon, xy);
  circle.add_arc(CurveRole::boundary, {0, 0}, kRadius, 0, 2 * pi, 1);
  const double expected = 2 * pi * kRadius / 20;
  for (pnpbs::PlaneDomain* domain : {&polygon, &circle}) {
    const ShapeSpacing<2> spacing(index_of(*domain), kTurn, {kGrowth});
    for (std::size_t k = 0; k < 40; ++k)
      ck_assert_double_eq_tol(at(spacing, {xy[2 * k], xy[2 * k + 1]}), expected, 1e-6);
    ck_assert_double_eq_tol(
        at(spacing, {0.5, 0}), expected + kGrowth * 2,
        domain == &polygon ? kGrowth * kRadius * (1 - std::cos(pi / 40)) : 1e-6);
  }
}
END_TEST

// The curvature of an ellipse at the ends of its axes; corners of a square have none.
START_TEST(curvature_of_curves) {
  pnpbs::PlaneDomain ellipse, square;
  ellipse.add_curve(
      CurveRole::boundary,
      [](std::int64_t n, const double* t, Point<2>* x) {
        for (std::int64_t i = 0; i < n; ++i) x[i] = {2 * std::cos(t[i]), std::sin(t[i])};
      },
      0, 2 * pi, 1);
  const ShapeSpacing<2> spacing(index_of(ellipse), kTurn, {1e6});
  ck_assert_double_eq_tol(at(spacing, {2, 0}), 2 * pi * 0.5 / 20, 1e-3 * 0.16);
  ck_assert_double_eq_tol(at(spacing, {0, 1}), 2 * pi * 4 / 20, 5e-3 * 1.3);
  add_polygon(square, {0, 0, 1, 0, 1, 1, 0, 1});
  const ShapeSpacing<2> none(index_of(square), kTurn, {kGrowth, 0, 0.3});
  ck_assert_double_eq(at(none, {0, 0}), 0.3);
}
END_TEST

START_TEST(curvature_of_surfaces) {
  pnpbs::VolumeDomain ball, cylinder;
  ball.add_ball({1, 1, 1}, 2, 1);
  cylinder.add_cylinder({0, 0, 0}, {0, 0, 4}, 0.5, 1);
  const ShapeSpacing<3> on_ball(index_of(ball), kTurn, {1e6}),
      on_cylinder(index_of(cylinder), kTurn, {1e6});
  double least = 1e9, most = 0;
  for (const auto& node : ball.mesh().nodes) {
    const double share = at(on_ball, node.position) / (2 * pi * 2 / 20);
    least = std::min(least, share);
    most = std::max(most, share);
  }
  ck_assert_double_ge(least, 0.93);  // triangles differ in shape
  ck_assert_double_le(most, 1.001);
  least = 1e9, most = 0;
  for (const auto& node : cylinder.mesh().nodes) {
    if (std::hypot(node.position[0], node.position[1]) < 0.4) continue;
    const double share = at(on_cylinder, node.position) / (2 * pi * 0.5 / 20);
    least = std::min(least, share);
    most = std::max(most, share);
  }
  ck_assert_double_ge(least, 0.999);
  ck_assert_double_le(most, 1.001);
}
END_TEST

START_TEST(width_of_a_channel) {
  pnpbs::PlaneDomain domain;
  add_polygon(domain, {0, 0, 10, 0, 10, 0.6, 0, 0.6});
  const ShapeSpacing<2> spacing(index_of(domain), kAcross, {kGrowth});
  for (double x = 0.05; x < 10; x += 0.1)
    for (const double y : {0.0, 0.1, 0.3, 0.6})
      ck_assert_double_eq_tol(at(spacing, {x, y}), 0.2 + kGrowth * std::min(y, 0.6 - y), 1e-12);
}
END_TEST

START_TEST(width_of_an_annulus) {
  pnpbs::PlaneDomain domain;
  domain.add_arc(CurveRole::boundary, {0, 0}, 2, 0, 2 * pi, 1);
  domain.add_arc(CurveRole::boundary, {0, 0}, 1.4, 0, 2 * pi, 2);
  const ShapeSpacing<2> spacing(index_of(domain), kAcross, {kGrowth});
  for (double t = 0; t < 2 * pi; t += 0.1)
    for (const double r : {1.4, 1.5, 1.7, 2.0})
      ck_assert_double_eq_tol(at(spacing, {r * std::cos(t), r * std::sin(t)}),
                              0.2 + kGrowth * std::min(r - 1.4, 2 - r), 1e-5);
}
END_TEST

START_TEST(width_of_a_slab) {
  pnpbs::VolumeDomain domain;
  domain.add_box({0, 0, 0}, {2, 3, 0.3}, 1);
  const ShapeSpacing<3> spacing(index_of(domain), kAcross, {kGrowth});
  Random random(4);
  for (int n = 0; n < 500; ++n) {
    const Point<3> x = random.point<3>({{0, 0, 0}, {2, 3, 0.3}});
    ck_assert_double_eq_tol(at(spacing, x), 0.1 + kGrowth * std::min(x[2], 0.3 - x[2]), 1e-12);
  }
}
END_TEST

// A tooth ends near a wall whose nearest vertices are far away.
START_TEST(width_under_a_tooth) {
  pnpbs::PlaneDomain domain;
  add_polygon(domain, {0, 0, 10, 0, 10, 5, 7.2, 5, 7, 0.3, 6.8, 5, 0, 5});
  const ShapeSpacing<2> spacing(index_of(domain), kAcross, {kGrowth});
  const double under = at(spacing, {7, 0.0});
  ck_assert_double_ge(under, 0.1 - 1e-12);
  ck_assert_double_le(under, 0.1 * 1.1);
  ck_assert_double_gt(at(spacing, {2, 0}), 0.5);
}
END_TEST

// Corners are not narrow, however finely the sides are divided.
START_TEST(width_at_corners) {
  pnpbs::PlaneDomain square;
  std::vector<double> xy;
  constexpr int kParts = 20;
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < kParts; ++k) {
      const double t = 1.0 * k / kParts;
      const double x[] = {t, 1, 1 - t, 0}, y[] = {0, t, 1, 1 - t};
      xy.insert(xy.end(), {x[side], y[side]});
    }
  add_polygon(square, xy);
  const ShapeSpacing<2> spacing(index_of(square), kAcross, {kGrowth});
  for (double t = 0; t <= 1; t += 0.01) ck_assert_double_ge(at(spacing, {t, 0}), 1.0 / 3 - 1e-12);
}
END_TEST

START_TEST(edges_of_the_input) {
  pnpbs::PlaneDomain domain;
  add_polygon(domain, {0, 0, 1, 0, 1.25, 0, 3, 0, 3, 4, 0, 4});
  const ShapeSpacing<2> spacing(index_of(domain), kEdge, {kGrowth});
  ck_assert_double_eq(at(spacing, {1.1, 0}), 0.25);
  ck_assert_double_eq_tol(at(spacing, {1.1, 2}), 0.25 + kGrowth * 2, 1e-14);
  ck_assert_double_eq_tol(at(spacing, {0, 0}), 0.25 + kGrowth, 1e-14);
}
END_TEST

// d follows the edges of given surfaces. A ball has no edges of its own, so d near it follows from
// growth.
START_TEST(edges_of_surfaces) {
  pnpbs::VolumeDomain domain;
  domain.add_box({0, 0, 0}, {3, 4, 3}, 1);
  domain.add_ball({1.5, 2, 1.5}, 0.5, 2);
  const ShapeSpacing<3> spacing(index_of(domain), kEdge, {kGrowth, 0, 100});
  const double least = (3 + 3 + std::sqrt(18.0)) / 3;  // triangles of a square side
  ck_assert_double_eq_tol(at(spacing, {1, 0, 1}), least, 1e-14);
  ck_assert_double_eq_tol(at(spacing, {1.5, 2, 1}), least + kGrowth * 2, 1e-14);
}
END_TEST

START_TEST(growth_and_bounds) {
  pnpbs::PlaneDomain plane;
  add_polygon(plane, {0, 0, 1, 0, 1.03, 0.02, 1.05, 0.04, 2, 0, 2, 0.3, 0.9, 0.2, 0, 1});
  constexpr ShapeRequirements all{20, 3, 1};
  const ShapeIndex<2> index = index_of(plane);
  expect_growth_below<2>({index, all, {kGrowth}}, {{-1, -1}, {3, 2}});
  const ShapeSpacing<2> bounded(index, all, {kGrowth, 0.045, 0.06});
  Random random(5);
  double least = 1, most = 0;
  for (int n = 0; n < 500; ++n) {
    const double d = at(bounded, random.point<2>({{0, 0}, {2, 1}}));
    least = std::min(least, d);
    most = std::max(most, d);
  }
  ck_assert_double_eq(least, 0.045);
  ck_assert_double_eq(most, 0.06);
  pnpbs::VolumeDomain volume;
  volume.add_box({0, 0, 0}, {1, 1, 1}, 1);
  volume.add_box({0.3, 0.3, 0.2}, {0.6, 0.5, 0.9}, 2);
  expect_growth_below<3>({index_of(volume), {20, 3, 0}, {kGrowth}}, {{0, 0, 0}, {1, 1, 1}});
}
END_TEST

TEST_SUITE(test_shape_spacing) {
  return run_kernel_suite(
      "shape spacing",
      {distances_in_the_plane, distances_to_arcs, distances_in_space, curvature_of_circles,
       curvature_of_curves, curvature_of_surfaces, width_of_a_channel, width_of_an_annulus,
       width_of_a_slab, width_under_a_tooth, width_at_corners, edges_of_the_input,
       edges_of_surfaces, growth_and_bounds});
}
