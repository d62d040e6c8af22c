// SPDX-License-Identifier: BSD-3-Clause
// The description of a volume's domain: volumes and areas against formulas, cavities, holes, inner
// surfaces and curves, fixed nodes, and invalid input.
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/volume/triangles.hpp"
#include "run_suite.hpp"
#include "triangle_soup.hpp"

using namespace soups;

namespace {

constexpr double pi = std::numbers::pi;
const double nan_value = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

void expect_argument_error(std::initializer_list<const char*> parts,
                           const std::function<void(VolumeDomain&)>& add) {
  VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, 1}, 1);
  domain.check();
  expect_error(pnpbs::ErrorKind::argument, parts, [&] { add(domain); });
  ck_assert(domain.is_checked() && domain.volume() == 1);  // unchanged
}

VolumeDomain unit_box() {
  VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, 1}, 1);
  return domain;
}

void add_node(VolumeDomain& domain, const P& x, std::int32_t tag = 5) {
  domain.add_fixed_nodes(1, x.data(), &tag);
}

void add_polyline(VolumeDomain& domain, const std::vector<P>& points, bool closed = false) {
  domain.add_polyline(closed, static_cast<std::int64_t>(points.size()), points[0].data(), nullptr);
}

std::size_t inner_facets(const VolumeDomain& domain) {
  std::size_t count = 0;
  for (const auto& facet : domain.mesh().facets) count += facet.bounds() ? 0 : 1;
  return count;
}

}  // namespace

// ---------------------------------------------------------------- primitives
START_TEST(a_box_has_its_volume_area_tags_and_bounds) {
  VolumeDomain domain;
  domain.add_box({-1, 2, 10}, {1, 5, 14}, {1, 2, 3, 4, 5, 6});
  domain.check();
  ck_assert(domain.is_checked() && domain.warnings().empty());
  ck_assert_double_eq(domain.volume(), 24);
  ck_assert_double_eq(domain.area(), 2 * (6 + 8 + 12));
  ck_assert(domain.bounds().low == P({-1, 2, 10}) && domain.bounds().high == P({1, 5, 14}));
  ck_assert_uint_eq(domain.mesh().facets.size(), 12);
  ck_assert_uint_eq(domain.mesh().nodes.size(), 8);
  for (const auto& facet : domain.mesh().facets) {
    ck_assert(facet.back_inside && !facet.front_inside);
    const int k = (facet.tag - 1) / 2;
    const double side = facet.tag % 2 == 1 ? domain.bounds().low[k] : domain.bounds().high[k];
    for (const P& x : pnpbs::corners_of(domain.mesh(), facet)) ck_assert(x[k] == side);
  }
  const pnpbs::VolumeSummary& summary = domain.summary();
  ck_assert_int_eq(summary.triangles, 12);
  ck_assert_int_eq(summary.components, 1);
}
END_TEST

START_TEST(a_ball_is_within_a_ten_thousandth_of_its_radius) {
  VolumeDomain domain;
  domain.add_ball({3, -2, 1}, 0.25, 7);
  domain.check();
  for (const auto& node : domain.mesh().nodes)
    expect_near(pnpbs::distance<3>(node.position, {3, -2, 1}), 0.25, 1e-14);
  for (const auto& facet : domain.mesh().facets) {
    ck_assert_int_eq(facet.tag, 7);
    const auto corners = pnpbs::corners_of(domain.mesh(), facet);
    const P nearest = pnpbs::nearest_on(corners, {3, -2, 1});
    ck_assert(pnpbs::distance<3>(nearest, {3, -2, 1}) > 0.25 * (1 - 1e-4));
  }
  expect_near(domain.volume(), 4 * pi / 3 * 0.015625, 2e-4);
  expect_near(domain.area(), 4 * pi * 0.0625, 2e-4);
  ck_assert(domain.warnings().empty());
}
END_TEST

START_TEST(cylinders_along_any_axis_have_their_volume) {
  for (const P& end : {P{1, 2, 5}, {0, 0, 4}, {-3, 0, 0}, {1, 1, 0.5}}) {
    VolumeDomain domain;
    domain.add_cylinder({0.5, 0, 0}, end, 0.75, 2);
    domain.check();
    const double height = pnpbs::distance<3>({0.5, 0, 0}, end), n = 256;
    expect_near(domain.volume(), 0.5 * n * std::sin(2 * pi / n) * 0.5625 * height, 1e-13);
    expect_near(domain.volume(), pi * 0.5625 * height, 2e-4);
    expect_near(domain.area(), 2 * pi * 0.75 * (0.75 + height), 2e-4);
    ck_assert(domain.warnings().empty());
  }
}
END_TEST

