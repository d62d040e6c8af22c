// SPDX-License-Identifier: BSD-3-Clause
// The Delaunay triangulation of nodes in space by CGAL, independent of the library's own lists.
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

// Returns tetrahedra as sorted indices of nodes.
std::vector<TetrahedronOfNodes> reference_tetrahedra(const std::vector<Place>& nodes);

struct BodyMesh {
  std::vector<TetrahedronOfNodes> tetrahedra;
  std::vector<TriangleOfNodes> boundary;  // the faces with one tetrahedron; sorted, as corners
};

// Returns the tetrahedra that fill a body: those with the centroid inside, except flat ones of four
// boundary nodes that are open to the outside, which are removed repeatedly. Such tetrahedra exist
// between nodes of one surface and are not part of a mesh.
BodyMesh reference_mesh(const std::vector<Place>& nodes, const std::vector<char>& on_boundary,
                        const Inside& inside);

// Returns an exact test of whether a point is inside the closed surface in a file (STL, OFF, OBJ).
Inside inside_of_file(const std::string& path);

}  // namespace pnpbs_bench
