// SPDX-License-Identifier: BSD-3-Clause
// A volume's domain in its background tree: inside and outside, facets near a point, the nearest
// point, and the refinement by d; against integers and loops over all triangles.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

#include "domain/volume/volume_domain.hpp"
#include "geometry/clearance.hpp"
#include "geometry/expect_error.hpp"
#include "implicit/level_set.hpp"
#include "mapped_volume.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"

using surfaces::Place;
using surfaces::Surface;
using P = pnpbs::Point<3>;
using Spacing = VolumeSpacing;

namespace {

// Objects that point into themselves can be neither copied nor moved.
using pnpbs::ResolvedVolume;
static_assert(!std::is_copy_constructible_v<ResolvedVolume> &&
              !std::is_move_constructible_v<ResolvedVolume> &&
              !std::is_copy_assignable_v<ResolvedVolume> &&
              !std::is_move_assignable_v<ResolvedVolume>);

Surface fine_sphere() { return scaled(surfaces::sphere(4, 900), 0x1p-10); }
// Triangles are in random order, so that any of equally near ones may be found first.
Surface block() {
  Surface s = scaled(surfaces::pierced_cube(), 0x1p-4);
  Random(0).shuffle(s.triangles);
  return s;
}
Surface oblique_block() { return scaled(surfaces::sheared(surfaces::pierced_cube()), 0x1p-6); }

// Points anywhere around the surface, and points for which predicates are ties: on triangles and in
// their planes, on the lines of their edges, and level with corners.
std::vector<Place> places_around(const Surface& s, int many, std::uint64_t seed) {
  Random random(seed);
  Place low = s.nodes[0], high = low;
  for (const Place& x : s.nodes)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  const auto anywhere = [&] {
    Place x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = low[k] - 2 + random.below(high[k] - low[k] + 5);
    return x;
  };
  std::vector<Place> places;
  while (std::ssize(places) < many) {
    const auto t = static_cast<std::size_t>(random.below(std::ssize(s.triangles)));
    const Place &a = s.corner(t, 0), &b = s.corner(t, 1), &c = s.corner(t, 2);
    const Place u = b - a, v = c - a;
    const std::int64_t i = random.below(5) - 2, j = random.below(5) - 2;
    places.push_back(anywhere());
    places.push_back(a + i * u + j * v);
    places.push_back(a + i * u);
    places.push_back(a);
    Place middle = a + b, centre = a + b + c, level = anywhere();
    for (std::size_t k = 0; k < 3; ++k) {
      middle[k] /= 2;
      centre[k] /= 3;
    }
    places.push_back(middle);
    places.push_back(centre);
    centre[static_cast<std::size_t>(random.below(3))] += random.below(3) - 1;
    places.push_back(centre);
    level[static_cast<std::size_t>(random.below(3))] = a[0];
    places.push_back(level);
  }
  return places;
}

void expect_sides(const Mapped& m, int many, std::uint64_t seed) {
  std::int64_t inside = 0, outside = 0, boundary = 0;
  for (const Place& x : places_around(m.surface, many, seed)) {
    const bool on = surfaces::on_surface(m.surface, x);
    const bool expected = !on && surfaces::is_inside(m.surface, x);
    const P at = m.surface.at(x);
    quick_assert_msg(m.map.inside(at) == expected, "(%.17g, %.17g, %.17g) is %s", at[0], at[1],
                     at[2], expected ? "inside" : "not inside");
    ++(on ? boundary : expected ? inside : outside);
  }
  ck_assert_int_gt(inside, many / 50);
  ck_assert_int_gt(outside, many / 50);
  ck_assert_int_gt(boundary, many / 5);
}

}  // namespace

START_TEST(sides_of_a_sphere) {
  for (const double d : {0.03, 0.2, 3.0}) expect_sides(Mapped(fine_sphere(), constant(d)), 3000, 1);
}
END_TEST

