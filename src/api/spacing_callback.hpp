// SPDX-License-Identifier: BSD-3-Clause
// A spacing callback of the C interface as a spacing.
#pragma once

#include "api/guard.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs::api {

template <int Dim>
CallbackSpacing<Dim> spacing_from(pnpbs_spacing_fn spacing, void* user) {
  if (!spacing) throw Error(ErrorKind::argument, "argument spacing is NULL");
  return CallbackSpacing<Dim>([spacing, user](std::int64_t n, const double* x, double* d) {
    const HostArithmetic arithmetic;
    return spacing(n, Dim, x, d, user);
  });
}

}  // namespace pnpbs::api
