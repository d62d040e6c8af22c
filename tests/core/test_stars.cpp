// SPDX-License-Identifier: BSD-3-Clause
// Delaunay stars against the constrained Delaunay triangulation of CGAL.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "evaluate.hpp"
#include "hard_shapes.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "star_triangles.hpp"

using hard_shapes::add_square;
using hard_shapes::graded;
using hard_shapes::jump;
using hard_shapes::Shape;
using hard_shapes::small_shapes;
using Level = pnpbs::Level<2>;
using pnpbs::PlaneDomain;
using shapes::add_loop;
using shapes::rectangle;
using P = pnpbs::Point<2>;

namespace {

std::vector<Triangle> reference(const Level& level) {
  pnpbs_bench::NodeSet set;
  for (std::int64_t i = 0; i < level.nodes.count; ++i) {
    set.x.push_back(level.nodes.position(i));
    set.d.push_back(level.nodes.d(i));
  }
  const std::vector<std::int64_t> places = boundary_places(level);
  for (const pnpbs::BoundaryEdge& e : level.geometry.boundary().facets) {
    if (e.begin == e.end) continue;
    const std::array<std::int64_t, 2> ends{places[static_cast<std::size_t>(e.begin)],
                                           places[static_cast<std::size_t>(e.end)]};
    (e.left_inside == e.right_inside ? set.inner_edges : set.edges).push_back(ends);
  }
  return pnpbs_bench::reference_triangles(set);
}

int place_in_circle(const Level& level, const Triangle& t, std::int64_t d) {
  const auto x = [&](std::int64_t i) { return level.nodes.position(i); };
  const int turn = pnpbs::orientation(x(t[0]), x(t[1]), x(t[2]));
  return turn * pnpbs::in_circle(x(t[0]), x(t[1]), x(t[2]), x(d));
}

// Returns whether a corner of an adjacent triangle in `others` lies exactly on the circle of t and
// none lies inside.
bool tied(const Level& level, const Triangle& t, const std::vector<Triangle>& others) {
  const auto in_t = [&](std::int64_t d) { return std::count(t.begin(), t.end(), d) > 0; };
  bool on_circle = false;
  for (const Triangle& other : others) {
    if (std::none_of(other.begin(), other.end(), in_t)) continue;
    for (std::int64_t d : other) {
      if (in_t(d)) continue;
      const int place = place_in_circle(level, t, d);
      if (place > 0) return false;
      on_circle = on_circle || place == 0;
    }
  }
  return on_circle;
}

// Expects the same triangles. Where four or more nodes lie exactly on a circle, expects the same
// number on that circle.
void expect_reference(const Level& level, const std::string& what) {
  const std::vector<Triangle> ours = star_triangles(level), theirs = reference(level);
  std::vector<Triangle> ours_only, theirs_only;
  std::set_difference(ours.begin(), ours.end(), theirs.begin(), theirs.end(),
                      std::back_inserter(ours_only));
  std::set_difference(theirs.begin(), theirs.end(), ours.begin(), ours.end(),
                      std::back_inserter(theirs_only));
  quick_assert_msg(ours.size() == theirs.size(), "%s: %zu triangles instead of %zu", what.c_str(),
                   ours.size(), theirs.size());
  ck_assert_uint_gt(ours.size(), 0);
  for (const Triangle& t : ours_only) {
    quick_assert_msg(tied(level, t, theirs_only),
                     "%s: triangle (%.17g, %.17g) (%.17g, %.17g) (%.17g, %.17g) is not Delaunay",
                     what.c_str(), level.nodes.x[0](t[0]), level.nodes.x[1](t[0]),
                     level.nodes.x[0](t[1]), level.nodes.x[1](t[1]), level.nodes.x[0](t[2]),
                     level.nodes.x[1](t[2]));
  }
}

// Checks the stars of the fill, soon after, and when most nodes have settled.
void expect_stars(const std::string& what, const Build& build, const Plane& d,
                  std::int64_t min_nodes = 100) {
  LevelRun run(build, d);
  fill_level(*run.level);
  ck_assert_int_gt(run.level->nodes.count, min_nodes);
  for (const std::int64_t until : {0, 5, 100}) {
    run.steps(until - run.steps_done);
    run.renew_stars();
    expect_reference(*run.level, what + " after " + std::to_string(until) + " steps");
  }
  pnpbs::sweep_and_repair(*run.level, 5);
  run.renew_stars();
  expect_reference(*run.level, what + " after sweeps");
}

pnpbs::IncomingNodes<2> scattered(const LevelRun& run, std::uint64_t seed, std::int64_t n) {
  Random random(seed);
  pnpbs::IncomingNodes<2> nodes;
  for (std::int64_t i = 0; i < n; ++i) nodes.push_back({random.point<2>(run.domain->bounds()), -1});
  return nodes;
}

void take_all(const LevelRun& run, const pnpbs::IncomingNodes<2>& nodes) {
  const pnpbs::ImportedNodes taken = pnpbs::take(*run.level, nodes, 0);
  quick_assert_msg(taken.left_out == 0 && taken.thinned == 0, "%lld nodes left out, %lld thinned",
                   static_cast<long long>(taken.left_out), static_cast<long long>(taken.thinned));
}

// Nodes at random positions, far too few or too many for d, so that the lists are of no use.
void expect_stars_of_scattered_nodes(const std::string& what, const Build& build, const Plane& d) {
  std::uint64_t seed = 70;
  for (const std::int64_t n : {0, 1, 2, 5, 30, 200, 3000}) {
    LevelRun run(build, d);
    pnpbs::take(*run.level, scattered(run, ++seed, n), 0);
    run.renew_stars();
    expect_reference(*run.level, what + " with " + std::to_string(n) + " scattered nodes");
  }
}

}  // namespace

