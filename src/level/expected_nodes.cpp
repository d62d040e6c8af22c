// SPDX-License-Identifier: BSD-3-Clause
#include "level/expected_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/lattice.hpp"

namespace pnpbs {

namespace {

// Returns the nodes expected in each leaf of a surface without a body. The known total area is
// divided among the leaves in proportion to the areas of their faces.
std::vector<double> wanted_on_surfaces(const Level<3>& level) {
  const SizedTree<3>& map = level.map();
  const BackgroundTree<3>& tree = map.tree();
  const auto face = [&](std::int32_t leaf) {
    if (!level.tree->owns(leaf) || map.leaf_outside(leaf)) return 0.0;
    const double sides = tree.cell_side(tree.leaf_cell(leaf)) / tree.side();
    return sides * sides;
  };
  FixedPointSum sum;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) sum.add(face(leaf));
  const double all = level.comm->allreduce_sum(sum).value();
  std::vector<double> wanted;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const double part = face(leaf), d = map.leaf_spacing(leaf);
    wanted.push_back(part > 0 ? Lattice<2>::kDensity * level.geometry.domain().area() *
                                    (part / all) / (d * d)
                              : 0);
  }
  return wanted;
}
std::vector<double> wanted_on_surfaces(const Level<2>&) { return {}; }

}  // namespace

// Returns the expected nodes of each leaf. The part of the domain in a single boundary leaf is
// unknown. Together these leaves have what remains of the area (volume) of the domain, so each
// counts with the same fraction of its size.
template <int Dim>
std::vector<double> wanted_nodes(const Level<Dim>& level) {
  if (level.geometry.kind() == GeometryKind::surface) return wanted_on_surfaces(level);
  const SizedTree<Dim>& map = level.map();
  const BackgroundTree<Dim>& tree = map.tree();
  std::uint64_t inside = 0, crossed = 0;  // areas or volumes
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    if (level.tree->owns(leaf) && !map.leaf_outside(leaf))
      (map.leaf_has_facets(leaf) ? crossed : inside) += map.leaf_size(leaf);
  const double unit =
      tree.aspect() * power<Dim>(std::ldexp(tree.side(), -SizedTree<Dim>::kSizeDepth));
  const double area_inside = unit * static_cast<double>(level.comm->allreduce_sum(inside)),
               area_crossed = unit * static_cast<double>(level.comm->allreduce_sum(crossed));
  const double share =
      area_crossed > 0
          ? std::clamp((level.geometry.measure() - area_inside) / area_crossed, 0.0, 1.0)
          : 0;
  std::vector<double> wanted;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const double d = map.leaf_spacing(leaf), measure = tree.cell_measure(tree.leaf_cell(leaf));
    const double part = !level.tree->owns(leaf) || map.leaf_outside(leaf) ? 0
                        : map.leaf_has_facets(leaf)                       ? share
                                                                          : 1;
    wanted.push_back(part > 0 ? part * Lattice<Dim>::kDensity * measure / power<Dim>(d) : 0);
  }
  return wanted;
}

template <int Dim>
double expected_nodes(const Level<Dim>& level) {
  FixedPointSum nodes;
  for (double wanted : wanted_nodes(level)) nodes.add(wanted);
  return level.comm->allreduce_sum(nodes).value();
}

namespace {

// Returns the growth of d in the chart of a sphere that does not exist on the sphere itself. It
// does not count as growth, because bubbles of the sphere are bubbles of the chart. It is infinite
// in leaves across which the chart grows too much for their samples, and in those of the patch of a
// whole sphere, which is not filled.
double growth_of_chart(const Level<2>& level, std::int32_t leaf, double d) {
  constexpr double kTooMuch = 0.5;  // growth across a leaf
  const Embedding<2>& embedding = level.geometry.domain().embedding();
  if (!embedding.is_sphere()) return 0;
  const BackgroundTree<2>& tree = level.map().tree();
  const std::int32_t cell = tree.leaf_cell(leaf);
  const Point<2> centre = tree.cell_centre(cell);
  const double growth = embedding.chart().relative_growth(centre), side = tree.cell_side(cell);
  const Point<2> outermost{centre[0] + std::copysign(side / 2, centre[0]),
                           centre[1] + std::copysign(side / 2, centre[1])};
  if (growth * side > kTooMuch || level.geometry.domain().is_in_patch(outermost))
    return std::numeric_limits<double>::infinity();
  return d * growth;
}
double growth_of_chart(const Level<3>&, std::int32_t, double) { return 0; }

}  // namespace

template <int Dim>
SpacingVariation spacing_variation(const Level<Dim>& level) {
  const SizedTree<Dim>& map = level.map();
  // Largest distance of a leaf's points from its samples, over its side.
  constexpr double kBetweenSamples = 0.7;
  SpacingVariation own;
  for (std::int32_t leaf = 0; leaf < map.tree().leaf_count(); ++leaf) {
    if (!level.tree->owns(leaf) || map.leaf_outside(leaf)) continue;
    const double min = map.leaf_min_spacing(leaf), max = map.leaf_max_spacing(leaf);
    // Leaves next to the boundary may have the samples of their parent cell.
    const double cell = map.tree().cell_side(map.tree().leaf_cell(leaf)),
                 way = kBetweenSamples * (map.leaf_has_facets(leaf) ? 2 * cell : cell);
    own.min = std::min(own.min, min);
    own.max = std::max(own.max, max);
    own.steepest = std::max(own.steepest, (max - min) / way - growth_of_chart(level, leaf, min));
  }
  return SpacingVariation{-level.comm->allreduce_max(-own.min), level.comm->allreduce_max(own.max),
                          level.comm->allreduce_max(own.steepest)};
}

template std::vector<double> wanted_nodes(const Level<2>&);
template std::vector<double> wanted_nodes(const Level<3>&);
template double expected_nodes(const Level<2>&);
template double expected_nodes(const Level<3>&);
template SpacingVariation spacing_variation(const Level<2>&);
template SpacingVariation spacing_variation(const Level<3>&);

}  // namespace pnpbs
