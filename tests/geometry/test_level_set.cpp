// SPDX-License-Identifier: BSD-3-Clause
// Bodies defined by level sets: their triangles against formulas, the number of evaluations of f,
// invalid input, and the projection of points to the surface.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "base/space_vectors.hpp"
#include "domain/volume/volume_domain.hpp"
#include "expect_error.hpp"
#include "implicit/level_set_lattice.hpp"
#include "implicit/level_set_surface.hpp"
#include "run_suite.hpp"

using pnpbs::Box;
using pnpbs::ErrorKind;
using pnpbs::LevelSet;
using pnpbs::LevelSetFunction;
using pnpbs::VolumeDomain;
using P = pnpbs::Point<3>;

namespace {

constexpr double pi = std::numbers::pi;
using Formula = std::function<double(const P&)>;

LevelSetFunction in_batches(const Formula& f, std::int64_t* asked = nullptr) {
  return [f, asked](std::int64_t n, const P* x, double* values) {
    for (std::int64_t i = 0; i < n; ++i) values[i] = f(x[i]);
    if (asked) *asked += n;
  };
}

double radius(const P& x, const P& centre = {}) { return pnpbs::distance<3>(x, centre); }
Formula ball(double r, const P& centre = {}) {
  return [=](const P& x) { return radius(x, centre) - r; };
}
double torus(const P& x) { return std::hypot(std::hypot(x[0], x[1]) - 1, x[2]) - 0.4; }
double two_balls(const P& x) {
  return std::min(ball(0.5, {0.8, 0, 0})(x), ball(0.3, {-0.8, 0, 0})(x));
}
// Negative where the product of the distances to two points is less than 0.71^2: a body with a
// waist.
double cassini(const P& x) {
  return radius(x, {0.7, 0, 0}) * radius(x, {-0.7, 0, 0}) - 0.71 * 0.71;
}
double gyroid(const P& x) {
  const auto part = [](double a, double b) { return std::sin(2 * pi * a) * std::cos(2 * pi * b); };
  const double sheets = part(x[0], x[1]) + part(x[1], x[2]) + part(x[2], x[0]);
  return std::max(std::fabs(sheets) - 0.6, radius(x) - 1.2);
}
double cube(const P& x) {
  return std::max({std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2])}) - 0.9;
}
double pierced_cube(const P& x) { return std::max(cube(x), 0.5 - std::hypot(x[0], x[1])); }
// The intersection of two unit balls at a distance of 1. Its surfaces meet at the edge at 60
// degrees to either side.
constexpr P kLeft{-0.5, 0, 0}, kRight{0.5, 0, 0};
double lens(const P& x) { return std::max(radius(x, kLeft), radius(x, kRight)) - 1; }
const double kLensVolume = 2 * pi * 0.25 * 2.5 / 3;
// The union of two balls, with a concave edge.
double both_balls(const P& x) { return std::min(radius(x, kLeft), radius(x, kRight)) - 0.9; }

constexpr Box<3> kBox{{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}};

// Returns the body and allows any warnings.
VolumeDomain any_body(const Formula& f, double resolution) {
  VolumeDomain domain;
  domain.add_level_set(in_batches(f), kBox, resolution, 3);
  domain.check();
  return domain;
}

VolumeDomain body(const Formula& f, double resolution, const Box<3>& box = kBox) {
  VolumeDomain domain;
  domain.add_level_set(in_batches(f), box, resolution, 3);
  domain.check();
  for (const pnpbs::Warning& warning : domain.warnings())
    ck_abort_msg("%s", warning.message.text().c_str());
  return domain;
}

// Returns vertices - edges + triangles. Expects that every edge belongs to two triangles with
// opposite directions.
std::int64_t euler_characteristic(const VolumeDomain& domain) {
  std::set<std::pair<std::int32_t, std::int32_t>> sides;
  for (const auto& facet : domain.mesh().facets)
    for (std::size_t k = 0; k < 3; ++k)
      ck_assert(sides.insert({facet.nodes[k], facet.nodes[(k + 1) % 3]}).second);
  for (const auto& [a, b] : sides) ck_assert(sides.contains({b, a}));
  return std::ssize(domain.mesh().nodes) - std::ssize(sides) / 2 + std::ssize(domain.mesh().facets);
}

