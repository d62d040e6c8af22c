// SPDX-License-Identifier: BSD-3-Clause
// Voronoi cells of the nodes, within their elements: volumes, faces between neighbours, and the
// boundary's share.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "results/nodal_results.hpp"

namespace pnpbs {

// Of the nodes that a rank owns, in the order of their ids. Volumes are areas in the plane and on
// surfaces, and areas of faces are lengths there.
struct VoronoiCells {
  int dimension = 0;
  std::vector<double> volumes;
  std::vector<double> boundary;   // [nodes][dimension]: outward normals, integrated over the share
  std::vector<char> at_boundary;  // has the cell a share of the boundary, or no element at all?
  std::vector<std::int64_t> offsets{0};    // of faces, by node; within one by the neighbour's id
  std::vector<std::int64_t> ids, numbers;  // of the neighbours
  std::vector<double> areas, distances;
  std::vector<double> normals;  // [faces][dimension], towards the neighbour
};

// Each element is divided among the nodes that are closest in some part of it, so the volumes add
// up to that of the elements; each of a cell's parts is a function of the nodes alone, and they are
// added by size: any number of ranks and threads gives the same bits. Collective.
std::unique_ptr<VoronoiCells> make_voronoi_cells(NodalResults& results);

}  // namespace pnpbs
