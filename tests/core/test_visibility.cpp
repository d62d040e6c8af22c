// SPDX-License-Identifier: BSD-3-Clause
// The adjacency lists in a domain: all pairs within the radius that no boundary separates.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hard_shapes.hpp"
#include "predicates/plane.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"

using hard_shapes::Shape;
using hard_shapes::small_shapes;
using pnpbs::BoundaryEdge;
using Level = pnpbs::Level<2>;
using pnpbs::PlaneDomain;
using P = pnpbs::Point<2>;

namespace {

enum class Way { free, blocked, unclear };

class Walls {
 public:
  explicit Walls(const Level& level) : level_(level) {
    const pnpbs::Box<2>& box = level.map().tree().cell_box(0);
    close_ = 1e-9 * (box.high[0] - box.low[0]);
  }

  // Prepares queries for segments from x that are at most `longest` long.
  void stand_at(const P& x, double longest) {
    near_.clear();
    for (const BoundaryEdge& e : level_.geometry.boundary().facets)
      if (gap(at(e.begin), at(e.end), x) < longest + 2 * close_) near_.push_back(e);
  }

  // Returns blocked if the segment crosses an edge or partly lies outside, and unclear if it
  // touches an edge.
  Way between(const P& x, const P& y) const {
    bool touches = false;
    for (const BoundaryEdge& e : near_) {
      if (pnpbs::cross_properly(x, y, at(e.begin), at(e.end))) return Way::blocked;
      for (const P& end : {at(e.begin), at(e.end)})
        touches = touches || (end != x && end != y && gap(x, y, end) < close_);
    }
    for (int k = 1; k < 8; ++k) {
      const double t = k / 8.0;
      const P z{x[0] + t * (y[0] - x[0]), x[1] + t * (y[1] - x[1])};
      if (along_boundary(z))
        touches = true;
      else if (!inside(z))
        return Way::blocked;
    }
    return touches ? Way::unclear : Way::free;
  }

 private:
  const P& at(std::int32_t node) const { return level_.geometry.boundary().nodes[node].position; }

  static double gap(const P& a, const P& b, const P& x) {
    const double ux = b[0] - a[0], uy = b[1] - a[1], length2 = ux * ux + uy * uy;
    if (length2 == 0) return std::hypot(x[0] - a[0], x[1] - a[1]);
    const double t = std::clamp(((x[0] - a[0]) * ux + (x[1] - a[1]) * uy) / length2, 0.0, 1.0);
    return std::hypot(x[0] - a[0] - t * ux, x[1] - a[1] - t * uy);
  }

  bool along_boundary(const P& x) const {
    for (const BoundaryEdge& e : near_)
      if (gap(at(e.begin), at(e.end), x) < close_) return true;
    return false;
  }

  bool inside(const P& x) const {
    bool inside = false;
    for (const BoundaryEdge& e : level_.geometry.boundary().facets) {
      const P &a = at(e.begin), &b = at(e.end);
      if (e.left_inside != e.right_inside && (a[1] > x[1]) != (b[1] > x[1]) &&
          (pnpbs::orientation(a, b, x) > 0) == (b[1] > a[1]))
        inside = !inside;
    }
    return inside;
  }

  const Level& level_;
  double close_;
  std::vector<BoundaryEdge> near_;
};

struct Pairs {
  std::int64_t free = 0, blocked = 0, unclear = 0;
};

void expect_lists(LevelRun& run, double radius, const std::string& what, Pairs& pairs) {
  pnpbs::rebuild_lists(*run.level, radius);
  const Level& level = *run.level;
  const pnpbs::Nodes<2>& nodes = level.nodes;
  Walls walls(level);
  std::vector<char> listed(static_cast<std::size_t>(nodes.count));
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    const P x = nodes.position(i);
    std::fill(listed.begin(), listed.end(), 0);
    level.lists().for_neighbours(i,
                                 [&](std::int64_t j) { listed[static_cast<std::size_t>(j)] = 1; });
    double longest = 0;
    for (std::int64_t j = 0; j < nodes.count; ++j)
      longest = std::max(longest, radius * 0.5 * (nodes.d(i) + nodes.d(j)));
    walls.stand_at(x, longest);
    for (std::int64_t j = 0; j < nodes.count; ++j) {
      const P y = nodes.position(j);
      const bool in_list = listed[static_cast<std::size_t>(j)] != 0;
      if (i == j || pnpbs::distance<2>(x, y) >= radius * 0.5 * (nodes.d(i) + nodes.d(j))) {
        quick_assert(!in_list);
        continue;
      }
      const Way way = walls.between(x, y);
      ++(way == Way::free ? pairs.free : way == Way::blocked ? pairs.blocked : pairs.unclear);
      if (way != Way::unclear && in_list != (way == Way::free))
        ck_abort_msg("%s: (%.17g, %.17g) and (%.17g, %.17g) should %ssee each other", what.c_str(),
                     x[0], x[1], y[0], y[1], way == Way::free ? "" : "not ");
    }
  }
}

Pairs expect_lists_in(const Shape& shape, const Plane& d) {
  LevelRun run(shape.build, d);
  fill_level(*run.level);
  Pairs pairs;
  expect_lists(run, 1.5, shape.name, pairs);
  run.steps(10);
  expect_lists(run, 1.7, shape.name, pairs);
  ck_assert_int_gt(pairs.free, 100);
  ck_assert_int_lt(pairs.unclear, pairs.free);
  return pairs;
}

}  // namespace