START_TEST(sides_of_pierced_blocks) {
  for (const double d : {0.2, 0.9, 30.0}) {
    expect_sides(Mapped(block(), constant(d)), 3000, 2);
    expect_sides(Mapped(oblique_block(), constant(d)), 3000, 3);
  }
  expect_sides(Mapped(block(), [](const P& x) { return 0.1 + 0.2 * pnpbs::distance<3>(x, {}); }),
               3000, 4);
}
END_TEST

// Every segment between two points crosses an even number of triangles if both are on the same
// side, also through corners, along edges and in the planes of triangles, where all predicates are
// ties.
START_TEST(ways_cross_as_often_as_they_should) {
  for (const Surface& s : {block(), oblique_block(), fine_sphere()}) {
    std::vector<pnpbs::FacetCorners<3>> facets;
    for (std::size_t t = 0; t < s.triangles.size(); ++t)
      facets.push_back({s.at(s.corner(t, 0)), s.at(s.corner(t, 1)), s.at(s.corner(t, 2))});
    std::vector<Place> places = places_around(s, 600, 5);
    std::erase_if(places, [&](const Place& x) { return surfaces::on_surface(s, x); });
    std::vector<char> inside;
    for (const Place& x : places) inside.push_back(surfaces::is_inside(s, x));
    Random random(6);
    std::int64_t through_corners = 0;
    const auto expect_parity = [&](const Place& p, const Place& q, bool odd) {
      const P from = s.at(p), to = s.at(q);
      std::int64_t crossed = 0;
      for (const pnpbs::FacetCorners<3>& facet : facets) crossed += pnpbs::crosses(from, to, facet);
      ck_assert_int_eq(crossed % 2, odd);
    };
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto j = static_cast<std::size_t>(random.below(std::ssize(places)));
      expect_parity(places[i], places[j], inside[i] != inside[j]);
      // Segments through a corner, and through the midpoint of an edge.
      const auto t = static_cast<std::size_t>(random.below(std::ssize(s.triangles)));
      const Place &a = s.corner(t, 0), &b = s.corner(t, 1);
      for (const Place& through : {2 * a, a + b}) {
        const Place mirrored = through - places[i];
        if (surfaces::on_surface(s, mirrored)) continue;
        expect_parity(places[i], mirrored, inside[i] != surfaces::is_inside(s, mirrored));
        ++through_corners;
      }
    }
    ck_assert_int_gt(through_corners, 200);
  }
}
END_TEST

namespace {

void expect_nearest(const Mapped& m, int many, std::uint64_t seed) {
  const double unit = m.surface.unit, size = m.size();
  std::int64_t equally_near = 0;
  for (const Place& place : places_around(m.surface, many, seed)) {
    const P x = m.surface.at(place);
    std::vector<double> gaps;
    for (std::size_t t = 0; t < m.count(); ++t)
      gaps.push_back(unit *
                     static_cast<double>(std::sqrt(surfaces::squared_gap(m.surface, t, place))));
    const double min = *std::min_element(gaps.begin(), gaps.end());
    for (const double reach : {0.01 * size, 0.1 * size, 2 * size, min * 0.999, min * 1.001}) {
      const double expected = std::min(min, reach);
      ck_assert_double_eq_tol(m.map.clearance(x, reach), expected, 1e-14 * size);
      const pnpbs::NearestPoint<3> nearest = m.map.nearest(x, reach);
      ck_assert_double_eq_tol(nearest.gap, expected, 1e-14 * size);
      quick_assert((nearest.facet >= 0) == (min < reach));
      std::vector<char> named(m.count(), 0);
      m.map.for_facets_near(x, reach, [&](std::int32_t f) { named[f] = 1; });
      for (std::size_t t = 0; t < named.size(); ++t) quick_assert(named[t] || gaps[t] >= reach);
      if (nearest.facet < 0) continue;
      ck_assert_double_eq_tol(gaps[nearest.facet], min, 1e-14 * size);
      ck_assert_double_eq_tol(pnpbs::distance<3>(nearest.x, x), nearest.gap, 1e-14 * size);
      // Everything is exact along the axes, including ties.
      if (unit != 0x1p-4) continue;
      for (std::int32_t t = 0; t < nearest.facet; ++t) quick_assert(gaps[t] > min);
      equally_near += std::count(gaps.begin(), gaps.end(), min) > 1;
    }
  }
  if (unit == 0x1p-4) ck_assert_int_gt(equally_near, many / 10);
}

}  // namespace

