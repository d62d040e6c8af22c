// SPDX-License-Identifier: BSD-3-Clause
// Finishing a level on the Delaunay stars: sweeps, and the repair of defects.
#include <algorithm>
#include <optional>

#include "level/level.hpp"
#include "quality/plane/bad_triangles.hpp"
#include "quality/plane/surplus_nodes.hpp"
#include "quality/sweep.hpp"

namespace pnpbs {

// Lists of the present positions, from which visibility is judged from now on.
void Level::prepare_finish() {
  set_reference_positions();
  exchange(kRepairHops);
  agreed(*comm_, [this] { rebuild_lists(settings_.list_radius); });
  prepared_ = version_;
}

// In blocks of a few sweeps, within which the stars stay as they are. Surplus nodes leave the stars
// before the first sweep, so that the others can fill their places, and the level after the block.
PopulationCounts Level::sweep_and_repair(std::int64_t sweeps) {
  constexpr std::int64_t kBlock = 5;
  const bool repairs = settings_.repair.rounds > 0;
  // The guard of a node asks where its neighbours want to go, which their stars tell. Without a
  // surplus node in between a node of the second ring may be a neighbour, too; its star changes
  // with a surplus node in the third, and whether that goes hangs on the ring around it.
  const int rings = repairs ? 4 : 1;
  PopulationCounts counts;
  for (std::int64_t done = 0; done < std::max<std::int64_t>(sweeps, repairs ? 1 : 0);
       done += kBlock) {
    if (prepared_ != version_) prepare_finish();
    make_stars(kRepairHops, settings_.list_radius, rings);
    ++version_;
    const PhaseTimer timer(timers_, Phase::sweeps);
    std::vector<std::int32_t> surplus;
    agreed(*comm_, [&] {
      if (done == 0 && repairs) surplus = take_out_surplus_nodes(nodes_, stars_);
    });
    sweep_over_stars(std::min(kBlock, sweeps - done));
    const bool last = done + kBlock >= sweeps;
    if (last && repairs) repair_bad_triangles();
    if (last) find_edge_bands();  // while there are stars
    for (std::int32_t i : surplus) counts.deleted += nodes_.owned(i);
    if (!surplus.empty()) delete_nodes(surplus);
  }
  if (sweeps == 0 && !repairs) {
    if (prepared_ != version_) prepare_finish();
    make_stars(kRepairHops, settings_.list_radius, 0);
    find_edge_bands();
  }
  return counts;
}

// Whether the nodes follow d is asked after every run, so it must cost next to nothing: the stars
// of the last sweeps will do, though a few edges have other nodes by now.
void Level::find_edge_bands() {
  renew_ghosts();
  agreed(*comm_, [this] { edge_bands_ = measure_edge_bands(*comm_, nodes_, stars_); });
}

void Level::sweep_over_stars(std::int64_t times) {
  View<char> allowed;
  agreed(*comm_, [&] { allowed = make_view<char>("pnpbs::Level::allowed", nodes_.count); });
  for (std::int64_t s = 0; s < times; ++s) {
    renew_ghosts();
    pnpbs::sweep(nodes_, stars_, near_edges_, map_, settings_.sweep, next_, allowed);
    ghosts_exact_ = false;
  }
  lists_valid_ = false;
}

// The worst first: what bars a triangle from getting better may itself be only just good enough.
void Level::repair_bad_triangles() {
  const RepairRule& rule = settings_.repair;
  repair_triangles_below(std::min(rule.worst_below, rule.bad_below));
  if (rule.worst_below < rule.bad_below) repair_triangles_below(rule.bad_below);
}

void Level::repair_triangles_below(double shape) {
  renew_ghosts();
  std::optional<BadTriangleRepair> repair;
  agreed(*comm_, [&] { repair.emplace(nodes_, stars_, near_edges_, map_, shape); });
  for (std::int64_t round = 0; round < settings_.repair.rounds; ++round) {
    renew_ghosts();
    std::int64_t moved = 0;
    agreed(*comm_, [&] { moved = repair->round(); });
    ghosts_exact_ = false;
    if (comm_->allreduce_sum(static_cast<std::uint64_t>(moved)) == 0) break;
  }
  lists_valid_ = false;
}

}  // namespace pnpbs
