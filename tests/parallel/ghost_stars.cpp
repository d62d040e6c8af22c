// SPDX-License-Identifier: BSD-3-Clause
// Tests that ranks receive the stars of ghosts from the owners: in all rings they are the stars
// that one rank finds, also if a rank must fetch nodes for them, and no rank finds a star for
// another.
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/index_by_id.hpp"
#include "base/mixed_hash.hpp"
#include "core/volume_tetrahedra.hpp"
#include "level/exchange.hpp"
#include "level/lists_and_stars.hpp"
#include "level/reach.hpp"
#include "method/constants.hpp"
#include "neighbors/rings.hpp"
#include "placement/placement_impl.hpp"
#include "rank_checks.hpp"

namespace {

using rank_checks::comm;
using rank_checks::expect;
using Level = pnpbs::Level<3>;

std::unique_ptr<pnpbs::PlacementImpl<3>> placed(
    const std::shared_ptr<const pnpbs::Communicator>& ranks) {
  auto domain = std::make_shared<pnpbs::VolumeDomain>();
  domain->add_box({0, 0, 0}, {1, 1, 1}, 1);
  auto placement =
      std::make_unique<pnpbs::PlacementImpl<3>>(ranks, std::move(domain), pnpbs::Options());
  placement->set_spacing(
      std::make_shared<pnpbs::CallbackSpacing<3>>([](std::int64_t n, const double* x, double* d) {
        for (std::int64_t i = 0; i < n; ++i) d[i] = 0.05 + 0.15 * x[3 * i];
        return std::int32_t{0};
      }));
  expect(placement->run() != pnpbs::Outcome::stopped, "the run ends");
  placement->results().prepare_stars();
  return placement;
}

using StarsById = std::map<std::int64_t, volume_tetrahedra::Star>;

// Moves free nodes by up to `way` times d along each axis. Directions depend on the id only.
void shift_nodes(Level& level, double way) {
  pnpbs::Nodes<3>& nodes = level.nodes;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.moves(i)) continue;
    pnpbs::Point<3> x = nodes.position(i);
    std::uint64_t h = static_cast<std::uint64_t>(nodes.id(i));
    for (double& coordinate : x) {
      h = pnpbs::mixed(h);
      coordinate += way * nodes.d(i) * (static_cast<double>(h % 1024) / 512 - 1);
    }
    nodes.set_position(i, x);
  }
  nodes.moved();
  nodes.set_reference_positions();
}

// Finds all stars without earlier ones.
StarsById stars_from_scratch(Level& level) {
  level.stars_before.forget();
  make_lists_and_stars(level, pnpbs::kRepairHops, level.settings.list_radius, {});
  StarsById stars;
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    stars[level.nodes.id(i)] = volume_tetrahedra::star_by_ids(level.nodes, level.stars, i);
  return stars;
}

// Checks the stars of the owned nodes and of the ghosts in the rings around them.
void check_stars(const Level& level, int rings, const StarsById& alone, const std::string& where) {
  const pnpbs::Nodes<3>& nodes = level.nodes;
  std::vector<char> reached(nodes.owned.data(), nodes.owned.data() + nodes.count);
  std::vector<std::int64_t> ring;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (nodes.owned(i)) ring.push_back(i);
  for (int r = 0; r <= rings; ++r) {
    expect(!ring.empty(), where + ": a ring has nodes");
    for (const std::int64_t i : ring) {
      expect(level.stars.found(i) && level.stars.needs(i) == 0, where + ": stars are found");
      expect(volume_tetrahedra::star_by_ids(nodes, level.stars, i) == alone.at(nodes.id(i)),
             where + ": the stars of one rank, in ring " + std::to_string(r));
    }
    ring = next_ring(level.stars, ring, reached);
  }
}

constexpr double kReach = 3.3;  // of nodes that must be known, in units of d

// Checks that a rank knows all nodes whose distance from an owned node is less than the sum of both
// reaches.
void check_pairs(const Level& level, const Level& alone, const std::string& where) {
  const pnpbs::Nodes<3>&nodes = level.nodes, &all = alone.nodes;
  const pnpbs::IndexById known(nodes);
  std::int64_t pairs = 0;
  for (std::int64_t j = 0; j < all.count; ++j) {
    if (known.of(all.id(j)) >= 0) continue;
    for (std::int64_t i = 0; i < nodes.count; ++i)
      pairs += nodes.owned(i) && pnpbs::distance<3>(nodes.position(i), all.position(j)) <
                                     kReach * (nodes.d(i) + all.d(j));
  }
  expect(pairs == 0, where + ": all pairs are known");
}

// Finds the stars with ghosts of this depth.
void check_with_ghosts(Level& level, int hops, const Level& alone, const StarsById& expected,
                       const std::string& when) {
  const std::string where = "with " + std::to_string(hops) + " hops, " + when;
  const double radius = level.settings.list_radius;
  exchange(level, hops);
  const std::int64_t ghosts = level.nodes.count - level.owned_count();
  const pnpbs::NodesWorkedFor before = level.timers.nodes(pnpbs::Phase::stars);
  make_lists_and_stars(level, hops, radius, {pnpbs::method::kSliverRings, kReach});
  const pnpbs::NodesWorkedFor after = level.timers.nodes(pnpbs::Phase::stars);
  expect(after.owned > before.owned && after.all - before.all == after.owned - before.owned,
         where + ": stars are found by the owner only");
  check_stars(level, pnpbs::method::kSliverRings, expected, where);
  check_pairs(level, alone, where);
  const std::int64_t fetched = level.nodes.count - level.owned_count() - ghosts;
  const auto all_fetched = level.comm->allreduce_sum(static_cast<std::uint64_t>(fetched));
  expect(hops > 1 || all_fetched > 0, where + ": nodes are fetched");
}

void check_all() {
  const auto one = placed(pnpbs::serial_communicator()), placement = placed(comm);
  auto& alone = const_cast<Level&>(one->level());
  auto& level = const_cast<Level&>(placement->level());
  StarsById expected = stars_from_scratch(alone);
  expect(
      level.comm->allreduce_sum(static_cast<std::uint64_t>(level.owned_count())) == expected.size(),
      "the nodes of one rank");
  check_with_ghosts(level, 1, alone, expected, "from scratch");
  check_with_ghosts(level, pnpbs::kRepairHops, alone, expected, "from scratch");
  for (const double way : {0.2, -0.2, 0.2}) {
    take_stars(level);
    shift_nodes(alone, way);
    shift_nodes(level, way);
    expected = stars_from_scratch(alone);
    check_with_ghosts(level, 1, alone, expected, "with kept stars");
  }
}

}  // namespace

int main(int argc, char** argv) { return rank_checks::run_in_groups(argc, argv, check_all); }