void expect_refused(ErrorKind kind, std::initializer_list<const char*> parts, const Formula& f,
                    double resolution = 0.1, const Box<3>& box = kBox, std::int32_t tag = 1) {
  VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, 1}, 1);
  domain.check();
  expect_error(kind, parts, [&] { domain.add_level_set(in_batches(f), box, resolution, tag); });
  ck_assert(domain.is_checked() && domain.volume() == 1);  // unchanged
}

}  // namespace

// ---------------------------------------------------------------- triangles
START_TEST(a_ball_to_second_order) {
  double volume_error[2], area_error[2];
  const double steps[] = {0.2, 0.1};
  for (int k = 0; k < 2; ++k) {
    const VolumeDomain domain = body(ball(1), steps[k]);
    ck_assert_int_eq(euler_characteristic(domain), 2);
    for (const auto& node : domain.mesh().nodes)
      ck_assert_double_eq_tol(radius(node.position), 1, 1e-9);
    for (const auto& facet : domain.mesh().facets)
      ck_assert(facet.tag == 3 && facet.back_inside && !facet.front_inside);
    volume_error[k] = std::fabs(domain.volume() - 4 * pi / 3);
    area_error[k] = std::fabs(domain.area() - 4 * pi);
    ck_assert_double_lt(volume_error[k], 1.2 * steps[k] * steps[k]);
    ck_assert_double_lt(area_error[k], 1.5 * steps[k] * steps[k]);
  }
  ck_assert_double_lt(volume_error[1], volume_error[0] / 3);
  ck_assert_double_lt(area_error[1], area_error[0] / 3);
}
END_TEST

START_TEST(a_torus_has_a_hole) {
  const VolumeDomain domain = body(torus, 0.05);
  ck_assert_int_eq(euler_characteristic(domain), 0);
  ck_assert_double_eq_tol(domain.volume() / (2 * pi * pi * 0.16), 1, 4e-3);
  ck_assert_double_eq_tol(domain.area() / (4 * pi * pi * 0.4), 1, 4e-3);
}
END_TEST

START_TEST(two_balls_apart) {
  const VolumeDomain domain = body(two_balls, 0.05);
  ck_assert_int_eq(domain.summary().components, 2);
  ck_assert_int_eq(euler_characteristic(domain), 4);
  ck_assert_double_eq_tol(domain.volume() / (4 * pi / 3 * (0.125 + 0.027)), 1, 5e-3);
}
END_TEST

// The distance of the surface from the x axis is sqrt(sqrt(c^4 + 4 a^2 x^2) - x^2 - a^2).
START_TEST(a_body_with_a_waist) {
  const double a = 0.7, c = 0.71, end = std::sqrt(a * a + c * c);
  constexpr int kSlices = 100000;
  double volume = 0;
  for (int k = 0; k < kSlices; ++k) {
    const double x = end * (k + 0.5) / kSlices;
    const double root = std::sqrt(std::pow(c, 4) + 4 * a * a * x * x);
    volume += 2 * pi * (root - x * x - a * a) * end / kSlices;
  }
  const VolumeDomain domain = body(cassini, 0.03);
  ck_assert_int_eq(euler_characteristic(domain), 2);
  ck_assert_double_eq_tol(domain.volume() / volume, 1, 3e-3);
}
END_TEST

