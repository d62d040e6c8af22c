// SPDX-License-Identifier: BSD-3-Clause
// The stars of nodes in space: together they form one triangulation of the domain, for any lists
// and any known region.
#include <cmath>
#include <string>
#include <vector>

#include "run_kernel_suite.hpp"
#include "spacing/sized_tree.hpp"
#include "surfaces.hpp"
#include "volume_box.hpp"
#include "volume_tetrahedra.hpp"

using pnpbs::VolumeStars;
using volume_tetrahedra::input_of;
using volume_tetrahedra::Mesh;
using volume_tetrahedra::mesh_of;
using volume_tetrahedra::Star;
using volume_tetrahedra::star_by_ids;
using P = Point<3>;

namespace {

const pnpbs::KnownRegion<3> kEverywhere;

double graded(const P& x) { return 0.06 + 0.12 * x[0]; }

// Returns random nodes that keep a minimum distance for d.
std::vector<Bubble<3>> graded_nodes(std::uint64_t seed, int trials) {
  Random random(seed);
  std::vector<Bubble<3>> all;
  for (int k = 0; k < trials; ++k) {
    const P x = random.point<3>(unit_box<3>());
    const double d = graded(x);
    bool fits = true;
    for (const Bubble<3>& b : all) fits = fits && pnpbs::distance<3>(b.x, x) > 0.4 * (b.d + d);
    if (fits) all.push_back({x, d, 0});
  }
  std::vector<std::int64_t> ids;
  while (ids.size() < all.size()) ids.push_back(5000 + 3 * std::ssize(ids));
  random.shuffle(ids);
  for (std::size_t k = 0; k < all.size(); ++k) all[k].id = ids[k];
  return all;
}

Bubbles<3> listed(const std::vector<Bubble<3>>& nodes, double radius,
                  const SpacingFunction<3>& d = graded) {
  Bubbles<3> b;
  b.grow_tree(d);
  b.set(nodes);
  b.list(radius);
  return b;
}

std::map<std::int64_t, Star> stars_by_ids(const Bubbles<3>& b, const VolumeStars& stars) {
  std::map<std::int64_t, Star> all;
  for (std::int64_t i = 0; i < b.nodes.count; ++i)
    all[b.nodes.id(i)] = star_by_ids(b.nodes, stars, i);
  return all;
}

}  // namespace

// A lattice with fixed outer layers and random displacements inside. Its convex hull is not a box,
// but the stars inside are closed.
START_TEST(shaken_lattice) {
  const volume_box::Crystal crystal{8};
  std::vector<Bubble<3>> sites = volume_box::sites(crystal);
  volume_box::shake(sites, 0.15);
  Bubbles<3> b;
  b.box = crystal.box();
  b.grow_tree([](const P&) { return 1.0; });
  b.set(sites);
  b.list(1.5);
  VolumeStars stars;
  stars.build(input_of(b, kEverywhere));
  const Mesh mesh = mesh_of(b.nodes, stars);
  const double side = crystal.cells * volume_box::kCell;
  ck_assert_double_eq_tol(mesh.volume, side * side * side, 1e-9);
  std::int64_t inner = 0, neighbours = 0;
  for (std::int64_t i = 0; i < b.nodes.count; ++i) {
    quick_assert(stars.needs(i) == 0);
    if (!b.nodes.moves(i)) continue;
    quick_assert(stars.closed(i));
    ++inner;
    neighbours += stars.size(i);
  }
  ck_assert_int_gt(inner, 300);
  ck_assert_double_eq_tol(static_cast<double>(neighbours) / static_cast<double>(inner), 14, 0.5);
}
END_TEST

// Nodes of a cubic lattice fill the box, with eight on each sphere and flat sides.
START_TEST(cubic_lattice_fills_the_box) {
  constexpr int kCells = 8;
  std::vector<Bubble<3>> nodes;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j)
      for (int k = 0; k <= kCells; ++k)
        nodes.push_back({P{i * 0.125, j * 0.125, k * 0.125}, 0.13, 0});
  Random(20).shuffle(nodes);
  for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k].id = static_cast<std::int64_t>(k);
  for (const double radius : {1.2, 1.5, 2.0}) {
    const Bubbles<3> b = listed(nodes, radius, [](const P&) { return 0.13; });
    VolumeStars stars;
    stars.build(input_of(b, kEverywhere));
    const Mesh mesh = mesh_of(b.nodes, stars);
    ck_assert_double_eq_tol(mesh.volume, 1, 1e-13);
    // Two triangles per square of the border.
    std::int64_t border = 0;
    for (const auto& [face, count] : mesh.faces) border += count == 1 ? 1 : 0;
    ck_assert_int_eq(border, 6 * 2 * kCells * kCells);
  }
}
END_TEST

