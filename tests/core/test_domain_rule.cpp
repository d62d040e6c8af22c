// SPDX-License-Identifier: BSD-3-Clause
// Tests of which flat tetrahedra below a surface are left out: those without which it keeps its
// nodes and feature edges. Four nodes are placed below the top of a cube.
#include <memory>
#include <utility>

#include "delaunay/volume/domain_rule.hpp"
#include "placement/placement_impl.hpp"
#include "quick_assert.hpp"
#include "run_kernel_suite.hpp"

using Point3 = pnpbs::Point<3>;
using pnpbs::Carrier;
using Placement3 = pnpbs::PlacementImpl<3>;

namespace {

using Four = std::array<std::int64_t, 4>;
using Edge = std::pair<std::int64_t, std::int64_t>;

std::unique_ptr<Placement3> cube() {
  auto domain = std::make_shared<pnpbs::VolumeDomain>();
  domain->add_box({0, 0, 0}, {1, 1, 1}, 1);
  auto placement = std::make_unique<Placement3>(pnpbs::serial_communicator(), std::move(domain),
                                                pnpbs::Options());
  placement->set_spacing(std::make_shared<pnpbs::ConstantSpacing<3>>(0.25));
  ck_assert(placement->run() != pnpbs::Outcome::stopped);
  return placement;
}

// Moves the first four nodes on surfaces to these points.
Four put(Placement3& placement, const std::array<Point3, 4>& x) {
  pnpbs::Nodes<3>& nodes = const_cast<pnpbs::Level<3>&>(placement.level()).nodes;
  Four four{};
  std::size_t found = 0;
  for (std::int64_t i = 0; found < 4; ++i) {
    if (nodes.carrier(i) != Carrier::surface) continue;
    nodes.set_position(i, x[found]);
    four[found++] = i;
  }
  return four;
}

// Returns the input of the star search for these nodes.
pnpbs::VolumeStarInput input_of(const Placement3& placement) {
  static const pnpbs::KnownRegion<3> everywhere;
  const pnpbs::Level<3>& level = placement.level();
  return {level.nodes,   level.tree->tree(), level.neighbourhood.buckets(),
          level.lists(), everywhere,         &level.geometry.domain().index().sides()};
}

// Returns whether the tetrahedron is an element if a feature edge connects corners `first` and
// `second` (-1: no feature edge).
bool is_element(const std::array<Point3, 4>& x, int first = -1, int second = -1) {
  const std::unique_ptr<Placement3> placement = cube();
  const Four nodes = put(*placement, x);
  const pnpbs::Level<3>& level = placement->level();
  pnpbs::VolumeStarInput input = input_of(*placement);
  input.on_one_surface = [](const Four&) { return true; };
  input.joined = [&](std::int64_t i, std::int64_t j) {
    if (first < 0) return false;
    const Edge edge{nodes[static_cast<std::size_t>(first)],
                    nodes[static_cast<std::size_t>(second)]};
    return edge == Edge{i, j} || edge == Edge{j, i};
  };
  input.nearest = [&](const Point3& at, double reach) {
    return level.geometry.domain().index().nearest(at, reach);
  };
  return pnpbs::in_domain(input, nodes);
}

bool lies_in_boundary(const std::array<Point3, 4>& x) {
  const std::unique_ptr<Placement3> placement = cube();
  const Four nodes = put(*placement, x);
  return pnpbs::lies_in_boundary(input_of(*placement), pnpbs::ordered_by_id(pnpbs::tetrahedron_of(
                                                           placement->level().nodes, nodes)));
}

// A tetrahedron with two crossing edges, of which the second is nearer to the top.
constexpr std::array<Point3, 4> kCap{
    {{0.3, 0.5, 0.97}, {0.7, 0.5, 0.97}, {0.5, 0.3, 0.99}, {0.5, 0.7, 0.99}}};

}  // namespace

START_TEST(a_cap_goes) { ck_assert(!is_element(kCap)); }
END_TEST

START_TEST(one_below_a_feature_edge_stays) {
  ck_assert(is_element(kCap, 2, 3));
  ck_assert(!is_element(kCap, 0, 1));  // this edge becomes the outer one
}
END_TEST

// The lowest node of this tetrahedron would become a vertex of the surface if the tetrahedron were
// left out.
START_TEST(one_node_below_a_face_stays) {
  ck_assert(
      is_element({{{0.3, 0.3, 0.99}, {0.7, 0.3, 0.99}, {0.5, 0.7, 0.99}, {0.5, 0.43, 0.97}}}));
}
END_TEST

START_TEST(what_is_not_flat_stays) {
  ck_assert(is_element({{{0.3, 0.5, 0.7}, {0.7, 0.5, 0.7}, {0.5, 0.3, 0.99}, {0.5, 0.7, 0.99}}}));
}
END_TEST

// A flat tetrahedron in a side is detected. It cannot be an element and need not be one.
START_TEST(a_flat_one_in_a_side_is_told) {
  ck_assert(lies_in_boundary({{{0.3, 0.3, 1}, {0.7, 0.3, 1}, {0.7, 0.7, 1}, {0.3, 0.7, 1}}}));
  ck_assert(!lies_in_boundary(
      // Across the cube.
      {{{0.3, 0.3, 0.3}, {0.7, 0.3, 0.3}, {0.7, 0.7, 0.7}, {0.3, 0.7, 0.7}}}));
  ck_assert(!lies_in_boundary(kCap));
}
END_TEST

TEST_SUITE(test_domain_rule) {
  return run_kernel_suite("domain_rule",
                          {a_cap_goes, one_below_a_feature_edge_stays, one_node_below_a_face_stays,
                           what_is_not_flat_stays, a_flat_one_in_a_side_is_told});
}
