// SPDX-License-Identifier: BSD-3-Clause
// Checks and conversion of a spacing on a grid.
#pragma once

#include <cstdint>
#include <memory>

#include "spacing/spacing.hpp"

namespace pnpbs::api {

// The arguments of the C interface for a grid.
struct GridArguments {
  const std::int64_t* size;
  const double *origin, *step, *values;
};

// Returns the spacing on a grid. Both functions throw Error(ErrorKind::argument), or
// Error(ErrorKind::spacing) for an invalid value.
template <int Dim>
std::shared_ptr<const GridSpacing<Dim>> spacing_on_grid(const GridArguments& grid);
// Returns the spacing on a grid of longitudes and latitudes in degrees.
std::shared_ptr<const LocalSpacing<3>> spacing_on_sphere_grid(const GridArguments& grid,
                                                              double radius);

}  // namespace pnpbs::api
