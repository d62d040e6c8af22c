// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/large_facets.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "base/lattice.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

constexpr std::size_t kLargest = 64;  // pieces that are looked at, of either kind
constexpr double kBytesOnEdge = 450;  // of a node while it is laid: samples of d about
constexpr int kParts = 4;             // of their sides, at whose ends d is asked

// With the piece's end points; an edge has two that are the same.
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

// The places of a lattice on a piece.
void append_places(const LargePiece& piece, std::vector<Point<3>>& places) {
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

// Of each piece the largest d at its places.
std::vector<double> largest_spacings(const std::vector<LargePiece>& pieces,
                                     const SpacingEvaluator<3>& spacing) {
  std::vector<Point<3>> places;
  for (const LargePiece& piece : pieces) append_places(piece, places);
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

}  // namespace

void require_few_on_large_facets(const BoundaryMesh<3>& mesh, const Features& features,
                                 const SpacingEvaluator<3>& spacing, const NodeLimit& limit) {
  const std::vector<LargePiece> edges = largest_edges(mesh, features),
                                triangles = largest_triangles(mesh, features);
  const std::vector<double> on_edges = largest_spacings(edges, spacing),
                            on_triangles = largest_spacings(triangles, spacing);
  double nodes = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) nodes += edges[i].size / on_edges[i];
  const double on_all_edges = nodes;
  // Half of the nodes on its sides stand in for a triangle's own.
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

}  // namespace pnpbs
