// SPDX-License-Identifier: BSD-3-Clause
// What a run would come to, before it makes any inner node.
#pragma once

#include <cstdint>
#include <memory>

#include "comm/communicator.hpp"
#include "domain/domain.hpp"
#include "spacing/spacing.hpp"
#include "spacing/steepest_growth.hpp"

namespace pnpbs {

struct Estimate {
  std::int64_t nodes = 0;  // of all ranks
  std::int64_t bytes = 0;  // memory of each process
  double seconds = 0;      // roughly
};

template <int Dim>
struct NodeEstimate {
  double nodes = 0;
  SteepestGrowth<Dim> steepest;
};

// Near the boundary, where most of an estimate's time goes: few are enough for some per cent.
enum class Samples { few, many };

// What it depends on besides.
struct EstimatedRun {
  bool stretched;  // the lattice that fills a body with even d
  bool first_row;  // is fitted to the boundary, in the plane
};

// By samples of d in some thousand cells, more of them where there would be more nodes. Collective.
template <int Dim>
NodeEstimate<Dim> estimate_nodes(const Communicator& comm, const Domain<Dim>& domain,
                                 const Spacing<Dim>& spacing, std::int64_t max_boundary_nodes,
                                 const EstimatedRun& run, Samples samples);

}  // namespace pnpbs
