// SPDX-License-Identifier: BSD-3-Clause
// The chart of a sphere against angles and lengths in space, great circles, caps and their areas; d
// along the sphere, its growth and the limit of that; and measures of domains of each kind.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/space_vectors.hpp"
#include "domain/plane/plane_domain.hpp"
#include "domain/volume/volume_domain.hpp"
#include "quick_assert.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "spacing/growth_source.hpp"
#include "spacing/sphere_spacing.hpp"
#include "sphere/embedding.hpp"
#include "sphere/great_circle.hpp"
#include "sphere/sphere_cap.hpp"
#include "sphere/stereographic_chart.hpp"

using pnpbs::Embedding, pnpbs::GeometryKind, pnpbs::Point, pnpbs::SphereCap,
    pnpbs::StereographicChart;

namespace {

constexpr double kPi = std::numbers::pi;

Point<3> on_unit_sphere(Random& random) {
  const double z = random.between(-1, 1), turn = random.between(-kPi, kPi);
  const double across = std::sqrt(1 - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

Point<3> from_degrees(double longitude, double latitude) {
  const double a = longitude * kPi / 180, b = latitude * kPi / 180;
  return {std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b)};
}

std::vector<StereographicChart> charts() {
  Random random(5);
  std::vector<StereographicChart> all{{1, {0, 0, -1}}, {6371.22, {0, 0, 2}}};
  for (int k = 0; k < 6; ++k) all.emplace_back(random.between(0.1, 10), on_unit_sphere(random));
  return all;
}

double gap(const Point<3>& a, const Point<3>& b) { return pnpbs::distance<3>(a, b); }

Point<3> times(double factor, const Point<3>& x) { return pnpbs::shifted({}, factor, x); }

}  // namespace

START_TEST(there_and_back) {
  Random random(1);
  for (const StereographicChart& chart : charts())
    for (int k = 0; k < 1000; ++k) {
      const Point<3> x = times(chart.radius(), on_unit_sphere(random));
      const Point<3> back = chart.on_sphere(chart.in_chart(times(3, x)));
      quick_assert(gap(back, x) < 1e-13 * chart.radius() * chart.stretch(chart.in_chart(x)));
      quick_assert(std::fabs(pnpbs::length(back) / chart.radius() - 1) < 1e-15);
    }
}
END_TEST

// Small steps to the east and to the north in the chart are orthogonal on the sphere, have the same
// length over the stretch, and turn left as seen from outside.
START_TEST(it_keeps_angles) {
  Random random(2);
  for (const StereographicChart& chart : charts()) {
    const double step = 1e-5 * chart.radius();
    for (int k = 0; k < 200; ++k) {
      const Point<2> u{random.between(-5, 5) * chart.radius(),
                       random.between(-5, 5) * chart.radius()};
      const Point<3> x = chart.on_sphere(u);
      const auto way = [&](double east, double north) {
        return times(0.5 / step, pnpbs::difference(chart.on_sphere({u[0] + east, u[1] + north}),
                                                   chart.on_sphere({u[0] - east, u[1] - north})));
      };
      const Point<3> east = way(step, 0), north = way(0, step);
      const double stretch = chart.stretch(u);
      quick_assert(std::fabs(pnpbs::dot(east, north)) * stretch * stretch < 1e-6);
      quick_assert(std::fabs(pnpbs::length(east) * stretch - 1) < 1e-6);
      quick_assert(std::fabs(pnpbs::length(north) * stretch - 1) < 1e-6);
      quick_assert(pnpbs::dot(pnpbs::cross(east, north), x) > 0);
    }
  }
}
END_TEST

START_TEST(distances_are_along_the_sphere) {
  Random random(3);
  for (const StereographicChart& chart : charts())
    for (int k = 0; k < 1000; ++k) {
      const Point<3> a = on_unit_sphere(random), b = on_unit_sphere(random);
      const double expected = chart.radius() * std::acos(pnpbs::dot(a, b));
      const double found = chart.distance(chart.in_chart(a), chart.in_chart(b));
      quick_assert_msg(std::fabs(found - expected) < 1e-6 * chart.radius(), "%g, not %g", found,
                       expected);
    }
}
END_TEST

START_TEST(ways_follow_great_circles) {
  Random random(4);
  const StereographicChart chart(2, {0, 0, -1});
  int some = 0;
  for (int k = 0; k < 200; ++k) {
    const Point<3> a = on_unit_sphere(random), b = on_unit_sphere(random);
    if (std::min(a[2], b[2]) < -0.9 || pnpbs::angle_between(a, b) > 2.5) continue;
    std::vector<Point<2>> way{chart.in_chart(a)};
    for (const Point<2>& u : pnpbs::points_on_arc(chart, a, b)) way.push_back(u);
    way.push_back(chart.in_chart(b));
    const Point<3> normal = pnpbs::unit_vector(pnpbs::cross(a, b));
    for (std::size_t p = 0; p + 1 < way.size(); ++p) {
      const Point<3> begin = chart.on_sphere(way[p]), end = chart.on_sphere(way[p + 1]);
      quick_assert(std::fabs(pnpbs::dot(begin, normal)) < 1e-9);
      // The straight segment of the chart deviates little from the great circle, compared with its
      // length.
      const Point<3> middle = chart.on_sphere(pnpbs::middle_of<2>(way[p], way[p + 1]));
      quick_assert(std::fabs(pnpbs::dot(middle, normal)) <= 0.0014 * gap(begin, end));
    }
    some += way.size() > 10;
  }
  ck_assert_int_gt(some, 50);
  // A segment without intermediate points deviates much.
  const Point<2> u = chart.in_chart(from_degrees(0, 0)), v = chart.in_chart(from_degrees(90, 0));
  const Point<3> middle = chart.on_sphere(pnpbs::middle_of<2>(u, v));
  ck_assert_double_gt(std::fabs(middle[2]), 0.5);
}
END_TEST

START_TEST(areas_of_caps) {
  for (const double latitude : {-80.0, -30.0, 0.0, 50.0}) {
    pnpbs::PlaneDomain domain(StereographicChart(3, {0, 0, -1}));
    std::vector<Point<3>> ring;
    for (int k = 0; k < 3600; ++k) ring.push_back(from_degrees(0.1 * k, latitude));
    domain.add_great_circles(pnpbs::CurveRole::boundary, true, ring, nullptr, 0);
    domain.check();
    const double cap = 2 * kPi * 9 * (1 - std::sin(latitude * kPi / 180));
    ck_assert_double_eq_tol(pnpbs::area_on_sphere(domain) / cap, 1, 1e-5);
    // Given vertices are corners; intermediate points are not.
    ck_assert_int_eq(domain.corners().size(), 3600);
  }
  // Seen as an outline from the other side, the domain is the rest of the sphere.
  pnpbs::PlaneDomain rest(StereographicChart(1, from_degrees(0, 90)));
  std::vector<Point<3>> ring;
  for (int k = 0; k < 8; ++k) ring.push_back(from_degrees(45 * k, 80));
  rest.add_great_circles(pnpbs::CurveRole::boundary, true, ring, nullptr, 0);
  rest.check();
  // The octagon around the pole, by l'Huilier's theorem.
  const double side = pnpbs::angle_between(ring[0], ring[1]), around = 10 * kPi / 180;
  const double half = around + side / 2;  // half the perimeter of a triangle with the pole
  const double octagon = 8 * 4 *
                         std::atan(std::tan((half - around) / 2) *
                                   std::sqrt(std::tan(half / 2) * std::tan((half - side) / 2)));
  ck_assert_double_eq_tol(pnpbs::area_on_sphere(rest), 4 * kPi - octagon, 1e-6);
}
END_TEST

// Caps at all distances from the centre of projection, some of which contain it.
START_TEST(caps_hold_what_is_near) {
  Random random(7);
  int around = 0;
  for (const StereographicChart& chart : charts()) {
    const double radius = chart.radius();
    for (int k = 0; k < 300; ++k) {
      const Point<3> near_point = pnpbs::unit_vector(
          pnpbs::shifted(times(1 / radius, chart.projection_centre()),
                         std::pow(10.0, random.between(-3, 0.5)), on_unit_sphere(random)));
      const Point<2> centre = chart.in_chart(near_point);
      const Point<3> at = chart.on_sphere(centre);
      const double length = radius * std::pow(10.0, random.between(-3, 0.25));
      const SphereCap cap(chart, centre, length);
      quick_assert(!cap.is_whole_sphere());
      around += gap(at, chart.projection_centre()) < length;
      for (int l = 0; l < 50; ++l) {
        const Point<2> u = chart.in_chart(
            pnpbs::shifted(at, length * random.between(0, 3), on_unit_sphere(random)));
        const double far = gap(chart.on_sphere(u), at) / length;
        quick_assert(cap.holds(u) || far > 1 - 1e-6);
        quick_assert(!cap.holds(u) || far < 1 + 1e-6);
        // A cap meets a box if it holds a point of it, and does not if the whole box is clearly
        // farther away.
        const double half = std::pow(10.0, random.between(-1, 0.5)) * length *
                            std::min(chart.stretch(u), chart.stretch(centre));
        const pnpbs::Box<2> box{{u[0] - half * random.between(0, 1), u[1] - half},
                                {u[0] + half, u[1] + half * random.between(0, 1)}};
        quick_assert(!cap.holds(u) || cap.meets(box));
        bool held = false;
        for (int s = 0; s <= 40 * 41; ++s) {
          const double a = 0.025 * (s / 41), b = 0.025 * (s % 41);
          held = held || SphereCap(chart, centre, std::min(1.3 * length, 1.79 * radius))
                             .holds({box.low[0] + a * (box.high[0] - box.low[0]),
                                     box.low[1] + b * (box.high[1] - box.low[1])});
        }
        quick_assert(held || !cap.meets(box));
      }
    }
    quick_assert(SphereCap(chart, {0, 0}, 1.81 * radius).is_whole_sphere());
  }
  ck_assert_int_gt(around, 100);
}
END_TEST

// A circle in the chart is held if no point inside it is farther away, also if the smaller part of
// the sphere is outside of it.
START_TEST(caps_hold_circles) {
  Random random(8);
  int some = 0, large = 0;
  for (const StereographicChart& chart : charts())
    for (int k = 0; k < 2000; ++k) {
      const double radius = chart.radius(), reach = std::pow(10.0, random.between(-2, 0.5));
      Point<2> corner[3];
      const Point<3> middle = on_unit_sphere(random);
      for (Point<2>& u : corner)
        u = chart.in_chart(pnpbs::shifted(middle, reach, on_unit_sphere(random)));
      const auto turn = [&] {
        return (corner[1][0] - corner[0][0]) * (corner[2][1] - corner[0][1]) -
               (corner[1][1] - corner[0][1]) * (corner[2][0] - corner[0][0]);
      };
      if (turn() < 0) std::swap(corner[1], corner[2]);
      const Point<3> x = chart.on_sphere(corner[0]), a = chart.on_sphere(corner[1]),
                     b = chart.on_sphere(corner[2]);
      const Point<3> normal =
          pnpbs::unit_vector(pnpbs::cross(pnpbs::difference(a, x), pnpbs::difference(b, x)));
      // The inside is the part of the sphere behind the plane of the circle, or the rest of the
      // sphere.
      const double plane = pnpbs::dot(normal, x);
      const double across = 2 * std::sqrt(std::max(0.0, radius * radius - plane * plane));
      if (std::fabs(plane) < 0.01 * radius || across > 1.7 * radius) continue;
      const bool is_small = plane > 0;
      quick_assert(SphereCap(chart, corner[0], 1.001 * across).holds_circle(corner[1], corner[2]) ==
                   is_small);
      quick_assert(!SphereCap(chart, corner[0], 0.999 * across).holds_circle(corner[1], corner[2]));
      quick_assert(SphereCap(chart, corner[0], 1.9 * radius).holds_circle(corner[1], corner[2]));
      // The centre of projection is never inside.
      quick_assert(pnpbs::dot(normal, chart.projection_centre()) <= plane);
      some += is_small;
      large += !is_small;
    }
  ck_assert_int_gt(some, 1000);
  ck_assert_int_gt(large, 50);
}
END_TEST

// A constant d along the sphere does not grow there, although it does in the chart.
START_TEST(growth_is_along_the_sphere) {
  Random random(6);
  const StereographicChart chart(2, {0, 0, -1});
  const auto constant = std::make_shared<const pnpbs::ConstantSpacing<3>>(0.1);
  const pnpbs::SphereSpacing spacing(constant, chart);
  const pnpbs::GrowthRule<2> rule{0.2, chart};
  for (int k = 0; k < 200; ++k) {
    const Point<2> u[2] = {chart.in_chart(on_unit_sphere(random)),
                           chart.in_chart(on_unit_sphere(random))};
    double d[2];
    spacing.evaluate(2, u, d);
    quick_assert(std::fabs(d[0] / chart.stretch(u[0]) - 0.1) < 1e-12);
    quick_assert(rule.between(u[0], d[0], u[1], d[1]) < 1e-12);
    const double limit = rule.limit({u[0], d[0]}, u[1]) / chart.stretch(u[1]);
    const double way = 2 * pnpbs::angle_between(chart.on_sphere(u[0]), chart.on_sphere(u[1]));
    quick_assert(std::fabs(limit - (0.1 + 0.2 * way)) < 1e-7);
  }
}
END_TEST

namespace {

template <int Dim>
Point<Dim> anywhere(Random& random) {
  Point<Dim> x;
  for (double& part : x) part = random.between(-5, 5);
  return x;
}

// Expects equality to the bit: nodes in the plane and in space do not depend on the embedding.
template <int Dim>
void measures_as_coordinates_are(const Embedding<Dim>& embedding) {
  Random random(7);
  const pnpbs::GrowthRule<Dim> rule{0.2, embedding};
  quick_assert(!embedding.is_sphere() && embedding.radius() == 0);
  quick_assert(embedding.coordinates() == Dim);
  for (int k = 0; k < 200; ++k) {
    const Point<Dim> x = anywhere<Dim>(random), y = anywhere<Dim>(random);
    const double d = random.between(0.1, 3), e = random.between(0.1, 3);
    const double way = pnpbs::distance<Dim>(x, y);
    quick_assert(embedding.measured_length(x, d) == d && embedding.coordinate_length(x, d) == d);
    quick_assert(embedding.distance(x, y) == way);
    const Point<3> in_space = embedding.in_space(x);
    quick_assert(std::equal(x.begin(), x.end(), in_space.begin()));
    quick_assert(Dim == 3 || in_space[2] == 0);
    quick_assert(rule.limit({x, d}, y) == d + 0.2 * way);
    quick_assert(rule.between(x, d, y, e) == std::fabs(d - e) / way);
  }
  pnpbs::Box<Dim> box;
  box.low.fill(-1);
  box.high.fill(100);
  quick_assert(embedding.min_stretch_in(box) == 1 && embedding.max_stretch_in(box) == 1);
  quick_assert(!embedding.varies_much_in(box));
}

}  // namespace

START_TEST(flat_domains_are_measured_as_they_are) {
  measures_as_coordinates_are<2>(pnpbs::PlaneDomain().embedding());
  measures_as_coordinates_are<3>(pnpbs::VolumeDomain::embedding());
}
END_TEST

START_TEST(domains_on_spheres_are_measured_along_them) {
  Random random(8);
  for (const StereographicChart& chart : charts()) {
    const pnpbs::PlaneDomain domain(chart);
    const Embedding<2>& embedding = domain.embedding();
    quick_assert(embedding.is_sphere() && embedding.chart() == chart);
    quick_assert(embedding.radius() == chart.radius() && embedding.coordinates() == 3);
    for (int k = 0; k < 200; ++k) {
      const Point<2> u = chart.in_chart(on_unit_sphere(random)),
                     v = chart.in_chart(on_unit_sphere(random));
      const double d = random.between(0.1, 3);
      quick_assert(embedding.measured_length(u, d) == d / chart.stretch(u));
      quick_assert(embedding.coordinate_length(u, d) == d * chart.stretch(u));
      quick_assert(embedding.distance(u, v) == chart.distance(u, v));
      quick_assert(embedding.in_space(u) == chart.on_sphere(u));
    }
    const pnpbs::Box<2> box{{-1, -1}, {100 * chart.radius(), 1}};
    quick_assert(embedding.min_stretch_in(box) == chart.min_stretch_in(box));
    quick_assert(embedding.max_stretch_in(box) == chart.max_stretch_in(box));
    quick_assert(embedding.varies_much_in(box));
  }
}
END_TEST

START_TEST(kinds_of_domains) {
  pnpbs::VolumeDomain volume;
  ck_assert(pnpbs::PlaneDomain().kind() == GeometryKind::plane);
  ck_assert(pnpbs::PlaneDomain(charts().front()).kind() == GeometryKind::sphere);
  ck_assert(volume.kind() == GeometryKind::body);
  volume.set_filled(false);
  ck_assert(volume.kind() == GeometryKind::surface);
  ck_assert_int_eq(pnpbs::bubble_dimension(GeometryKind::body), 3);
  for (const auto kind : {GeometryKind::plane, GeometryKind::sphere, GeometryKind::surface})
    ck_assert_int_eq(pnpbs::bubble_dimension(kind), 2);
}
END_TEST

TEST_SUITE(test_sphere) {
  return run_kernel_suite(
      "sphere",
      {there_and_back, it_keeps_angles, distances_are_along_the_sphere, ways_follow_great_circles,
       areas_of_caps, caps_hold_what_is_near, caps_hold_circles, growth_is_along_the_sphere,
       flat_domains_are_measured_as_they_are, domains_on_spheres_are_measured_along_them,
       kinds_of_domains});
}