START_TEST(nearest_points) {
  expect_nearest(Mapped(fine_sphere(), constant(0.1)), 200, 7);
  expect_nearest(Mapped(block(), constant(0.4)), 800, 8);
  expect_nearest(Mapped(oblique_block(), constant(0.4)), 800, 9);
}
END_TEST

// Each leaf has all triangles that meet it, tested by points of triangles in it. A triangle lies
// between any two points of a leaf of which only one is inside.
START_TEST(facets_of_leaves) {
  for (const Surface& s : {fine_sphere(), oblique_block()}) {
    const Mapped m(s, constant(0.1));
    const pnpbs::BackgroundTree<3>& tree = m.map.tree();
    Random random(10);
    for (int trial = 0; trial < 20000; ++trial) {
      const auto t = static_cast<std::int32_t>(random.below(std::ssize(m.mesh.facets)));
      const auto& [a, b, c] = m.map.corners(t);
      double u = random.between(0, 1), v = random.between(0, 1);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      P x;
      for (std::size_t k = 0; k < 3; ++k) x[k] = a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]);
      const auto facets = m.map.facets_of_leaf(tree.leaf_at(x));
      quick_assert(std::binary_search(facets.begin(), facets.end(), t));
    }
    std::int64_t crossed = 0;
    for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
      const pnpbs::Box<3> box = tree.cell_box(tree.leaf_cell(leaf));
      const P p = random.point<3>(box), q = random.point<3>(box);
      const bool p_inside = m.map.inside(p), q_inside = m.map.inside(q);
      quick_assert(m.map.leaf_has_facets(leaf) || m.map.leaf_outside(leaf) == !p_inside);
      if (p_inside != q_inside) quick_assert(m.map.facet_between(leaf, p, q));
      if (m.map.leaf_has_facets(leaf)) ++crossed;
    }
    ck_assert_int_gt(crossed, 200);
  }
}
END_TEST

START_TEST(leaf_sizes_follow_d) {
  const Mapped uniform(block(), constant(0.2));
  const pnpbs::BackgroundTree<3>& coarse = uniform.map.tree();
  for (std::int32_t leaf = 0; leaf < coarse.leaf_count(); ++leaf) {
    if (uniform.map.leaf_outside(leaf)) continue;
    const double side = coarse.cell_side(coarse.leaf_cell(leaf));
    ck_assert_double_le(side, 4 * 0.2);
    ck_assert_double_gt(side, 2 * 0.2);
    ck_assert_double_eq_tol(uniform.map.leaf_spacing(leaf), 0.2, 1e-15);
  }
  const Spacing d = [](const P& x) { return 0.02 + 0.1 * pnpbs::distance<3>(x, {1.5, 1, 1.5}); };
  const Mapped graded(block(), d);
  const pnpbs::BackgroundTree<3>& tree = graded.map.tree();
  double nodes = 0, expected = 0;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    if (graded.map.leaf_outside(leaf)) continue;
    const pnpbs::Box<3> box = tree.cell_box(tree.leaf_cell(leaf));
    const double side = tree.cell_side(tree.leaf_cell(leaf));
    const double min = graded.map.leaf_min_spacing(leaf), max = graded.map.leaf_max_spacing(leaf);
    ck_assert_double_le(side, 4 * min);
    ck_assert_double_le(min, graded.map.leaf_spacing(leaf) * (1 + 1e-12));
    ck_assert_double_le(graded.map.leaf_spacing(leaf), max * (1 + 1e-12));
    ck_assert_double_le(max - min, 0.1 * 1.7321 * side);
    if (graded.map.leaf_has_facets(leaf)) continue;
    // Leaves are no finer than necessary: a leaf of twice the width would violate the limit.
    ck_assert_double_gt(2 * side, 4 * (min - 0.1 * 1.7321 * 2 * side));
    nodes += std::pow(side / graded.map.leaf_spacing(leaf), 3);
    constexpr int kFine = 4;
    for (int cell = 0; cell < kFine * kFine * kFine; ++cell) {
      const P x{box.low[0] + (cell % kFine + 0.5) * side / kFine,
                box.low[1] + (cell / kFine % kFine + 0.5) * side / kFine,
                box.low[2] + (cell / kFine / kFine + 0.5) * side / kFine};
      expected += std::pow(side / kFine / d(x), 3);
    }
  }
  ck_assert_double_eq_tol(nodes, expected, 0.02 * expected);
}
END_TEST

