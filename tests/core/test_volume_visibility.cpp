// SPDX-License-Identifier: BSD-3-Clause
// Visibility near the boundary of a level in space, against all nodes and all faces: nodes whose
// lists lack a hidden node, and the distance from a node to a face.
#include <algorithm>
#include <cmath>
#include <memory>

#include "level/finish.hpp"
#include "level/lists_and_stars.hpp"
#include "placement/placement_impl.hpp"
#include "run_kernel_suite.hpp"

using pnpbs::Carrier;
using Level = pnpbs::Level<3>;
using Placement = pnpbs::PlacementImpl<3>;

namespace {

constexpr double kLow = 0.4, kHigh = 0.65;  // extent of the cavity

// Returns a cube with a cavity, whose edges hide nodes from each other.
std::unique_ptr<Placement> cube_with_cavity() {
  auto domain = std::make_shared<pnpbs::VolumeDomain>();
  domain->add_box({0, 0, 0}, {1, 1, 1}, 1);
  domain->add_box({kLow, kLow, kLow}, {kHigh, kHigh, kHigh}, 2);
  auto placement = std::make_unique<Placement>(pnpbs::serial_communicator(), std::move(domain),
                                               pnpbs::Options());
  placement->set_spacing(std::make_shared<pnpbs::ConstantSpacing<3>>(0.125));
  ck_assert(placement->run() != pnpbs::Outcome::stopped);
  placement->results().prepare_stars();
  return placement;
}

double distance_to_boundary(const pnpbs::Point<3>& x) {
  double wall = 1, beyond = 0;
  for (const double along : x) {
    wall = std::min({wall, along, 1 - along});
    const double gap = std::max({kLow - along, along - kHigh, 0.0});
    beyond += gap * gap;
  }
  return std::min(wall, std::sqrt(beyond));
}

}  // namespace

START_TEST(lists_that_lack_a_node) {
  const std::unique_ptr<Placement> placement = cube_with_cavity();
  const Level& level = placement->level();
  const pnpbs::Nodes<3>& nodes = level.nodes;
  int lacking = 0, complete_on_boundary = 0;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    int near = 0, listed = 0;
    for (std::int64_t j = 0; j < nodes.count; ++j) {
      const double reach = 0.5 * level.lists().radius() * (nodes.d(i) + nodes.d(j));
      near += j != i && pnpbs::distance<3>(nodes.position(i), nodes.position(j)) < reach ? 1 : 0;
    }
    level.lists().for_neighbours(i, [&](std::int64_t) { ++listed; });
    ck_assert_int_eq(level.neighbourhood.near_boundary().sees_all(i), listed == near);
    lacking += listed < near ? 1 : 0;
    complete_on_boundary += listed == near && nodes.carrier(i) != Carrier::free ? 1 : 0;
  }
  ck_assert_int_gt(lacking, 20);
  ck_assert_int_gt(complete_on_boundary, 100);
}
END_TEST

START_TEST(room_around_nodes) {
  const std::unique_ptr<Placement> placement = cube_with_cavity();
  const Level& level = placement->level();
  const pnpbs::Nodes<3>& nodes = level.nodes;
  int near = 0;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (nodes.carrier(i) != Carrier::free) continue;
    const double distance = distance_to_boundary(nodes.position(i));
    const double room = level.neighbourhood.near_boundary().room(i, nodes);
    ck_assert_double_le(room, distance + 1e-12);
    ck_assert_double_ge(room, std::min(distance, nodes.d(i)) - 1e-12);
    near += distance < nodes.d(i) ? 1 : 0;
  }
  ck_assert_int_gt(near, 50);
}
END_TEST

// Also for nodes that have moved several times since the lists were built.
START_TEST(nodes_that_went_on) {
  constexpr double kClearance = 0.6, kWay = 0.25;  // in spacings
  const std::unique_ptr<Placement> placement = cube_with_cavity();
  auto& level = const_cast<Level&>(placement->level());
  pnpbs::require_finish_lists(level);
  pnpbs::Nodes<3>& nodes = level.nodes;
  int refused = 0;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (nodes.carrier(i) != Carrier::free) continue;
    for (int go = 0; go < 12; ++go) {
      const double d = nodes.d(i), before = distance_to_boundary(nodes.position(i));
      pnpbs::Point<3> to = nodes.position(i);
      to[2] -= kWay * d;
      const double after = distance_to_boundary(to);
      const bool clear = to[2] > 0 && (after >= kClearance * d || after >= before);
      if (std::fabs(after - kClearance * d) < 1e-9 || std::fabs(after - before) < 1e-9) break;
      ck_assert_int_eq(level.neighbourhood.near_boundary().stays_clear(i, nodes, level.geometry, to,
                                                                       kClearance * d),
                       clear);
      refused += clear ? 0 : 1;
      if (!clear) break;
      nodes.set_position(i, to);
    }
  }
  ck_assert_int_gt(refused, 100);
}
END_TEST

TEST_SUITE(test_volume_visibility) {
  return run_kernel_suite("volume_visibility",
                          {lists_that_lack_a_node, room_around_nodes, nodes_that_went_on});
}
