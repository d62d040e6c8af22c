// SPDX-License-Identifier: BSD-3-Clause
// Values at the nodes of a rank, and behind them those at its ghosts.
#pragma once

#include <vector>

#include "comm/ghost_update.hpp"
#include "results/nodal_results.hpp"

namespace pnpbs {

// [places][components], of which the owned ones are given. Collective.
inline std::vector<double> with_ghosts(NodalResults& results, std::int64_t components,
                                       const double* values) {
  const Communicator& comm = results.communicator();
  const auto pattern = results.exchange_pattern();
  std::vector<double> all;
  GhostUpdate update;
  collective_try(comm, [&] {
    all.assign(values, values + results.count() * components);
    all.resize(static_cast<std::size_t>(results.held() * components));
    update.pack(comm, pattern, components, all.data());
  });
  update.start();
  update.wait();
  update.unpack(all.data());
  return all;
}

}  // namespace pnpbs
