// SPDX-License-Identifier: BSD-3-Clause
// Does d count everywhere? A mean over all edges hides a region that is crushed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pnpbs_bench {

// One edge: its ends, its length over the mean of d there, and that mean.
struct MeasuredEdge {
  std::size_t a, b;
  double ratio, d;
  bool at_boundary;  // has an end on the boundary
};

// Edge length over d of the edges whose d lies in a range.
struct EdgeBand {
  double d_from = 0, d_to = 0;
  std::int64_t edges = 0;
  double mean = 0, deviation = 0;

  void add(double ratio);  // mean and deviation are sums, until finished
  void finish();
};

// Bands from the finest d on, those without edges left out: eight that are equal in log d, or
// octaves. One where d hardly varies.
std::vector<EdgeBand> eight_bands(const std::vector<MeasuredEdge>& edges);
std::vector<EdgeBand> octaves(const std::vector<MeasuredEdge>& edges);

// Around which node the mean over the edges of it and of its neighbours is least, and where it is
// largest, of the nodes with `fewest` edges to that mean.
struct WorstPlaces {
  double min = 0, max = 0;
  std::size_t min_node = 0, max_node = 0;
};
WorstPlaces worst_places(std::size_t nodes, const std::vector<MeasuredEdge>& edges, double fewest);

}  // namespace pnpbs_bench
