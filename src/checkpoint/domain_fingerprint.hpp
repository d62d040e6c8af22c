// SPDX-License-Identifier: BSD-3-Clause
// Fingerprints of domains, which show whether ranks and checkpoints use the same domain.
#pragma once

#include <cstdint>

#include "comm/communicator.hpp"
#include "domain/domain.hpp"

namespace pnpbs {

// Returns a hash of the domain, which must have been checked. On a whole sphere the patch that
// closes it is left out.
std::uint64_t fingerprint_of(const PlaneDomain& domain);
std::uint64_t fingerprint_of(const VolumeDomain& domain);

// Throws unless all ranks have the same domain, since they would wait for each other forever
// otherwise. Collective.
void require_same_domain(const Communicator& comm, const PlaneDomain& domain);
void require_same_domain(const Communicator& comm, const VolumeDomain& domain);

}  // namespace pnpbs
