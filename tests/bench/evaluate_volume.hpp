// SPDX-License-Identifier: BSD-3-Clause
// The Delaunay triangulation of nodes in space by another library (CGAL), never by our own lists.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pnpbs_bench {

using Place = std::array<double, 3>;
using TetrahedronOfNodes = std::array<std::int64_t, 4>;
using TriangleOfNodes = std::array<std::int64_t, 3>;
using Inside = std::function<bool(const Place&)>;

// By their corners' places among the nodes, each tetrahedron's sorted.
std::vector<TetrahedronOfNodes> reference_tetrahedra(const std::vector<Place>& nodes);

struct BodyMesh {
  std::vector<TetrahedronOfNodes> tetrahedra;
  std::vector<TriangleOfNodes>
      boundary;  // the faces with no tetrahedron behind; sorted, as corners
};

// Those of them that fill a body: with the centroid inside, less the flat ones of four boundary
// nodes that lie open to the outside, one after the other. Between nodes of one surface there are
// such, and they are part of no mesh.
BodyMesh reference_mesh(const std::vector<Place>& nodes, const std::vector<char>& on_boundary,
                        const Inside& inside);

// Whether a point is inside the closed surface that a file (STL, OFF, OBJ) holds, exactly.
Inside inside_of_file(const std::string& path);

}  // namespace pnpbs_bench
