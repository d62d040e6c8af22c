// SPDX-License-Identifier: BSD-3-Clause
#include "check/boundary_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/space_vectors.hpp"
#include "comm/records.hpp"
#include "geometry/volume/nearest_triangles.hpp"
#include "geometry/volume/triangles.hpp"

namespace pnpbs {

namespace {

// A boundary face of the tetrahedra.
struct Face {
  FacetCorners<3> corners;
  double d;  // smallest spacing at its corners
  // Bit k is set if this face samples the side from corner k to the next one. Each side has two
  // faces, and one of them samples it.
  std::int32_t sides;
};

std::vector<Face> own_faces(const Results<3>& results) {
  const Nodes<3>& nodes = results.level().nodes;
  std::vector<Face> faces;
  results.for_open_facets([&](const std::array<std::int64_t, 3>& places) {
    Face face{{}, std::numeric_limits<double>::infinity(), 0};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t i = results.node_at(places[k]);
      face.corners[k] = nodes.position(i);
      face.d = std::min(face.d, nodes.d(i));
      if (nodes.id(i) < nodes.id(results.node_at(places[(k + 1) % 3]))) face.sides |= 1 << k;
    }
    faces.push_back(face);
  });
  return faces;
}

double farthest_face(const std::vector<Face>& faces, const SurfaceIndex& surfaces) {
  double farthest = 0;
  const auto measure = [&](const Face& face, const Point<3>& x) {
    farthest =
        std::max(farthest, surfaces.clearance(x, std::numeric_limits<double>::infinity()) / face.d);
  };
  for (const Face& face : faces) {
    measure(face, centroid(face.corners));
    for (std::size_t k = 0; k < 3; ++k)
      if ((face.sides >> k & 1) != 0)
        measure(face, halfway(face.corners[k], face.corners[(k + 1) % 3]));
  }
  return farthest;
}

// Distances of surface triangles from the faces. A triangle is bisected until its edges are at most
// d long.
class SurfacePieces {
 public:
  explicit SurfacePieces(const std::vector<Face>& faces) : faces_(faces), tree_(corners(faces)) {}

  // Returns the largest distance over d between the piece and the faces.
  double farthest(const FacetCorners<3>& piece) const {
    constexpr double kLongest = 1;  // longest edge of a piece, in d
    const Point<3> middle = centroid(piece);
    const NearestTriangles::Nearest nearest = tree_.nearest(middle);
    const double d = faces_[static_cast<std::size_t>(nearest.triangle)].d;
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (side(piece, k) > side(piece, longest)) longest = k;
    if (side(piece, longest) <= kLongest * d) return std::sqrt(nearest.square) / d;
    const std::size_t next = (longest + 1) % 3;
    FacetCorners<3> first = piece, second = piece;
    first[next] = second[longest] = halfway(piece[longest], piece[next]);
    return std::max(farthest(first), farthest(second));
  }

 private:
  static double side(const FacetCorners<3>& piece, std::size_t k) {
    return distance<3>(piece[k], piece[(k + 1) % 3]);
  }
  static std::vector<FacetCorners<3>> corners(const std::vector<Face>& faces) {
    std::vector<FacetCorners<3>> all;
    for (const Face& face : faces) all.push_back(face.corners);
    return all;
  }

  const std::vector<Face>& faces_;
  NearestTriangles tree_;
};

// Returns the largest distance over d of this rank's share of the surface triangles from the faces.
double farthest_surface(const Level<3>& level, const std::vector<Face>& faces) {
  const SurfacePieces pieces(faces);
  const Surface& surface = level.geometry.surface();
  double farthest = 0;
  for (std::int32_t f = level.comm->rank();
       f < static_cast<std::int32_t>(level.geometry.boundary().facets.size());
       f += level.comm->size())
    if (surface.patch(f) >= 0 && level.geometry.bounds_domain(f))
      farthest = std::max(farthest, pieces.farthest(surface.corners(f)));
  return farthest;
}

}  // namespace

BoundaryDistance boundary_distance(const Results<2>&) { return {}; }

BoundaryDistance boundary_distance(const Results<3>& results) {
  const Communicator& comm = results.communicator();
  if (results.kind() != GeometryKind::body) return {};
  BoundaryDistance distance;
  std::vector<Face> own;
  collective_try(comm, [&] {
    own = own_faces(results);
    distance.of_faces = farthest_face(own, results.level().geometry.domain().index());
  });
  const std::vector<Face> all = of_all_ranks(comm, own);
  if (all.empty()) return {};
  collective_try(comm, [&] { distance.of_surfaces = farthest_surface(results.level(), all); });
  return {comm.allreduce_max(distance.of_faces), comm.allreduce_max(distance.of_surfaces)};
}

}  // namespace pnpbs
