// SPDX-License-Identifier: BSD-3-Clause
// Bodies from triangles that do not properly enclose them: the winding number against the sum of
// all solid angles, and the inside, volumes and distances against those of the intended body.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/space_vectors.hpp"
#include "expect_error.hpp"
#include "geometry/volume/winding_number.hpp"
#include "implicit/repaired_body.hpp"
#include "run_suite.hpp"
#include "triangle_soup.hpp"

using pnpbs::ErrorKind;
using pnpbs::FacetCorners;
using pnpbs::RepairedBody;
using pnpbs::VolumeDomain;
using soups::P;
using soups::Soup;

namespace {

using Triangles = std::vector<FacetCorners<3>>;

Triangles triangles_of(const Soup& soup) {
  Triangles triangles;
  for (std::size_t t = 0; t < soup.corners.size(); t += 3) {
    FacetCorners<3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        corners[k][c] = soup.xyz[3 * static_cast<std::size_t>(soup.corners[t + k]) + c];
    triangles.push_back(corners);
  }
  return triangles;
}

// Returns the unit cube with 2 n^2 triangles on each side.
Soup cube(int n) {
  Soup soup;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int high = 0; high < 2; ++high) {
      const auto vertex = [&](int i, int j) {
        P x;
        x[axis] = high;
        x[(axis + 1) % 3] = static_cast<double>(i) / n;
        x[(axis + 2) % 3] = static_cast<double>(j) / n;
        return soup.vertex(x[0], x[1], x[2]);
      };
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const std::array<std::int64_t, 4> v{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1),
                                              vertex(i, j + 1)};
          soup.triangle(v[0], v[1], v[2]);
          soup.triangle(v[0], v[2], v[3]);
          for (const std::int64_t back : {1, 2})
            if (high == 0) soup.turn(soup.triangles() - back);
        }
    }
  return soup;
}

// Returns two narrow pyramids with their tips at the centre of the unit cube.
Soup needles() {
  Soup soup;
  const std::int64_t tip = soup.vertex(0.5, 0.5, 0.5);
  for (const int end : {0, 1}) {
    std::array<std::int64_t, 4> base;
    for (std::size_t k = 0; k < 4; ++k)
      base[k] = soup.vertex(0.4 + (k == 1 || k == 2 ? 0.2 : 0), 0.4 + (k >= 2 ? 0.2 : 0), end);
    soup.triangle(base[0], base[2], base[1]);
    soup.triangle(base[0], base[3], base[2]);
    for (std::size_t k = 0; k < 4; ++k) soup.triangle(base[k], base[(k + 1) % 4], tip);
    for (std::int64_t t = 1; end == 1 && t <= 6; ++t) soup.turn(soup.triangles() - t);
  }
  return soup;
}

Soup without(Soup soup, std::int64_t from, std::int64_t count) {
  const auto at = static_cast<std::ptrdiff_t>(from), n = static_cast<std::ptrdiff_t>(count);
  soup.corners.erase(soup.corners.begin() + 3 * at, soup.corners.begin() + 3 * (at + n));
  soup.tags.erase(soup.tags.begin() + at, soup.tags.begin() + at + n);
  return soup;
}

Soup both(Soup a, const Soup& b) {
  a.add(b);
  return a;
}

Soup scaled(Soup soup, double by) {
  for (double& x : soup.xyz) x *= by;
  return soup;
}

double sum_of_windings(const Triangles& triangles, const P& x) {
  double sum = 0;
  for (const FacetCorners<3>& triangle : triangles) sum += pnpbs::winding_of(triangle, x);
  return sum;
}

std::vector<P> random_points(std::size_t n, double low, double high) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(low, high);
  std::vector<P> points(n);
  for (P& x : points)
    for (double& c : x) c = along(random);
  return points;
}

START_TEST(windings_of_a_cube_are_whole) {
  const Triangles triangles = triangles_of(cube(3));
  for (const P& x : random_points(200, -1, 2)) {
    const bool inside = std::all_of(x.begin(), x.end(), [](double c) { return c > 0 && c < 1; });
    ck_assert_double_eq_tol(sum_of_windings(triangles, x), inside ? 1 : 0, 1e-9);
  }
  // The side of a cube covers a sixth of the solid angle, as seen from the centre.
  const Triangles side = triangles_of(without(cube(1), 2, 10));
  ck_assert_double_eq_tol(sum_of_windings(side, {0.5, 0.5, 0.5}), 1.0 / 6, 1e-12);
}
END_TEST