START_TEST(volumes_of_whole_number_surfaces_are_exact) {
  VolumeDomain domain;
  soup_of(surfaces::pierced_cube()).add_to(domain);
  domain.check();
  ck_assert_double_eq(domain.volume(), 216.0 * (512 - 2 * 3 * 8 - 2 * 2 * 3));
  ck_assert_double_eq(domain.area(), 36.0 * (6 * 64 - 2 * 6 + 2 * (2 + 3) * 8 + 2 * (4 + 6 + 6)));
  ck_assert_int_eq(domain.summary().components, 2);
  const surfaces::Surface sheared = surfaces::sheared(surfaces::pierced_cube());
  VolumeDomain oblique;
  soup_of(sheared).add_to(oblique);
  oblique.check();
  surfaces::Wide six = 0;
  for (std::size_t t = 0; t < sheared.triangles.size(); ++t)
    six += dot(sheared.corner(t, 0), cross(sheared.corner(t, 1), sheared.corner(t, 2)));
  ck_assert_double_eq(oblique.volume(), static_cast<double>(six / 6));
}
END_TEST

// ---------------------------------------------------------------- nesting
START_TEST(every_second_surface_from_outside_bounds_a_cavity) {
  VolumeDomain domain;
  domain.add_box({-4, -4, -4}, {4, 4, 4}, 1);
  domain.add_box({-3, -3, -3}, {3, 3, 3}, 2);
  domain.add_box({-2, -2, -2}, {2, 2, 2}, 3);
  domain.add_box({5, -1, -1}, {6, 1, 1}, 4);
  domain.check();
  ck_assert_double_eq(domain.volume(), 512 - 216 + 64 + 4);
  ck_assert_int_eq(domain.summary().components, 4);
  ck_assert(domain.warnings().empty());
  for (const auto& facet : domain.mesh().facets) {
    ck_assert(facet.back_inside && !facet.front_inside);
    const auto [a, b, c] = pnpbs::corners_of(domain.mesh(), facet);
    if (facet.tag == 4) continue;
    // Normals of the cavity point towards its centre.
    const double towards = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                           a[2] * (b[0] * c[1] - b[1] * c[0]);
    ck_assert_int_eq(towards < 0, facet.tag == 2);
  }
}
END_TEST

START_TEST(a_cavity_may_be_given_either_way_round) {
  const Soup small = soup_of(surfaces::sphere(2, 60)), large = soup_of(surfaces::sphere(2, 600));
  VolumeDomain a, b;
  large.add_to(a);
  small.add_to(a);
  large.add_to(b);
  small.turned().add_to(b);
  a.check();
  b.check();
  ck_assert(a.warnings().empty() && b.warnings().empty());
  ck_assert(a.volume() == b.volume() && a.area() == b.area());
  VolumeDomain one;
  large.add_to(one);
  one.check();
  ck_assert(a.volume() < one.volume() && a.area() > one.area());
}
END_TEST

// ---------------------------------------------------------------- TetGen's files
// Returns nested cubes of sides 8, 2 and 1 with the tags 1, 2 and 3.
pnpbs::SurfaceTriangles cubes_within_each_other() {
  pnpbs::SurfaceTriangles all;
  all.divides = true;
  for (const double half : {4.0, 1.0, 0.5}) {
    VolumeDomain box;
    box.add_box({-half, -half, -half}, {half, half, half}, 1);
    box.check();
    const auto first = static_cast<std::int32_t>(all.vertices.size());
    for (const auto& node : box.mesh().nodes) all.vertices.push_back(node.position);
    for (const auto& facet : box.mesh().facets) {
      const auto& [a, b, c] = facet.nodes;
      all.triangles.push_back({first + a, first + b, first + c});
      all.tags.push_back(1 + first / 8);
    }
  }
  return all;
}