// Lists that are too short for a proof, or that may be incomplete.
START_TEST(lists_do_not_matter) {
  const std::vector<Bubble<3>> nodes = graded_nodes(21, 20000);
  ck_assert_int_gt(std::ssize(nodes), 500);
  std::map<std::int64_t, Star> expected;
  for (const double radius : {1.5, 0.9, 1.2, 2.0}) {
    const Bubbles<3> b = listed(nodes, radius);
    VolumeStars stars;
    pnpbs::VolumeStarInput input = input_of(b, kEverywhere);
    stars.build(input);
    mesh_of(b.nodes, stars);
    const std::map<std::int64_t, Star> found = stars_by_ids(b, stars);
    if (expected.empty()) expected = found;
    quick_assert(found == expected);
    input.complete = [&](std::int64_t i) { return b.nodes.id(i) % 2 == 0; };
    stars.build(input);
    quick_assert(stars_by_ids(b, stars) == expected);
  }
}
END_TEST

// Some stars are found first, then the others. The result is the same, and none is found before it
// is requested.
START_TEST(found_in_parts) {
  const Bubbles<3> b = listed(graded_nodes(21, 20000), 1.5);
  const pnpbs::VolumeStarInput input = input_of(b, kEverywhere);
  VolumeStars all, parts;
  all.build(input);
  const std::int64_t n = b.nodes.count;
  parts.build_none(input);
  for (std::int64_t i = 0; i < n; ++i) quick_assert(parts.size(i) == 0 && !parts.closed(i));
  constexpr std::int64_t kParts = 3;
  for (std::int64_t part = 0; part < kParts; ++part) {
    std::vector<char> wanted(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n; ++i)
      wanted[static_cast<std::size_t>(i)] = b.nodes.id(i) % kParts == part;
    parts.add(input, wanted);
    for (std::int64_t i = 0; i < n; ++i) {
      if (b.nodes.id(i) % kParts <= part)
        quick_assert(star_by_ids(b.nodes, parts, i) == star_by_ids(b.nodes, all, i));
      else
        quick_assert(parts.size(i) == 0);
    }
  }
}
END_TEST

// A rank knows the nodes of some leaves, requests more, and obtains the same stars.
START_TEST(what_is_not_known_is_asked_for) {
  const std::vector<Bubble<3>> nodes = graded_nodes(22, 20000);
  const Bubbles<3> all = listed(nodes, 1.5);
  VolumeStars stars;
  stars.build(input_of(all, kEverywhere));
  const std::map<std::int64_t, Star> expected = stars_by_ids(all, stars);
  for (const double middle : {0.3, 0.55}) {
    std::vector<char> known_leaves;
    for (std::int32_t leaf = 0; leaf < all.tree.leaf_count(); ++leaf)
      known_leaves.push_back(all.tree.cell_box(all.tree.leaf_cell(leaf)).low[1] < middle);
    pnpbs::KnownRegion<3> known(all.tree, known_leaves);
    std::vector<Box<3>> boxes;
    int rounds = 0;
    for (bool asks = true; asks; ++rounds) {
      quick_assert(rounds < 20);
      std::vector<Bubble<3>> here;
      for (const Bubble<3>& b : nodes) {
        bool has = known_leaves[static_cast<std::size_t>(all.tree.leaf_at(b.x))] != 0;
        for (const Box<3>& box : boxes) {
          bool in = true;
          for (int k = 0; k < 3; ++k) in = in && b.x[k] >= box.low[k] && b.x[k] <= box.high[k];
          has = has || in;
        }
        if (has) here.push_back(b);
      }
      const Bubbles<3> part = listed(here, 1.5);
      stars.build(input_of(part, known));
      asks = false;
      for (std::int64_t i = 0; i < part.nodes.count; ++i) {
        const P x = part.nodes.position(i);
        if (stars.needs(i) > 0) {
          quick_assert(stars.size(i) == 0 && !stars.closed(i));
          if (x[1] > middle - 0.2) continue;
          boxes.push_back(pnpbs::box_around<3>(x, stars.needs(i)));
          known.add(all.tree, boxes.back());
          asks = true;
        } else {
          quick_assert(star_by_ids(part.nodes, stars, i) == expected.at(part.nodes.id(i)));
        }
      }
    }
    ck_assert_int_gt(rounds, 1);
  }
}
END_TEST

