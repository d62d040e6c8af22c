// SPDX-License-Identifier: BSD-3-Clause
// The curves that lines of a mesh from Gmsh make up, and its points.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/msh_mesh.hpp"

namespace pnpbs {

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

}  // namespace pnpbs
