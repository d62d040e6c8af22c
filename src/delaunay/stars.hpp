// SPDX-License-Identifier: BSD-3-Clause
// The Delaunay stars of all nodes, in the plane and in space.
#pragma once

#include <type_traits>

#include "delaunay/delaunay_stars.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {

template <int Dim>
using Stars = std::conditional_t<Dim == 2, DelaunayStars, VolumeStars>;

}  // namespace pnpbs
