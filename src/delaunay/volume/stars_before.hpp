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
//
// Where no node has moved at all, come or gone, on any rank, all are put back as they were.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {

class StarsBefore {
 public:
  // Takes the stars of these nodes, if they are of these: those of the owned ones. The digest is
  // that of the nodes for which they are right (level/node_digest.hpp); 0: not known.
  void take(const Nodes<3>& nodes, VolumeStars& stars, std::uint64_t digest = 0);
  bool any() const { return !ids_.empty(); }
  std::uint64_t digest() const { return digest_; }
  void forget();

  // Finds the stars of the nodes for which wanted is set, owned all; those of all other owned nodes
  // are there. Uses up what was taken.
  void find_stars(const VolumeStarInput& input, std::vector<char> wanted, VolumeStars& stars);

  // Puts back the stars of the owned nodes, which are where they were; not those with a ghost that
  // is not known here any more. Returns for which nodes. Uses up what was taken.
  std::vector<char> restore(const VolumeStarInput& input, VolumeStars& stars);

 private:
  // Of nodes before: where each is now, -1: nowhere; and the star of which of them node i now has,
  // -1: none of them.
  struct Places {
    std::vector<std::int32_t> now, before;
  };

  template <class Counts>
  Places find_places(const Nodes<3>& nodes, const Counts& counts) const;
  template <class Keeps>
  std::vector<char> put_in_place(const Places& places, const Keeps& keeps, VolumeStars& stars);

  std::vector<std::int64_t> ids_;  // of the nodes then
  std::vector<char> owned_;        // were they then?
  std::uint64_t digest_ = 0;
  VolumeStars stars_;
};

}  // namespace pnpbs
