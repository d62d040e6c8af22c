// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/node_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "base/execution.hpp"
#include "base/lattice.hpp"
#include "check/boundary_room.hpp"
#include "domain/facets_for_tree.hpp"
#include "estimate/first_row_estimate.hpp"
#include "estimate/surface_estimate.hpp"
#include "initial/initial_fill.hpp"
#include "initial/volume/cubic_lattice.hpp"
#include "method/constants.hpp"
#include "spacing/sized_tree.hpp"
#include "tree/cell_samples.hpp"

namespace pnpbs {

namespace {

// Approximate number of sample points in all leaves near the boundary, and limits per leaf.
constexpr double kFewSamples = 4e3, kManySamples = 6e4;
constexpr int kMinPerLeaf = 2, kMinOfMany = 16, kMaxPerLeaf = 1024;
constexpr double kMaxTests = 1e7;  // Maximum number of tests of points against facets.
// Approximate number of boundary edges examined for the first row.
constexpr std::int64_t kFewEdges = 200, kManyEdges = 2000;

// Returns the n-th point of a sequence that fills a cell evenly for any number of points and has
// distinct coordinates on each axis: multiples of powers of the inverse plastic number and its
// generalization (M. Roberts, The unreasonable effectiveness of quasirandom sequences, 2018). [side
// of the cell]
template <int Dim>
Point<Dim> even_sample(std::int64_t n) {
  constexpr double kRoot = Dim == 2 ? 1.3247179572447460 : 1.2207440846057596;
  Point<Dim> fraction;
  double step = 1;
  for (double& along : fraction) {
    step /= kRoot;
    along = 0.5 + step * static_cast<double>(n);
    along -= std::floor(along);
  }
  return fraction;
}

// The leaves near the boundary, and the sample points in them that are inside the domain.
template <int Dim>
struct LeavesNearBoundary {
  std::vector<std::int32_t> leaves;
  std::vector<std::size_t> first{0};  // Index of the first point of each leaf, and the end.
  std::vector<Point<Dim>> inside;     // Sample points inside the domain.
  double points_per_leaf = 1;         // Number of sample points per leaf, inside or not.
};

// Returns whether nodes lie in a leaf, and not only images of them.
template <int Dim>
bool counts(const SizedTree<Dim>& map, std::int32_t leaf) {
  return !map.leaf_outside(leaf) && map.tree().in_periodic_cell(leaf);
}

template <int Dim>
bool near_boundary(const SizedTree<Dim>& map, const BoundaryRoom<Dim>& boundary,
                   std::int32_t leaf) {
  if (map.leaf_has_facets(leaf)) return true;
  const std::int32_t cell = map.tree().leaf_cell(leaf);
  const double to_corner = 0.5 * std::sqrt(static_cast<double>(Dim)) * map.tree().cell_side(cell),
               reach = to_corner + boundary.reach() * map.leaf_max_spacing(leaf);
  return boundary.any_nearer(map.tree().cell_centre(cell), reach);
}

template <int Dim>
LeavesNearBoundary<Dim> leaves_near_boundary(const SizedTree<Dim>& map,
                                             const BoundaryRoom<Dim>& boundary, Samples samples) {
  const bool many = samples == Samples::many;
  LeavesNearBoundary<Dim> near;
  for (std::int32_t leaf = 0; leaf < map.tree().leaf_count(); ++leaf)
    if (counts(map, leaf) && near_boundary(map, boundary, leaf)) near.leaves.push_back(leaf);
  const double wanted =
      (many ? kManySamples : kFewSamples) / std::max(1.0, static_cast<double>(near.leaves.size()));
  std::size_t facets = 0;  // Upper bound of the facets that a test for inside examines.
  for (const std::int32_t leaf : near.leaves) facets += map.facets_of_leaf(leaf).size();
  const double affordable = kMaxTests / std::max(1.0, static_cast<double>(facets));
  const int per_leaf = static_cast<int>(std::clamp<double>(
      std::min(wanted, affordable), many ? kMinOfMany : kMinPerLeaf, kMaxPerLeaf));
  near.points_per_leaf = per_leaf;
  std::int64_t number = 0;
  for (const std::int32_t leaf : near.leaves) {
    const Box<Dim> box = map.tree().cell_box(map.tree().leaf_cell(leaf));
    for (int n = 0; n < per_leaf; ++n) {
      const Point<Dim> x = point_in<Dim>(box, even_sample<Dim>(number++));
      if (map.inside_in_leaf(leaf, x)) near.inside.push_back(x);
    }
    near.first.push_back(near.inside.size());
  }
  return near;
}

// Returns the integral of 1/d^Dim over the domain, without the part that the nodes of the boundary
// occupy. Leaves near the boundary are integrated by samples. The samples do not resolve which part
// of a leaf on the boundary is inside, so the sum over these leaves is scaled such that all leaves
// together have the measure of the domain.
template <int Dim>
double room_inside(const SizedTree<Dim>& map, double measure, const SpacingEvaluator<Dim>& spacing,
                   const BoundaryRoom<Dim>& boundary, Samples samples) {
  const auto volume_of = [&](std::int32_t leaf) {
    return map.tree().cell_measure(map.tree().leaf_cell(leaf));
  };
  const LeavesNearBoundary<Dim> near = leaves_near_boundary(map, boundary, samples);
  std::vector<double> d(near.inside.size());
  spacing(std::ssize(d), near.inside.data(), d.data());
  std::vector<char> taken(d.size());
  for_each("pnpbs::room_inside", std::ssize(d), [&](std::int64_t i) {
    const auto s = static_cast<std::size_t>(i);
    taken[s] = boundary.holds(near.inside[s], d[s]);
  });
  double inside = 0, crossed = 0;  // Volumes.
  double room = 0, room_crossed = 0;
  std::size_t next = 0;
  for (std::int32_t leaf = 0; leaf < map.tree().leaf_count(); ++leaf) {
    if (!counts(map, leaf)) continue;
    const double volume = volume_of(leaf), of_leaf = map.leaf_spacing(leaf);
    if (next == near.leaves.size() || near.leaves[next] != leaf) {
      inside += volume;
      room += of_leaf > 0 ? volume / power<Dim>(of_leaf) : 0;
      continue;
    }
    const std::size_t begin = near.first[next], end = near.first[next + 1];
    ++next;
    double density = 0;
    for (std::size_t s = begin; s < end; ++s) density += taken[s] ? 0 : 1 / power<Dim>(d[s]);
    const double of_point = volume / near.points_per_leaf;
    (map.leaf_has_facets(leaf) ? crossed : inside) += of_point * static_cast<double>(end - begin);
    (map.leaf_has_facets(leaf) ? room_crossed : room) += of_point * density;
  }
  const double share = crossed > 0 ? std::max(0.0, measure - inside) / crossed : 0;
  return room + share * room_crossed;
}

// Returns the range of d in the leaves.
template <int Dim>
SpacingSummary<Dim> range_of_spacing(const SizedTree<Dim>& map) {
  SpacingSummary<Dim> range;
  for (std::int32_t leaf = 0; leaf < map.tree().leaf_count(); ++leaf) {
    if (!counts(map, leaf)) continue;
    range.min = std::min(range.min, map.leaf_min_spacing(leaf));
    range.max = std::max(range.max, map.leaf_max_spacing(leaf));
  }
  return range;
}

// Number of nodes per d^Dim, and the distance from the boundary that its nodes occupy. [d] In the
// plane, these are those of the lattice and of BoundaryRoom.
struct Packing {
  double density, boundary_reach;
};

Packing packing(const SizedTree<2>&, const PlaneDomain&, bool) {
  return {Lattice<2>::kDensity, BoundaryRoom<2>::kPlaneReach};
}

// Returns the packing in space. If d varies, it is measured in runs: for a box, a ball, a cylinder,
// an L-block, a bracket and Eros with 1 000 to 40 000 nodes and d graded 1:2 to 1:19, the estimate
// has a root mean square error of 1.4 % and a maximum error of 2.7 %. If d is constant, it is that
// of the lattice, unless the edges of the lattice deviate by more than 2 %. On surfaces alone,
// edges are 1.03 d long where d varies.
Packing packing(const SizedTree<3>& map, const VolumeDomain& domain, bool stretched) {
  constexpr double kEdgesOnSurfaces = 1.03, kOff = 0.02;
  const SpacingSummary<3> d = range_of_spacing(map);
  const bool varied = d.max > method::kPatchVariation * d.min;
  if (!domain.filled())
    return {Lattice<2>::kDensity / (varied ? power<3>(kEdgesOnSurfaces) : 1), 0};
  if (varied) return {1.61, 0.48};
  const PeriodicCell<3>& cell = domain.cell();
  const CubicLattice lattice(d.min, cell.any() ? cell.box() : domain.bounds(), true, stretched,
                             cell);
  const double density = lattice.density() * power<3>(d.min);
  const bool off = std::fabs(std::cbrt(density / method::kA15Density) - 1) > kOff;
  return {off ? method::kA15Density : density, stretched && !off ? 0.45 : method::kFillClearance};
}

// Returns the integral of 1/d^2 over surfaces alone, scaled to their area.
double room_on_surfaces(const SizedTree<3>& map, double area) {
  double crossed = 0, nodes = 0;  // Sums over one face of each leaf.
  for (std::int32_t leaf = 0; leaf < map.tree().leaf_count(); ++leaf) {
    if (!counts(map, leaf)) continue;
    const double side = map.tree().cell_side(map.tree().leaf_cell(leaf)),
                 d = map.leaf_spacing(leaf);
    crossed += side * side;
    nodes += side * side / (d * d);
  }
  return nodes * area / crossed;
}

// Returns the number of inner nodes; on surfaces alone, that of all nodes.
template <int Dim>
double nodes_in(const SizedTree<Dim>& map, const Domain<Dim>& domain,
                const SpacingEvaluator<Dim>& evaluator, bool stretched, Samples samples) {
  const Packing packed = packing(map, domain, stretched);
  if constexpr (Dim == 3)
    if (!domain.filled()) return packed.density * room_on_surfaces(map, domain.area());
  const BoundaryRoom<Dim> boundary(map, evaluator, packed.boundary_reach);
  return packed.density * room_inside<Dim>(map, measure_of(domain), evaluator, boundary, samples);
}

template <int Dim>
bool is_in_cell(const PeriodicCell<Dim>& cell, const std::type_identity_t<Point<Dim>>& x) {
  return !cell.any() || cell.image_of(x) == Image<Dim>{};
}

// Nodes that close a sphere replace inner nodes and are not counted.
double nodes_on_boundary(const PlaneDomain& domain, const BoundaryMesh<2>& boundary,
                         const SpacingEvaluator<2>&) {
  return static_cast<double>(
      std::ranges::count_if(boundary.nodes, [&](const BoundaryNode<2>& node) {
        return !domain.is_in_patch(node.position) && is_in_cell(domain.cell(), node.position);
      }));
}

double nodes_on_boundary(const VolumeDomain& domain, const BoundaryMesh<3>& boundary,
                         const SpacingEvaluator<3>& spacing) {
  std::vector<FacetCorners<3>> facets;
  for (const BoundaryTriangle& facet : boundary.facets)
    if (is_in_cell(domain.cell(), centroid(corners_of(boundary, facet))))
      facets.push_back(corners_of(boundary, facet));
  return nodes_on_triangles(std::move(facets), spacing);
}

}  // namespace

template <int Dim>
NodeEstimate<Dim> estimate_nodes(const Communicator& comm, const Domain<Dim>& domain,
                                 const Spacing<Dim>& spacing, std::int64_t max_boundary_nodes,
                                 const EstimatedRun& run, Samples samples) {
  constexpr int kUniformDepth = Dim == 2 ? 4 : 3;
  const bool many = samples == Samples::many;
  const int passes = many ? 4 : 3, cells = many ? 4096 : 512;
  const SpacingEvaluator<Dim> evaluator = [&](std::int64_t n, const Point<Dim>* x, double* d) {
    evaluate_spacing<Dim>(spacing, measure_of(domain), n, x, d);
  };
  BoundaryMesh<Dim> boundary;
  double on_boundary = 0;
  collective_try(comm, [&] {
    boundary = facets_for_tree(domain, evaluator, max_boundary_nodes);
    on_boundary = nodes_on_boundary(domain, boundary, evaluator);
  });
  SizedTree<Dim> map;
  double max = std::numeric_limits<double>::infinity(), nodes = 0;
  for (int pass = 0; pass < passes; ++pass) {
    map.build_part(
        comm, TreeBounds<Dim>(domain.bounds(), domain.cell()), boundary, evaluator,
        std::numeric_limits<std::int64_t>::max(),
        [&](const BackgroundTree<Dim>& tree, std::int32_t c, double in_cell) {
          return tree.cell(c).depth < kUniformDepth || in_cell > max ||
                 domain.embedding().varies_much_in(tree.cell_box(c));
        },
        kLevelRefinement<Dim>);
    const bool last = pass + 1 == passes;
    collective_try(comm, [&] {
      nodes = nodes_in<Dim>(map, domain, evaluator, run.stretched, last ? samples : Samples::few);
      if (last && run.first_row)
        nodes += first_row_excess(map, evaluator, many ? kManyEdges : kFewEdges);
    });
    if (domain.kind() != GeometryKind::surface) nodes += on_boundary;
    max = nodes / cells;
  }
  return {nodes, steepest_growth<Dim>(
                     comm, map, [](std::int32_t) { return true; }, evaluator,
                     spacing.spacing_hints(), domain.embedding())};
}

template NodeEstimate<2> estimate_nodes<2>(const Communicator&, const Domain<2>&, const Spacing<2>&,
                                           std::int64_t, const EstimatedRun&, Samples);
template NodeEstimate<3> estimate_nodes<3>(const Communicator&, const Domain<3>&, const Spacing<3>&,
                                           std::int64_t, const EstimatedRun&, Samples);

}  // namespace pnpbs