// Compares the volume with the fraction of grid points that are inside.
START_TEST(a_gyroid_in_a_ball) {
  constexpr int kRow = 150;
  std::int64_t inside = 0;
  for (int i = 0; i < kRow * kRow * kRow; ++i) {
    P x;
    for (std::size_t k = 0, rest = static_cast<std::size_t>(i); k < 3; ++k, rest /= kRow)
      x[k] = -1.5 + 3 * (static_cast<double>(rest % kRow) + 0.5) / kRow;
    inside += gyroid(x) < 0 ? 1 : 0;
  }
  const double volume = 27.0 * static_cast<double>(inside) / (kRow * kRow * kRow);
  const VolumeDomain domain = any_body(gyroid, WHEN_SANITIZED(0.1, 0.06));
  ck_assert_int_lt(euler_characteristic(domain), -10);
  ck_assert_double_eq_tol(domain.volume() / volume, 1, 2e-2);
}
END_TEST

// The surface passes through or close to lattice points, edges and planes.
START_TEST(surfaces_through_lattice_points) {
  for (const double h : {0.3, 0.2}) {
    const LevelSet somewhere("level set 0", in_batches(ball(1)), kBox, h);
    const pnpbs::LevelSetLattice lattice(somewhere);
    const std::int32_t middle = static_cast<std::int32_t>(1.5 / h);
    const P centre = lattice.position({middle, middle + 1, middle});
    const P far = lattice.position({middle + 3, middle + 4, middle + 3});
    for (int k = 0; k < 20; k += WHEN_SANITIZED(4, 1)) {
      const double off = k == 0 ? 0 : std::ldexp(1.0, -3 * k);
      const P at = pnpbs::shifted(centre, off, {0.1, k % 3 == 0 ? 0 : 0.03, 0});
      const auto moved = [&](const Formula& f) {
        return [f, at](const P& x) { return f(pnpbs::difference(x, at)); };
      };
      const double half = far[0] - centre[0];
      ck_assert_int_eq(euler_characteristic(body(moved(ball(half)), h)), 2);
      ck_assert_int_eq(euler_characteristic(body(moved(ball(1)), h)), 2);
      const Formula box = moved([half](const P& x) {
        return std::max({std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2])}) - half;
      });
      ck_assert_int_eq(euler_characteristic(any_body(box, h)), 2);
      const Formula diamond = moved([half](const P& x) {
        return std::fabs(x[0]) + std::fabs(x[1]) + std::fabs(x[2]) - half;
      });
      ck_assert_int_eq(euler_characteristic(any_body(diamond, h)), 2);
    }
  }
}
END_TEST

// Shells as thin as the resolution still have a valid surface.
START_TEST(thin_shells) {
  for (int k = 0; k < WHEN_SANITIZED(4, 12); ++k) {
    const P centre{0.013 * k, 0.007 * k, 0.003 * k};
    VolumeDomain domain;
    domain.add_level_set(
        in_batches([&](const P& x) { return std::fabs(radius(x, centre) - 1) - 0.05; }), kBox,
        0.1 + 0.01 * (k % 4), 1);
    domain.check();
    ck_assert_int_eq(euler_characteristic(domain) % 2, 0);
  }
}
END_TEST

// ---------------------------------------------------------------- edges
// Calls check(x) for the mesh's nodes on feature edges.
static void for_nodes_on_edges(const VolumeDomain& domain,
                               const std::function<void(const P&)>& check) {
  for (const auto& curve : domain.features().curves)
    for (const std::int32_t node : curve.nodes)
      check(domain.mesh().nodes[static_cast<std::size_t>(node)].position);
}

START_TEST(the_edge_of_a_lens) {
  double error[2];
  const double steps[] = {0.2, 0.1};
  for (int k = 0; k < 2; ++k) {
    const VolumeDomain domain = body(lens, steps[k]);
    ck_assert_int_eq(euler_characteristic(domain), 2);
    ck_assert_int_eq(domain.summary().patches, 2);
    ck_assert_uint_eq(domain.features().curves.size(), 1);
    ck_assert(domain.features().curves[0].closed());
    ck_assert_int_eq(domain.summary().corners, 0);
    ck_assert_int_gt(domain.summary().feature_edges, 2 * pi * std::sqrt(0.75) / steps[k]);
    for_nodes_on_edges(domain, [](const P& x) {
      ck_assert_double_eq_tol(radius(x, kLeft), 1, 1e-8);
      ck_assert_double_eq_tol(radius(x, kRight), 1, 1e-8);
    });
    error[k] = std::fabs(domain.volume() - kLensVolume);
    ck_assert_double_lt(error[k], 0.6 * steps[k] * steps[k]);
  }
  ck_assert_double_lt(error[1], error[0] / 3);
}
END_TEST

