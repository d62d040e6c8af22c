// SPDX-License-Identifier: BSD-3-Clause
// The regions into which surfaces divide space, and which of them lie on either side of each
// triangle, by exact decisions. Which way the triangles are turned does not matter.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "surfaces/surface_edges.hpp"
#include "surfaces/triangulation.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

class SurfaceRegions {
 public:
  // The arguments must outlive it. Triangles meet in common vertices and edges only.
  SurfaceRegions(const Triangulation& surface, const SurfaceEdges& edges, const BoxTree<3>& tree);

  // Region 0 is the unbounded one.
  std::int32_t count() const { return count_; }
  std::int32_t front(std::int32_t t) const { return region_[class_of_side_[2 * std::size_t(t)]]; }
  std::int32_t back(std::int32_t t) const {
    return region_[class_of_side_[2 * std::size_t(t) + 1]];
  }
  // Of a point on no triangle.
  std::int32_t around(const Point<3>& x) const { return region_around(x, -1); }

  // Surfaces that are connected by edges.
  std::int32_t components() const { return components_; }
  std::int32_t component(std::int32_t t) const { return component_[t]; }
  // The region in which a component lies.
  std::int32_t outside(std::int32_t component) const { return outside_[component]; }

 private:
  void find_components(const SurfaceEdges& edges);
  void find_classes(const SurfaceEdges& edges);
  std::vector<double> enclosed_volumes(std::int32_t classes) const;
  void number_regions(const std::vector<double>& volumes);
  Point<3> point_of(std::int32_t component, const std::vector<std::int32_t>& component_at) const;
  std::int32_t region_around(const Point<3>& x, std::int32_t without_component) const;

  const Triangulation& surface_;
  const BoxTree<3>& tree_;
  Box<3> bounds_;
  std::int32_t count_ = 1, components_ = 0;
  std::vector<std::int32_t> component_;       // of each triangle
  std::vector<std::int32_t> first_triangle_;  // of each component
  std::vector<std::int32_t> outside_;
  // The sides of triangles (front and back) between which one can go across edges make a class.
  // One class of each component sees it from outside; what is inside the others are regions.
  std::vector<std::int32_t> class_of_side_;
  std::vector<double> volume_;        // within each class; 0 for that which is seen from outside
  std::vector<std::int32_t> region_;  // of each class
};

// Of each region, is it inside? Each boundary triangle leads from outside in or from inside out.
std::vector<char> inside_by_parity(const Triangulation& surface, const SurfaceRegions& regions);

// Gives the triangles with a tag that has a role this role. Throws Error(ErrorKind::domain) if no
// triangle has a tag that has a role.
void give_roles(Triangulation& surface, const std::map<std::int32_t, SurfaceRole>& roles);

// A triangle whose role goes by its place bounds the body if what surrounds the surface that it
// belongs to is on one side of it: then closed surfaces within each other bound cavities, and
// sheets and what divides a body are inner. An open surface that nothing encloses stays a boundary,
// for the check of that to tell where it is open. Throws Error(ErrorKind::domain) if triangles
// cross.
void find_roles_by_place(Triangulation& surface);

// Finds the roles of dividing triangles, for each source by its own triangles alone: one bounds the
// body if it has the source's unbounded region on one side only. A triangle with that region on
// both sides stays a boundary, and the check of the boundary reports its open edges. Throws
// Error(ErrorKind::domain) if triangles of such a source cross.
void find_roles_of_dividing(Triangulation& surface);

}  // namespace pnpbs
