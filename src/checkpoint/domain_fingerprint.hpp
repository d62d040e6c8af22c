// SPDX-License-Identifier: BSD-3-Clause
// A number that tells whether ranks describe the same domain.
#pragma once

#include <cstdint>

#include "comm/communicator.hpp"
#include "domain/domain.hpp"

namespace pnpbs {

std::uint64_t fingerprint_of(const PlaneDomain& domain);
std::uint64_t fingerprint_of(const VolumeDomain& domain);

// Throws unless all ranks have the same one: others would wait for each other for ever. Collective.
void require_same_domain(const Communicator& comm, const PlaneDomain& domain);
void require_same_domain(const Communicator& comm, const VolumeDomain& domain);

}  // namespace pnpbs