START_TEST(an_edge_turned_inwards) {
  const double r = 0.9, cap = r - 0.5;
  const VolumeDomain domain = body(both_balls, 0.1);
  ck_assert_int_eq(domain.summary().patches, 2);
  ck_assert_uint_eq(domain.features().curves.size(), 1);
  for_nodes_on_edges(domain, [&](const P& x) {
    ck_assert_double_eq_tol(radius(x, kLeft), r, 1e-8);
    ck_assert_double_eq_tol(radius(x, kRight), r, 1e-8);
  });
  const double both = 2 * 4 * pi / 3 * r * r * r, common = 2 * pi * cap * cap * (3 * r - cap) / 3;
  ck_assert_double_eq_tol(domain.volume() / (both - common), 1, 4e-3);
}
END_TEST

// Planar faces are exact: corners and edges are within 1e-5 of the resolution. A box
// added around the body has its own exact edges.
START_TEST(edges_and_corners_of_a_box) {
  VolumeDomain domain = body(cube, 0.11);
  ck_assert_int_eq(euler_characteristic(domain), 2);
  ck_assert_int_eq(domain.summary().patches, 6);
  ck_assert_int_eq(domain.summary().corners, 8);
  ck_assert_uint_eq(domain.features().curves.size(), 12);
  for (const std::int32_t corner : domain.features().corners)
    for (const double x : domain.mesh().nodes[static_cast<std::size_t>(corner)].position)
      ck_assert_double_eq_tol(std::fabs(x), 0.9, 1.1e-6);
  for_nodes_on_edges(domain, [](const P& x) {
    int at_end = 0;
    for (const double each : x) at_end += std::fabs(std::fabs(each) - 0.9) < 1.1e-6 ? 1 : 0;
    ck_assert_int_ge(at_end, 2);
  });
  ck_assert_double_eq_tol(domain.volume() / std::pow(1.8, 3), 1, 1.1e-6);
  domain.add_box({-2, -2, -2}, {2, 2, 2}, 1);
  domain.check();
  ck_assert_int_eq(domain.summary().patches, 12);
  ck_assert_int_eq(domain.summary().corners, 16);
  ck_assert_double_eq_tol(domain.volume() / (64 - std::pow(1.8, 3)), 1, 1e-8);
}
END_TEST

START_TEST(a_hole_through_a_box) {
  const double volume = std::pow(1.8, 3) - pi * 0.25 * 1.8;
  double error[2];
  const double steps[] = {0.2, 0.1};
  for (int k = 0; k < 2; ++k) {
    const VolumeDomain domain = body(pierced_cube, steps[k]);
    ck_assert_int_eq(euler_characteristic(domain), 0);
    ck_assert_int_eq(domain.summary().patches, 7);
    ck_assert_uint_eq(domain.features().curves.size(), 14);
    ck_assert_int_eq(domain.summary().corners, 8);
    error[k] = std::fabs(domain.volume() - volume);
    ck_assert_double_lt(error[k], 1.5 * steps[k] * steps[k]);
  }
  ck_assert_double_lt(error[1], error[0] / 3);
}
END_TEST

