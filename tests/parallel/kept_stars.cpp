// SPDX-License-Identifier: BSD-3-Clause
// Tests that stars in space are restored if no node of any rank has moved, been inserted or
// deleted, and are rebuilt otherwise. In both cases they equal stars built from scratch.
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/volume_tetrahedra.hpp"
#include "level/finding_stars.hpp"
#include "level/finish.hpp"
#include "level/lists_and_stars.hpp"
#include "level/reach.hpp"
#include "placement/placement_impl.hpp"
#include "rank_checks.hpp"
#include "volume_bodies.h"

namespace {

using rank_checks::comm;
using rank_checks::expect;
using Level = pnpbs::Level<3>;

struct Body {
  std::string name;
  std::function<void(pnpbs::VolumeDomain&)> add;
  double d;  // at x = 0; it grows with x
};

void add_rough_globe(pnpbs::VolumeDomain& domain) {
  std::vector<double> xyz(9 * GLOBE_TRIANGLES);
  const std::int64_t corners =
      volume_rough_globe_corners(0.5, 8, reinterpret_cast<double(*)[3]>(xyz.data()));
  std::vector<std::int64_t> triangles(static_cast<std::size_t>(corners));
  std::iota(triangles.begin(), triangles.end(), 0);
  domain.add_surface(pnpbs::SurfaceRole::boundary, corners, xyz.data(), corners / 3,
                     triangles.data(), nullptr, 40);
}

// Returns two bodies: a box with another box inside, and a body at whose boundary the labels of
// tetrahedra are ambiguous.
const std::vector<Body>& bodies() {
  static const std::vector<Body> all{{"a box",
                                      [](pnpbs::VolumeDomain& domain) {
                                        domain.add_box({0, 0, 0}, {1, 1, 1}, 1);
                                        domain.add_box({0.3, 0.3, 0.3}, {0.7, 0.5, 0.6}, 2);
                                      },
                                      0.06},
                                     {"a rough globe", add_rough_globe, 0.13}};
  return all;
}

std::unique_ptr<pnpbs::PlacementImpl<3>> placed(const Body& body) {
  auto domain = std::make_shared<pnpbs::VolumeDomain>();
  body.add(*domain);
  pnpbs::Options options;
  options.set("conforming_rounds", "0");
  auto placement = std::make_unique<pnpbs::PlacementImpl<3>>(comm, std::move(domain), options);
  placement->set_spacing(std::make_shared<pnpbs::CallbackSpacing<3>>(
      [d0 = body.d](std::int64_t n, const double* x, double* d) {
        for (std::int64_t i = 0; i < n; ++i) d[i] = d0 + 0.05 * x[3 * i];
        return std::int32_t{0};
      }));
  expect(placement->run() != pnpbs::Outcome::stopped, "the run ends");
  placement->results().prepare_stars();
  return placement;
}

using StarsById = std::map<std::int64_t, volume_tetrahedra::Star>;

StarsById stars_by_id(const Level& level, const pnpbs::VolumeStars& stars) {
  StarsById found;
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    if (level.nodes.owned(i))
      found[level.nodes.id(i)] = volume_tetrahedra::star_by_ids(level.nodes, stars, i);
  return found;
}

void expect_found_anew(const Level& level, const std::string& when) {
  const pnpbs::KnownRegion<3> everywhere;
  pnpbs::VolumeStars anew;
  anew.build(star_input(level, everywhere));
  expect(stars_by_id(level, level.stars) == stars_by_id(level, anew), when + ": the same stars");
}

// Builds the stars a second time. Returns whether the previous ones were restored.
bool made_again(Level& level) {
  take_stars(level);
  require_finish_lists(level);
  const bool hold = stars_hold(level);
  make_stars(level, pnpbs::kRepairHops, level.settings.list_radius, {});
  return hold;
}

// Applies a change to one owned free node near the middle of the local order, on the last rank that
// has such a node.
void change_one(Level& level, const std::function<void(std::int64_t)>& change) {
  std::int64_t some = -1;
  for (std::int64_t i = 0; i < level.nodes.count && some < level.nodes.count / 2; ++i)
    if (level.nodes.owned(i) && level.nodes.carrier(i) == pnpbs::Carrier::free) some = i;
  const double last = comm->allreduce_max(some < 0 ? -1.0 : comm->rank());
  if (last == comm->rank()) change(some);
}

// Checks that stars are restored if no node changes, and are rebuilt if one node moves by one bit
// or gets another d. Elements at a non-manifold boundary get other labels; stars with such labels
// are not restored and must be replaced.
void check_restore(Level& level, const Body& body) {
  made_again(level);
  expect(made_again(level), "stars are put back");
  expect_found_anew(level, body.name + ", put back");

  change_one(level, [&](std::int64_t i) {
    pnpbs::Point<3> x = level.nodes.position(i);
    x[0] = std::nextafter(x[0], 9.0);
    level.nodes.set_position(i, x);
  });
  expect(!made_again(level), "not where a node has moved by a bit");
  expect_found_anew(level, body.name + ", after a move by a bit");

  change_one(level, [&](std::int64_t i) { level.nodes.d(i) *= 0.5; });
  expect(!made_again(level), "not where a node has another d");
  expect_found_anew(level, body.name + ", with another d");
}

// Checks the stars after a repair, which invalidates some of them.
void check_after_repair(Level& level, const Body& body) {
  sweep_and_repair(level, 1);
  make_finish_stars(level, {});
  expect_found_anew(level, body.name + ", after a repair");
}

void check_all() {
  for (const Body& body : bodies()) {
    const auto placement = placed(body);
    auto& level = const_cast<Level&>(placement->level());
    expect_found_anew(level, body.name + ", after the run");
    check_restore(level, body);
    check_after_repair(level, body);
  }
}

}  // namespace

int main(int argc, char** argv) { return rank_checks::run_in_groups(argc, argv, check_all); }
