// SPDX-License-Identifier: BSD-3-Clause
// Quality of the elements and the ratio of edge lengths to the spacing, over all ranks. All sums
// are sums of integers, so the results have the same bits for any number of ranks and threads.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "comm/communicator.hpp"
#include "delaunay/stars.hpp"
#include "quality/measured_nodes.hpp"
#include "quality/plane/cell_quality.hpp"

namespace pnpbs {

// Statistics of the edge length divided by d, where d is the mean at the two ends.
struct EdgeRatio {
  std::int64_t edges = 0;
  double mean = 0, deviation = 0;
};

// Statistics of the edges whose d lies in one band. Edges between two boundary nodes are excluded,
// because the corners of the domain determine their lengths.
struct EdgeBand {
  double from = 0, to = 0;  // [d]
  EdgeRatio ratio;
};

// Quality of the elements: triangles in the plane and on surfaces, tetrahedra in space.
struct SimplexQuality {
  std::int64_t elements = 0;
  double mean = 0, min = 0;  // 2 r_in / R of triangles, 3 r_in / R of tetrahedra
  double one_percent = 0;    // 99 % of the elements have a larger quality; rounded down to 2^-16
  double min_angle = 0;      // [degrees] of tetrahedra: dihedral
  std::int64_t obtuse = 0;   // triangles with an angle above 90 degrees
  // Triangles with all nodes on the boundary, in the plane and on a sphere. Set by Results.
  std::int64_t on_boundary = 0;
  // Smallest angle of the elements at edges where the body itself is sharp, and smallest angle of
  // all others. [degrees] The first is 180 if there are no such elements, as in the plane and on
  // surfaces.
  double min_angle_at_sharp_edges = 180, min_angle_elsewhere = 0;
};

// Everything that measure_elements() computes.
struct ElementQuality {
  SimplexQuality simplex;
  CellQuality cell;  // only in the plane and on a sphere
  EdgeRatio edge;    // all edges
  std::vector<EdgeBand> bands;
  // Share of the inner nodes whose number of neighbours is not six (14 in space).
  double irregular = 0;
};

// Measures elements, cells, edges and nodes. The stars must be valid for the owned nodes and the
// ghosts around these exact.
// Collective.
template <int Dim>
ElementQuality measure_elements(const Communicator& comm, const MeasuredNodes<Dim>& measured,
                                const Stars<Dim>& stars, const FillGhosts& fill_ghosts);

// Returns the bands of d that have edges, with the statistics by which their agreement with d is
// judged. A band is judged by its edges with at least one inner end. If these miss d by more than
// 10 % in some band, two exceptions apply. In a body, where the edges are too long, those that end
// at feature edges and corners do not count: a node inside a dihedral angle of 90 degrees keeps
// about 1.15 d from the nodes of its edge, even where d is constant. Then a band is judged by its
// edges with two inner ends, provided that they are at least 50 and closer to d: a wall of
// thickness 1.5 d has edges through it as long as it is thick, and beside a boundary of short edges
// inner edges may be too short. Edges with an end in `left_out` (one entry per node) do not count;
// an empty view excludes none. Collective.
template <int Dim>
std::vector<EdgeBand> edge_bands_to_judge(const Communicator& comm,
                                          const MeasuredNodes<Dim>& measured,
                                          const Stars<Dim>& stars, const View<char>& left_out = {});

// Returns the band whose mean edge ratio deviates most from 1, among bands with at least 50 edges
// and a deviation of more than 10 %. Returns nullptr if none exists.
const EdgeBand* worst_missed_band(const std::vector<EdgeBand>& bands);

}  // namespace pnpbs