START_TEST(windings_by_the_tree_are_near_the_sum) {
  const Soup soup = both(without(cube(20), 100, 150), scaled(cube(12), 0.8).shifted(0.5, 0.4, 0.3));
  const Triangles triangles = triangles_of(soup);
  const pnpbs::WindingNumber winding(triangles);
  double worst = 0;
  for (const P& x : random_points(500, -0.5, 1.5))
    worst = std::max(worst, std::fabs(winding(x) - sum_of_windings(triangles, x)));
  ck_assert_double_lt(worst, 0.015);
  ck_assert_double_eq(pnpbs::WindingNumber(Triangles{})({0, 0, 0}), 0);
}
END_TEST

// ------------------------------------------------------------------ bodies ---------------------

struct Case {
  const char* name;
  Soup soup;
  double volume;
  double off = 0.01;   // relative error of the volume
  bool turns = false;  // triangles are turned or dropped before winding numbers are computed
};

// Displaces each vertex of each triangle by at most `by` in each direction.
Soup shaken(Soup soup, double by) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> along(-by, by);
  for (double& x : soup.xyz) x += along(random);
  return soup;
}

std::vector<Case> cases() {
  const Soup whole = cube(4);
  Soup turned = whole;
  for (std::int64_t t = 0; t < turned.triangles(); t += 3) turned.turn(t);
  const Soup other = whole.shifted(0.55, 0.55, 0.55);
  Soup bar = cube(1);
  for (std::size_t x = 0; x < bar.xyz.size(); x += 3) {
    bar.xyz[x] = 0.3 + 0.1 * bar.xyz[x];
    bar.xyz[x + 1] = 0.45 + 0.1 * bar.xyz[x + 1];
    bar.xyz[x + 2] += 0.5;
  }
  const Soup small = scaled(whole, 0.5).shifted(0.25, 0.25, 0.25);
  return {
      {"whole", whole, 1},
      {"torn", whole.torn(), 1},
      {"inside out", whole.turned(), 1},
      {"turned here and there", turned, 1, 0.01, true},
      {"torn by rounding, and turned", shaken(turned.torn(), 1e-5), 1, 0.01, true},
      {"triangles twice, in both ways", both(whole, whole.turned()), 1, 0.01, true},
      {"some triangles twice, and turned", both(turned, without(whole, 0, 100)), 1, 0.01, true},
      {"a triangle is missing", without(whole, 40, 1), 1},
      {"a fifth of a side is missing", without(whole, 40, 6), 1, 0.02},
      {"triangles twice", both(whole, whole), 1},
      {"crossing", both(whole, other), 1.908875},
      {"crossing and open", both(without(whole, 5, 1), without(other, 180, 1)), 1.908875, 0.02},
      {"one within another", both(whole, small), 1},
      {"a cavity", both(whole, small.turned()), 0.875},
      {"a sheet that sticks out", both(whole, without(cube(1), 2, 10).shifted(0.5, 0.3, 0.7)), 1},
      {"a bar through the middle of a triangle", both(cube(1), bar), 1.005, 0.02},
      {"needles that touch", needles(), 0.04 / 3, 0.2}};
}

VolumeDomain repaired(const Soup& soup, double resolution) {
  VolumeDomain domain;
  soup.add_to(domain);
  domain.set_repair(resolution, true);  // repairs valid surfaces as well
  domain.check();
  return domain;
}

START_TEST(bodies_are_what_triangles_enclose) {
  const Case the = cases()[static_cast<std::size_t>(_i)];
  const VolumeDomain domain = repaired(the.soup, 0.1);
  ck_assert_msg(std::fabs(domain.volume() / the.volume - 1) < the.off, "%s: %g", the.name,
                domain.volume());
}
END_TEST

