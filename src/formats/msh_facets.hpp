// SPDX-License-Identifier: BSD-3-Clause
// What bounds and divides the domain of a mesh from Gmsh: lines in the plane, triangles and
// quadrangles in space; its curves and points; and points in its physical groups.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/msh_mesh.hpp"
#include "formats/surface_triangles.hpp"

namespace pnpbs {

enum class MshSides {
  one_inside,   // it bounds the domain
  both_inside,  // it lies in it
  unknown       // the file does not tell
};

struct MshFacet {
  std::array<std::int32_t, 4> corners;  // nodes of the mesh
  std::int32_t corner_count;
  std::int32_t tag;
  MshSides sides;

  std::span<const std::int32_t> nodes() const {
    return {corners.data(), static_cast<std::size_t>(corner_count)};
  }
};

// Those of a domain of this dimension. The elements that fill it tell on which side it is; else, in
// version 4.1, the entities that they bound. Where elements fill the domain, facets that the file
// leaves out are added: those of one element, and those between elements of different regions, with
// the least tag that is free. Throws Error(ErrorKind::file), also if there are none.
std::vector<MshFacet> facets_of(const MshMesh& mesh, int dimension);

// Of the facets that have these sides. Throws Error(ErrorKind::file) for quadrangles that cannot be
// divided.
SurfaceTriangles triangles_of(const MshMesh& mesh, const std::vector<MshFacet>& facets,
                              MshSides sides);

// Lines that follow one another, through nodes where two lines meet that are alike.
struct MshCurve {
  std::vector<std::int32_t> nodes;  // of the mesh; of a closed one the first is not repeated
  bool closed;
  std::int32_t tag;
  bool inner;  // or on the boundary
};

struct MshPoint {
  std::int32_t node;  // of the mesh
  std::int32_t tag;
};

// In order from their ends on, closed ones from their first line on.
//
// Of a domain in the plane: lines, and what bounds triangles and quadrangles. They end at the
// points, too. Throws Error(ErrorKind::file) if the mesh lies in no plane of constant z, and as
// facets_of does.
std::vector<MshCurve> curves_of_plane(const MshMesh& mesh, const std::vector<MshPoint>& points);
// Lines in physical groups, which lie inside a body.
std::vector<MshCurve> curves_in_groups(const MshMesh& mesh);

// Points in physical groups.
std::vector<MshPoint> points_in_groups(const MshMesh& mesh);

struct MshRegionPoint {
  Point<3> point;
  std::int32_t tag;  // of the group
  std::string name;
};

// One in each part of a group of elements of this dimension: what facets of the mesh divide are
// several. None where all elements are in one group, or all in none.
std::vector<MshRegionPoint> region_points_of(const MshMesh& mesh, int dimension);

}  // namespace pnpbs
