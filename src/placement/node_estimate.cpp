// SPDX-License-Identifier: BSD-3-Clause
#include "placement/node_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/lattice.hpp"
#include "domain/plane/boundary.hpp"
#include "spacing/domain_map.hpp"

namespace pnpbs {

namespace {

// Of what the boundary leaves of the leaves it crosses, only the sum is known: by the domain's
// area.
double nodes_inside(const DomainMap<2>& map, double area) {
  double inside = 0, crossed = 0, nodes_of_inside = 0, nodes_of_crossed = 0;
  for (std::int32_t leaf = 0; leaf < map.tree().leaf_count(); ++leaf) {
    if (map.leaf_outside(leaf)) continue;
    const double side = map.tree().cell_side(map.tree().leaf_cell(leaf)),
                 d = map.leaf_spacing(leaf);
    const double nodes = d > 0 ? Lattice<2>::kDensity * side * side / (d * d) : 0;
    (map.leaf_has_facets(leaf) ? crossed : inside) += side * side;
    (map.leaf_has_facets(leaf) ? nodes_of_crossed : nodes_of_inside) += nodes;
  }
  const double share = crossed > 0 ? std::clamp((area - inside) / crossed, 0.0, 1.0) : 0;
  return nodes_of_inside + share * nodes_of_crossed;
}

}  // namespace

NodeEstimate estimate_nodes(const Communicator& comm, const PlaneDomain& domain,
                            const Spacing<2>& spacing, std::int64_t max_boundary_nodes) {
  constexpr int kUniformDepth = 4, kPasses = 4, kCells = 4096;
  const SpacingEvaluator<2> evaluator = [&](std::int64_t n, const Point<2>* x, double* d) {
    evaluate_spacing<2>(spacing, domain.area(), n, x, d);
  };
  Boundary boundary;
  agreed(comm, [&] { boundary = discretize_boundary(domain, evaluator, max_boundary_nodes); });
  DomainMap<2> map;
  double max = std::numeric_limits<double>::infinity(), nodes = 0;
  for (int pass = 0; pass < kPasses; ++pass) {
    map.build_part(comm, domain.bounds(), boundary, evaluator,
                   std::numeric_limits<std::int64_t>::max(),
                   [&](const BackgroundTree<2>& tree, std::int32_t c, double in_cell) {
                     return tree.cell(c).depth < kUniformDepth || in_cell > max;
                   });
    nodes = nodes_inside(map, domain.area());
    max = nodes / kCells;
  }
  // A boundary node has half of its neighbours outside, and half of its own room.
  nodes += 0.5 * static_cast<double>(boundary.nodes.size());
  return {nodes, steepest_growth(
                     comm, map, [](std::int32_t) { return true; }, evaluator)};
}

}  // namespace pnpbs
