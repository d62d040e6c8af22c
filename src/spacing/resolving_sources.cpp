// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/resolving_sources.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "base/execution.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

// A part of a facet, represented by its centroid.
struct Piece {
  FacetCorners<3> corners;
  std::int32_t facet;

  Point<3> middle() const {
    const auto& [a, b, c] = corners;
    return {(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3};
  }
};

double edge_length(const Piece& piece, std::size_t k) {
  return distance<3>(piece.corners[k], piece.corners[(k + 1) % 3]);
}
std::size_t longest_edge(const Piece& piece) {
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (edge_length(piece, k) > edge_length(piece, longest)) longest = k;
  return longest;
}

void append_halves(const Piece& piece, std::vector<Piece>& pieces) {
  const std::size_t k = longest_edge(piece), next = (k + 1) % 3;
  const Point<3>& from = piece.corners[k];
  const Point<3> middle = halfway(from, piece.corners[next]);
  for (const std::size_t end : {k, next}) {
    pieces.push_back(piece);
    pieces.back().corners[end] = middle;
  }
}

// Measures the room in front of and behind the facets of a body.
class ShapeToResolve {
 public:
  ShapeToResolve(const VolumeDomain& domain, const Resolution& resolution)
      : mesh_(domain.mesh()), index_(domain.index()), resolution_(resolution) {}

  std::vector<Piece> facets() const {
    std::vector<Piece> pieces;
    for (std::size_t f = 0; f < mesh_.facets.size(); ++f)
      if (normal(static_cast<std::int32_t>(f)) != Point<3>{})
        pieces.push_back({corners_of(mesh_, mesh_.facets[f]), static_cast<std::int32_t>(f)});
    return pieces;
  }

  // Returns the upper bound of d at a point of a facet; d itself if there is room enough.
  double held(std::int32_t facet, const Point<3>& x, double d) const {
    const bool bounds = mesh_.facets[static_cast<std::size_t>(facet)].bounds();
    const double in_gap = bounds ? resolution_.in_gap : resolution_.in_wall;
    return std::max(std::min(held_on_side(facet, x, -1, resolution_.in_wall, d),
                             held_on_side(facet, x, 1, in_gap, d)),
                    resolution_.least * d);
  }

 private:
  Point<3> normal(std::int32_t f) const {
    return facet_normal(mesh_, mesh_.facets[static_cast<std::size_t>(f)]);
  }

  // Returns the bound on one side of the facet. Surfaces that meet at an edge leave ever less room
  // towards it for any d, so there the room at a distance of d from the edge counts.
  double held_on_side(std::int32_t facet, const Point<3>& x, double side, double layers,
                      double d) const {
    const Point<3> out = normal(facet), ahead{side * out[0], side * out[1], side * out[2]};
    const double reach = layers * d;
    const SurfaceIndex::Hit hit = index_.first_hit(x, shifted({}, reach, ahead), facet);
    if (hit.facet < 0) return d;
    const Point<3> other = normal(hit.facet);
    const Point<3> turn =
        dot(other, ahead) < 0 ? shifted(ahead, 1, other) : difference(ahead, other);
    return std::min(d, std::max(hit.along * d, length(turn) * d));
  }

  const BoundaryMesh<3>& mesh_;
  const SurfaceIndex& index_;
  Resolution resolution_;
};

}  // namespace

// Pieces are bisected until they are not much larger than the bound of d on them.
std::vector<GrowthSource<3>> resolving_sources(const Spacing<3>& raw, const VolumeDomain& domain,
                                               const NodeLimit& limit, const Resolution& resolution,
                                               const std::function<void()>& beat) {
  constexpr double kPieces = 1.5;       // longest edge of a piece [bound of d]
  constexpr std::size_t kChunk = 1024;  // number of pieces between two calls of beat()
  const ShapeToResolve shape(domain, resolution);
  std::vector<GrowthSource<3>> sources;
  std::vector<Piece> pieces = shape.facets();
  while (!pieces.empty()) {
    std::vector<double> d(pieces.size());
    std::vector<Point<3>> middles;
    for (const Piece& piece : pieces) middles.push_back(piece.middle());
    evaluate_spacing<3>(raw, domain.volume(), std::ssize(middles), middles.data(), d.data());
    std::vector<double> held(pieces.size());
    for (std::size_t begin = 0; begin < pieces.size(); begin += kChunk) {
      beat();
      for_each("pnpbs::resolving_sources",
               static_cast<std::int64_t>(std::min(kChunk, pieces.size() - begin)),
               [&](std::int64_t k) {
                 const std::size_t p = begin + static_cast<std::size_t>(k);
                 held[p] = shape.held(pieces[p].facet, middles[p], d[p]);
               });
    }
    std::vector<Piece> next;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      if (edge_length(pieces[p], longest_edge(pieces[p])) > kPieces * held[p])
        append_halves(pieces[p], next);
      else if (held[p] < d[p])
        sources.push_back({middles[p], held[p]});
    }
    if (const auto all = static_cast<double>(sources.size() + next.size());
        all > static_cast<double>(limit.max_nodes)) {
      const auto finest = std::ranges::min_element(sources, {}, &GrowthSource<3>::d);
      const bool any = finest != sources.end();
      limit.report_too_many(all, any ? finest->d : d[0], point_text(any ? finest->x : middles[0]));
    }
    limit.require_memory_for(static_cast<double>(sources.size() + next.size()));
    pieces = std::move(next);
  }
  return sources;
}

}  // namespace pnpbs
