// SPDX-License-Identifier: BSD-3-Clause
// The faces between tetrahedra that represent the surfaces inside a body.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// Returns whether all facets are farther from node i than its neighbours in the star are. It may
// return false although they are.
bool is_far_from_facets(const Level<3>& level, std::int64_t i);

// A face between two tetrahedra that lie on different sides of an inner surface.
struct InnerFacet {
  // The one with the smallest id first; oriented like the surface.
  std::array<std::int64_t, 3> nodes;
  std::int32_t tag;    // of the surface
  std::int32_t facet;  // of the surface, between the centroids of the tetrahedra
};

// Finds such faces around single nodes. A face represents an inner surface if its three nodes lie
// on the surface and its two tetrahedra lie on different sides of it, so that the segment between
// their centroids crosses it an odd number of times, or into another region. The segments around an
// edge of these faces form a ring, which crosses a surface without a border an even number of
// times. Therefore the faces leave no gap. The restricted Delaunay triangulation (H. Edelsbrunner,
// N. R. Shah, Int. J. Comput. Geom. Appl. 7 (1997) 365-378) uses the segment between circumcentres
// instead. The two agree for tetrahedra with their fourth node off the surface. If all four nodes
// lie on it, the tetrahedron is flat and its circumcentre can be anywhere.
class InnerFacets {
 public:
  explicit InnerFacets(const Level<3>& level);

  // Returns whether the body has inner surfaces.
  bool any() const { return any_; }
  // Returns the faces whose node with the smallest id is node i. They are the same on every rank
  // that has the star of node i. The reference is valid until the next call.
  const std::vector<InnerFacet>& at(std::int64_t i);
  // Returns in the same way all faces with node i that represent an inner surface.
  const std::vector<InnerFacet>& around(std::int64_t i);
  // Returns in the same way the faces where tetrahedra cross an inner surface: their two
  // tetrahedra lie on different sides of it, but their nodes do not all lie on it.
  const std::vector<InnerFacet>& strays_at(std::int64_t i);
  // Returns the area of the faces of all ranks over that of these and the strays; 1 without inner
  // surfaces. Collective; requires the stars of all owned nodes.
  double covered_share();

 private:
  // A face of node i together with one of its two tetrahedra.
  struct Face {
    std::array<std::int64_t, 3> ids;    // ascending
    std::array<std::int64_t, 3> nodes;  // memory indices, in the order of ids
    std::int64_t apex, apex_id;         // the fourth node of the tetrahedron
  };

  bool is_held(std::int64_t i) const { return level_.nodes.carrier(i) != Carrier::free; }
  enum class Of { all_nodes, smallest_id };
  template <class Wanted>
  void judge_faces(std::int64_t i, Of of, const Wanted& wanted);
  bool on_patch(std::int64_t i, std::int32_t patch) const;
  Point<3> centroid_of(const Face& face) const;
  void find_crossed_facets(const Point<3>& from, const Point<3>& to);
  bool changes_region(const Point<3>& from, const Point<3>& to) const;
  void judge(const Face& one, const Face& other);

  const Level<3>& level_;
  bool any_ = false;
  std::vector<Face> faces_;
  std::vector<std::int32_t> crossed_;
  std::vector<InnerFacet> found_, strays_;
};

}  // namespace pnpbs
