// SPDX-License-Identifier: BSD-3-Clause
// Statistics of edge length over d by bands of d and by location. A mean over all edges would hide
// regions with compressed nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pnpbs_bench {

// An edge: its ends, its length over the mean of d at its ends, and that mean.
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

  void add(double ratio);  // mean and deviation are sums until finish()
  void finish();
};

// Return the nonempty bands from the smallest d on: eight of equal width in log d, or octaves.
// There is one band if d hardly varies.
std::vector<EdgeBand> eight_bands(const std::vector<MeasuredEdge>& edges);
std::vector<EdgeBand> octaves(const std::vector<MeasuredEdge>& edges);

// The nodes around which the mean over their edges and those of their neighbours is smallest and
// largest, among nodes with at least `fewest` such edges.
struct WorstPlaces {
  double min = 0, max = 0;
  std::size_t min_node = 0, max_node = 0;
};
WorstPlaces worst_places(std::size_t nodes, const std::vector<MeasuredEdge>& edges, double fewest);

}  // namespace pnpbs_bench
