// SPDX-License-Identifier: BSD-3-Clause
// What a run would come to, before it makes any inner node.
#pragma once

#include <cstdint>
#include <memory>

#include "comm/communicator.hpp"
#include "domain/plane/plane_domain.hpp"
#include "spacing/spacing.hpp"
#include "spacing/steepest_growth.hpp"

namespace pnpbs {

struct Estimate {
  std::int64_t nodes = 0;  // of all ranks
  std::int64_t bytes = 0;  // memory of each process
  double seconds = 0;      // roughly
};

struct NodeEstimate {
  double nodes = 0;
  SteepestGrowth steepest;
};

// By samples of d in some thousand cells, more of them where there would be more nodes. Collective.
NodeEstimate estimate_nodes(const Communicator& comm, const PlaneDomain& domain,
                            const Spacing<2>& spacing, std::int64_t max_boundary_nodes);

}  // namespace pnpbs