START_TEST(boundaries_separate) {
  std::int64_t blocked = 0;
  for (const Shape& shape : small_shapes()) {
    blocked += expect_lists_in(shape, constant(shape.d)).blocked;
    blocked += expect_lists_in(shape, hard_shapes::graded(shape.d)).blocked;
    blocked += expect_lists_in(shape, hard_shapes::jump(1.5 * shape.d)).blocked;
  }
  ck_assert_int_gt(blocked, 1000);
}
END_TEST

START_TEST(shorelines_separate) {
  const Build build = [](PlaneDomain& domain) { add_lake(domain, "lake_victoria"); };
  ck_assert_int_gt(expect_lists_in({"lake", build, 0}, constant(9)).blocked, 100);
}
END_TEST

// Segments that meet a boundary node exactly: through a wall, along one, past its end, past a
// corner.
START_TEST(ways_through_boundary_nodes) {
  const auto listed = [](const Build& build, const P& x, const P& y) {
    LevelRun run(build, constant(0.2));
    const pnpbs::ImportedNodes taken = pnpbs::take(*run.level, {{x, -1}, {y, -1}}, 0);
    ck_assert_int_eq(taken.left_out, 0);
    pnpbs::rebuild_lists(*run.level, 1.7);
    const pnpbs::Nodes<2>& nodes = run.level->nodes;
    bool found = false;
    for (std::int64_t i = 0; i < nodes.count; ++i)
      run.level->lists().for_neighbours(i, [&](std::int64_t j) {
        found = found || (nodes.position(i) == x && nodes.position(j) == y);
      });
    return found;
  };
  const auto with_wall = [](const std::vector<double>& xy) {
    return [xy](PlaneDomain& domain) {
      hard_shapes::add_square(domain);
      shapes::add_chain(domain, xy);
    };
  };
  const P left{0.375, 0.5}, right{0.625, 0.5};
  quick_assert(listed(hard_shapes::add_square, left, right));
  quick_assert(!listed(with_wall({0.5, 0.25, 0.5, 0.5, 0.5, 0.75}), left, right));  // through
  quick_assert(!listed(
      [](PlaneDomain& domain) {
        hard_shapes::add_square(domain);
        shapes::add_chain(domain, {0.25, 0.25, 0.5, 0.5, 0.75, 0.75});
        shapes::add_chain(domain, {0.25, 0.75, 0.5, 0.5, 0.75, 0.25});
      },
      left, right));
  quick_assert(listed(with_wall({0.5, 0.125, 0.5, 0.5}), left, right));  // past an end
  // Past a corner.
  quick_assert(listed(with_wall({0.4375, 0.25, 0.5, 0.5, 0.5625, 0.25}), left, right));
  // An island with two corners on the segment.
  quick_assert(!listed(
      [](PlaneDomain& domain) {
        hard_shapes::add_square(domain);
        const double xy[] = {0.484375, 0.5, 0.5, 0.484375, 0.515625, 0.5, 0.5, 0.515625};
        domain.add_polyline(pnpbs::CurveRole::boundary, true, 4, xy, nullptr, 0);
      },
      left, right));
}
END_TEST

// Nodes are driven against the boundary, far between two events. None comes closer than permitted,
// whether its edges are tested in a step or not.
START_TEST(nodes_stay_off_the_boundary) {
  LevelRun run([](PlaneDomain& p) { shapes::add_loop(p, shapes::rectangle(0, 0, 1, 1)); },
               constant(0.1), {{"event_interval", "100"}});
  fill_level(*run.level);
  run.steps(1, false, false);
  const double d = 0.1, toward_wall = -1.5 * d;
  std::int64_t at_wall = 0;
  for (int step = 0; step < 60; ++step) {
    pnpbs::Nodes<2>& nodes = run.level->nodes;
    for (std::int64_t i = 0; i < nodes.count; ++i)
      if (nodes.moves(i)) nodes.v[0](i) = toward_wall;
    run.steps(1, false, false);
    for (std::int64_t i = 0; i < nodes.count; ++i) {
      if (!nodes.moves(i)) continue;
      ck_assert_double_ge(nodes.x[0](i), 0.4 * d * (1 - 1e-9));
      at_wall += nodes.x[0](i) < 0.5 * d;
    }
  }
  ck_assert_int_gt(at_wall, 100);
}
END_TEST

// The distance that a node can move before the next event determines whether the boundary is tested
// for it. If options change this distance, it counts from the current position.
START_TEST(changed_options_count_from_here) {
  LevelRun run([](PlaneDomain& p) { shapes::add_loop(p, shapes::rectangle(0, 0, 1, 1)); },
               [](double x, double) { return 0.03 + 0.04 * x; }, {{"event_interval", "100"}});
  fill_level(*run.level);
  run.steps(10, false, false);
  const auto away_from_anchor = [&] {
    const pnpbs::Nodes<2>& nodes = run.level->nodes;
    int away = 0;
    for (std::int64_t i = 0; i < nodes.count; ++i)
      away += nodes.reference[0](i) != nodes.x[0](i) || nodes.reference[1](i) != nodes.x[1](i);
    return away;
  };
  pnpbs::Options options;
  options.set("event_interval", "100");
  options.set("damping", "0.5");
  run.level->change_settings(pnpbs::Settings(options));
  ck_assert_int_gt(away_from_anchor(), 100);
  options.set("event_interval", "22");
  run.level->change_settings(pnpbs::Settings(options));
  ck_assert_int_eq(away_from_anchor(), 0);
}
END_TEST

TEST_SUITE(test_visibility) {
  return run_kernel_suite("visibility",
                          {boundaries_separate, shorelines_separate, ways_through_boundary_nodes,
                           nodes_stay_off_the_boundary, changed_options_count_from_here});
}