namespace {

// Returns a cone with a fan of needles around its tip.
Surface cone(int needles) {
  Surface s;
  s.unit = 0x1p-20;
  s.nodes = {{0, 0, 1 << 20}, {0, 0, 0}};
  for (std::int32_t k = 0; k < needles; ++k) {
    const double angle = 2 * std::acos(-1) * k / needles;
    s.nodes.push_back(
        {std::llround(0x1p20 * std::cos(angle)), std::llround(0x1p20 * std::sin(angle)), 0});
    const std::int32_t here = 2 + k, next = 2 + (k + 1) % needles;
    s.triangles.push_back({0, here, next});
    s.triangles.push_back({1, next, here});
  }
  return s;
}

std::int32_t greatest_depth(const pnpbs::BackgroundTree<3>& tree) {
  std::int32_t depth = 0;
  for (std::int32_t c = 0; c < tree.cell_count(); ++c) depth = std::max(depth, tree.cell(c).depth);
  return depth;
}

}  // namespace

// The number of facets per leaf is bounded for any d, except for facets that meet in one corner.
START_TEST(leaves_hold_few_boundary_nodes) {
  const Mapped sphere(fine_sphere(), constant(10));
  const pnpbs::BackgroundTree<3>& tree = sphere.map.tree();
  std::size_t max = 0;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    max = std::max(max, sphere.map.facets_of_leaf(leaf).size());
  ck_assert_uint_le(max, 96);
  ck_assert_uint_gt(max, 48);
  const Mapped pointed(cone(500), constant(10));
  ck_assert_int_le(greatest_depth(pointed.map.tree()), 9);
  expect_sides(pointed, 500, 11);
}
END_TEST

// Here d would require a deeper tree than is possible.
START_TEST(finest_leaves_there_can_be) {
  const Mapped m(block(), [](const P& x) { return 1e-10 + 0.3 * pnpbs::distance<3>(x, {}); });
  const pnpbs::BackgroundTree<3>& tree = m.map.tree();
  ck_assert_int_eq(greatest_depth(tree), pnpbs::BackgroundTree<3>::kMaxDepth);
  const std::int32_t finest = tree.leaf_at({});
  ck_assert_int_eq(tree.cell(tree.leaf_cell(finest)).depth, pnpbs::BackgroundTree<3>::kMaxDepth);
  ck_assert_double_eq_tol(m.map.leaf_min_spacing(finest), 1e-10, 1e-12);
  for (const double way : {1e-9, 1e-5, 0.1}) {
    quick_assert(m.map.inside({way, 2 * way, way}) && !m.map.inside({way, 2 * way, -way}));
    ck_assert_double_eq_tol(m.map.clearance({2 * way, 3 * way, way}, 1), way, 1e-20);
  }
}
END_TEST

