// SPDX-License-Identifier: BSD-3-Clause
#include "level/plane/level_geometry.hpp"

#include <iterator>

#include "base/error.hpp"

namespace pnpbs {

LevelGeometry<2>::LevelGeometry(std::shared_ptr<const PlaneDomain> domain,
                                std::shared_ptr<const Spacing<2>> spacing, const NodeLimit& limit)
    : domain_(std::move(domain)), spacing_(std::move(spacing)) {
  boundary_ = discretize_boundary(*domain_, evaluator(), limit.max_nodes);
  if (cell().any()) find_images();
  // Fixed nodes off the curves act as edges of length zero, so inner nodes keep their clearance
  // from them. Nodes in the margin of a patch do not, because they move and no other nodes come
  // between them.
  for (std::size_t f = static_cast<std::size_t>(boundary_.first_fixed); f < boundary_.nodes.size();
       ++f) {
    if (domain_->is_in_margin(boundary_.nodes[f].position)) continue;
    const std::int32_t node = static_cast<std::int32_t>(f);
    boundary_.facets.push_back({node, node, boundary_.nodes[f].tag, true, true});
  }
  sectors_.build(boundary_);
  if (domain_->closing()) require_one_triangle_left();
  bubble_bound_ = bubbles_on_boundary(boundary_);
  std::vector<Point<2>> positions;
  for (const BoundaryNode<2>& node : boundary_.nodes) positions.push_back(node.position);
  boundary_spacing_.resize(positions.size());
  evaluator()(std::ssize(positions), positions.data(), boundary_spacing_.data());
}

void LevelGeometry<2>::find_images() {
  std::vector<Point<2>> positions;
  for (const BoundaryNode<2>& node : boundary_.nodes) positions.push_back(node.position);
  images_ = ImagesOfPoints<2>(cell(), positions);
  for (std::size_t b = 0; b < positions.size(); ++b) boundary_.nodes[b].position = positions[b];
}

// Throws unless the closing patch leaves exactly one triangle open and nothing else bounds the
// sphere.
void LevelGeometry<2>::require_one_triangle_left() const {
  const auto edges = std::ranges::count_if(boundary_.facets, &BoundaryEdge::bounds);
  if (edges != 3)
    throw Error(ErrorKind::spacing,
                "the spacing varies too much around the point that is named as outside of the "
                "domain: the patch that closes the sphere there has " +
                    std::to_string(edges) + " open edges, not 3; name another point");
}

SpacingEvaluator<2> LevelGeometry<2>::evaluator() const {
  return [this](std::int64_t n, const Point<2>* x, double* d) {
    evaluate_spacing<2>(*spacing_, domain_->area(), n, x, d);
  };
}

}  // namespace pnpbs
