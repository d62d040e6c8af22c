// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/feature_nodes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "base/index.hpp"
#include "base/lattice.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "domain/curve_steps.hpp"
#include "domain/node_limit.hpp"
#include "domain/spacing_evaluator.hpp"
#include "domain/volume/features.hpp"
#include "geometry/boundary_mesh.hpp"
#include "geometry/polyline_track.hpp"
#include "implicit/level_set_kinks.hpp"

namespace pnpbs {
namespace {

// A check that the largest pieces of a surface alone do not imply too many nodes, as happens if one
// vertex is far away by mistake.

constexpr std::size_t kLargest = 64;  // most edges, and most triangles, that are checked
// Memory of a node while it is placed, for the samples of d [bytes]
constexpr double kBytesOnEdge = 450;
constexpr int kParts = 4;  // intervals per side between the points at which d is evaluated

// A feature edge or a triangle; an edge (a, b) has the corners a, b, b.
struct LargePiece {
  double size;  // length or area
  FacetCorners<3> corners;
};

void keep_largest_pieces(std::vector<LargePiece>& pieces) {
  const auto larger = [](const LargePiece& a, const LargePiece& b) {
    return a.size != b.size ? a.size > b.size : a.corners < b.corners;
  };
  const auto end = pieces.begin() + static_cast<std::ptrdiff_t>(std::min(kLargest, pieces.size()));
  std::partial_sort(pieces.begin(), end, pieces.end(), larger);
  pieces.erase(end, pieces.end());
}

std::vector<LargePiece> largest_edges(const BoundaryMesh<3>& mesh, const Features& features) {
  std::vector<LargePiece> edges;
  const auto at = [&](std::int32_t node) {
    return mesh.nodes[static_cast<std::size_t>(node)].position;
  };
  for (const FeatureCurve& curve : features.curves) {
    for (std::size_t k = 1; k < curve.nodes.size(); ++k) {
      const Point<3> a = at(curve.nodes[k - 1]), b = at(curve.nodes[k]);
      edges.push_back({distance<3>(a, b), {a, b, b}});
    }
  }
  keep_largest_pieces(edges);
  return edges;
}

std::vector<LargePiece> largest_triangles(const BoundaryMesh<3>& mesh, const Features& features) {
  std::vector<LargePiece> triangles;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (features.patch[f] < 0) continue;
    const FacetCorners<3> x = corners_of(mesh, mesh.facets[f]);
    const Point<3> normal = cross(difference(x[1], x[0]), difference(x[2], x[0]));
    triangles.push_back({0.5 * length(normal), x});
  }
  keep_largest_pieces(triangles);
  return triangles;
}

// Appends the points of a lattice on the piece.
void append_lattice_points(const LargePiece& piece, std::vector<Point<3>>& places) {
  for (int i = 0; i <= kParts; ++i)
    for (int j = 0; i + j <= kParts; ++j) {
      const std::array<double, 3> share{double(i) / kParts, double(j) / kParts,
                                        double(kParts - i - j) / kParts};
      Point<3> place{};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t c = 0; c < 3; ++c) place[k] += share[c] * piece.corners[c][k];
      places.push_back(place);
    }
}

// Returns for each piece the largest d at its lattice points.
std::vector<double> largest_spacings(const std::vector<LargePiece>& pieces,
                                     const SpacingEvaluator<3>& spacing) {
  std::vector<Point<3>> places;
  for (const LargePiece& piece : pieces) append_lattice_points(piece, places);
  std::vector<double> d(places.size());
  if (!places.empty()) spacing(std::ssize(places), places.data(), d.data());
  std::vector<double> largest;
  const auto each =
      static_cast<std::ptrdiff_t>(places.size() / std::max<std::size_t>(1, pieces.size()));
  for (auto at = d.begin(); at != d.end(); at += each)
    largest.push_back(*std::max_element(at, at + each));
  return largest;
}

double perimeter(const FacetCorners<3>& x) {
  return distance<3>(x[0], x[1]) + distance<3>(x[1], x[2]) + distance<3>(x[2], x[0]);
}

