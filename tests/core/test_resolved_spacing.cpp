// SPDX-License-Identifier: BSD-3-Clause
// The spacing that resolves a shape, against walls, gaps and wedges of known thickness. Its search
// structures are compared with loops over all triangles and all sources.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "base/error.hpp"
#include "base/space_vectors.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "spacing/resolving_sources.hpp"
#include "spacing/sizing_field.hpp"
#include "surfaces.hpp"

using pnpbs::difference;
using P = pnpbs::Point<3>;
using Source = pnpbs::GrowthSource<3>;

namespace {

constexpr double kSpacing = 0.2, kGrowth = 0.3;

double resolved_at(const pnpbs::SizingField<3>& spacing, const P& x) {
  double d;
  spacing.evaluate(1, &x, &d);
  return d;
}

pnpbs::SizingField<3> resolved(const pnpbs::VolumeDomain& domain) {
  pnpbs::SizingField<3> field(std::make_shared<pnpbs::ConstantSpacing<3>>(kSpacing));
  field.resolve(
      pnpbs::resolving_sources(field, domain, pnpbs::NodeLimit(1'000'000), pnpbs::kResolved),
      kGrowth);
  return field;
}

// Checks d at a distance `gap` from a surface with the constant limit `at_surface`. Sources are up
// to 1.5 times that limit wide, so their points lie within 0.87 of it.
void expect_near_surface(double d, double at_surface, double gap) {
  ck_assert_double_ge(d, std::min(kSpacing, at_surface + kGrowth * gap) - 1e-12);
  ck_assert_double_le(d, std::min(kSpacing, at_surface * (1 + 0.87 * kGrowth) + kGrowth * gap));
}

// Returns the smallest t for which x + t way lies on a triangle (Moeller and Trumbore).
double first_crossing(const surfaces::Surface& s, const P& x, const P& way) {
  double first = 1;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const P a = s.at(s.corner(t, 0));
    const P u = difference(s.at(s.corner(t, 1)), a), v = difference(s.at(s.corner(t, 2)), a);
    const P p = pnpbs::cross(way, v), from = difference(x, a), q = pnpbs::cross(from, u);
    const double scale = 1 / pnpbs::dot(u, p);
    const double along_u = scale * pnpbs::dot(from, p), along_v = scale * pnpbs::dot(way, q);
    const double along = scale * pnpbs::dot(v, q);
    if (along_u >= 0 && along_v >= 0 && along_u + along_v <= 1 && along >= 0)
      first = std::min(first, along);
  }
  return first;
}

}  // namespace

START_TEST(limits_of_many_sources) {
  const pnpbs::Box<3> box{{0, 0, 0}, {1, 2, 1}};
  Random random(1);
  std::vector<Source> sources;
  for (int n = 0; n < 1000; ++n)
    sources.push_back({random.point<3>(box), random.between(0.01, 0.3)});
  const pnpbs::GrowthSources<3> tree(sources, kGrowth);
  for (int n = 0; n < 2000; ++n) {
    const P x = random.point<3>(box);
    const double bound = random.between(0.02, 0.4);
    double expected = bound;
    for (const Source& source : sources) expected = std::min(expected, source.limit(x, kGrowth));
    ck_assert_double_eq(tree.limit(x, bound), expected);
  }
  ck_assert_double_eq(pnpbs::GrowthSources<3>({}, kGrowth).limit({0, 0, 0}, 0.5), 0.5);
}
END_TEST

START_TEST(first_facets_on_the_way) {
  surfaces::Surface s = surfaces::sphere(3, 900);
  s.unit = 0x1p-10;
  pnpbs::BoundaryMesh<3> mesh;
  s.add_to(mesh, pnpbs::SurfaceRole::boundary);
  const pnpbs::SurfaceIndex index(mesh, s.bounds());
  Random random(2);
  int hits = 0;
  for (int n = 0; n < 2000; ++n) {
    const P x = random.point<3>(s.bounds()), end = random.point<3>(s.bounds());
    const P way = difference(end, x);
    const pnpbs::SurfaceIndex::Hit hit = index.first_hit(x, way, -1);
    const double expected = first_crossing(s, x, way);
    ck_assert_double_eq_tol(hit.along, expected, 1e-9);
    ck_assert_int_eq(hit.facet >= 0, expected < 1);
    if (hit.facet < 0) continue;
    ++hits;
    const pnpbs::SurfaceIndex::Hit next = index.first_hit(x, way, hit.facet);
    ck_assert_double_ge(next.along, hit.along);
    ck_assert_int_ne(next.facet, hit.facet);
  }
  ck_assert_int_gt(hits, 500);
}
END_TEST

