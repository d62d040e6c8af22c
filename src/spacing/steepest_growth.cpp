// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/steepest_growth.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/execution.hpp"

namespace pnpbs {

namespace {

// A point at which d is sampled, in a leaf of this rank.
template <int Dim>
struct Sample {
  std::int32_t leaf;
  Point<Dim> x;
  bool on_boundary;
};

// Appends the samples of a leaf.
template <int Dim>
void add_samples(const SizedTree<Dim>& map, std::int32_t leaf, std::vector<Sample<Dim>>& samples) {
  const BackgroundTree<Dim>& tree = map.tree();
  const Point<Dim> middle = tree.cell_centre(tree.leaf_cell(leaf));
  const double side = tree.cell_side(tree.leaf_cell(leaf));
  const auto add_if_inside = [&](const Point<Dim>& x) {
    if (map.inside_in_leaf(leaf, x)) samples.push_back({leaf, x, false});
  };
  // Samples on the faces ensure that a jump between two leaves shows in one of them.
  add_if_inside(middle);
  for (int k = 0; k < Dim; ++k)
    for (const double off : {-0.5, 0.5}) {
      Point<Dim> x = middle;
      x[k] += off * side;
      add_if_inside(x);
    }
  for (const std::int32_t e : map.facets_of_leaf(leaf)) {
    const Point<Dim>& begin = map.corners(e)[0];
    if (tree.leaf_at(begin) == leaf) samples.push_back({leaf, begin, true});
  }
}

// Returns the samples of the leaves of this rank, in the order of the leaves.
template <int Dim>
std::vector<Sample<Dim>> samples_of_own(const SizedTree<Dim>& map,
                                        const std::function<bool(std::int32_t)>& owns_leaf) {
  constexpr std::int32_t kChunk = 1024;
  const std::int32_t leaves = map.tree().leaf_count(), chunks = (leaves + kChunk - 1) / kChunk;
  std::vector<std::vector<Sample<Dim>>> of_chunk(static_cast<std::size_t>(chunks));
  for_each("pnpbs::samples_of_own", chunks, [&](std::int64_t c) {
    const auto first = static_cast<std::int32_t>(c) * kChunk;
    for (std::int32_t leaf = first; leaf < std::min(first + kChunk, leaves); ++leaf)
      if (owns_leaf(leaf) && !map.leaf_outside(leaf))
        add_samples(map, leaf, of_chunk[static_cast<std::size_t>(c)]);
  });
  std::vector<Sample<Dim>> samples;
  for (const std::vector<Sample<Dim>>& some : of_chunk)
    samples.insert(samples.end(), some.begin(), some.end());
  return samples;
}

template <int Dim>
struct Slope {
  double growth, d;  // d: the smaller of the two values
  Point<Dim> at;
  bool in_domain = true;
};

// Returns the steepest slope in each leaf that this rank owns.
template <int Dim>
std::vector<Slope<Dim>> slopes_of_own(const SizedTree<Dim>& map,
                                      const std::function<bool(std::int32_t)>& owns_leaf,
                                      const SpacingEvaluator<Dim>& spacing,
                                      const GrowthRule<Dim>& rule) {
  const std::vector<Sample<Dim>> samples = samples_of_own(map, owns_leaf);
  std::vector<Point<Dim>> points;
  for (const Sample<Dim>& sample : samples) points.push_back(sample.x);
  std::vector<double> d(points.size());
  spacing(std::ssize(points), points.data(), d.data());
  std::vector<Slope<Dim>> slopes;  // one for each leaf
  for (std::size_t a = 0; a < samples.size(); ++a) {
    const std::int32_t leaf = samples[a].leaf;
    if (a == 0 || samples[a - 1].leaf != leaf) slopes.push_back({0, d[a], points[a]});
    // Boundary samples come last in their leaf and are not compared with each other.
    if (samples[a].on_boundary) continue;
    for (std::size_t b = a + 1; b < samples.size() && samples[b].leaf == leaf; ++b) {
      const double growth = rule.between(points[a], d[a], points[b], d[b]);
      const std::size_t low = d[a] < d[b] ? a : b;
      if (growth > slopes.back().growth && !map.facet_between(leaf, points[a], points[b]))
        slopes.back() = {growth, d[low], points[low]};
    }
  }
  return slopes;
}

// Appends the steepest known slope that belongs to this rank. Sorting first avoids most calls of
// is_own.
template <int Dim, class IsOwn>
void add_steepest(std::vector<Slope<Dim>>& known, const IsOwn& is_own,
                  std::vector<Slope<Dim>>& slopes) {
  std::ranges::sort(known, std::ranges::greater(), &Slope<Dim>::growth);
  const auto first = std::ranges::find_if(known, is_own);
  if (first != known.end()) slopes.push_back(*first);
}

// Appends the known slopes of this rank that are at least as steep as `growth` and have the
// smallest d, including ties.
template <int Dim, class IsOwn>
void add_finest(std::vector<Slope<Dim>>& known, double growth, const IsOwn& is_own,
                std::vector<Slope<Dim>>& slopes) {
  std::erase_if(known, [&](const Slope<Dim>& slope) { return slope.growth < growth; });
  std::ranges::sort(known, {}, &Slope<Dim>::d);
  auto slope = std::ranges::find_if(known, is_own);
  if (slope == known.end()) return;
  for (const double finest = slope->d; slope != known.end() && slope->d == finest; ++slope)
    if (is_own(*slope)) slopes.push_back(*slope);
}

}  // namespace

template <int Dim>
SteepestGrowth<Dim> steepest_growth(const Communicator& comm, const SizedTree<Dim>& map,
                                    const std::function<bool(std::int32_t)>& owns_leaf,
                                    const SpacingEvaluator<Dim>& spacing,
                                    const SpacingHints<Dim>& known,
                                    const Embedding<Dim>& embedding) {
  std::vector<Slope<Dim>> slopes;
  std::vector<Slope<Dim>> known_slopes;
  const auto is_own = [&](const Slope<Dim>& slope) {
    if (!in_closed_box(map.tree().cell_box(0), slope.at)) return false;
    const std::int32_t leaf = map.tree().leaf_at(slope.at);
    if (!owns_leaf(leaf)) return false;
    return slope.in_domain || (!map.leaf_outside(leaf) && map.inside_in_leaf(leaf, slope.at));
  };
  collective_try(comm, [&] {
    slopes = slopes_of_own<Dim>(map, owns_leaf, spacing, {0, embedding});
    for (const auto& [growth, d, at, in_domain] : known.slopes)
      known_slopes.push_back({growth, d, at, in_domain});
    add_steepest<Dim>(known_slopes, is_own, slopes);
  });
  // Keeps the slopes that have the largest value over all ranks, and returns this value.
  // Collective.
  const auto keep_max = [&](const auto& value) {
    double own = -std::numeric_limits<double>::infinity();
    for (const Slope<Dim>& slope : slopes) own = std::max(own, value(slope));
    const double max = comm.allreduce_max(own);
    std::erase_if(slopes, [&](const Slope<Dim>& slope) { return value(slope) < max; });
    return max;
  };
  double max = 0;
  for (const Slope<Dim>& slope : slopes) max = std::max(max, slope.growth);
  SteepestGrowth<Dim> steepest;
  steepest.growth = comm.allreduce_max(max);
  collective_try(comm,
                 [&] { add_finest<Dim>(known_slopes, 0.5 * steepest.growth, is_own, slopes); });
  std::erase_if(slopes,
                [&](const Slope<Dim>& slope) { return slope.growth < 0.5 * steepest.growth; });
  keep_max([](const Slope<Dim>& slope) { return -slope.d; });
  for (int k = 0; k < Dim; ++k)
    steepest.at[k] = keep_max([k](const Slope<Dim>& slope) { return slope.at[k]; });
  return steepest;
}

template SteepestGrowth<2> steepest_growth<2>(const Communicator&, const SizedTree<2>&,
                                              const std::function<bool(std::int32_t)>&,
                                              const SpacingEvaluator<2>&, const SpacingHints<2>&,
                                              const Embedding<2>&);
template SteepestGrowth<3> steepest_growth<3>(const Communicator&, const SizedTree<3>&,
                                              const std::function<bool(std::int32_t)>&,
                                              const SpacingEvaluator<3>&, const SpacingHints<3>&,
                                              const Embedding<3>&);

}  // namespace pnpbs
