// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/thin_pieces.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/index.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "base/union_find.hpp"
#include "geometry/volume/triangles.hpp"

namespace pnpbs {

namespace {

struct ClosedPiece {
  std::int32_t first = -1;  // of its vertices
  double volume = 0, area = 0;

  double thickness() const { return 2 * std::fabs(volume) / area; }
};

}  // namespace

void remove_thin_pieces(SurfaceSource& surface, double least) {
  UnionFind<std::int32_t> joined(surface.vertices.size());
  for (const auto& [a, b, c] : surface.triangles) {
    joined.join(a, b);
    joined.join(b, c);
  }
  // Seen from a vertex of its own: far from the origin volumes would round away.
  std::vector<ClosedPiece> pieces(surface.vertices.size());
  for (const auto& [a, b, c] : surface.triangles) {
    ClosedPiece& piece = pieces[index(joined.root(a))];
    if (piece.first < 0) piece.first = a;
    const FacetCorners<3> corners{surface.vertices[index(a)], surface.vertices[index(b)],
                                  surface.vertices[index(c)]};
    const Point<3> normal = area_normal(corners);
    const Point<3> way = difference(corners[0], surface.vertices[index(piece.first)]);
    piece.area += length(normal);
    piece.volume += dot(normal, way) / 3;
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const ClosedPiece& piece = pieces[index(joined.root(surface.triangles[t][0]))];
    if (piece.thickness() < least) continue;
    surface.triangles[kept] = surface.triangles[t];
    surface.tags[kept++] = surface.tags[t];
  }
  surface.triangles.resize(kept);
  surface.tags.resize(kept);
  std::int64_t thin = 0;
  std::int32_t first = -1;
  for (const ClosedPiece& piece : pieces)
    if (piece.first >= 0 && piece.thickness() < least && thin++ == 0) first = piece.first;
  if (thin > 0)
    surface.warnings.emplace_back(
        WarningCode::pieces_left_out,
        std::to_string(thin) + (thin == 1 ? " piece" : " pieces") + " of the body, thinner than " +
            rounded_text(least) + " in the mean, " + (thin == 1 ? "is" : "are") +
            " left out, one of them at " + rounded_point_text<3>(surface.vertices[index(first)]) +
            ": a smaller resolution keeps them",
        thin, least);
}

}  // namespace pnpbs