// Compares with a search over all facets, to the bit: far away, near and on facets, also for
// needles.
START_TEST(nearest_points) {
  Random random(5);
  for (const double thin : {1.0, 1e-5}) {
    surfaces::Surface s = surfaces::sphere(3, 900);
    s.unit = 0x1p-10;
    pnpbs::BoundaryMesh<3> mesh;
    s.add_to(mesh, pnpbs::SurfaceRole::boundary);
    for (pnpbs::BoundaryNode<3>& node : mesh.nodes) node.position[1] *= thin;
    const pnpbs::SurfaceIndex index(mesh, s.bounds());
    for (int n = 0; n < 500; ++n) {
      P x = random.point<3>(s.bounds());
      x[1] *= thin;
      const P on = index.nearest(x, 1e3).x;
      const double part = n % 3 == 0 ? 0 : std::pow(10, -random.between(0, 14));
      x = pnpbs::shifted(on, part, pnpbs::difference(x, on));
      const double reach = n % 2 == 0 ? 1e3 : std::pow(10, -random.between(0, 6));
      pnpbs::NearestPoint<3> expected{reach};
      for (std::int32_t f = 0; f < std::ssize(mesh.facets); ++f) {
        const P q = pnpbs::nearest_on(index.sides().corners(f), x);
        const double gap = pnpbs::distance<3>(q, x);
        if (gap < expected.gap) expected = {gap, f, q};
      }
      const pnpbs::NearestPoint<3> found = index.nearest(x, reach);
      quick_assert(found.facet == expected.facet && found.gap == expected.gap);
      quick_assert(found.x == expected.x);
    }
  }
}
END_TEST

// d is half of the thickness on both sides, and larger in the middle.
START_TEST(a_plate) {
  constexpr double kThick = 0.06;
  pnpbs::VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, kThick}, 1);
  domain.check();
  const pnpbs::SizingField<3> spacing = resolved(domain);
  Random random(3);
  for (int n = 0; n < 1000; ++n) {
    const P x = random.point<3>({{0, 0, 0}, {1, 1, kThick}});
    expect_near_surface(resolved_at(spacing, x), kThick / 2, std::min(x[2], kThick - x[2]));
  }
}
END_TEST

// d in a gap is three quarters of its width and grows from there.
START_TEST(a_gap) {
  constexpr double kWide = 0.04;
  pnpbs::VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, 1}, 1);
  domain.add_box({0.2, 0.2, 0.5 - kWide / 2}, {0.8, 0.8, 0.5 + kWide / 2}, 2);
  domain.check();
  const pnpbs::SizingField<3> spacing = resolved(domain);
  Random random(4);
  for (int n = 0; n < 1000; ++n) {
    const P x = random.point<3>({{0.3, 0.3, 0.5 + kWide / 2}, {0.7, 0.7, 1}});
    expect_near_surface(resolved_at(spacing, x), 0.75 * kWide, x[2] - 0.5 - kWide / 2);
  }
}
END_TEST

// A block much thicker than d does not change d.
START_TEST(a_block) {
  pnpbs::VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, 1}, 1);
  domain.check();
  const pnpbs::SizingField<3> spacing = resolved(domain);
  Random random(5);
  for (int n = 0; n < 200; ++n)
    ck_assert_double_eq(resolved_at(spacing, random.point<3>({{0, 0, 0}, {1, 1, 1}})), kSpacing);
}
END_TEST

// At the edge, d is the thickness of the wedge at a distance d, and nowhere smaller. Farther out it
// is half of the thickness if that is larger.
START_TEST(a_wedge) {
  const double angle = std::acos(-1.0) / 9, room = 2 * std::sin(angle / 2);
  const double c = 2 * std::cos(angle), s = 2 * std::sin(angle);
  const double xyz[] = {0, 0, 0, 2, 0, 0, c, s, 0, 0, 0, 1, 2, 0, 1, c, s, 1};
  const std::int64_t corners[] = {0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3,
                                  1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5};
  pnpbs::VolumeDomain domain;
  domain.add_surface(pnpbs::SurfaceRole::boundary, 6, xyz, 8, corners, nullptr);
  domain.check();
  const pnpbs::SizingField<3> spacing = resolved(domain);
  for (double r = 0; r < 1.5; r += 0.05) {
    // The thickness of the wall on the bisector equals the length of the segment across it.
    const P x{r * std::cos(angle / 2), r * std::sin(angle / 2), 0.5};
    const double d = resolved_at(spacing, x);
    const double at_surface = std::max(room * kSpacing, r * std::tan(angle) / 2);
    ck_assert_double_ge(d, room * kSpacing);
    ck_assert_double_le(d, std::min(kSpacing, 1.27 * at_surface + kGrowth * r * std::sin(angle)));
    if (r > 1.2) ck_assert_double_eq(d, kSpacing);
  }
}
END_TEST

START_TEST(walls_too_thin) {
  pnpbs::VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, 1e-6}, 1);
  domain.check();
  try {
    resolved(domain);
    ck_abort_msg("a million nodes do");
  } catch (const pnpbs::Error& error) {
    ck_assert_int_eq(static_cast<int>(error.kind()), static_cast<int>(pnpbs::ErrorKind::spacing));
  }
}
END_TEST

TEST_SUITE(test_resolved_spacing) {
  return run_kernel_suite("resolved spacing",
                          {limits_of_many_sources, first_facets_on_the_way, nearest_points, a_plate,
                           a_gap, a_block, a_wedge, walls_too_thin});
}
