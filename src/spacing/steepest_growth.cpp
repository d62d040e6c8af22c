// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/steepest_growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pnpbs {

namespace {

// In units of a leaf's side, from its middle: there, west, east, south, north. On its sides a jump
// between two leaves shows in one of them.
constexpr std::array<Point<2>, 5> kSamples{
    {{0.0, 0.0}, {-0.5, 0.0}, {0.5, 0.0}, {0.0, -0.5}, {0.0, 0.5}}};

struct Sample {
  std::int32_t leaf;
  Point<2> x;
  bool on_boundary;
};

std::vector<Sample> samples_of_own(const DomainMap<2>& map,
                                   const std::function<bool(std::int32_t)>& owns_leaf) {
  const BackgroundTree<2>& tree = map.tree();
  std::vector<Sample> samples;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    if (!owns_leaf(leaf) || map.leaf_outside(leaf)) continue;
    const Point<2> middle = tree.cell_centre(tree.leaf_cell(leaf));
    const double side = tree.cell_side(tree.leaf_cell(leaf));
    for (const Point<2>& sample : kSamples) {
      const Point<2> x{middle[0] + sample[0] * side, middle[1] + sample[1] * side};
      if (map.inside_in_leaf(leaf, x)) samples.push_back({leaf, x, false});
    }
    for (const std::int32_t e : map.facets_of_leaf(leaf)) {
      const Point<2>& begin = map.corners(e)[0];
      if (tree.leaf_at(begin) == leaf) samples.push_back({leaf, begin, true});
    }
  }
  return samples;
}

struct Slope {
  double growth, d;  // d at its lower end
  Point<2> at;
};

std::vector<Slope> slopes_of_own(const DomainMap<2>& map,
                                 const std::function<bool(std::int32_t)>& owns_leaf,
                                 const SpacingEvaluator<2>& spacing) {
  const std::vector<Sample> samples = samples_of_own(map, owns_leaf);
  std::vector<Point<2>> points;
  for (const Sample& sample : samples) points.push_back(sample.x);
  std::vector<double> d(points.size());
  spacing(std::ssize(points), points.data(), d.data());
  std::vector<Slope> slopes;  // the steepest of each leaf
  for (std::size_t a = 0; a < samples.size(); ++a) {
    const std::int32_t leaf = samples[a].leaf;
    if (a == 0 || samples[a - 1].leaf != leaf) slopes.push_back({0, d[a], points[a]});
    for (std::size_t b = a + 1; b < samples.size() && samples[b].leaf == leaf; ++b) {
      if (samples[a].on_boundary && samples[b].on_boundary) continue;
      const double growth = std::abs(d[b] - d[a]) / distance<2>(points[a], points[b]);
      const std::size_t low = d[a] < d[b] ? a : b;
      if (growth > slopes.back().growth && !map.facet_between(leaf, points[a], points[b]))
        slopes.back() = {growth, d[low], points[low]};
    }
  }
  return slopes;
}

}  // namespace

SteepestGrowth steepest_growth(const Communicator& comm, const DomainMap<2>& map,
                               const std::function<bool(std::int32_t)>& owns_leaf,
                               const SpacingEvaluator<2>& spacing) {
  std::vector<Slope> slopes;
  agreed(comm, [&] { slopes = slopes_of_own(map, owns_leaf, spacing); });
  // Of the slopes that are left, over all ranks, those with the largest of something.
  const auto keep_max = [&](const auto& value) {
    double own = -std::numeric_limits<double>::infinity();
    for (const Slope& slope : slopes) own = std::max(own, value(slope));
    const double max = comm.allreduce_max(own);
    std::erase_if(slopes, [&](const Slope& slope) { return value(slope) < max; });
    return max;
  };
  double max = 0;
  for (const Slope& slope : slopes) max = std::max(max, slope.growth);
  SteepestGrowth steepest;
  steepest.growth = comm.allreduce_max(max);
  std::erase_if(slopes, [&](const Slope& slope) { return slope.growth < 0.5 * steepest.growth; });
  keep_max([](const Slope& slope) { return -slope.d; });
  for (int k = 0; k < 2; ++k)
    steepest.at[k] = keep_max([k](const Slope& slope) { return slope.at[k]; });
  return steepest;
}

}  // namespace pnpbs
