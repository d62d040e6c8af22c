// SPDX-License-Identifier: BSD-3-Clause
// Evaluates a node set by the constrained Delaunay triangulation of CGAL, independent of the
// library's own lists.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "edges_over_d.hpp"

namespace pnpbs_bench {

struct NodeSet {
  std::vector<std::array<double, 2>> x;
  std::vector<double> d;                                      // desired spacing at the nodes
  std::vector<std::array<std::int64_t, 2>> edges;             // boundary edges; even-odd rule
  std::vector<std::array<std::int64_t, 2>> inner_edges = {};  // with the domain on both sides
};

struct Measures {
  std::int64_t triangles = 0;
  double quality_mean = 0;         // 2 r_in / R
  double quality_one_percent = 0;  // 99 % of the triangles are above
  double quality_min = 0;
  double share_above_80 = 0, share_above_90 = 0;
  double angle_min = 0;  // degrees
  double edge_mean = 0;  // edge length over the mean of d at its ends
  double edge_deviation = 0;
};

// Statistics of edges by location. Edges of the boundary do not count, as the domain determines
// their length.
struct EdgesByPlace {
  std::vector<EdgeBand> bands;  // eight
  EdgeBand at_boundary;         // edges with one end on the boundary
  // Smallest and largest mean over the edges around a node and its neighbours.
  double min_place = 0, max_place = 0;
  std::array<double, 2> min_at{}, max_at{};
};

struct Verdict {
  Measures all;
  EdgesByPlace edges;
  double nodes_wanted = 0;  // required by d on the area of the triangles
  // Excludes triangles that no node set can improve: those where the domain is narrower than 3 d
  // (some chord through their centre is shorter) and those that touch a boundary edge shorter than
  // 0.7 d.
  Measures wide;
  std::int64_t missing_edges = 0;  // boundary edges that are crossed or split: must be 0
};

Verdict evaluate(const NodeSet& nodes);

// Returns the same triangles as sorted vertex triples, for comparison with the library's.
std::vector<std::array<std::int64_t, 3>> reference_triangles(const NodeSet& nodes);

}  // namespace pnpbs_bench
