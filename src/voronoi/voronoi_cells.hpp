// SPDX-License-Identifier: BSD-3-Clause
// Voronoi cells of the nodes restricted to the elements: volumes, faces between neighbours, and
// parts of the boundary.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "results/nodal_results.hpp"

namespace pnpbs {

// The cells of the nodes that a rank owns, in the order of their ids. Volumes are areas in the
// plane and on surfaces, and areas of faces are lengths there.
struct VoronoiCells {
  int dimension = 0;
  std::vector<double> volumes;
  // [nodes][dimension]; integral of the outward normal over the cell's part of the boundary.
  std::vector<double> boundary;
  std::vector<char> at_boundary;  // Whether the cell is at the boundary or its node has no element.
  // Begin of the faces of each node, which are in the order of the neighbours' ids.
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int64_t> ids, numbers;  // Ids and numbers of the neighbours.
  std::vector<double> areas, distances;
  std::vector<double> normals;  // [faces][dimension]; unit normals towards the neighbour.
};

// Returns the cells. Each element is divided among the nodes that are closest in some part of it,
// so that the volumes of the cells sum up to that of the elements. Each part is a function of the
// nodes alone, and parts are summed up by size. Therefore results are bitwise equal for any number
// of ranks and threads. Collective.
std::unique_ptr<VoronoiCells> make_voronoi_cells(NodalResults& results);

}  // namespace pnpbs
