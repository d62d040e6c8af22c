// SPDX-License-Identifier: BSD-3-Clause
#include "placement/node_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/lattice.hpp"
#include "domain/facets_for_tree.hpp"
#include "spacing/domain_map.hpp"

namespace pnpbs {

namespace {

double area_of(const FacetCorners<3>& x) {
  Point<3> u, v;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = x[1][k] - x[0][k];
    v[k] = x[2][k] - x[0][k];
  }
  return 0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                          u[0] * v[1] - u[1] * v[0]);
}

// Of what the boundary leaves of the leaves it crosses, only the sum is known: by the
// domain's area or volume.
template <int Dim>
double nodes_inside(const DomainMap<Dim>& map, double measure) {
  double inside = 0, crossed = 0, nodes_of_inside = 0, nodes_of_crossed = 0;
  for (std::int32_t leaf = 0; leaf < map.tree().leaf_count(); ++leaf) {
    if (map.leaf_outside(leaf)) continue;
    const double side = map.tree().cell_side(map.tree().leaf_cell(leaf)),
                 d = map.leaf_spacing(leaf);
    const double nodes = d > 0 ? Lattice<Dim>::kDensity * power<Dim>(side) / power<Dim>(d) : 0;
    (map.leaf_has_facets(leaf) ? crossed : inside) += power<Dim>(side);
    (map.leaf_has_facets(leaf) ? nodes_of_crossed : nodes_of_inside) += nodes;
  }
  const double share = crossed > 0 ? std::clamp((measure - inside) / crossed, 0.0, 1.0) : 0;
  return nodes_of_inside + share * nodes_of_crossed;
}

double nodes_on_boundary(const BoundaryMesh<2>& boundary, const SpacingEvaluator<2>&) {
  return static_cast<double>(boundary.nodes.size());
}

// By the area of the facets, with d at their middles.
double nodes_on_boundary(const BoundaryMesh<3>& boundary, const SpacingEvaluator<3>& spacing) {
  std::vector<Point<3>> middles;
  for (const BoundaryTriangle& facet : boundary.facets) {
    const auto [a, b, c] = corners_of(boundary, facet);
    Point<3> middle;
    for (std::size_t k = 0; k < 3; ++k) middle[k] = (a[k] + b[k] + c[k]) / 3;
    middles.push_back(middle);
  }
  std::vector<double> d(middles.size());
  spacing(std::ssize(middles), middles.data(), d.data());
  double nodes = 0;
  for (std::size_t f = 0; f < middles.size(); ++f)
    nodes +=
        Lattice<2>::kDensity * area_of(corners_of(boundary, boundary.facets[f])) / (d[f] * d[f]);
  return nodes;
}

}  // namespace

template <int Dim>
NodeEstimate<Dim> estimate_nodes(const Communicator& comm, const Domain<Dim>& domain,
                                 const Spacing<Dim>& spacing, std::int64_t max_boundary_nodes) {
  constexpr int kUniformDepth = Dim == 2 ? 4 : 3, kPasses = 4, kCells = 4096;
  const SpacingEvaluator<Dim> evaluator = [&](std::int64_t n, const Point<Dim>* x, double* d) {
    evaluate_spacing<Dim>(spacing, measure_of(domain), n, x, d);
  };
  BoundaryMesh<Dim> boundary;
  double on_boundary = 0;
  agreed(comm, [&] {
    boundary = facets_for_tree(domain, evaluator, max_boundary_nodes);
    on_boundary = nodes_on_boundary(boundary, evaluator);
  });
  DomainMap<Dim> map;
  double max = std::numeric_limits<double>::infinity(), nodes = 0;
  for (int pass = 0; pass < kPasses; ++pass) {
    map.build_part(
        comm, domain.bounds(), boundary, evaluator, std::numeric_limits<std::int64_t>::max(),
        [&](const BackgroundTree<Dim>& tree, std::int32_t c, double in_cell) {
          return tree.cell(c).depth < kUniformDepth || in_cell > max;
        },
        kLevelRefinement<Dim>);
    nodes = nodes_inside(map, measure_of(domain));
    max = nodes / kCells;
  }
  // A boundary node has half of its neighbours outside, and half of its own room.
  nodes += 0.5 * on_boundary;
  return {nodes, steepest_growth<Dim>(
                     comm, map, [](std::int32_t) { return true; }, evaluator)};
}

template NodeEstimate<2> estimate_nodes<2>(const Communicator&, const Domain<2>&, const Spacing<2>&,
                                           std::int64_t);
template NodeEstimate<3> estimate_nodes<3>(const Communicator&, const Domain<3>&, const Spacing<3>&,
                                           std::int64_t);

}  // namespace pnpbs
