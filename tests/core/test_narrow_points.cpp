// SPDX-License-Identifier: BSD-3-Clause
// Detection of regions narrower than d, in plates of known thickness.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "placement/placement_impl.hpp"
#include "quick_assert.hpp"
#include "run_kernel_suite.hpp"
#include "sizing/narrow_points.hpp"

using Point3 = pnpbs::Point<3>;
using Source = pnpbs::GrowthSource<3>;
using Placement3 = pnpbs::PlacementImpl<3>;

namespace {

constexpr double kSpacing = 0.2;

// Returns a plate of this thickness, and a block beside it that is not narrow.
std::unique_ptr<Placement3> plate(double thickness) {
  auto domain = std::make_shared<pnpbs::VolumeDomain>();
  domain->add_box({0, 0, 0}, {1, 1, thickness}, 1);
  domain->add_box({2, 0, 0}, {3, 1, 1}, 2);
  pnpbs::Options options;
  options.set("conforming_rounds", "0");
  auto placement =
      std::make_unique<Placement3>(pnpbs::serial_communicator(), std::move(domain), options);
  placement->set_spacing(std::make_shared<pnpbs::ConstantSpacing<3>>(kSpacing));
  ck_assert(placement->initialise() != pnpbs::Outcome::stopped);
  return placement;
}

bool on_a_side(const Point3& x, double thickness) {
  return x[0] < 1.5 && std::min(std::fabs(x[2]), std::fabs(x[2] - thickness)) < 1e-12;
}

}  // namespace

// Both sides of the plate are found, but neither its rim nor the block.
START_TEST(a_plate_is_narrow_all_over) {
  constexpr double kThickness = 0.1;
  const auto placement = plate(kThickness);
  double left = 1, right = 0;
  for (const Source& source : pnpbs::narrow_points(placement->level(), {})) {
    quick_assert(on_a_side(source.x, kThickness));
    ck_assert_double_eq_tol(source.d, kThickness, 1e-12);
    left = std::min(left, source.x[0]);
    right = std::max(right, source.x[0]);
  }
  ck_assert_double_le(left, kThickness);
  ck_assert_double_ge(right, 1 - kThickness);
}
END_TEST

START_TEST(near_places_alone) {
  const auto placement = plate(0.1);
  const std::vector<Source> places{{{0.5, 0.5, 0.1}, kSpacing}, {{2.5, 0.5, 1}, kSpacing}};
  const std::vector<Source> all = pnpbs::narrow_points(placement->level(), {});
  const std::vector<Source> near = pnpbs::narrow_points(placement->level(), places);
  std::size_t expected = 0;
  for (const Source& source : all) expected += pnpbs::distance<3>(source.x, places[0].x) < kSpacing;
  ck_assert_uint_gt(expected, 0);
  ck_assert_uint_lt(expected, all.size());
  ck_assert_uint_eq(near.size(), expected);
  for (const Source& source : near)
    quick_assert(pnpbs::distance<3>(source.x, places[0].x) < kSpacing);
}
END_TEST

// One round reduces d by a bounded factor, however thin the plate is.
START_TEST(a_foil_is_come_near_to_in_rounds) {
  const auto placement = plate(0.01);
  const std::vector<Source> found = pnpbs::narrow_points(placement->level(), {});
  ck_assert_uint_gt(found.size(), 0);
  for (const Source& source : found) ck_assert_double_eq_tol(source.d, 0.3 * kSpacing, 1e-12);
}
END_TEST

TEST_SUITE(test_narrow_points) {
  return run_kernel_suite("narrow_points", {a_plate_is_narrow_all_over, near_places_alone,
                                            a_foil_is_come_near_to_in_rounds});
}
