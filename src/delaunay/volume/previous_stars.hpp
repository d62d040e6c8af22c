// SPDX-License-Identifier: BSD-3-Clause
// The stars found before nodes moved a little and were reordered. Most of them are still Delaunay,
// and checking that takes much less time than finding them.
//
// A star is kept if it is closed and its tetrahedra have positive orientation, are elements and
// belong to the domain, and if no node behind a face lies in the sphere of the tetrahedron before
// it. All this must hold by far more than rounding errors. The other stars are found again. Then
// kept stars that contradict a tetrahedron of a found star are found again, until there are none.
// This is a proof: if a node were in the sphere of a tetrahedron with kept stars at all corners, it
// would also be in those of all tetrahedra on the way to it, from face to face, up to the first one
// with a corner whose star was found, where it is not.
//
// If no node has moved, come or gone on any rank, all stars are put back unchanged.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {

class PreviousStars {
 public:
  // Moves the stars of the owned nodes from `stars` if they are of these nodes. `digest` identifies
  // the nodes for which they are correct (level/node_digest.hpp); 0 if it is unknown.
  void take(const Nodes<3>& nodes, VolumeStars& stars, std::uint64_t digest = 0);
  bool any() const { return !ids_.empty(); }
  std::uint64_t digest() const { return digest_; }
  void forget();

  // Finds the stars of the nodes for which `wanted` is set, which must be owned. `stars` must
  // contain those of all other owned nodes. The stored stars are consumed.
  void find_stars(const VolumeStarInput& input, std::vector<char> wanted, VolumeStars& stars);

  // Puts back the stars of the owned nodes, none of which may have moved, except stars with a ghost
  // that this rank no longer has. Returns the flags of the nodes with restored stars. The stored
  // stars are consumed.
  std::vector<char> restore(const VolumeStarInput& input, VolumeStars& stars);

 private:
  // The relation of nodes before and now. now[k] is the present index of previous node k, or -1 if
  // it is gone. before[i] is the previous node whose star node i has, or -1 if none exists.
  struct Places {
    std::vector<std::int32_t> now, before;
  };

  template <class Counts>
  Places find_places(const Nodes<3>& nodes, const Counts& counts) const;
  template <class Keeps>
  std::vector<char> put_in_place(const Places& places, const Keeps& keeps, VolumeStars& stars);

  std::vector<std::int64_t> ids_;  // Ids of the previous nodes.
  std::vector<char> owned_;        // Whether they were owned.
  std::uint64_t digest_ = 0;
  VolumeStars stars_;
};

}  // namespace pnpbs
