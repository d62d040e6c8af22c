// SPDX-License-Identifier: BSD-3-Clause
// Comparison of the points that ranks query. If all ranks query the same points, each rank can
// answer for its own part without sending the points.
#pragma once

#include <cstdint>
#include <cstring>

#include "base/mixed_hash.hpp"
#include "base/types.hpp"
#include "comm/communicator.hpp"

namespace pnpbs {

// Returns true if all ranks pass the same points, compared by a hash. Collective.
template <int Dim>
bool same_points(const Communicator& comm, std::int64_t n, const Point<Dim>* x) {
  if (comm.size() == 1) return true;
  std::uint64_t hash = mixed(static_cast<std::uint64_t>(n));
  for (std::int64_t i = 0; i < n; ++i)
    for (const double coordinate : x[i]) {
      std::uint64_t bits;
      std::memcpy(&bits, &coordinate, sizeof bits);
      hash = mixed(hash ^ bits);
    }
  return comm.same_on_all(hash);
}

}  // namespace pnpbs
