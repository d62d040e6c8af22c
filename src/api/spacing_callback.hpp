// SPDX-License-Identifier: BSD-3-Clause
// Conversion of a spacing callback of the C interface.
#pragma once

#include "api/guard.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs::api {

// Returns the callback as a spacing. Throws if it is NULL.
template <int Dim>
CallbackSpacing<Dim> spacing_from(pnpbs_spacing_fn spacing, void* user) {
  if (!spacing) throw Error(ErrorKind::argument, "argument spacing is NULL");
  return CallbackSpacing<Dim>([spacing, user](std::int64_t n, const double* x, double* d) {
    const HostArithmetic arithmetic;
    return spacing(n, Dim, x, d, user);
  });
}

}  // namespace pnpbs::api
