// SPDX-License-Identifier: BSD-3-Clause
#include "population/population_thresholds.hpp"

#include <algorithm>
#include <cmath>

#include "method/constants.hpp"
#include "spacing/spacing_range.hpp"

namespace pnpbs {

namespace {

// Counts per octave of d: first a histogram of the overlap ratios of owned bubbles, then the number
// of pairs of touching bubbles. A pair counts once for each of its bubbles.
constexpr int kBinsPerUnit = 32;  // histogram bins per unit of the overlap ratio
template <int Dim>
constexpr int kBins{kBinsPerUnit * Lattice<Dim>::kOverlapEnd};
template <int Dim>
constexpr int kPairs = kBins<Dim>;
template <int Dim>
constexpr int kCounts = kBins<Dim> + 1;

// Counts of all octaves of d, to be summed over threads and ranks.
struct OctaveCounts {
  std::vector<std::int64_t> values;  // kCounts<Dim> numbers per octave
  // per octave: sum of the distances of touching pairs, in desired distances
  std::vector<FixedPointSum> distances;

  void add(const OctaveCounts& other) {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += other.values[k];
    for (std::size_t k = 0; k < distances.size(); ++k) distances[k].add(other.distances[k]);
  }
};

int octave_of(double d) { return std::ilogb(d); }

// Returns whether a bubble is squeezed against boundary nodes. Boundary nodes do not move, so the
// ratio of such a bubble says nothing about the density.
template <int Dim>
bool is_squeezed(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, double ratio,
                 const PopulationRule& rule, std::int64_t i) {
  if (ratio <= method::kSqueezed * rule.ideal) return false;
  bool at_boundary = false;
  lists.for_neighbours(i, [&](std::int64_t j) { at_boundary = at_boundary || !nodes.moves(j); });
  return at_boundary;
}

template <int Dim>
void count_node(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, double ratio,
                std::int64_t i, std::int64_t* counts, FixedPointSum& distances) {
  const int bin = static_cast<int>(ratio * kBinsPerUnit);
  ++counts[std::clamp(bin, 0, kBins<Dim> - 1)];
  const Point<Dim> x = nodes.position(i);
  lists.for_neighbours(i, [&](std::int64_t j) {
    const double desired = 0.5 * (nodes.d(i) + nodes.d(j));
    const double w = distance<Dim>(x, nodes.position(j)) / desired;
    if (w > method::kTouch || !nodes.moves(j)) return;
    ++counts[kPairs<Dim>];
    distances.add(w);
  });
}

// Returns the number of bins, beginning with bin(0), that together hold at most `bubbles` bubbles.
template <int Dim, class Bin>
int bins_of(double bubbles, const Bin& bin) {
  double sum = 0;
  int k = 0;
  while (k < kBins<Dim> && (sum += static_cast<double>(bin(k))) <= bubbles) ++k;
  return k;
}

template <int Dim>
PopulationThresholds::Pair thresholds_of_octave(const std::int64_t* counts,
                                                const FixedPointSum& distances,
                                                const PopulationRule& rule, double tolerance) {
  PopulationThresholds::Pair pair{0, rule.delete_above};
  if (counts[kPairs<Dim>] == 0) return pair;
  double bubbles = 0;
  for (int k = 0; k < kBins<Dim>; ++k) bubbles += static_cast<double>(counts[k]);
  const double mean = distances.value() / static_cast<double>(counts[kPairs<Dim>]);
  if (std::fabs(mean - rule.mean_distance) <= tolerance) return pair;
  // The area (volume) per bubble is proportional to the square (cube) of the distance.
  const double t = mean / rule.mean_distance,
               missing = bubbles * ((rule.dimension == 2 ? power<2>(t) : power<3>(t)) - 1);
  const int act = bins_of<Dim>(std::fabs(missing), [&](int k) {
    return missing > 0 ? counts[k] : counts[kBins<Dim> - 1 - k];
  });
  if (missing > 0) {
    const double below = std::min(rule.ideal, static_cast<double>(act) / kBinsPerUnit);
    pair.insert_below = std::max(pair.insert_below, below);
  } else {
    const double above = std::max(rule.ideal, static_cast<double>(kBins<Dim> - act) / kBinsPerUnit);
    pair.delete_above = std::min(pair.delete_above, above);
  }
  return pair;
}

}  // namespace

const PopulationThresholds::Pair& PopulationThresholds::at(double d) const {
  const int last = static_cast<int>(octaves.size()) - 1;
  return octaves[static_cast<std::size_t>(std::clamp(octave_of(d) - first_octave, 0, last))];
}

template <int Dim>
View<double> overlap_ratios(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists) {
  const View<double> ratios = make_view<double>("pnpbs::overlap_ratios", nodes.count);
  for_each("pnpbs::overlap_ratios", nodes.count, [&](std::int64_t i) {
    ratios(i) = nodes.moves(i) ? overlap_ratio<Dim>(nodes, lists, i) : 0.0;
  });
  return ratios;
}

template <int Dim>
PopulationThresholds choose_thresholds(const Communicator& comm, const Nodes<Dim>& nodes,
                                       const AdjacencyList<Dim>& lists, const View<double>& ratios,
                                       const PopulationRule& rule, double tolerance) {
  PopulationThresholds thresholds(rule);
  if (rule.mean_distance == 0 || std::isinf(tolerance)) return thresholds;
  const SpacingRange d = spacing_range<Dim>(comm, nodes);
  if (d.empty()) return thresholds;
  const int first = octave_of(d.min), last = octave_of(d.max);
  OctaveCounts counts;
  collective_try(comm, [&] {
    const auto octaves = static_cast<std::size_t>(last - first + 1);
    counts.values.assign(octaves * kCounts<Dim>, 0);
    counts.distances.resize(octaves);
    counts = sums_over(
        "pnpbs::choose_thresholds", nodes.count, counts, [&](std::int64_t i, OctaveCounts& sums) {
          if (!nodes.moves(i) || !nodes.owned(i)) return;
          if (is_squeezed<Dim>(nodes, lists, ratios(i), rule, i)) return;
          const int octave = octave_of(nodes.d(i)) - first;
          count_node<Dim>(nodes, lists, ratios(i), i, sums.values.data() + octave * kCounts<Dim>,
                          sums.distances[static_cast<std::size_t>(octave)]);
        });
  });
  comm.allreduce_sum(counts.values, counts.distances);
  thresholds.first_octave = first;
  thresholds.octaves.clear();
  for (int octave = 0; octave <= last - first; ++octave)
    thresholds.octaves.push_back(thresholds_of_octave<Dim>(
        counts.values.data() + octave * kCounts<Dim>,
        counts.distances[static_cast<std::size_t>(octave)], rule, tolerance));
  return thresholds;
}

template View<double> overlap_ratios<2>(const Nodes<2>&, const AdjacencyList<2>&);
template View<double> overlap_ratios<3>(const Nodes<3>&, const AdjacencyList<3>&);
template PopulationThresholds choose_thresholds<2>(const Communicator&, const Nodes<2>&,
                                                   const AdjacencyList<2>&, const View<double>&,
                                                   const PopulationRule&, double);
template PopulationThresholds choose_thresholds<3>(const Communicator&, const Nodes<3>&,
                                                   const AdjacencyList<3>&, const View<double>&,
                                                   const PopulationRule&, double);

}  // namespace pnpbs
