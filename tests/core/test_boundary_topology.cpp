// SPDX-License-Identifier: BSD-3-Clause
// Tests of the points at which the topology of the boundary differs from that of the surfaces.
// Elements of a cube are removed by hand.
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "check/boundary_topology.hpp"
#include "placement/placement_impl.hpp"
#include "quick_assert.hpp"
#include "run_kernel_suite.hpp"

using Point3 = pnpbs::Point<3>;
using Placement3 = pnpbs::PlacementImpl<3>;

namespace {

constexpr double kSpacing = 0.125;

// Returns a cube without the elements around these nodes: their d is too small for the
// circumspheres.
std::unique_ptr<Placement3> cube_without(const std::function<bool(const Point3&)>& is_gone) {
  auto domain = std::make_shared<pnpbs::VolumeDomain>();
  domain->add_box({0, 0, 0}, {1, 1, 1}, 1);
  auto placement = std::make_unique<Placement3>(pnpbs::serial_communicator(), std::move(domain),
                                                pnpbs::Options());
  placement->set_spacing(std::make_shared<pnpbs::ConstantSpacing<3>>(kSpacing));
  ck_assert(placement->run() != pnpbs::Outcome::stopped);
  placement->results().prepare_stars();
  auto& level = const_cast<pnpbs::Level<3>&>(placement->level());
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    if (is_gone(level.nodes.position(i))) level.nodes.d(i) = 1e-3;
  level.stars.build({level.nodes,
                     level.tree->tree(),
                     level.neighbourhood.buckets(),
                     level.lists(),
                     {},
                     &level.geometry.domain().index().sides(),
                     [](std::int64_t) { return false; }});
  return placement;
}

bool is_near(const Point3& x, const Point3& place, double reach) {
  return pnpbs::distance<3>(x, place) < reach;
}

}  // namespace

// The boundary has more nodes around a dent in a side.
START_TEST(a_bubble_is_where_it_differs) {
  const Point3 bubble{0.5, 0.5, 0.75}, dent{0.5, 0.5, 0};
  const auto placement = cube_without([&](const Point3& x) {
    return is_near(x, bubble, 0.6 * kSpacing) || is_near(x, dent, 2.5 * kSpacing);
  });
  const std::vector<Point3> places = pnpbs::points_of_other_topology(placement->level());
  ck_assert_uint_gt(places.size(), 0);
  for (const Point3& x : places) quick_assert(is_near(x, bubble, 2.5 * kSpacing));
}
END_TEST

// The cut is reported, although each half has the topology of the surface.
START_TEST(a_cut_is_where_it_differs) {
  const auto placement =
      cube_without([](const Point3& x) { return std::fabs(x[2] - 0.5) < 0.6 * kSpacing; });
  const std::vector<Point3> places = pnpbs::points_of_other_topology(placement->level());
  ck_assert_uint_gt(places.size(), 0);
  for (const Point3& x : places) quick_assert(std::fabs(x[2] - 0.5) < 2 * kSpacing);
}
END_TEST

TEST_SUITE(test_boundary_topology) {
  return run_kernel_suite("boundary_topology",
                          {a_bubble_is_where_it_differs, a_cut_is_where_it_differs});
}
