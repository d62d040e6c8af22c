// SPDX-License-Identifier: BSD-3-Clause
// A number that tells whether ranks describe the same domain.
#pragma once

#include <cstdint>

#include "domain/domain.hpp"

namespace pnpbs {

std::uint64_t fingerprint_of(const PlaneDomain& domain);
std::uint64_t fingerprint_of(const VolumeDomain& domain);

}  // namespace pnpbs
