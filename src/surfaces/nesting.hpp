// SPDX-License-Identifier: BSD-3-Clause
// Finds the regions into which surfaces divide space, and which of them lie on either side of each
// triangle, by exact predicates. The orientation of the triangles does not matter.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "surfaces/surface_edges.hpp"
#include "surfaces/triangulation.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// The regions of space between the components of a triangulation. A component is a set of triangles
// connected by edges.
class SurfaceRegions {
 public:
  // The arguments must outlive this object. Triangles may meet only in common vertices and edges.
  SurfaceRegions(const Triangulation& surface, const SurfaceEdges& edges, const BoxTree<3>& tree);

  // Returns the number of regions. Region 0 is the unbounded one.
  std::int32_t count() const { return count_; }
  // Return the regions in front of triangle t and behind it.
  std::int32_t front(std::int32_t t) const { return region_[class_of_side_[2 * std::size_t(t)]]; }
  std::int32_t back(std::int32_t t) const {
    return region_[class_of_side_[2 * std::size_t(t) + 1]];
  }
  // Returns the region that contains x, which must not lie on a triangle.
  std::int32_t around(const Point<3>& x) const { return region_around(x, -1); }

  // Returns the number of components.
  std::int32_t components() const { return components_; }
  std::int32_t component(std::int32_t t) const { return component_[t]; }
  // Returns the region around a component.
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
  std::vector<std::int32_t> component_;       // per triangle
  std::vector<std::int32_t> first_triangle_;  // per component
  std::vector<std::int32_t> outside_;         // per component
  // A class is a set of triangle sides (front and back) that are connected across edges. Each
  // component has one outer class, which faces outwards. Every other class encloses a region.
  std::vector<std::int32_t> class_of_side_;
  std::vector<double> volume_;        // inside each class; 0 for outer classes
  std::vector<std::int32_t> region_;  // per class
};

// Returns for each region 1 if it is inside, else 0. Each boundary triangle separates inside from
// outside.
std::vector<char> inside_by_parity(const Triangulation& surface, const SurfaceRegions& regions);

// Sets the role of each triangle whose tag is a key of `roles`. Throws Error(ErrorKind::domain) if
// a tag of `roles` occurs on no triangle.
void give_roles(Triangulation& surface, const std::map<std::int32_t, SurfaceRole>& roles);

// Determines the roles of triangles with the role by_place. Such a triangle is a boundary if the
// region around its component is on exactly one side of it; so nested closed surfaces bound
// cavities, and sheets and dividing walls are inner. An open surface that nothing encloses stays a
// boundary, so that require_closed_boundary() reports its open edges. Throws
// Error(ErrorKind::domain) if triangles cross.
void find_roles_by_location(Triangulation& surface);

// Determines the roles of dividing triangles, for each source from its own triangles alone. Such a
// triangle is a boundary if exactly one of its sides lies in the unbounded region of its source. A
// triangle with both sides in that region stays a boundary, so that require_closed_boundary()
// reports its open edges. Throws Error(ErrorKind::domain) if triangles of such a source cross.
void find_roles_of_dividing(Triangulation& surface);

}  // namespace pnpbs
