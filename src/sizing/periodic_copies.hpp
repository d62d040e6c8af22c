// SPDX-License-Identifier: BSD-3-Clause
// How far the copies of a periodic domain must reach for the computations on its nodes.
#pragma once

#include <memory>

#include "domain/domain.hpp"
#include "spacing/sizing_field.hpp"

namespace pnpbs {

// Returns the domain itself, or for a periodic domain one with as many copies of its cell as nodes
// of this spacing need around them. Throws Error(ErrorKind::spacing) if a period is less than four
// spacings long, or if the user's function has other values on the opposite side of the cell.
// Collective.
template <int Dim>
std::shared_ptr<const Domain<Dim>> with_copies(const std::shared_ptr<const Domain<Dim>>& domain,
                                               const SizingField<Dim>& spacing);

// Returns whether the periods are long enough for this spacing. True for other domains.
// Collective.
template <int Dim>
bool periods_suffice(const Domain<Dim>& domain, const Spacing<Dim>& spacing);

}  // namespace pnpbs
