// SPDX-License-Identifier: BSD-3-Clause
// Nodes are equal to the bit for any rebuild schedule of the lists and any order in memory.
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "level_run.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"

using Level = pnpbs::Level<2>;
using pnpbs::PlaneDomain;
using shapes::add_chain;
using shapes::add_circle;
using shapes::add_loop;
using shapes::rectangle;
using P = pnpbs::Point<2>;

namespace {

// Position and velocity of each node, by id.
using State = std::map<std::int64_t, std::array<double, 4>>;

State state_of(const Level& level) {
  const pnpbs::Nodes<2>& nodes = level.nodes;
  State state;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    state[nodes.id(i)] = {nodes.x[0](i), nodes.x[1](i), nodes.v[0](i), nodes.v[1](i)};
  ck_assert_uint_eq(state.size(), static_cast<std::size_t>(nodes.count));
  return state;
}

void expect_same(const State& a, const State& b, const std::string& what, std::int64_t step) {
  quick_assert_msg(a.size() == b.size(), "%s, step %lld: %zu nodes and %zu", what.c_str(),
                   static_cast<long long>(step), a.size(), b.size());
  for (const auto& [id, values] : a) {
    const auto found = b.find(id);
    quick_assert_msg(found != b.end(), "%s, step %lld: node %lld is in one set only", what.c_str(),
                     static_cast<long long>(step), static_cast<long long>(id));
    quick_assert_msg(found->second == values,
                     "%s, step %lld: node %lld at (%.17g, %.17g) and (%.17g, %.17g)", what.c_str(),
                     static_cast<long long>(step), static_cast<long long>(id), values[0], values[1],
                     found->second[0], found->second[1]);
  }
}

struct Case {
  std::string name;
  Build build;
  Plane d;
  OptionList options;
};

void add_square(PlaneDomain& domain) { add_loop(domain, rectangle(0, 0, 1, 1)); }

const OptionList kPaper{{"method", "paper"}};

std::vector<Case> cases() {
  const Build slit = [](PlaneDomain& p) {
    add_square(p);
    add_chain(p, {0.2, 0.5, 0.6, 0.53, 0.62, 0.8});
  };
  const Build ring = [](PlaneDomain& p) {
    add_circle(p, 0.5, 0.5, 0.5);
    add_circle(p, 0.4, 0.45, 0.05);
    add_circle(p, 0.7, 0.6, 0.012);
  };
  const Build lake = [](PlaneDomain& p) { add_lake(p, "lake_victoria"); };
  const Build islands = [](PlaneDomain& p) { add_lake(p, "great_lakes_islands"); };
  const Plane graded = [](double x, double y) { return 0.008 + 0.05 * std::hypot(x - 0.4, y); };
  const Plane on_lake = [](double x, double y) { return 2 + 0.03 * std::hypot(x, y); };
  const Plane on_lakes = [](double x, double y) { return 8 + 0.01 * std::hypot(x, y); };
  return {{"square", add_square, graded, {}},  {"square, paper", add_square, graded, kPaper},
          {"slit", slit, graded, {}},          {"slit, paper", slit, graded, kPaper},
          {"ring", ring, constant(0.025), {}}, {"lake", lake, on_lake, {}},
          {"islands", islands, on_lakes, {}},  {"lake, paper", lake, on_lake, kPaper}};
}

// Returns a fill with random displacements, so that nodes move.
pnpbs::IncomingNodes<2> shaken(const Case& c, std::uint64_t seed) {
  LevelRun fill(c.build, c.d);
  fill_level(*fill.level);
  pnpbs::IncomingNodes<2> nodes = inner_nodes_of(*fill.level);
  Random random(seed);
  for (pnpbs::IncomingNode<2>& node : nodes)
    for (double& x : node.position)
      x += random.between(-0.3, 0.3) * c.d(node.position[0], node.position[1]);
  return nodes;
}

void finish(Level& level) {
  pnpbs::finish_by_runge_kutta(level);
  pnpbs::sweep_and_repair(level, 6);
}

void expect_rebuilds_do_not_matter(const Case& c) {
  const pnpbs::IncomingNodes<2> start = shaken(c, 140);
  LevelRun seldom(c.build, c.d, c.options), always(c.build, c.d, c.options);
  pnpbs::take(*seldom.level, start, 0);
  pnpbs::take(*always.level, start, 0);
  for (int step = 0; step < 60; ++step) {
    seldom.steps(1);
    always.steps(1, true);
    expect_same(state_of(*seldom.level), state_of(*always.level), c.name, seldom.steps_done);
  }
  ck_assert_int_ge(always.level->neighbourhood.rebuilds(), 60);
  ck_assert_int_lt(seldom.level->neighbourhood.rebuilds(),
                   always.level->neighbourhood.rebuilds() - 10);
}

}  // namespace

START_TEST(rebuilds_do_not_matter_in_a_square) {
  for (const Case& c : cases())
    if (c.name == "square") expect_rebuilds_do_not_matter(c);
}
END_TEST

START_TEST(rebuilds_do_not_matter_around_obstacles) {
  for (const Case& c : cases())
    if (c.options.empty() && c.name != "square") expect_rebuilds_do_not_matter(c);
}
END_TEST

START_TEST(rebuilds_do_not_matter_to_the_papers_scheme) {
  for (const Case& c : cases())
    if (!c.options.empty()) expect_rebuilds_do_not_matter(c);
}
END_TEST

START_TEST(order_in_memory_does_not_matter) {
  for (const Case& c : cases()) {
    pnpbs::IncomingNodes<2> start = shaken(c, 150);
    LevelRun straight(c.build, c.d, c.options), mixed(c.build, c.d, c.options);
    pnpbs::take(*straight.level, start, 0);
    Random(151).shuffle(start);
    pnpbs::take(*mixed.level, start, 0);
    straight.steps(45);
    mixed.steps(45);
    expect_same(state_of(*straight.level), state_of(*mixed.level), c.name, 45);
    for (Level* level : {straight.level.get(), mixed.level.get()}) {
      finish(*level);
    }
    expect_same(state_of(*straight.level), state_of(*mixed.level), c.name + ", finished", 46);
  }
}
END_TEST

TEST_SUITE(test_invariance) {
  return run_kernel_suite(
      "invariance", {rebuilds_do_not_matter_in_a_square, rebuilds_do_not_matter_around_obstacles,
                     rebuilds_do_not_matter_to_the_papers_scheme, order_in_memory_does_not_matter});
}
