// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/level_geometry.hpp"

#include <utility>

#include "domain/volume/feature_nodes.hpp"

namespace pnpbs {

LevelGeometry<3>::LevelGeometry(std::shared_ptr<const VolumeDomain> domain,
                                std::shared_ptr<const Spacing<3>> spacing, const NodeLimit& limit)
    : domain_(std::move(domain)),
      kind_(domain_->kind()),
      spacing_(std::move(spacing)),
      bounds_(widened(domain_->bounds(), domain_->mesh().node_distance)),
      surface_(domain_->mesh(), domain_->features()) {
  features_ = place_feature_nodes(domain_->mesh(), domain_->features(), evaluator(), limit);
  project_to_creases(domain_->resolved(), features_, boundary().node_distance);
  if (cell().any()) find_images();
  const Features& features = domain_->features();
  patch_bounds_.assign(index(features.patches), 0);
  for (std::size_t f = 0; f < features.patch.size(); ++f)
    if (features.patch[f] >= 0)
      patch_bounds_[index(features.patch[f])] = boundary().facets[f].bounds();
}

void LevelGeometry<3>::find_images() {
  std::vector<Point<3>> points;
  for (const FeatureNode& node : features_.nodes) points.push_back(node.position);
  images_of_feature_nodes_ = ImagesOfPoints<3>(cell(), points);
  for (std::size_t n = 0; n < points.size(); ++n) features_.nodes[n].position = points[n];
  points.clear();
  for (const BoundaryTriangle& facet : boundary().facets)
    points.push_back(centroid(corners_of(boundary(), facet)));
  images_of_facets_ = ImagesOfPoints<3>(cell(), points);
}

SpacingEvaluator<3> LevelGeometry<3>::evaluator() const {
  return [this](std::int64_t n, const Point<3>* x, double* d) {
    evaluate_spacing<3>(*spacing_, domain_->volume(), n, x, d);
  };
}

SurfaceSupport LevelGeometry<3>::place(Carrier carrier, std::int32_t on) const {
  if (carrier == Carrier::surface) return {SurfaceSupport::On::facet, on};
  const FeatureNode& node = features_.nodes[index(on)];
  if (node.corner >= 0) return {SurfaceSupport::On::corner, node.corner};
  return {SurfaceSupport::On::edge, node.edge};
}

IncomingNodes<3> LevelGeometry<3>::feature_nodes() const {
  IncomingNodes<3> nodes;
  for (std::size_t n = 0; n < features_.nodes.size(); ++n) {
    const FeatureNode& node = features_.nodes[n];
    IncomingNode<3> at{node.position, -1};
    at.carrier = node.corner >= 0 ? Carrier::fixed : Carrier::curve;
    at.boundary_node = static_cast<std::int32_t>(n);
    at.tag = node.tag;
    nodes.push_back(at);
  }
  return nodes;
}

}  // namespace pnpbs
