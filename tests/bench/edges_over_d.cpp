// SPDX-License-Identifier: BSD-3-Clause
#include "edges_over_d.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pnpbs_bench {

namespace {

struct Range {
  double min = std::numeric_limits<double>::infinity(), max = 0;
  bool graded() const { return max > 1.1 * min; }
};

Range range_of(const std::vector<MeasuredEdge>& edges) {
  Range range;
  for (const MeasuredEdge& e : edges) {
    range.min = std::min(range.min, e.d);
    range.max = std::max(range.max, e.d);
  }
  return range;
}

// Returns `count` bands; `width` is that of a band in log d.
std::vector<EdgeBand> bands_of(const std::vector<MeasuredEdge>& edges, const Range& range,
                               int count, double width) {
  std::vector<EdgeBand> bands(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    bands[static_cast<std::size_t>(k)].d_from = range.min * std::exp(k * width);
    bands[static_cast<std::size_t>(k)].d_to =
        range.graded() ? range.min * std::exp((k + 1) * width) : range.max;
  }
  for (const MeasuredEdge& e : edges) {
    const int k = range.graded() ? static_cast<int>(std::log(e.d / range.min) / width) : 0;
    bands[static_cast<std::size_t>(std::clamp(k, 0, count - 1))].add(e.ratio);
  }
  for (EdgeBand& band : bands) band.finish();
  std::erase_if(bands, [](const EdgeBand& band) { return band.edges == 0; });
  return bands;
}

}  // namespace

void EdgeBand::add(double ratio) {
  ++edges;
  mean += ratio;
  deviation += ratio * ratio;
}

void EdgeBand::finish() {
  if (edges == 0) return;
  const double n = static_cast<double>(edges);
  mean /= n;
  deviation = std::sqrt(std::max(0.0, deviation / n - mean * mean));
}

std::vector<EdgeBand> eight_bands(const std::vector<MeasuredEdge>& edges) {
  const Range range = range_of(edges);
  const int count = range.graded() ? 8 : 1;
  return bands_of(edges, range, count, range.graded() ? std::log(range.max / range.min) / 8 : 1);
}

std::vector<EdgeBand> octaves(const std::vector<MeasuredEdge>& edges) {
  const Range range = range_of(edges);
  const int count =
      range.graded() ? static_cast<int>(std::ceil(std::log2(range.max / range.min))) : 1;
  return bands_of(edges, range, count, std::log(2));
}

WorstPlaces worst_places(std::size_t nodes, const std::vector<MeasuredEdge>& edges, double fewest) {
  std::vector<double> sum(nodes, 0), count(nodes, 0);
  for (const MeasuredEdge& e : edges)
    for (std::size_t i : {e.a, e.b}) {
      sum[i] += e.ratio;
      count[i] += 1;
    }
  std::vector<double> wide_sum = sum, wide_count = count;
  for (const MeasuredEdge& e : edges) {
    wide_sum[e.a] += sum[e.b];
    wide_count[e.a] += count[e.b];
    wide_sum[e.b] += sum[e.a];
    wide_count[e.b] += count[e.a];
  }
  WorstPlaces worst;
  worst.min = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < nodes; ++i) {
    if (wide_count[i] < fewest) continue;
    const double mean = wide_sum[i] / wide_count[i];
    if (mean < worst.min) {
      worst.min = mean;
      worst.min_node = i;
    }
    if (mean > worst.max) {
      worst.max = mean;
      worst.max_node = i;
    }
  }
  return worst;
}

}  // namespace pnpbs_bench