START_TEST(small_shapes_with_constant_spacing) {
  for (const Shape& shape : small_shapes())
    expect_stars(shape.name, shape.build, constant(shape.d));
}
END_TEST

START_TEST(small_shapes_with_graded_spacing) {
  for (const Shape& shape : small_shapes())
    expect_stars(std::string("graded ") + shape.name, shape.build, graded(shape.d));
}
END_TEST

START_TEST(small_shapes_with_a_jump) {
  for (const Shape& shape : small_shapes())
    expect_stars(std::string("jump, ") + shape.name, shape.build, jump(shape.d));
}
END_TEST

// d is larger than the domain: there are few nodes besides those of the boundary.
START_TEST(small_shapes_far_too_coarse) {
  for (const Shape& shape : small_shapes())
    expect_stars(std::string("coarse ") + shape.name, shape.build, constant(0.4), 3);
}
END_TEST

START_TEST(lakes) {
  const struct {
    const char* name;
    double d;
  } all[] = {{"lake_victoria", 4}, {"great_lakes", 12}, {"great_lakes_islands", 12}};
  for (const auto& lake : all) {
    const Build build = [&](PlaneDomain& domain) { add_lake(domain, lake.name); };
    expect_stars(lake.name, build, constant(lake.d), 1000);
    const double d = 0.3 * lake.d;
    expect_stars(
        std::string("graded ") + lake.name, build,
        [d](double x, double y) { return d + 0.02 * std::hypot(x, y); }, 1000);
  }
}
END_TEST

START_TEST(scattered_nodes) {
  for (const Shape& shape : small_shapes()) {
    expect_stars_of_scattered_nodes(shape.name, shape.build, constant(shape.d));
    expect_stars_of_scattered_nodes(std::string("graded ") + shape.name, shape.build,
                                    graded(shape.d));
    expect_stars_of_scattered_nodes(std::string("jump, ") + shape.name, shape.build, jump(shape.d));
  }
}
END_TEST

// The triangle of the three nodes named is so flat that its circle reaches beyond all nodes.
// Nothing beyond the upper side, one long edge, counts.
START_TEST(flat_triangle) {
  LevelRun run([](PlaneDomain& domain) { add_loop(domain, rectangle(0, 0, 1, 0.1)); },
               [](double, double y) { return y > 0.0999 ? 10 : 0.02; });
  take_all(run, {{{0.4, 0.07}, -1}, {{0.7, 0.055}, -1}});
  run.renew_stars();
  expect_reference(*run.level, "strip");
  std::vector<std::int64_t> corners;
  for (std::int64_t i = 0; i < run.level->nodes.count; ++i)
    if (run.level->nodes.moves(i) || run.level->nodes.position(i) == P{1, 0.1})
      corners.push_back(i);
  const std::vector<Triangle> triangles = star_triangles(*run.level);
  quick_assert(std::count(triangles.begin(), triangles.end(),
                          Triangle{corners.at(0), corners.at(1), corners.at(2)}) == 1);
}
END_TEST