START_TEST(facets_that_divide_bound_regions) {
  pnpbs::SurfaceTriangles cubes = cubes_within_each_other();
  cubes.regions = {{{3, 3, 3}, "region a", 10}, {{0.75, 0, 0}, "region b", 20}};
  VolumeDomain domain;
  domain.add_surface(SurfaceRole::boundary, cubes);
  domain.check();
  ck_assert(domain.warnings().empty());
  ck_assert_double_eq(domain.volume(), 512);
  ck_assert_double_eq(domain.area(), 6 * 64);
  ck_assert_uint_eq(inner_facets(domain), 24);
  ck_assert_int_eq(domain.regions()->tag_at({-2, 0, 0}), 10);
  ck_assert_int_eq(domain.regions()->tag_at({0, -0.75, 0.1}), 20);
  ck_assert_int_eq(domain.regions()->tag_at({0.1, 0.2, 0.3}), 0);
  domain.add_box({-8, -8, -8}, {8, 8, 8}, 4);  // now the file's body is a cavity
  domain.check();
  ck_assert_double_eq(domain.volume(), 4096 - 512);
}
END_TEST

START_TEST(hole_points_make_cavities_of_facets_that_divide) {
  pnpbs::SurfaceTriangles cubes = cubes_within_each_other();
  cubes.holes = {{0.75, 0, 0}};
  VolumeDomain domain;
  domain.add_surface(SurfaceRole::boundary, cubes);
  domain.check();
  ck_assert(domain.warnings().empty());
  ck_assert_double_eq(domain.volume(), 512 - 8 + 1);
  ck_assert_double_eq(domain.area(), 6 * 64 + 6 * 4 + 6);
  ck_assert_uint_eq(inner_facets(domain), 0);
  // An explicit role of a tag takes precedence. The hole point is then outside the domain.
  domain.set_role(2, SurfaceRole::boundary);
  domain.check();
  ck_assert_double_eq(domain.volume(), 512 - 8);
  ck_assert(warns(domain, "hole 0 of surface 0 at (0.75, 0, 0) lies outside the domain"));
  cubes.holes = {{9, 0, 0}};
  VolumeDomain whole;
  whole.add_surface(SurfaceRole::boundary, cubes);
  whole.check();
  ck_assert_double_eq(whole.volume(), 512);
  ck_assert(warns(whole, "left out: hole 0 of surface 0 at (9, 0, 0) lies outside the domain"));
  whole.set_filled(false);
  whole.check();
  ck_assert_double_eq(whole.area(), 6 * 64 + 6 * 4 + 6);
}
END_TEST

START_TEST(sheets_that_divide_are_inner) {
  pnpbs::SurfaceTriangles box = cubes_within_each_other();
  box.triangles.resize(12 + 2);  // the large cube, and a side of the next one
  box.tags.resize(12 + 2);
  VolumeDomain domain;
  domain.add_surface(SurfaceRole::boundary, box);
  domain.check();
  ck_assert_double_eq(domain.volume(), 512);
  ck_assert_uint_eq(inner_facets(domain), 2);
  for (P& x : box.vertices) x[0] += 0.25 * (&x - box.vertices.data() >= 8 ? 40 : 0);
  VolumeDomain outside;
  outside.add_surface(SurfaceRole::boundary, box);
  expect_domain_error(outside, {"the boundary is not closed"});
}
END_TEST

// ---------------------------------------------------------------- holes, inner surfaces
START_TEST(holes_take_out_what_lies_between_surfaces) {
  VolumeDomain domain;
  domain.add_box({-4, -4, -4}, {4, 4, 4}, 1);
  VolumeDomain inner_box;
  inner_box.add_box({-1, -1, -1}, {1, 1, 1}, 2);
  inner_box.check();
  Soup soup;
  for (const auto& node : inner_box.mesh().nodes)
    soup.vertex(node.position[0], node.position[1], node.position[2]);
  for (const auto& facet : inner_box.mesh().facets)
    soup.triangle(facet.nodes[0], facet.nodes[2], facet.nodes[1], 3);
  soup.add_to(domain, SurfaceRole::inner);
  domain.check();
  ck_assert_double_eq(domain.volume(), 512);
  ck_assert_double_eq(domain.area(), 6 * 64);
  ck_assert_uint_eq(inner_facets(domain), 12);
  domain.add_hole({0.5, 0.25, 0});
  ck_assert(!domain.is_checked());
  domain.check();
  ck_assert_double_eq(domain.volume(), 512 - 8);
  ck_assert_uint_eq(inner_facets(domain), 0);
  domain.add_hole({0, 0, 0});
  domain.check();
  ck_assert(warns(domain, "hole 1 at (0, 0, 0) lies in the same region as hole 0"));
  VolumeDomain shell = domain;
  shell.add_hole({3, 3, 3});
  expect_domain_error(shell, {"the holes leave nothing of the domain"});
  VolumeDomain outside = domain;
  outside.add_hole({5, 0, 0});
  expect_domain_error(outside, {"hole 2 at (5, 0, 0) lies outside the domain"});
  VolumeDomain on = domain;
  on.add_hole({4, 1, 2});
  expect_domain_error(on, {"hole 2 at (4, 1, 2) lies on triangle", "of box 0: move it"});
}
END_TEST

