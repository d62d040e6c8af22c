// SPDX-License-Identifier: BSD-3-Clause
//
// Hashes of the nodes, lists, stars, elements and boundary of all ranks. They are sums of hashes by
// ids, so they depend neither on order nor on owners.
#pragma once

#include <mpi.h>
#include <pnpbs/pnpbs.h>

#include <cstdint>
#include <functional>
#include <string>

namespace hunt {

/** Calls take(name, sum over this rank) for each hash, and returns the first error of a call.
 * Collective. */
pnpbs_status for_result_hashes(
    pnpbs_placement placement,
    const std::function<void(const char* name, std::uint64_t sum)>& take);

std::uint64_t hash_of(const std::string& text);

}  // namespace hunt