// Coarse bubbles lie close to a jump of d, and one fine bubble lies beyond a strip of empty
// buckets. It is too small for the list of the coarse bubble opposite, but within the circle of its
// triangle.
START_TEST(fine_node_beyond_empty_buckets) {
  LevelRun run(add_square, [](double x, double) { return x < 0.5 ? 0.06 : 0.004; });
  pnpbs::IncomingNodes<2> nodes;
  const P coarse[] = {{0.49875, 0.4}, {0.49995, 0.41025}, {0.49995, 0.38975},
                      {0.48, 0.43},   {0.46, 0.4},        {0.48, 0.37}};
  for (const P& x : coarse) nodes.push_back({x, -1});
  nodes.push_back({{0.583, 0.4}, -1});
  take_all(run, nodes);
  run.renew_stars();
  expect_reference(*run.level, "fine node");
}
END_TEST

// All circles hold four or more nodes. The diagonals are just within, just beyond or exactly at the
// reach of the lists.
START_TEST(exact_grids) {
  const double h = 1.0 / 16;
  for (const double radius : {1.5, 1.7}) {
    std::vector<double> spacings{h, 0.9 * h, 1.25 * h};
    double d = std::sqrt(2.0) * h / radius;
    for (int k = 0; k < 4; ++k) d = std::nextafter(d, 0.0);
    for (int k = 0; k < 9; ++k) {
      spacings.push_back(d);
      d = std::nextafter(d, 1.0);
    }
    for (const double spacing : spacings) {
      LevelRun run(add_square, constant(spacing), {{"list_radius", "1.5"}});
      pnpbs::IncomingNodes<2> grid;
      for (int i = 2; i < 14; ++i)
        for (int j = 2; j < 14; ++j) grid.push_back({{(i + 0.5) * h, (j + 0.5) * h}, -1});
      Random(71).shuffle(grid);
      take_all(run, grid);
      pnpbs::rebuild_lists(*run.level, radius);
      pnpbs::rebuild_stars(*run.level);
      expect_reference(*run.level, "grid");
    }
  }
}
END_TEST

// Ids decide ties, so every order of the ids must give consistent stars.
START_TEST(many_nodes_on_one_circle) {
  Random random(72);
  for (int trial = 0; trial < 20; ++trial) {
    LevelRun run(add_square, constant(0.04));
    pnpbs::IncomingNodes<2> nodes;
    for (int x = -65; x <= 65; ++x)
      for (int y = -65; y <= 65; ++y)
        if (x * x + y * y == 65 * 65) nodes.push_back({{0.5 + x / 256.0, 0.5 + y / 256.0}, -1});
    ck_assert_uint_eq(nodes.size(), 36);
    if (trial % 2) nodes.push_back({{0.5, 0.5}, -1});
    random.shuffle(nodes);
    for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k].id = 100 + static_cast<std::int64_t>(k);
    take_all(run, nodes);
    run.renew_stars();
    expect_reference(*run.level, "circle");
  }
}
END_TEST

// Nodes that were pushed into one corner may end one unit in the last place apart. Rounding would
// make the circles of their flat triangles too small or far too large.
START_TEST(nodes_an_ulp_apart) {
  Random random(73);
  for (const double factor : {1.0, 25.0}) {
    LevelRun run(add_square, [&](double x, double) { return x < 0.52 ? factor * 0.012 : 0.012; });
    pnpbs::IncomingNodes<2> nodes;
    for (int pair = 0; pair < 60; ++pair) {
      // The factor 25 places them close to the clearance of the coarse nodes, 0.12.
      const P x{0.12 + (pair % 2) * random.between(0, 0.3), 0.12 + 0.01 * pair};
      nodes.push_back({x, -1});
      nodes.push_back({{std::nextafter(x[0], 1.0), x[1]}, -1});
      if (pair % 3 == 0) nodes.push_back({{x[0], std::nextafter(x[1], 0.0)}, -1});
    }
    pnpbs::take(*run.level, nodes, 0);
    run.renew_stars();
    expect_reference(*run.level, "an ulp apart");
  }
}
END_TEST

TEST_SUITE(test_stars) {
  return run_kernel_suite(
      "stars",
      {small_shapes_with_constant_spacing, small_shapes_with_graded_spacing,
       small_shapes_with_a_jump, small_shapes_far_too_coarse, lakes, scattered_nodes, flat_triangle,
       fine_node_beyond_empty_buckets, exact_grids, many_nodes_on_one_circle, nodes_an_ulp_apart});
}