START_TEST(an_inner_sheet_divides_a_body_where_it_is_joined_to_it) {
  // The upper half of a box with two storeys, whose sides have edges along the floor between them.
  Soup box;
  for (const double z : {0.0, 1.0, 3.0})
    for (const P& x : {P{0, 0}, {1, 0}, {1, 1}, {0, 1}}) box.vertex(x[0], x[1], z);
  const auto quad = [&](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
    box.triangle(a, b, c);
    box.triangle(a, c, d);
  };
  quad(0, 3, 2, 1);
  quad(8, 9, 10, 11);
  for (const std::int64_t low : {0, 4})
    for (std::int64_t k = 0; k < 4; ++k)
      quad(low + k, low + (k + 1) % 4, low + 4 + (k + 1) % 4, low + 4 + k);
  const Soup floor = sheet({0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1});
  for (const double z : {0.5, 2.0}) {
    VolumeDomain domain;
    box.add_to(domain);
    floor.add_to(domain, SurfaceRole::inner);
    domain.check();
    ck_assert_double_eq(domain.volume(), 3);
    ck_assert_uint_eq(inner_facets(domain), 2);
    ck_assert_uint_eq(domain.mesh().nodes.size(), 12);
    domain.add_hole({0.5, 0.25, z});
    domain.check();
    ck_assert_double_eq(domain.volume(), z < 1 ? 2 : 1);
    ck_assert_double_eq(domain.area(), z < 1 ? 10 : 6);
    ck_assert_uint_eq(inner_facets(domain), 0);
    ck_assert(warns(domain, "outside the domain and left out: 10 triangles of surface 0"));
  }
}
END_TEST

START_TEST(open_inner_surfaces_divide_nothing_and_are_left_out_outside) {
  VolumeDomain domain = unit_box();
  const Soup inside = sheet({.25, .25, .5}, {.75, .25, .5}, {.75, .75, .5}, {.25, .75, .75});
  inside.add_to(domain, SurfaceRole::inner);
  inside.shifted(3, 0, 0).add_to(domain, SurfaceRole::inner);
  domain.check();
  ck_assert_double_eq(domain.volume(), 1);
  ck_assert_uint_eq(inner_facets(domain), 2);
  ck_assert(warns(domain, "outside the domain and left out: 2 triangles of surface 1"));
  ck_assert(domain.bounds().high[0] == 1);
  VolumeDomain crossing = unit_box();
  inside.shifted(0.5, 0, 0).add_to(crossing, SurfaceRole::inner);
  expect_domain_error(crossing, {"of box 0 and triangle", "of surface 0 cross at (1"});
}
END_TEST

