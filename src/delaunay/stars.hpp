// SPDX-License-Identifier: BSD-3-Clause
// The Delaunay stars of all nodes, in the plane and in space.
#pragma once

#include <cstdint>
#include <type_traits>

#include "delaunay/delaunay_stars.hpp"
#include "delaunay/volume/stars_before.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {

template <int Dim>
using Stars = std::conditional_t<Dim == 2, DelaunayStars, VolumeStars>;

// In the plane stars are found so fast that none are kept.
struct NoStarsBefore {
  void take(const Nodes<2>&, const DelaunayStars&, std::uint64_t) {}
  void forget() {}
};

template <int Dim>
using KeptStarsBefore = std::conditional_t<Dim == 2, NoStarsBefore, StarsBefore>;

}  // namespace pnpbs
