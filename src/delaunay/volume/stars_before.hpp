// SPDX-License-Identifier: BSD-3-Clause
// The stars found before nodes moved a little and were put in another order: most are still those
// of the Delaunay triangulation, and to see that takes far less than to find them.
//
// Kept are stars all around their nodes whose tetrahedra are of positive orientation, elements and
// of the domain, with no node behind a face in the sphere of the tetrahedron before it, all that by
// far more than rounding; the others are found anew, then those of which a star found has another
// tetrahedron, until there are none. That is proof: were a node in the sphere of a tetrahedron with
// kept stars at all corners, then in those of all on the way to it, by the faces, up to the first
// with a corner whose star was found; and there it is not.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {

class StarsBefore {
 public:
  // Takes the stars of these nodes, if they are of these: those of the owned ones.
  void take(const Nodes<3>& nodes, VolumeStars& stars);
  bool any() const { return !ids_.empty(); }
  void forget();

  // Finds the stars of the nodes for which wanted is set, owned all; those of all other owned nodes
  // are there. Uses up what was taken.
  void find_stars(const VolumeStarInput& input, std::vector<char> wanted, VolumeStars& stars);

 private:
  std::vector<char> put_in_place(const VolumeStarInput& input, const std::vector<char>& wanted,
                                 VolumeStars& stars);

  std::vector<std::int64_t> ids_;  // of the nodes then; -1: of a ghost
  VolumeStars stars_;
};

}  // namespace pnpbs
