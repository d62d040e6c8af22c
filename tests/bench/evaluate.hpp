// SPDX-License-Identifier: BSD-3-Clause
// Judges a node set by a constrained Delaunay triangulation of another library (CGAL), never by
// our own lists.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "edges_over_d.hpp"

namespace pnpbs_bench {

struct NodeSet {
  std::vector<std::array<double, 2>> x;
  std::vector<double> d;                                      // wanted spacing at the nodes
  std::vector<std::array<std::int64_t, 2>> edges;             // boundary edges; even-odd rule
  std::vector<std::array<std::int64_t, 2>> inner_edges = {};  // both sides are alike
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

// Edges of the boundary do not count, as their length is the domain's business.
struct EdgesByPlace {
  std::vector<EdgeBand> bands;  // eight
  EdgeBand at_boundary;         // edges with one end on the boundary
  // The means over the edges around a node and its neighbours, where they are least and largest.
  double min_place = 0, max_place = 0;
  std::array<double, 2> min_at{}, max_at{};
};

struct Verdict {
  Measures all;
  EdgesByPlace edges;
  double nodes_wanted = 0;  // what the triangles' areas and d ask for
  // Without what no node set can mend: triangles where the domain is narrower than 3 d (some chord
  // through their middle is shorter) and those that touch a boundary edge shorter than 0.7 d.
  Measures wide;
  std::int64_t missing_edges = 0;  // boundary edges that are crossed or split: must be 0
};

Verdict evaluate(const NodeSet& nodes);

// The same triangles as vertex triples, sorted, for comparison with ours.
std::vector<std::array<std::int64_t, 3>> reference_triangles(const NodeSet& nodes);

}  // namespace pnpbs_bench
