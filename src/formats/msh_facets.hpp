// SPDX-License-Identifier: BSD-3-Clause
// Boundaries and dividing facets of a mesh from Gmsh: lines in the plane, triangles and quadrangles
// in space. Also its curves and points, and points in its physical groups.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/msh_mesh.hpp"
#include "formats/surface_triangles.hpp"

namespace pnpbs {

// Tells apart facets with the domain on one side and on both sides.
enum class MshSides {
  one_inside,   // the facet bounds the domain
  both_inside,  // the facet lies inside the domain
  unknown       // the file does not determine it
};

// A facet of the domain.
struct MshFacet {
  std::array<std::int32_t, 4> corners;  // indices of nodes of the mesh
  std::int32_t corner_count;
  std::int32_t tag;
  MshSides sides;

  std::span<const std::int32_t> nodes() const {
    return {corners.data(), static_cast<std::size_t>(corner_count)};
  }
};

// Returns the facets of a domain of this dimension. Their sides follow from the elements that fill
// the domain or, without such elements, from the entities that they bound (version 4.1 only). If
// elements fill the domain, facets that the file lacks are added: sides of a single element, and
// sides between different regions. Added facets have the smallest free tag. Throws
// Error(ErrorKind::file), also if there are no facets.
std::vector<MshFacet> facets_of(const MshMesh& mesh, int dimension);

// Returns the triangles of the facets with these sides; quadrangles are divided. Throws
// Error(ErrorKind::file) for quadrangles that cannot be divided.
SurfaceTriangles triangles_of(const MshMesh& mesh, const std::vector<MshFacet>& facets,
                              MshSides sides);

// A chain of lines with the same tag and sides.
struct MshCurve {
  // Indices of nodes of the mesh; a closed curve does not repeat the first.
  std::vector<std::int32_t> nodes;
  bool closed;
  std::int32_t tag;
  bool inner;  // inside the domain, not on its boundary
};

// A tagged point of the mesh.
struct MshPoint {
  std::int32_t node;  // index of the node of the mesh
  std::int32_t tag;
};

// Returns the curves of a plane domain: its lines, and the boundaries of its triangles and
// quadrangles. Curves end at `points`, too. Open curves come first, from one end to the other;
// closed ones start at their first line. Throws Error(ErrorKind::file) if the mesh is not in a
// plane of constant z, and as facets_of() does.
std::vector<MshCurve> curves_of_plane(const MshMesh& mesh, const std::vector<MshPoint>& points);
// Returns the curves of lines in physical groups, which lie inside a body.
std::vector<MshCurve> curves_in_groups(const MshMesh& mesh);

// Returns the points in physical groups.
std::vector<MshPoint> points_in_groups(const MshMesh& mesh);

// A point that marks a region of the domain.
struct MshRegionPoint {
  Point<3> point;
  std::int32_t tag;  // tag of the physical group
  std::string name;
};

// Returns a point in each connected part of each physical group of elements of this dimension.
// Facets of the mesh divide parts. Returns none if all elements are in one group or none is in any.
std::vector<MshRegionPoint> region_points_of(const MshMesh& mesh, int dimension);

}  // namespace pnpbs
