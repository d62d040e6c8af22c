// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/available_memory.hpp"
#include "base/kokkos_runtime.hpp"

namespace pnpbs {

namespace {

constexpr double kBytesOfProcess = 30e6;  // without nodes

// Throughput of one core of a current server, over cases with graded and uniform d. [nodes/s]
// docs/benchmarks.md.
constexpr double kNodesPerSecond = 400e3, kNodesPerSecondBest = 140e3, kNodesPerSecondPaper = 20e3;
// Throughput in bodies of 70 000 nodes. [nodes/s] docs/comparison_volumes.md.
constexpr double kNodesPerSecondInSpace = 20e3;

template <int Dim>
double nodes_per_second(const Options& options) {
  if (Dim == 3) return kNodesPerSecondInSpace;
  if (options.choice("method") == "paper") return kNodesPerSecondPaper;
  return options.choice("effort") == "best" ? kNodesPerSecondBest : kNodesPerSecond;
}

}  // namespace

template <int Dim>
Estimate estimate_of(const EffectiveSpacing<Dim>& to_place, const Settings& settings) {
  const Communicator& comm = to_place.comm();
  const double ranks = comm.size();
  const double nodes =
      estimated_nodes(to_place, to_place.effective_spacing(settings), settings, Samples::many);
  const auto threads =
      static_cast<double>(comm.allreduce_sum(static_cast<std::uint64_t>(thread_count())));
  return {static_cast<std::int64_t>(std::round(nodes)),
          static_cast<std::int64_t>(kBytesOfProcess + kBytesPerNode * nodes / ranks),
          nodes / (nodes_per_second<Dim>(to_place.options()) * std::max(1.0, threads))};
}

// Limits the growth of d in the same way as the run does. This builds the same tree and throws
// where the run would throw.
template <int Dim>
double estimated_nodes(const EffectiveSpacing<Dim>& to_place, SizingField<Dim> spacing,
                       const Settings& settings, Samples samples) {
  const auto estimate_with = [&](const Spacing<Dim>& d) {
    return estimate_nodes<Dim>(
        to_place.comm(), to_place.domain(), d, settings.max_nodes,
        {lattice_is_stretched(to_place.options()), settings.makes_first_row()}, samples);
  };
  if (!settings.user_limits_growth()) {
    const NodeEstimate<Dim> estimate = estimate_with(spacing);
    if (settings.growth_limit == 0 || !too_steep(estimate.steepest)) return estimate.nodes;
  }
  to_place.limit_growth(spacing, settings);
  return estimate_with(spacing).nodes;
}

double bytes_allowed(const Communicator& comm, const Options& options) {
  const double share = Settings(options).max_memory;
  if (share == 0) return std::numeric_limits<double>::infinity();
  const double mine = available_memory() / comm.ranks_on_node();
  return share * -comm.allreduce_max(-mine) * comm.size();
}

template Estimate estimate_of(const EffectiveSpacing<2>&, const Settings&);
template Estimate estimate_of(const EffectiveSpacing<3>&, const Settings&);
template double estimated_nodes(const EffectiveSpacing<2>&, SizingField<2>, const Settings&,
                                Samples);
template double estimated_nodes(const EffectiveSpacing<3>&, SizingField<3>, const Settings&,
                                Samples);

}  // namespace pnpbs