// Throws Error(ErrorKind::spacing) or Error(ErrorKind::memory) if the largest edges and triangles
// alone would have too many nodes; the message names the longest edge. The largest d at a few
// points of each piece gives a low estimate at much less cost than placing nodes.
void require_few_on_large_facets(const BoundaryMesh<3>& mesh, const Features& features,
                                 const SpacingEvaluator<3>& spacing, const NodeLimit& limit) {
  const std::vector<LargePiece> edges = largest_edges(mesh, features),
                                triangles = largest_triangles(mesh, features);
  const std::vector<double> on_edges = largest_spacings(edges, spacing),
                            on_triangles = largest_spacings(triangles, spacing);
  double nodes = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) nodes += edges[i].size / on_edges[i];
  const double on_all_edges = nodes;
  // Half of the nodes on a triangle's sides are subtracted, since they replace nodes of the
  // triangle.
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const double d = on_triangles[i];
    nodes += std::max(0.0, Lattice<2>::kDensity * triangles[i].size / (d * d) -
                               0.5 * perimeter(triangles[i].corners) / d);
  }
  if (edges.empty()) return;
  if (nodes > static_cast<double>(limit.max_nodes)) {
    const LargePiece& longest = edges.front();
    limit.report_too_many(nodes, on_edges.front(),
                          "the edge from " + point_text(longest.corners[0]) + " to " +
                              point_text(longest.corners[1]) + ", which is " +
                              number_text(longest.size) + " long,");
  }
  limit.require_memory_for(nodes);
  limit.require_memory_for(on_all_edges, kBytesOnEdge);
}

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

// Appends the nodes of curve c; corners exist already.
void add_curve(const Features& features, std::size_t c, const PolylineTrack<3>& track,
               const std::vector<double>& stations, FeatureNodes& found) {
  const FeatureCurve& curve = features.curves[c];
  std::vector<std::int32_t>& along = found.along.emplace_back();
  // True for curves with corners at both ends.
  const bool ends = features.is_corner(curve.nodes.front());
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
  std::int32_t step = way.forward ? 0 : last;  // for a corner
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
  // Two corners may be consecutive without nodes between them.
  if (nodes[static_cast<std::size_t>(a)].corner < 0) return false;
  return std::ranges::any_of(along, [&](const std::vector<std::int32_t>& row) {
    return row.size() == 2 && ((row[0] == a && row[1] == b) || (row[0] == b && row[1] == a));
  });
}

FeatureNodes place_feature_nodes(const BoundaryMesh<3>& mesh, const Features& features,
                                 const SpacingEvaluator<3>& spacing, const NodeLimit& limit) {
  require_few_on_large_facets(mesh, features, spacing, limit);
  const std::vector<std::vector<Point<3>>> lines = polylines(mesh, features);
  std::vector<PolylineTrack<3>> tracks;
  for (std::size_t c = 0; c < lines.size(); ++c)
    tracks.emplace_back(lines[c], features.curves[c].closed());
  const std::vector<std::vector<double>> stations =
      equal_step_stations(tracks, spacing, limit.max_nodes);
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

FeatureNodes middles_between(const BoundaryMesh<3>& mesh, const Features& features,
                             const FeatureNodes& laid) {
  const std::vector<std::vector<Point<3>>> lines = polylines(mesh, features);
  FeatureNodes middles;
  for (std::size_t c = 0; c < lines.size(); ++c) {
    const FeatureCurve& curve = features.curves[c];
    const PolylineTrack<3> track(lines[c], curve.closed());
    const std::vector<std::int32_t>& nodes = laid.along[c];
    std::vector<double> stations{0};
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
      const FeatureNode& node = laid.nodes[index(nodes[k])];
      const std::size_t e = index(node.edge - curve.first_edge);
      stations.push_back(track.vertex_stations()[e] + distance<3>(lines[c][e], node.position));
    }
    stations.push_back(track.length());
    std::vector<double> between;
    for (std::size_t k = 0; k + 1 < stations.size(); ++k)
      between.push_back(0.5 * (stations[k] + stations[k + 1]));
    std::vector<std::int32_t>& along = middles.along.emplace_back();
    track.for_places(between, [&](std::size_t, std::size_t segment, double fraction) {
      along.push_back(static_cast<std::int32_t>(middles.nodes.size()));
      middles.nodes.push_back({track.point(segment, fraction), curve.tag, -1,
                               static_cast<std::int32_t>(c),
                               curve.first_edge + static_cast<std::int32_t>(segment)});
    });
  }
  return middles;
}

