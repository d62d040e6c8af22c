// SPDX-License-Identifier: BSD-3-Clause
// What a run would come to, and how much memory there is for it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/available_memory.hpp"
#include "base/kokkos_runtime.hpp"
#include "placement/placement_of.hpp"

namespace pnpbs {

namespace {

constexpr double kBytesOfProcess = 30e6;  // before it has any nodes

// What a core of a present server does, over cases with d graded and even (docs/benchmarks.md).
constexpr double kNodesPerSecond = 400e3, kNodesPerSecondBest = 140e3, kNodesPerSecondPaper = 20e3;
// In bodies of 70 000 nodes (docs/comparison_volumes.md).
constexpr double kNodesPerSecondInSpace = 20e3;

template <int Dim>
double nodes_per_second(const Options& options) {
  if (Dim == 3) return kNodesPerSecondInSpace;
  if (options.choice("method") == "paper") return kNodesPerSecondPaper;
  return options.choice("effort") == "best" ? kNodesPerSecondBest : kNodesPerSecond;
}

}  // namespace

template <int Dim>
Estimate PlacementOf<Dim>::estimate() {
  require_kokkos();
  require_same_options();
  const Settings settings = settings_for_new_level();
  const double ranks = comm_->size();
  const double nodes = estimated_nodes(spacing_to_place(settings), settings);
  const double threads = from_fixed_point(comm_->allreduce_sum(
      static_cast<std::uint64_t>(fixed_point(static_cast<double>(thread_count())))));
  return {static_cast<std::int64_t>(std::round(nodes)),
          static_cast<std::int64_t>(kBytesOfProcess + kBytesPerNode * nodes / ranks),
          nodes / (nodes_per_second<Dim>(options_) * std::max(1.0, threads))};
}

// With the growth of d limited as the run limits it, which takes a tree as the run does; so it is
// refused where that would be.
template <int Dim>
double PlacementOf<Dim>::estimated_nodes(std::shared_ptr<const Spacing<Dim>> spacing,
                                         const Settings& settings) const {
  const auto estimate_with = [&](const Spacing<Dim>& d) {
    return estimate_nodes<Dim>(*comm_, *domain_, d, settings.max_nodes, lattice_is_stretched());
  };
  if (!settings.user_limits_growth()) {
    const NodeEstimate<Dim> estimate = estimate_with(*spacing);
    if (settings.growth_limit == 0 || !too_steep(estimate.steepest)) return estimate.nodes;
  }
  return estimate_with(*growth_limited(std::move(spacing), settings, [] {})).nodes;
}

// Of memory, for the nodes of all ranks: these share what their machines have, and hold equal
// parts.
double Placement::bytes_allowed() const {
  const double share = Settings(options_).max_memory;
  if (share == 0) return std::numeric_limits<double>::infinity();
  const double mine = available_memory() / comm_->ranks_on_node();
  return share * -comm_->allreduce_max(-mine) * comm_->size();
}

// Of the members defined here.
template class PlacementOf<2>;
template class PlacementOf<3>;

}  // namespace pnpbs