// ---------------------------------------------------------------- inner curves
START_TEST(polylines_become_segments_of_the_mesh) {
  VolumeDomain domain = unit_box();
  const std::vector<double> xyz{0, 0, 0, 0.5, 0.5, 0.5, 0.5, 0.75, 0.5};
  const std::int32_t tags[] = {4, 9};
  domain.add_polyline(false, 3, xyz.data(), tags);
  add_polyline(domain, {{0.5, 0.75, 0.5}, {0.25, 0.5, 0.75}, {0.25, 0.5, 0.5}}, true);
  add_polyline(domain, {{1, 1, 1}, {1, 0, 1}});  // along an edge
  add_polyline(domain, {{2, 1, 1}, {3, 0, 1}});
  domain.check();
  const auto& mesh = domain.mesh();
  ck_assert_uint_eq(mesh.facets.size(), 12 + 2 + 3 + 1);
  ck_assert_uint_eq(mesh.nodes.size(), 8 + 2 + 2);
  for (std::size_t f = 12; f < mesh.facets.size(); ++f) {
    ck_assert(!mesh.facets[f].bounds());
    ck_assert(mesh.facets[f].nodes[1] == mesh.facets[f].nodes[2]);
  }
  ck_assert_int_eq(mesh.facets[12].tag, 4);
  ck_assert_int_eq(mesh.facets[13].tag, 9);
  ck_assert(warns(domain, "left out: segment 0 of polyline 3"));
  ck_assert_double_eq(domain.volume(), 1);
}
END_TEST

START_TEST(polylines_that_meet_surfaces_or_each_other_are_told) {
  const std::vector<P> way{{0.5, 0.5, 0.5}, {0.5, 0.75, 0.5}};
  const auto expect = [&](std::vector<P> other, std::initializer_list<const char*> parts) {
    VolumeDomain domain = unit_box();
    add_polyline(domain, way);
    add_polyline(domain, other);
    expect_domain_error(domain, parts);
  };
  expect({{0.25, 0.5, 0.5}, {1.5, 0.25, 0.5}},
         {"segment 0 of polyline 1 meets triangle", "of box 0 at (1, 0.35"});
  expect({{0.25, 0.5, 0.25}, {0.25, 0.25, 0}},
         {"segment 0 of polyline 1 meets triangle", "of box 0 at (0.25, 0.25, 0)"});
  expect({{0, 0, 0}, {0.5, 0.75, 0}}, {"segment 0 of polyline 1 meets triangle"});
  expect({{0.25, 0.5, 0.5}, {0.75, 0.75, 0.5}},
         {"segment 0 of polyline 0 and segment 0 of polyline 1 meet at (0.5, 0.625, 0.5)"});
  expect({{0.25, 0.5, 0.5}, {0.5, 0.625, 0.5}, {0.75, 0.5, 0.5}},
         {"segment 0 of polyline 0 and segment 0 of polyline 1 meet at (0.5, 0.625, 0.5)"});
  expect({{0.5, 0.25, 0.5}, {0.5, 0.5, 0.5}, {0.5, 0.625, 0.5}},
         {"segment 0 of polyline 0 and segment 1 of polyline 1 overlap at (0.5, 0.5, 0.5)"});
  expect({{0.5, 0.25, 0.5}, {0.5, 0.25, 0.5 + 1e-12}},
         {"segment 0 of polyline 1 is too short at (0.5, 0.25, 0.5)"});
  VolumeDomain near = unit_box();
  add_polyline(near, {{0.5, 0.25, 1e-14}, {0.5, 0.5, 0.5}});
  expect_domain_error(near,
                      {"segment 0 of polyline 0 lies on triangle",
                       "of box 0 at (0.5, 0.25, 1e-14): it must be a vertex of the surface there"});
}
END_TEST

// ---------------------------------------------------------------- fixed nodes
START_TEST(fixed_nodes_are_inside_or_at_vertices) {
  VolumeDomain domain = unit_box();
  add_polyline(domain, {{0.5, 0.5, 0.5}, {0.5, 0.75, 0.5}});
  add_node(domain, {0.25, 0.5, 0.75}, 5);
  add_node(domain, {1, 1, 0}, 6);
  add_node(domain, {0.5, 0.75, 0.5}, 7);
  domain.check();
  ck_assert_uint_eq(domain.fixed_nodes().size(), 3);
  ck_assert_uint_eq(domain.mesh().nodes.size(), 8 + 2 + 1);
  const auto& facets = domain.mesh().facets;
  for (std::size_t i = 0; i < 3; ++i) {  // they have the last facets
    const pnpbs::FixedNode<3>& node = domain.fixed_nodes()[i];
    const auto& [a, b, c] = facets[facets.size() - 3 + i].nodes;
    const auto& there = domain.mesh().nodes[static_cast<std::size_t>(a)];
    ck_assert(a == b && b == c && there.position == node.position && there.tag == node.tag);
  }
  const auto expect = [&](const P& x, std::initializer_list<const char*> parts) {
    VolumeDomain other = domain;
    add_node(other, x);
    expect_domain_error(other, parts);
  };
  expect({1.5, 0, 0}, {"fixed node 3 at (1.5, 0, 0) lies outside the domain"});
  expect({1, 0.25, 0.5}, {"fixed node 3 lies on triangle",
                          "of box 0 at (1, 0.25, 0.5): it must be a vertex of the surface there"});
  expect({0.5, 0.625, 0.5}, {"fixed node 3 at (0.5, 0.625, 0.5) lies on segment 0 of polyline 0"});
  expect({0.25, 0.5, 0.75}, {"fixed node 0 and fixed node 3 are both at (0.25, 0.5, 0.75)"});
  expect({0.25, 0.5, 0.75 + 1e-12}, {"fixed node 0 and fixed node 3 are too close"});
}
END_TEST

