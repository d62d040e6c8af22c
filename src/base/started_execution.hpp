// SPDX-License-Identifier: BSD-3-Clause
// Parallel loops for code that may run before Kokkos has started: a domain can be queried before a
// placement exists.
#pragma once

#include "base/execution.hpp"

namespace pnpbs {

// Calls body(i) for 0 <= i < n like for_each, or on the calling thread alone if Kokkos does not
// run.
template <class Body>
void for_each_if_started(const char* label, std::int64_t n, const Body& body) {
  if (Kokkos::is_initialized() && !Kokkos::is_finalized()) return for_each(label, n, body);
  for (std::int64_t i = 0; i < n; ++i) body(i);
}

}  // namespace pnpbs