// The sides of triangles agree with the winding numbers where they determine what is inside.
START_TEST(signs_are_those_of_the_windings) {
  const Case the = cases()[static_cast<std::size_t>(_i)];
  pnpbs::SurfaceSource source;
  const Triangles given = triangles_of(the.soup);
  VolumeDomain domain = repaired(the.soup, 0.1);
  const pnpbs::LevelSet& set = *domain.level_sets().sets.back();
  std::vector<P> points = random_points(1000, -0.09, 1.09);
  std::mt19937 random(3);
  std::normal_distribution<double> off(0, 0.01);
  for (const P& x : random_points(1000, 0, 1)) {  // near the triangles
    const FacetCorners<3>& t = given[random() % given.size()];
    P near = pnpbs::shifted(t[0], x[0], pnpbs::difference(t[1], t[0]));
    near = pnpbs::shifted(near, (1 - x[0]) * x[1], pnpbs::difference(t[2], t[0]));
    const bool at_tip = random() % 4 == 0;
    for (double& c : near) c = (at_tip ? 0.5 : c) + off(random);
    points.push_back(near);
  }
  if (the.turns) return;
  const std::vector<double> f = set.values(points);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double winding = std::fabs(sum_of_windings(given, points[k]));
    if (std::fabs(winding - 0.5) < 0.05) continue;
    ck_assert_msg((f[k] < 0) == (winding > 0.5), "%s: %g at (%g, %g, %g), wound around %g times",
                  the.name, f[k], points[k][0], points[k][1], points[k][2], winding);
  }
}
END_TEST

START_TEST(edges_stay_sharp) {
  const VolumeDomain domain = repaired(without(cube(4), 41, 1), 0.05);
  ck_assert_int_eq(domain.summary().corners, 8);
  ck_assert_int_eq(domain.summary().patches, 6);
  for (const pnpbs::BoundaryNode<3>& node : domain.mesh().nodes)
    for (const double c : node.position) ck_assert(c > -1e-3 && c < 1 + 1e-3);
}
END_TEST

RepairedBody body_of(const Soup& soup, double resolution) {
  pnpbs::SurfaceSource source;
  for (std::size_t v = 0; v < soup.xyz.size(); v += 3)
    source.vertices.push_back({soup.xyz[v], soup.xyz[v + 1], soup.xyz[v + 2]});
  for (std::size_t t = 0; t < soup.corners.size(); t += 3)
    source.triangles.push_back({static_cast<std::int32_t>(soup.corners[t]),
                                static_cast<std::int32_t>(soup.corners[t + 1]),
                                static_cast<std::int32_t>(soup.corners[t + 2])});
  source.tags = soup.tags;
  return pnpbs::repaired_body({source}, resolution);
}

START_TEST(distances_are_told) {
  const RepairedBody body =
      body_of(both(cube(4), scaled(cube(4), 0.5).shifted(0.25, 0.25, 0.25)), 0.05);
  ck_assert_double_eq(body.distances.resolution, 0.05);
  ck_assert_double_lt(body.distances.to_given, 1e-3);
  ck_assert_double_eq(body.distances.over_holes, 0);
  ck_assert_double_le(body.distances.mean_to_given, body.distances.to_given);
  ck_assert_double_eq_tol(body.distances.lost, 0.25 / 1.25, 1e-9);  // the inner one
  ck_assert_double_eq_tol(body.distances.to_new, 0.25, 1e-3);
  const std::string text = text_of(body);
  ck_assert(text.find("with a resolution of 0.05") != std::string::npos);
  ck_assert(text.find("close holes") == std::string::npos);
  ck_assert(text.find("20 percent") != std::string::npos);
}
END_TEST

// The given triangles are far from the surface over a closed hole, which is not an error.
START_TEST(distances_over_holes_are_told_apart) {
  const RepairedBody lidless = body_of(without(cube(4), 0, 32), 0.05);
  ck_assert_double_lt(lidless.distances.to_given, 1e-3);
  ck_assert_double_eq_tol(lidless.distances.over_holes, 0.5, 0.05);  // to the centre of the lid
  ck_assert_double_eq_tol(lidless.distances.mean_to_given, 1. / 6 / 6, 0.005);
  ck_assert_double_lt(lidless.distances.to_new, 0.05);
  ck_assert_double_eq(lidless.distances.lost, 0);
  ck_assert(text_of(lidless).find("where they close holes, within 0.") != std::string::npos);
}
END_TEST

// Distances are measured at points all over large triangles, not only at their centres.
START_TEST(distances_are_those_of_large_triangles) {
  const Soup sheet = without(cube(1), 2, 10).shifted(0.5, 0.3, 0.7);  // sticks out
  const RepairedBody body = body_of(both(cube(1), sheet), 0.05);
  ck_assert_double_eq_tol(body.distances.to_new, std::hypot(0.3, 0.7), 1e-3);
}
END_TEST

