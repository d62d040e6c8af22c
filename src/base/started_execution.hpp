// SPDX-License-Identifier: BSD-3-Clause
// Kernels that run whether Kokkos does or not: a domain may be asked before there is any placement.
#pragma once

#include "base/execution.hpp"

namespace pnpbs {

// As for_each, or on the calling thread alone.
template <class Body>
void for_each_if_started(const char* label, std::int64_t n, const Body& body) {
  if (Kokkos::is_initialized() && !Kokkos::is_finalized()) return for_each(label, n, body);
  for (std::int64_t i = 0; i < n; ++i) body(i);
}

}  // namespace pnpbs
