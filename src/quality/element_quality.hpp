// SPDX-License-Identifier: BSD-3-Clause
// How good the elements are and how well their edges follow d, over all ranks: the same bits for
// any number of ranks and threads, as all sums are of integers.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "comm/communicator.hpp"
#include "delaunay/stars.hpp"
#include "quality/measured_nodes.hpp"
#include "quality/plane/cell_quality.hpp"

namespace pnpbs {

// Of edge length over d, the mean of d at the two ends.
struct EdgeRatio {
  std::int64_t edges = 0;
  double mean = 0, deviation = 0;
};

// Of the edges whose d is in a band, but not of those between two boundary nodes, whose places the
// corners of the domain decide.
struct EdgeBand {
  double from = 0, to = 0;  // of d
  EdgeRatio ratio;
};

// Of triangles in the plane, of tetrahedra in space.
struct SimplexQuality {
  std::int64_t elements = 0;
  double mean = 0, min = 0;  // 2 r_in / R, 3 r_in / R
  double one_percent = 0;    // 99 % lie above; in steps of 2^-16, downwards
  double min_angle = 0;      // degrees; of tetrahedra, between faces
  std::int64_t obtuse = 0;   // triangles: their circumcentres lie outside of them
  // The same of the elements at edges where the body itself is sharp, and of all others; 180 if
  // there are none. In the plane and on surfaces all are others.
  double min_angle_at_sharp_edges = 180, min_angle_elsewhere = 0;
};

struct ElementQuality {
  SimplexQuality simplex;
  CellQuality cell;  // in the plane or on a sphere
  EdgeRatio edge;    // of all edges
  std::vector<EdgeBand> bands;
  double irregular = 0;  // share of the inner nodes without six (14) neighbours
};

// From stars that are right for the owned nodes, and exact ghosts around these. Collective.
template <int Dim>
ElementQuality measure_elements(const Communicator& comm, const MeasuredNodes<Dim>& measured,
                                const Stars<Dim>& stars, const FillGhosts& fill_ghosts);

// The bands in which d may be missed, without those that have no edge: of each the edges with an
// end inside; if d is missed by these, those with both, where they are nearer to d and enough. (A
// wall of 1.5 d has edges through it that are as long as it is thick; beside a shore of short edges
// those inside may be too short.) Edges of nodes that are left out, if it is told which are, do not
// count. Collective.
template <int Dim>
std::vector<EdgeBand> edge_bands_to_judge(const Communicator& comm,
                                          const MeasuredNodes<Dim>& measured,
                                          const Stars<Dim>& stars, const View<char>& left_out = {});

// The band in which edges are most off d, by more than 10 % in the mean, of those with enough edges
// for a mean; nullptr if there is none.
const EdgeBand* worst_missed_band(const std::vector<EdgeBand>& bands);

}  // namespace pnpbs