START_TEST(what_cannot_be_is_refused) {
  VolumeDomain domain;
  expect_error(ErrorKind::argument, {"resolution is -1"}, [&] { domain.set_repair(-1); });
  expect_error(ErrorKind::argument, {"resolution is nan"}, [&] { domain.set_repair(NAN); });
  expect_error(ErrorKind::domain, {"repair: the triangles enclose nothing"},
               [&] { repaired(without(cube(1), 2, 10), 0); });
  expect_error(ErrorKind::domain, {"repair: the resolution is 3", "longest side"},
               [&] { repaired(cube(1), 3); });
  // The message names the function that repairs if no repair is set.
  VolumeDomain open;
  without(cube(2), 3, 1).add_to(open);
  expect_error(ErrorKind::domain, {"not closed", "pnpbs_domain_set_repair"}, [&] { open.check(); });
  open.set_repair(0.1);
  open.check();
  ck_assert_double_eq_tol(open.volume(), 1, 0.02);
  VolumeDomain crossing;
  both(cube(1), cube(1).shifted(0.5, 0.4, 0.3)).add_to(crossing);
  expect_error(ErrorKind::domain, {"cross", "--repair"}, [&] { crossing.check(); });
}
END_TEST

// Returns a wavy sheet from (2, 0) to (3, 1), which encloses nothing, although its winding number
// slightly exceeds one half beside the waves.
Soup sheet() {
  constexpr int kCount = 24;
  Soup soup;
  const auto vertex = [&](int i, int j) {
    const double x = static_cast<double>(i) / kCount, y = static_cast<double>(j) / kCount;
    return soup.vertex(2 + x, y, 0.5 + 0.015 * std::sin(15 * x) * std::cos(11 * y));
  };
  for (int i = 0; i < kCount; ++i)
    for (int j = 0; j < kCount; ++j) {
      soup.triangle(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      soup.triangle(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  return soup;
}

START_TEST(crumbs_of_sheets_are_none) {
  expect_error(ErrorKind::domain, {"repair: the triangles enclose nothing", "--surfaces-only"},
               [&] { repaired(sheet(), 0.03); });
  const VolumeDomain domain = repaired(both(cube(4), sheet()), 0.03);
  ck_assert_double_eq_tol(domain.volume(), 1, 0.01);
  ck_assert_double_lt(domain.bounds().high[0], 1.1);
  const auto& warnings = domain.warnings();
  ck_assert_int_eq(std::count_if(warnings.begin(), warnings.end(),
                                 [](const pnpbs::Warning& warning) {
                                   return warning.code == pnpbs::WarningCode::pieces_left_out &&
                                          warning.point().has_value();
                                 }),
                   1);
}
END_TEST

VolumeDomain repaired_if_broken(const Soup& soup) {
  VolumeDomain domain;
  soup.add_to(domain);
  domain.set_repair(0.1);
  domain.check();
  return domain;
}

bool is_repaired(const VolumeDomain& domain) {
  const bool repaired = domain.repair_distances().resolution > 0;
  std::int64_t told = 0, not_repaired = 0;
  for (const pnpbs::Warning& warning : domain.warnings()) {
    told += warning.code == pnpbs::WarningCode::repaired;
    not_repaired += warning.message.text().find("not repaired: the body is sound") == 0;
  }
  ck_assert_int_eq(told, 1);
  ck_assert_int_eq(not_repaired, repaired ? 0 : 1);
  ck_assert_int_eq(domain.level_sets().sets.empty(), !repaired);
  return repaired;
}

// Surfaces that the checks accept or correct equal those without a repair.
START_TEST(sound_bodies_stay) {
  Soup whole = cube(4), turned = whole;
  for (std::size_t t = 0; t < whole.tags.size(); ++t)
    whole.tags[t] = turned.tags[t] = 1 + static_cast<std::int32_t>(t / 32);
  for (std::int64_t t = 0; t < turned.triangles(); t += 3) turned.turn(t);
  const Soup small = scaled(whole, 0.5).shifted(0.25, 0.25, 0.25);
  for (const Soup& soup :
       {whole, whole.torn(), whole.turned(), turned, both(whole, small.turned()),
        both(whole, small.turned()).turned(), both(whole, whole.shifted(2, 0, 0).turned())}) {
    const VolumeDomain domain = repaired_if_broken(soup);
    ck_assert(!is_repaired(domain));
    VolumeDomain ordinary;
    soup.add_to(ordinary);
    ordinary.check();
    ck_assert(domain.volume() == ordinary.volume() && domain.area() == ordinary.area());
    ck_assert_int_eq(domain.summary().patches, ordinary.summary().patches);
    ck_assert(domain.mesh().facets.size() == ordinary.mesh().facets.size());
    for (std::size_t f = 0; f < ordinary.mesh().facets.size(); ++f)
      ck_assert_int_eq(domain.mesh().facets[f].tag, ordinary.mesh().facets[f].tag);
  }
}
END_TEST

START_TEST(bodies_that_are_not_sound_are_repaired) {
  const Soup whole = cube(4), small = scaled(whole, 0.5).shifted(0.25, 0.25, 0.25);
  for (const Soup& soup : {without(whole, 40, 1), both(whole, whole.shifted(0.55, 0.55, 0.55)),
                           both(whole, small), both(whole, small).turned()})
    ck_assert(is_repaired(repaired_if_broken(soup)));
  ck_assert(is_repaired(repaired(whole, 0.1)));
}
END_TEST

// Surfaces without an inside are repaired if the body that they would enclose is.
START_TEST(surfaces_alone_are_repaired_where_a_body_would_be) {
  for (const bool open : {false, true}) {
    VolumeDomain domain;
    (open ? without(cube(4), 40, 1) : cube(4)).add_to(domain);
    domain.set_filled(false);
    domain.set_repair(0.1);
    domain.check();
    ck_assert_int_eq(is_repaired(domain), open);
    ck_assert_double_eq_tol(domain.area(), 6, open ? 0.05 : 1e-12);
  }
}
END_TEST

// A domain built from a repaired body reports that repair.
START_TEST(repairs_of_other_bodies_are_taken) {
  const VolumeDomain body = repaired_if_broken(without(cube(4), 40, 1));
  VolumeDomain made;
  made.add_box({0, 0, 0}, {1, 1, 1}, 1);
  made.take_repair_of(body);
  made.check();
  ck_assert_double_eq(made.repair_distances().resolution, 0.1);
  ck_assert(made.repair_distances().over_holes == body.repair_distances().over_holes);
  ck_assert_int_eq(std::ssize(made.warnings()), 1);
  ck_assert(made.warnings()[0].code == pnpbs::WarningCode::repaired);
}
END_TEST

// Surfaces with other roles are not repaired.
START_TEST(other_surfaces_stay) {
  VolumeDomain domain;
  without(cube(4), 3, 1).add_to(domain);
  scaled(cube(1), 0.3).shifted(0.3, 0.3, 0.3).add_to(domain, pnpbs::SurfaceRole::inner);
  domain.set_repair(0.05);
  domain.check();
  ck_assert_double_eq_tol(domain.volume(), 1, 0.01);
  const auto& facets = domain.mesh().facets;
  ck_assert_int_eq(std::count_if(facets.begin(), facets.end(),
                                 [](const auto& facet) { return !facet.bounds(); }),
                   12);
}
END_TEST

}  // namespace

TEST_SUITE(test_repaired_body) {
  [[maybe_unused]] const int bodies = static_cast<int>(cases().size());
  Suite* suite = suite_create("repaired_body");
  TCase* tests = tcase_create("repaired_body");
  tcase_set_timeout(tests, 0);
  tcase_add_test(tests, windings_of_a_cube_are_whole);
  tcase_add_test(tests, windings_by_the_tree_are_near_the_sum);
  tcase_add_loop_test(tests, bodies_are_what_triangles_enclose, 0, WHEN_SANITIZED(2, bodies));
  tcase_add_loop_test(tests, signs_are_those_of_the_windings, 0, WHEN_SANITIZED(2, bodies));
  tcase_add_test(tests, edges_stay_sharp);
  tcase_add_test(tests, distances_are_told);
  tcase_add_test(tests, distances_over_holes_are_told_apart);
  tcase_add_test(tests, distances_are_those_of_large_triangles);
  tcase_add_test(tests, what_cannot_be_is_refused);
  tcase_add_test(tests, crumbs_of_sheets_are_none);
  tcase_add_test(tests, sound_bodies_stay);
  tcase_add_test(tests, bodies_that_are_not_sound_are_repaired);
  tcase_add_test(tests, surfaces_alone_are_repaired_where_a_body_would_be);
  tcase_add_test(tests, repairs_of_other_bodies_are_taken);
  tcase_add_test(tests, other_surfaces_stay);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
