// SPDX-License-Identifier: BSD-3-Clause
// The type of the Delaunay stars of all nodes, for the plane and for space.
#pragma once

#include <cstdint>
#include <type_traits>

#include "delaunay/delaunay_stars.hpp"
#include "delaunay/volume/previous_stars.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {

template <int Dim>
using Stars = std::conditional_t<Dim == 2, DelaunayStars, VolumeStars>;

// An empty replacement of PreviousStars. In the plane, finding stars is so fast that none are kept.
struct NoPreviousStars {
  void take(const Nodes<2>&, const DelaunayStars&, std::uint64_t) {}
  void forget() {}
};

template <int Dim>
using KeptStarsBefore = std::conditional_t<Dim == 2, NoPreviousStars, PreviousStars>;

}  // namespace pnpbs