// ---------------------------------------------------------------- invalid input
START_TEST(wrong_arguments_are_named_with_their_value) {
  const std::vector<double> xyz{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::int64_t corners[] = {0, 1, 2};
  const auto add = [&](std::vector<double> coordinates, std::vector<std::int64_t> ends,
                       std::int32_t tag, double angle) {
    return [=](VolumeDomain& domain) {
      domain.add_surface(SurfaceRole::boundary, 3, coordinates.data(), 1, ends.data(), &tag, angle);
    };
  };
  for (const double bad : {nan_value, infinity, 2e60}) {
    std::vector<double> wrong = xyz;
    wrong[7] = bad;
    expect_argument_error({"coordinates[2][1] is", "expected a number between -1e60 and 1e60"},
                          add(wrong, {0, 1, 2}, 1, 40));
  }
  expect_argument_error({"corners[0][2] is 3, expected a vertex from 0 to 2"},
                        add(xyz, {0, 1, 3}, 1, 40));
  expect_argument_error({"corners[0][0] is -1"}, add(xyz, {-1, 1, 2}, 1, 40));
  expect_argument_error({"tags[0] is 0, expected a nonzero tag"}, add(xyz, {0, 1, 2}, 0, 40));
  expect_argument_error({"feature_angle is nan"}, add(xyz, {0, 1, 2}, 1, nan_value));
  expect_argument_error({"feature_angle is 181, expected 0 to 180"}, add(xyz, {0, 1, 2}, 1, 181));
  const auto role = SurfaceRole::boundary;
  expect_argument_error({"coordinates is NULL"}, [&](VolumeDomain& d) {
    d.add_surface(role, 3, nullptr, 1, corners, nullptr);
  });
  expect_argument_error({"corners is NULL"}, [&](VolumeDomain& d) {
    d.add_surface(role, 3, xyz.data(), 1, nullptr, nullptr);
  });
  expect_argument_error({"vertices is 2, expected at least 3"}, [&](VolumeDomain& d) {
    d.add_surface(role, 2, xyz.data(), 1, corners, nullptr);
  });
  expect_argument_error({"triangles is 0, expected at least 1"}, [&](VolumeDomain& d) {
    d.add_surface(role, 3, xyz.data(), 0, corners, nullptr);
  });
  expect_argument_error({"high[1] is 0, expected more than low[1], which is 0"},
                        [](VolumeDomain& d) {
                          d.add_box({0, 0, 0}, {1, 0, 1}, 1);
                        });
  expect_argument_error({"low[2] is nan"}, [](VolumeDomain& d) {
    d.add_box({0, 0, nan_value}, {1, 1, 1}, 1);
  });
  expect_argument_error({"tags[3] is 0"}, [](VolumeDomain& d) {
    d.add_box({0, 0, 0}, {1, 1, 1}, {1, 1, 1, 0, 1, 1});
  });
  expect_argument_error({"radius is -1"}, [](VolumeDomain& d) { d.add_ball({0, 0, 0}, -1, 1); });
  expect_argument_error({"the ball reaches (", "beyond 1e60"}, [](VolumeDomain& d) {
    d.add_ball({1e60, 0, 0}, 1e60, 1);
  });
  expect_argument_error({"tag is 0"}, [](VolumeDomain& d) { d.add_ball({0, 0, 0}, 1, 0); });
  expect_argument_error({"begin and end are both (1, 2, 3)"}, [](VolumeDomain& d) {
    d.add_cylinder({1, 2, 3}, {1, 2, 3}, 1, 1);
  });
  expect_argument_error({"end[0] is inf"}, [](VolumeDomain& d) {
    d.add_cylinder({1, 2, 3}, {infinity, 2, 3}, 1, 1);
  });
  expect_argument_error({"point[2] is nan"}, [](VolumeDomain& d) {
    d.add_hole({0, 0, nan_value});
  });
  expect_argument_error({"n is 1, expected at least 2"},
                        [&](VolumeDomain& d) { d.add_polyline(false, 1, xyz.data(), nullptr); });
  expect_argument_error({"vertices 0 and 1 are both (0, 0, 0)"}, [](VolumeDomain& d) {
    add_polyline(d, {{0, 0, 0}, {0, 0, 0}});
  });
  expect_argument_error({"n is -1"},
                        [&](VolumeDomain& d) { d.add_fixed_nodes(-1, xyz.data(), nullptr); });
}
END_TEST

START_TEST(domains_without_a_boundary_or_size_are_refused) {
  VolumeDomain empty;
  expect_domain_error(empty, {"the domain has no surfaces"});
  VolumeDomain inner;
  unit_tetrahedron().add_to(inner, SurfaceRole::inner);
  expect_domain_error(inner, {"the domain has no boundary surface, only inner ones"});
  VolumeDomain tiny;
  tiny.add_box({0, 0, 0}, {1e-61, 1e-61, 1e-61}, 1);
  expect_domain_error(tiny, {"the domain's size is 1e-61, less than 1e-60"});
  VolumeDomain far;
  far.add_box({1e12, 0, 0}, {1e12 + 1, 1, 1}, 1);
  expect_domain_error(far, {"the domain's size is 1, less than 1e-10 of its distance from the "
                            "origin, as at (1e+12, 0, 0)",
                            "move the domain closer to the origin"});
}
END_TEST

START_TEST(any_scale_and_place_gives_the_same_domain) {
  const Soup soup = soup_of(surfaces::sphere(2, 600));
  VolumeDomain reference;
  soup.add_to(reference);
  reference.check();
  for (const double scale : {0x1p-190, 0x1p190}) {
    Soup scaled = soup;
    for (double& x : scaled.xyz) x *= scale;
    VolumeDomain domain;
    scaled.add_to(domain);
    domain.check();
    ck_assert_double_eq(domain.volume(), reference.volume() * scale * scale * scale);
    ck_assert(domain.warnings().empty());
  }
  VolumeDomain moved;
  soup.shifted(1e6, -1e9, 3).add_to(moved);
  moved.check();
  ck_assert_double_eq(moved.volume(), reference.volume());
}
END_TEST

START_TEST(of_several_feature_angles_the_smallest_holds) {
  VolumeDomain domain = unit_box();
  const Soup soup = unit_tetrahedron().shifted(2, 0, 0);
  domain.add_surface(SurfaceRole::boundary, 4, soup.xyz.data(), 4, soup.corners.data(), nullptr,
                     25);
  domain.check();
  ck_assert(warns(domain, "the smallest feature_angle, 25 degrees, holds for all surfaces"));
}
END_TEST

TEST_SUITE(test_volume_shapes) {
  return run_suite(
      "volume_shapes",
      {a_box_has_its_volume_area_tags_and_bounds, a_ball_is_within_a_ten_thousandth_of_its_radius,
       cylinders_along_any_axis_have_their_volume, volumes_of_whole_number_surfaces_are_exact,
       every_second_surface_from_outside_bounds_a_cavity, a_cavity_may_be_given_either_way_round,
       facets_that_divide_bound_regions, hole_points_make_cavities_of_facets_that_divide,
       sheets_that_divide_are_inner, holes_take_out_what_lies_between_surfaces,
       an_inner_sheet_divides_a_body_where_it_is_joined_to_it,
       open_inner_surfaces_divide_nothing_and_are_left_out_outside,
       polylines_become_segments_of_the_mesh, polylines_that_meet_surfaces_or_each_other_are_told,
       fixed_nodes_are_inside_or_at_vertices, wrong_arguments_are_named_with_their_value,
       domains_without_a_boundary_or_size_are_refused, any_scale_and_place_gives_the_same_domain,
       of_several_feature_angles_the_smallest_holds});
}
