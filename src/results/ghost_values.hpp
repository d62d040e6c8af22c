// SPDX-License-Identifier: BSD-3-Clause
// Values at the nodes of a rank, followed by those at its ghosts.
#pragma once

#include <vector>

#include "comm/ghost_update.hpp"
#include "results/nodal_results.hpp"

namespace pnpbs {

// Returns `values`, an array [owned nodes][components], extended by the values of the ghosts. All
// ranks must call it, and if one rank throws, all ranks throw.
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