namespace {

// The sides of a level set's edge at a node.
struct CreaseAtNode {
  const LevelSet* set = nullptr;
  std::array<Point<3>, 2> normals;  // unit normals of the two sides
  std::array<Point<3>, 2> ways;     // unit vectors along the surface, away from the edge
};

CreaseAtNode crease_at(const ResolvedVolume& volume, const FeatureNode& node) {
  CreaseAtNode at;
  if (node.curve < 0) return at;
  const LevelSetTriangles& sets = volume.level_sets;
  const FeatureCurve& curve = volume.features.curves[index(node.curve)];
  const std::size_t e = index(node.edge - curve.first_edge);
  const LevelSetCrease* const crease = sets.crease(curve.nodes[e], curve.nodes[e + 1]);
  if (!crease) return at;
  at.set = sets.at(curve.facets[e].front());
  at.normals = crease->normals;
  const auto place = [&](std::int32_t n) { return volume.mesh.nodes[index(n)].position; };
  const Point<3> along = difference(place(crease->nodes[1]), place(crease->nodes[0]));
  at.ways = {unit_vector(cross(at.normals[0], along)), unit_vector(cross(along, at.normals[1]))};
  return at;
}

}  // namespace

void project_to_creases(const ResolvedVolume& volume, FeatureNodes& laid, double reach) {
  constexpr double kAside = 0.2;  // [resolution of the level set]
  if (volume.level_sets.creases.empty()) return;
  for (const auto& set : volume.level_sets.sets) {
    if (!set) continue;
    std::vector<std::size_t> nodes;
    std::vector<CreaseSearch> searches;
    for (std::size_t n = 0; n < laid.nodes.size(); ++n) {
      const CreaseAtNode at = crease_at(volume, laid.nodes[n]);
      if (at.set != set.get()) continue;
      const Point<3>& x = laid.nodes[n].position;
      const double aside = kAside * set->resolution();
      nodes.push_back(n);
      searches.push_back({{shifted(x, aside, at.ways[0]), shifted(x, aside, at.ways[1])},
                          shifted(at.normals[0], 1, at.normals[1])});
    }
    const auto found = find_crease_points(*set, searches);
    for (std::size_t k = 0; k < found.size(); ++k) {
      Point<3>& x = laid.nodes[nodes[k]].position;
      if (found[k] && distance<3>(found[k]->position, x) <= reach) x = found[k]->position;
    }
  }
}

// The gradient is evaluated at two distances from the edge and extrapolated to distance 0.
std::array<Point<3>, 2> normals_beside(const ResolvedVolume& volume, const FeatureNode& node) {
  constexpr double kAside = 1e-3;  // [resolution of the level set]
  const CreaseAtNode at = crease_at(volume, node);
  std::array<Point<3>, 2> normals{};
  if (!at.set) return normals;
  std::vector<Point<3>> places;
  for (const Point<3>& way : at.ways)
    for (const double steps : {1.0, 2.0})
      places.push_back(shifted(node.position, steps * kAside * at.set->resolution(), way));
  const std::vector<LevelSetSlope> slopes = at.set->slopes(places);
  for (std::size_t side = 0; side < 2; ++side) {
    const Point<3> near = slopes[2 * side].normal(), far = slopes[2 * side + 1].normal();
    normals[side] = unit_vector(shifted(near, 1, difference(near, far)));
  }
  return normals;
}

}  // namespace pnpbs