// At any position in the lattice, triangles do not cross, and edges that are not found are
// reported.
START_TEST(edges_anywhere) {
  for (int k = 0; k < 6; ++k) {
    const P at{0.013 * k, 0.027 * k, -0.007 * k};
    const double a = 0.3 * k, b = 0.2 * k;
    const auto moved = [&](const Formula& f) {
      return [f, at, a, b](const P& x) {
        const P y = pnpbs::difference(x, at);
        const double u = std::cos(a) * y[0] - std::sin(a) * y[1],
                     v = std::sin(a) * y[0] + std::cos(a) * y[1];
        return f({u, std::cos(b) * v - std::sin(b) * y[2], std::sin(b) * v + std::cos(b) * y[2]});
      };
    };
    const VolumeDomain found = body(moved(lens), 0.15 + 0.01 * k);
    ck_assert_int_eq(found.summary().patches, 2);
    const Formula octahedron = [](const P& x) {
      return std::fabs(x[0]) + std::fabs(x[1]) + std::fabs(x[2]) - 1;
    };
    const VolumeDomain tried = any_body(moved(octahedron), 0.15 + 0.01 * k);
    ck_assert_int_eq(euler_characteristic(tried), 2);
    ck_assert_double_eq_tol(tried.volume() / (4.0 / 3), 1, 5e-3);
    ck_assert(tried.summary().patches == 8 || !tried.warnings().empty());
  }
}
END_TEST

START_TEST(boxes_of_any_sides) {
  const Box<3> flat{{-1.07, -2.3, -1.01}, {1.2, 1.4, 1.13}};
  ck_assert_double_eq_tol(body(ball(1), 0.1, flat).volume() / (4 * pi / 3), 1, 5e-3);
  // The resolution is so coarse that the octree has one cell.
  ck_assert_int_eq(euler_characteristic(body(ball(1), 1.4)), 2);
}
END_TEST

START_TEST(f_is_asked_near_the_surface) {
  const double h = 3.0 / WHEN_SANITIZED(32, 64);
  std::int64_t asked = 0;
  VolumeDomain domain;
  domain.add_level_set(in_batches(ball(1), &asked), kBox, h, 1);
  ck_assert_int_lt(asked, static_cast<std::int64_t>(40 * 4 * pi / (h * h)));
  // A second ball is far from the first and has 1/150 of the width of the box. f decreases towards
  // it.
  const Formula far = [](const P& x) {
    return std::min(ball(0.5, {0.7, 0.7, 0.7})(x), ball(0.01, {-1.123, -1.234, -0.777})(x));
  };
  ck_assert_int_eq(body(far, 0.01).summary().components, 2);
}
END_TEST

START_TEST(any_slope_will_do) {
  const Formula steep = [](const P& x) { return std::pow(radius(x), 6) - 1; };
  ck_assert_double_eq_tol(body(steep, 0.1).volume() / (4 * pi / 3), 1, 6e-3);
  const Formula step = [](const P& x) { return radius(x) < 1 ? -1.0 : 1.0; };
  const VolumeDomain jump = body(step, 0.1);
  for (const auto& node : jump.mesh().nodes)
    ck_assert_double_eq_tol(radius(node.position), 1, 0.02);
}
END_TEST

// Compares with the gradient of the distance, at two step sizes.
START_TEST(slopes_to_second_order) {
  const LevelSet set("level set 0", in_batches(torus), kBox, 0.1);
  std::vector<P> x;
  std::vector<P> exact;
  for (int k = 0; k < 100; ++k) {
    const double u = 0.37 * k, v = 1.1 * k;
    exact.push_back({std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)});
    x.push_back(pnpbs::shifted({std::cos(u), std::sin(u), 0}, 0.4, exact.back()));
  }
  const auto error = [&](double step) {
    const std::vector<pnpbs::LevelSetSlope> slopes = set.slopes(x, step);
    double largest = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      ck_assert_double_eq_tol(slopes[k].f, 0, 1e-15);
      largest = std::max(largest, pnpbs::distance<3>(slopes[k].normal(), exact[k]));
    }
    return largest;
  };
  ck_assert_double_lt(error(0.4), 0.01);
  ck_assert_double_lt(error(0.2), error(0.4) / 3.5);
  ck_assert_double_gt(error(0.2), error(0.4) / 4.5);
  ck_assert_double_lt(error(LevelSet::kSlopeStep), 1e-9);
  const P on_edge{0.9, 0.9, 0}, smooth{0.9, 0.1, 0};
  const LevelSet box("level set 1", in_batches(cube), kBox, 0.1);
  ck_assert_double_gt(box.slopes({&on_edge, 1})[0].kink, 0.5);
  ck_assert_double_lt(box.slopes({&smooth, 1})[0].kink, 1e-6);
}
END_TEST