START_TEST(too_many_nodes) {
  expect_error(
      pnpbs::ErrorKind::spacing,
      {"spacing d = 0.01 near (", "would mean about ", " nodes or more", "max_nodes allows 100000"},
      [&] { Mapped(block(), constant(0.01), 100'000); });
  Mapped(block(), constant(0.05), 300'000);
}
END_TEST

// ------------------------------------------------------------------ clearance ------------------

namespace {

std::vector<std::int32_t> all_facets(const pnpbs::BoundaryMesh<3>& mesh) {
  std::vector<std::int32_t> facets(mesh.facets.size());
  std::iota(facets.begin(), facets.end(), 0);
  return facets;
}

// A box with a wall across it, and a fixed node.
struct Chambers {
  Surface box, wall;
  pnpbs::BoundaryMesh<3> mesh;
  pnpbs::SizedTree<3> map;
  static constexpr P kFixed{0.5, 0.5, 0.5};

  Chambers() {
    box = surfaces::cubes(1, [](auto, auto, auto) { return true; });
    for (Place& x : box.nodes) x = {4 * x[0], 2 * x[1], 2 * x[2]};
    box.unit = 1.0 / 12;
    wall.unit = box.unit;
    wall.nodes = {{11, 0, 0}, {13, 12, 0}, {13, 12, 12}, {11, 0, 12}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    box.add_to(mesh, pnpbs::SurfaceRole::boundary);
    wall.add_to(mesh, pnpbs::SurfaceRole::inner);
    const auto node = static_cast<std::int32_t>(mesh.nodes.size());
    mesh.nodes.push_back({kFixed, 1});
    mesh.facets.push_back({{node, node, node}, 1, true, true});
    map.build(box.bounds(), mesh, evaluator_of(constant(0.11)), 1'000'000);
  }
  static bool beyond_wall(const P& x) { return 12 * x[0] > 11 + 2 * x[1]; }
  // Returns the distance to the boundary, from the planes of the faces.
  static double gap(const P& x) {
    double min = std::fabs(12 * x[0] - 11 - 2 * x[1]) / std::hypot(12.0, 2.0);
    for (std::size_t k = 0; k < 3; ++k) min = std::min({min, x[k], (k == 0 ? 2 : 1) - x[k]});
    return std::min(min, pnpbs::distance<3>(x, kFixed));
  }
};

}  // namespace

// A node stays in its chamber, inside the box, whatever its goal is.
START_TEST(walls_hold) {
  const Chambers m;
  const std::vector<std::int32_t> facets = all_facets(m.mesh);
  Random random(12);
  std::int64_t held = 0, moved = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const P from = random.point<3>({{0, 0, 0}, {2, 1, 1}});
    if (!(m.gap(from) > 0)) continue;
    P to = from;
    const double reach = random.between(0, 0.5);
    for (double& along : to) along += random.between(-reach, reach);
    const pnpbs::ClearPosition<3> kept = pnpbs::clear_position<3>(m.map, facets, from, to, 0.11);
    quick_assert(m.map.inside(kept.position));
    ck_assert_int_eq(m.beyond_wall(kept.position), m.beyond_wall(from));
    const double gap = m.gap(kept.position);
    quick_assert(kept.clear == (gap >= 0.35 * 0.11) || std::fabs(gap - 0.35 * 0.11) < 1e-12);
    if (m.gap(from) >= 0.35 * 0.11) quick_assert(kept.clear);
    const bool free_way = m.map.inside(to) && m.beyond_wall(to) == m.beyond_wall(from);
    if (free_way && m.gap(to) >= 0.4 * 0.11) {
      quick_assert(kept.position == to);
      ++moved;
    } else {
      ++held;
    }
  }
  ck_assert_int_gt(held, 3000);
  ck_assert_int_gt(moved, 3000);
}
END_TEST

START_TEST(clearance_is_reached_where_there_is_room) {
  const Chambers m;
  const double d = 0.1;
  const std::vector<std::int32_t> facets = all_facets(m.mesh);
  const auto keep = [&](const P& from, const P& to) {
    return pnpbs::clear_position<3>(m.map, facets, from, to, d);
  };
  for (const double y : {0.3, 0.51, 0.777}) {
    pnpbs::ClearPosition<3> kept = keep({0.06, y, 0.4}, {0.01, y + 0.02, 0.41});  // too near
    quick_assert(kept.clear);
    ck_assert_double_eq_tol(pnpbs::distance<3>(kept.position, {0.04, y + 0.02, 0.41}), 0, 1e-15);
    for (const double x : {-0.05, 0.0}) {  // beyond a side, and onto it: back to the old position
      kept = keep({0.06, y, 0.4}, {x, y, 0.4});
      quick_assert(kept.clear && kept.position == (P{0.06, y, 0.4}));
    }
  }
  const pnpbs::ClearPosition<3> corner = keep({0.05, 0.05, 0.05}, {0.01, 0.02, 0.03});
  quick_assert(corner.clear);
  ck_assert_double_eq_tol(pnpbs::distance<3>(corner.position, {0.04, 0.04, 0.04}), 0, 1e-15);
  // The corner of the floor, a side and the wall at 81 degrees: the node is moved off each, and off
  // the side again.
  const P wedged{0.92561, 0.005, 0.004};
  quick_assert(keep({0.98, 0.06, 0.06}, wedged).clear);
  // The node moves straight away from the fixed node.
  const pnpbs::ClearPosition<3> kept = keep({0.5, 0.5, 0.6}, {0.5, 0.51, 0.51});
  ck_assert_double_eq_tol(pnpbs::distance<3>(kept.position, Chambers::kFixed), 0.04, 1e-15);
  ck_assert_double_eq_tol(kept.position[1], kept.position[2], 1e-15);
  quick_assert(kept.clear && kept.position[0] == 0.5);
}
END_TEST

// Nodes of a level set lie on f = 0, beside the triangles. Leaves outside the domain belong to no
// rank.
START_TEST(no_nodes_of_level_sets_outside) {
  const auto torus = [](std::int64_t n, const P* x, double* f) {
    for (std::int64_t i = 0; i < n; ++i)
      f[i] = std::hypot(std::hypot(x[i][0], x[i][1]) - 1, x[i][2]) - 0.4;
  };
  // Deviation of edges that are up to sqrt(3) resolutions long, with a radius of 0.4.
  constexpr double kResolution = 0.2, kDeviation = 3 * kResolution * kResolution / (8 * 0.4);
  pnpbs::VolumeDomain domain;
  domain.add_level_set(torus, {{-1.5, -1.5, -0.5}, {1.5, 1.5, 0.5}}, kResolution, 1);
  domain.check();
  const pnpbs::BoundaryMesh<3>& mesh = domain.mesh();
  ck_assert_double_ge(mesh.node_distance, kDeviation);
  ck_assert_double_le(mesh.node_distance, 2 * kDeviation);
  pnpbs::SizedTree<3> map;
  map.build(domain.bounds(), mesh, evaluator_of(constant(0.03)), 1'000'000);
  Random random(1);
  std::vector<P> nodes;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto [a, b, c] = pnpbs::corners_of(mesh, mesh.facets[f]);
    for (int k = 0; k < 10; ++k) {
      const double u = random.between(0, 1), v = random.between(0, 1 - u);
      P x;
      for (std::size_t d = 0; d < 3; ++d) x[d] = a[d] + u * (b[d] - a[d]) + v * (c[d] - a[d]);
      nodes.push_back(x);
    }
  }
  const std::vector<P> on_facets = nodes;
  domain.level_sets().sets[0]->project(nodes, mesh.node_distance);
  std::size_t off_the_facets = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    double f = 0;
    torus(1, &nodes[k], &f);
    ck_assert_double_le(std::fabs(f), 1e-14);
    quick_assert(!map.leaf_empty(map.tree().leaf_at(nodes[k])));
    off_the_facets += pnpbs::distance<3>(nodes[k], on_facets[k]) > 0.2 * kDeviation;
  }
  ck_assert_uint_ge(off_the_facets, nodes.size() / 20);
}
END_TEST

TEST_SUITE(test_volume_domain) {
  return run_kernel_suite(
      "volume_domain",
      {sides_of_a_sphere, sides_of_pierced_blocks, ways_cross_as_often_as_they_should,
       nearest_points, facets_of_leaves, leaf_sizes_follow_d, leaves_hold_few_boundary_nodes,
       finest_leaves_there_can_be, too_many_nodes, walls_hold,
       clearance_is_reached_where_there_is_room, no_nodes_of_level_sets_outside});
}
