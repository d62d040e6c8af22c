// SPDX-License-Identifier: BSD-3-Clause
// Estimates the number of nodes of a run before any inner node exists.
#pragma once

#include <cstdint>
#include <memory>

#include "comm/communicator.hpp"
#include "domain/domain.hpp"
#include "spacing/spacing.hpp"
#include "spacing/steepest_growth.hpp"

namespace pnpbs {

struct Estimate {
  std::int64_t nodes = 0;  // Number on all ranks.
  std::int64_t bytes = 0;  // Memory of each process.
  double seconds = 0;      // Rough estimate.
};

template <int Dim>
struct NodeEstimate {
  double nodes = 0;
  SteepestGrowth<Dim> steepest;
};

// Number of samples near the boundary, where an estimate spends most of its time. With few samples,
// the error is some per cent.
enum class Samples { few, many };

// Properties of the run that affect the number of nodes.
struct EstimatedRun {
  bool stretched;  // Whether the lattice that fills a body with constant d is stretched.
  bool first_row;  // Whether a first row is fitted to the boundary, in the plane.
};

// Estimates the number of nodes from samples of d in some thousand cells, which are denser where
// there are more nodes. It also returns the steepest growth of d. Collective.
template <int Dim>
NodeEstimate<Dim> estimate_nodes(const Communicator& comm, const Domain<Dim>& domain,
                                 const Spacing<Dim>& spacing, std::int64_t max_boundary_nodes,
                                 const EstimatedRun& run, Samples samples);

}  // namespace pnpbs
