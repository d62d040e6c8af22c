// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/feature_nodes.hpp"

#include <algorithm>

#include "domain/curve_steps.hpp"
#include "domain/volume/large_facets.hpp"
#include "geometry/polyline_track.hpp"

namespace pnpbs {

namespace {

std::vector<std::vector<Point<3>>> polylines(const BoundaryMesh<3>& mesh,
                                             const Features& features) {
  std::vector<std::vector<Point<3>>> lines;
  for (const FeatureCurve& curve : features.curves) {
    std::vector<Point<3>>& line = lines.emplace_back();
    for (const std::int32_t node : curve.nodes)
      line.push_back(mesh.nodes[static_cast<std::size_t>(node)].position);
  }
  return lines;
}

std::int32_t corner_at(const Features& features, std::int32_t mesh_node) {
  const std::vector<std::int32_t>& corners = features.corners;
  const auto at = std::lower_bound(corners.begin(), corners.end(), mesh_node);
  return static_cast<std::int32_t>(at - corners.begin());
}

// Appends the nodes of curve c, without corners.
void add_curve(const Features& features, std::size_t c, const PolylineTrack<3>& track,
               const std::vector<double>& stations, FeatureNodes& found) {
  const FeatureCurve& curve = features.curves[c];
  std::vector<std::int32_t>& along = found.along.emplace_back();
  const bool ends = features.is_corner(curve.nodes.front());  // and then begins, at a corner
  track.for_places(stations, [&](std::size_t i, std::size_t segment, double fraction) {
    const bool first = i == 0, last = i + 1 == stations.size();
    if (ends && (first || last)) {
      along.push_back(corner_at(features, first ? curve.nodes.front() : curve.nodes.back()));
    } else if (last) {
      along.push_back(along.front());
    } else {
      along.push_back(static_cast<std::int32_t>(found.nodes.size()));
      found.nodes.push_back({track.point(segment, fraction), curve.tag, -1,
                             static_cast<std::int32_t>(c),
                             curve.first_edge + static_cast<std::int32_t>(segment)});
    }
  });
}

}  // namespace

std::int32_t FeatureNodes::next(std::int32_t node, const CurveDirection& way) const {
  const std::vector<std::int32_t>& row = along[static_cast<std::size_t>(way.curve)];
  const auto last = static_cast<std::int32_t>(row.size()) - 1;
  std::int32_t step = way.forward ? 0 : last;  // of a corner
  if (nodes[static_cast<std::size_t>(node)].corner < 0) {
    // Nodes between corners have consecutive numbers.
    const bool from_corner = nodes[static_cast<std::size_t>(row[0])].corner >= 0;
    step = from_corner ? node - row[1] + 1 : node - row[0];
    if (step == 0 && !way.forward) step = last;
  }
  return row[static_cast<std::size_t>(way.forward ? step + 1 : step - 1)];
}

bool FeatureNodes::joined(std::int32_t a, std::int32_t b) const {
  const auto follows = [&](std::int32_t from, std::int32_t to) {
    const std::int32_t curve = nodes[static_cast<std::size_t>(from)].curve;
    return curve >= 0 && (next(from, {curve, true}) == to || next(from, {curve, false}) == to);
  };
  if (follows(a, b) || follows(b, a)) return true;
  // Two corners with nothing between them?
  if (nodes[static_cast<std::size_t>(a)].corner < 0) return false;
  return std::ranges::any_of(along, [&](const std::vector<std::int32_t>& row) {
    return row.size() == 2 && ((row[0] == a && row[1] == b) || (row[0] == b && row[1] == a));
  });
}

FeatureNodes lay_feature_nodes(const BoundaryMesh<3>& mesh, const Features& features,
                               const SpacingEvaluator<3>& spacing, const NodeLimit& limit) {
  require_few_on_large_facets(mesh, features, spacing, limit);
  const std::vector<std::vector<Point<3>>> lines = polylines(mesh, features);
  std::vector<PolylineTrack<3>> tracks;
  for (std::size_t c = 0; c < lines.size(); ++c)
    tracks.emplace_back(lines[c], features.curves[c].closed());
  const std::vector<std::vector<double>> stations =
      lay_equal_steps(tracks, spacing, limit.max_nodes);
  FeatureNodes found;
  for (std::int32_t corner = 0; corner < static_cast<std::int32_t>(features.corners.size());
       ++corner) {
    const std::int32_t node = features.corners[static_cast<std::size_t>(corner)];
    const BoundaryNode<3>& at = mesh.nodes[static_cast<std::size_t>(node)];
    found.nodes.push_back({at.position, at.tag, corner, -1, -1});
  }
  for (std::size_t c = 0; c < tracks.size(); ++c)
    add_curve(features, c, tracks[c], stations[c], found);
  return found;
}

}  // namespace pnpbs
