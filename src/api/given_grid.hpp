// SPDX-License-Identifier: BSD-3-Clause
// The spacing on a grid, as the C interface takes it: what must be right with it.
#pragma once

#include <cstdint>
#include <memory>

#include "spacing/spacing.hpp"

namespace pnpbs::api {

struct GivenGrid {
  const std::int64_t* size;
  const double *origin, *step, *values;
};

// Throw Error(ErrorKind::argument) or, of a value, Error(ErrorKind::spacing).
template <int Dim>
std::shared_ptr<const GridSpacing<Dim>> spacing_on_grid(const GivenGrid& grid);
// Of longitude and latitude in degrees.
std::shared_ptr<const LocalSpacing<3>> spacing_on_sphere_grid(const GivenGrid& grid, double radius);

}  // namespace pnpbs::api
