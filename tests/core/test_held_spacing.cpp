// SPDX-License-Identifier: BSD-3-Clause
// Points at which d is held down reach the background tree of a level even if few of its samples
// are near them.
#include <memory>

#include "level/level.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "sizing/holding_spacing.hpp"

using Point3 = pnpbs::Point<3>;

namespace {

constexpr double kSpacing = 0.05, kHeld = 0.002;

// The block has enough samples. The plate beside it is so thin that hardly any lie in it.
constexpr pnpbs::Box<3> kBlock{{0, 0, 0}, {1, 1, 0.3}}, kPlate{{0, 0, 0.306}, {1, 1, 0.31}};

// Returns the smallest d that the tree of a level assumes around the point.
double expected_at(const Point3& place) {
  auto domain = std::make_shared<pnpbs::VolumeDomain>();
  domain->add_box(kBlock.low, kBlock.high, 1);
  domain->add_box(kPlate.low, kPlate.high, 1);
  domain->check();
  const pnpbs::Settings settings{pnpbs::Options(), 3};
  pnpbs::PlacedSpacing<3> placed;
  placed.d = pnpbs::SizingField<3>(std::make_shared<pnpbs::ConstantSpacing<3>>(kSpacing));
  placed.held.places.push_back({place, kHeld});
  const auto comm = pnpbs::serial_communicator();
  pnpbs::apply_local_reductions(*comm, placed, settings);
  pnpbs::Timers timers(comm->seconds_waited());
  pnpbs::Level<3> level(comm, domain, std::make_shared<pnpbs::SizingField<3>>(placed.d), settings,
                        timers);
  level.grow_tree();
  return level.map().leaf_min_spacing(level.map().tree().leaf_at(place));
}

}  // namespace

START_TEST(a_place_is_known_between_samples) {
  Random random(27);
  for (int k = 0; k < 40; ++k) {
    const Point3 place = random.point(kPlate);
    // d is at most 1.4 times kHeld here. Nodes that meet a d below kFarFiner times the tree's value
    // would restart the run.
    ck_assert_double_le(expected_at(place), 2 * kHeld);
  }
}
END_TEST

TEST_SUITE(test_held_spacing) {
  return run_kernel_suite("held_spacing", {a_place_is_known_between_samples});
}