// Unusually many neighbours, on a sphere around a node.
START_TEST(very_many_neighbours) {
  for (const int around : {900, 1600}) {
    Random random(23);
    std::vector<Bubble<3>> nodes{{{0.5, 0.5, 0.5}, 0.4, 3}};
    for (int k = 0; k < around; ++k) {
      const double z = -1 + (2 * k + 1.0) / around, angle = 2.4 * k, across = std::sqrt(1 - z * z);
      const double r = 0.4 * (1 + random.between(-1e-4, 1e-4));
      nodes.push_back(
          {{0.5 + r * across * std::cos(angle), 0.5 + r * across * std::sin(angle), 0.5 + r * z},
           0.4,
           2000 - k});
    }
    const Bubbles<3> b = listed(nodes, 1.5, [](const P&) { return 0.4; });
    VolumeStars stars;
    stars.build(input_of(b, kEverywhere));
    mesh_of(b.nodes, stars);
    for (std::int64_t i = 0; i < b.nodes.count; ++i) {
      if (b.nodes.id(i) != 3) continue;
      quick_assert(stars.size(i) == around && stars.closed(i));
      int triangles = 0;
      stars.for_simplices(i, [&](const VolumeStars::Corners&) { ++triangles; });
      ck_assert_int_eq(triangles, 2 * around - 4);
    }
  }
}
END_TEST

// The domain is concave, pierced and hollow. Nodes lie on its surface, and with small displacements
// inside. The elements fill exactly the domain.
START_TEST(tetrahedra_of_a_domain) {
  for (const bool oblique : {false, true}) {
    surfaces::Surface surface = surfaces::pierced_cube();
    if (oblique) surface = surfaces::sheared(surface);
    surface.unit = 0x1p-6;
    pnpbs::BoundaryMesh<3> boundary;
    surface.add_to(boundary, pnpbs::SurfaceRole::boundary);
    // The corners of a cube are six apart: nodes lie at every third point and in the middle of
    // four.
    Random random(24);
    std::vector<Bubble<3>> nodes;
    const surfaces::Surface straight = surfaces::pierced_cube();
    const double step = oblique ? 0.17 : 0.05;
    for (std::int64_t i = 0; i <= 48; i += 3)
      for (std::int64_t j = 0; j <= 48; j += 3)
        for (std::int64_t k = 0; k <= 48; k += 3) {
          surfaces::Surface at;
          at.nodes = {surfaces::Place{{i, j, k}}};
          const bool on = surfaces::on_surface(straight, at.nodes[0]);
          if (!on && !surfaces::is_inside(straight, at.nodes[0])) continue;
          P x = surface.at(oblique ? surfaces::sheared(at).nodes[0] : at.nodes[0]);
          if (!on)
            for (double& along : x) along += random.between(-0.1, 0.1) * step;
          nodes.push_back({x, step, std::ssize(nodes), !on});
        }
    random.shuffle(nodes);
    pnpbs::SizedTree<3> map;
    const Box<3> box = surface.bounds();
    map.build(
        box, boundary, [=](std::int64_t n, const P*, double* d) { std::fill(d, d + n, step); },
        1'000'000);
    Bubbles<3> b;
    b.box = box;
    b.grow_tree([=](const P&) { return step; });
    b.set(nodes);
    b.list(1.5);
    pnpbs::VolumeStarInput input = input_of(b, kEverywhere);
    VolumeStars stars;
    stars.build(input);
    const std::size_t with_outside = mesh_of(b.nodes, stars).tetrahedra.size();
    input.facets = &map;
    stars.build(input);
    const Mesh mesh = mesh_of(b.nodes, stars);
    ck_assert_uint_lt(mesh.tetrahedra.size(), with_outside);
    // 8^3 cubes minus 2 * 3 * 8 and 2 * 2 * 3. The shear multiplies the volume by its determinant.
    const double cube = std::pow(6 * surface.unit, 3) * (oblique ? 29 : 1);
    ck_assert_double_eq_tol(mesh.volume / cube, 512 - 48 - 12, 1e-9);
    for (std::int64_t i = 0; i < b.nodes.count; ++i)
      quick_assert(stars.closed(i) == b.nodes.moves(i));
  }
}
END_TEST

TEST_SUITE(test_volume_stars) {
  return run_kernel_suite(
      "volume_stars",
      {shaken_lattice, cubic_lattice_fills_the_box, lists_do_not_matter, found_in_parts,
       what_is_not_known_is_asked_for, very_many_neighbours, tetrahedra_of_a_domain});
}
