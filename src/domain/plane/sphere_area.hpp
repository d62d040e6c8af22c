// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "domain/plane/plane_domain.hpp"

namespace pnpbs {

// Of a checked domain on a sphere, along the sphere.
double area_on_sphere(const PlaneDomain& domain);

}  // namespace pnpbs
