// SPDX-License-Identifier: BSD-3-Clause
// The shape of a domain on a sphere, in space: its curves in straight pieces whose ends are on the
// sphere.
#pragma once

#include "shape/shape.hpp"

namespace pnpbs {

// Of a checked domain. Radii of curvature and lengths of edges are those along the sphere.
Shape<3> shape_on_sphere(const PlaneDomain& domain);

}  // namespace pnpbs