// ---------------------------------------------------------------- invalid input
START_TEST(bad_arguments) {
  const double nan = std::nan("");
  for (const double h : {0.0, -1.0, nan, HUGE_VAL, 3.1, 1e-7})
    expect_refused(ErrorKind::argument, {"resolution is", "expected", "to 3"}, ball(1), h);
  expect_refused(ErrorKind::argument, {"high[1] is -1.5"}, ball(1), 0.1,
                 {kBox.low, {1.5, -1.5, 1.5}});
  expect_refused(ErrorKind::argument, {"low[2] is nan"}, ball(1), 0.1, {{0, 0, nan}, kBox.high});
  expect_refused(ErrorKind::argument, {"tag is 0"}, ball(1), 0.1, kBox, 0);
}
END_TEST

START_TEST(bad_functions) {
  expect_refused(ErrorKind::domain, {"level set 0", "negative at none"}, ball(-1));
  expect_refused(ErrorKind::domain, {"level set 0", "negative at", "on the border"}, ball(1.6));
  expect_refused(ErrorKind::domain, {"negative at (-1.5, -1.5, -1.5)", "on the border"}, ball(9));
  expect_refused(ErrorKind::domain, {"f is nan at (", "finite"},
                 [](const P& x) { return radius(x) < 0.5 ? std::nan("") : ball(1)(x); });
  expect_refused(ErrorKind::domain, {"f is inf at ("},
                 [](const P& x) { return x[0] == -1.5 ? HUGE_VAL : ball(1)(x); });
}
END_TEST

// ---------------------------------------------------------------- projection
START_TEST(points_are_put_on_the_surface) {
  const LevelSet set("level set 0", in_batches(torus), kBox, 0.1);
  std::vector<P> x, given;
  for (int k = 0; k < 500; ++k) {
    const double u = 0.37 * k, v = 1.1 * k, r = 0.4 + 0.03 * std::sin(k);
    const double to_axis = 1 + r * std::cos(v);
    x.push_back({to_axis * std::cos(u), to_axis * std::sin(u), r * std::sin(v)});
  }
  x.push_back({0, 0, 1.2});  // too far away
  given = x;
  set.project(x, 0.1);
  for (std::size_t k = 0; k < 500; ++k) {
    ck_assert_double_le(std::fabs(torus(x[k])), 1e-14);
    // The projection is orthogonal: no other surface point is nearer.
    ck_assert_double_eq_tol(pnpbs::distance<3>(x[k], given[k]), std::fabs(torus(given[k])), 1e-6);
  }
  ck_assert(x[500] == given[500]);
  // Single points give the same results as all points together.
  for (std::size_t k = 0; k < x.size(); k += 50) {
    P alone = given[k];
    set.project({&alone, 1}, 0.1);
    ck_assert(alone == x[k]);
  }
}
END_TEST

TEST_SUITE(test_level_set) {
  return run_suite(
      "level set",
      {a_ball_to_second_order, a_torus_has_a_hole, two_balls_apart, a_body_with_a_waist,
       a_gyroid_in_a_ball, surfaces_through_lattice_points, thin_shells, the_edge_of_a_lens,
       an_edge_turned_inwards, edges_and_corners_of_a_box, a_hole_through_a_box, edges_anywhere,
       boxes_of_any_sides, f_is_asked_near_the_surface, any_slope_will_do, slopes_to_second_order,
       bad_arguments, bad_functions, points_are_put_on_the_surface});
}
