// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/surface_sides.hpp"

#include <algorithm>
#include <cmath>

#include "base/space_vectors.hpp"
#include "geometry/volume/triangle_contacts.hpp"
#include "surfaces/surface_checks.hpp"

namespace pnpbs {

namespace {

const Point<3> kUnknown{};

// Largest deviation of a winding number from 0 or 1 that counts as that value. Winding numbers have
// errors of 0.01 and deviate near holes.
constexpr double kWhole = 0.03;

// Returns 1 if the front of the triangle is outside and its back inside, -1 in the opposite case,
// else 0. Evaluates near the centroid and near the corners, because a hole affects only parts of a
// large triangle.
int front_is_outside(const FacetCorners<3>& triangle, const WindingNumber& winding) {
  // Distance of the evaluated points from the corners [distance to the centroid] and from the
  // triangle [square root of its area].
  constexpr double kInward = 0.05, kOff = 1e-4;
  const Point<3> area = area_normal(triangle), middle = centroid(triangle);
  if (!(length(area) > 0)) return 0;
  const Point<3> off = shifted({}, kOff / std::sqrt(length(area)), area);
  const auto inside = [&](const Point<3>& x) {  // -1: uncertain
    const double w = std::fabs(winding(x));
    return w < kWhole ? 0 : std::fabs(w - 1) < kWhole ? 1 : -1;
  };
  int front = -1, back = -1;
  for (const Point<3>& corner : {middle, triangle[0], triangle[1], triangle[2]}) {
    const Point<3> x = shifted(corner, kInward, difference(middle, corner));
    const int f = inside(shifted(x, 1, off)), b = inside(shifted(x, -1, off));
    if (f < 0 || b < 0 || f == b || (front >= 0 && (f != front || b != back))) return 0;
    front = f;
    back = b;
  }
  return back - front;
}

double angle_at(const FacetCorners<3>& triangle, std::size_t k) {
  const Point<3> a = difference(triangle[(k + 1) % 3], triangle[k]),
                 b = difference(triangle[(k + 2) % 3], triangle[k]);
  return std::atan2(length(cross(a, b)), dot(a, b));
}

}  // namespace

SurfaceSides::SurfaceSides(const Triangulation& surface, const SurfaceEdges& edges,
                           const WindingNumber& winding)
    : face_(surface.triangles.size()),
      edge_(surface.triangles.size()),
      corner_(surface.triangles.size()) {
  find_faces(surface, winding);
  leave_out_crossing(surface);
  find_edges(edges);
  find_corners(surface);
}

void SurfaceSides::find_faces(const Triangulation& surface, const WindingNumber& winding) {
  for (std::size_t t = 0; t < face_.size(); ++t) {
    const FacetCorners<3> triangle = surface.corners(static_cast<std::int32_t>(t));
    face_[t] = shifted({}, front_is_outside(triangle, winding), unit_vector(area_normal(triangle)));
  }
}

void SurfaceSides::leave_out_crossing(const Triangulation& surface) {
  const BoxTree<3> tree = tree_of(surface);
  for (std::size_t t = 0; t < face_.size(); ++t) {
    const auto number = static_cast<std::int32_t>(t);
    tree.for_meeting(surface.box(number), [&](std::int32_t other) {
      const auto o = static_cast<std::size_t>(other);
      if (other <= number || (face_[t] == kUnknown && face_[o] == kUnknown)) return;
      if (triangles_meet(surface.corners(number), surface.triangles[t].vertices,
                         surface.corners(other), surface.triangles[o].vertices))
        face_[t] = face_[o] = kUnknown;
    });
  }
}

void SurfaceSides::find_edges(const SurfaceEdges& edges) {
  for (std::size_t e = 0; e < edges.count(); ++e) {
    const auto sides = edges.sides(e);
    Point<3> sum{};
    bool known = sides.size() == 2;
    for (const EdgeSide& side : sides) {
      const Point<3>& normal = face_[static_cast<std::size_t>(side.triangle)];
      known = known && normal != kUnknown;
      sum = shifted(sum, 1, normal);
    }
    for (const EdgeSide& side : sides)
      edge_[static_cast<std::size_t>(side.triangle)][static_cast<std::size_t>(side.k)] =
          known ? sum : kUnknown;
  }
}

// Sets the normals of corners whose triangles form closed fans. If several fans touch in a vertex,
// the sum of all is correct: for a point nearest to the vertex all fans give the same side.
void SurfaceSides::find_corners(const Triangulation& surface) {
  struct Around {
    Point<3> sum{};
    bool known = true;
  };
  std::vector<Around> around(surface.vertices.size());
  const auto for_corners = [&](const auto& visit) {
    for (std::size_t t = 0; t < face_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        visit(t, k, around[static_cast<std::size_t>(surface.triangles[t].vertices[k])]);
  };
  for_corners([&](std::size_t t, std::size_t k, Around& vertex) {
    vertex.known = vertex.known && edge_[t][k] != kUnknown && edge_[t][(k + 2) % 3] != kUnknown;
    vertex.sum =
        shifted(vertex.sum, angle_at(surface.corners(static_cast<std::int32_t>(t)), k), face_[t]);
  });
  for_corners([&](std::size_t t, std::size_t k, const Around& vertex) {
    corner_[t][k] = vertex.known ? vertex.sum : kUnknown;
  });
}

int SurfaceSides::side(std::int32_t triangle, const TrianglePoint& nearest,
                       const Point<3>& x) const {
  constexpr double kRounding = 1e-12;
  const auto t = static_cast<std::size_t>(triangle);
  const auto [v, w] = nearest.along;
  // Whether the barycentric coordinate of each corner is 0 at the nearest point.
  const std::array<bool, 3> without{v + w >= 1 - kRounding, v <= 0, w <= 0};
  Point<3> normal = face_[t];
  for (std::size_t k = 0; k < 3; ++k) {
    if (without[(k + 1) % 3] && without[(k + 2) % 3]) normal = corner_[t][k];
    if (without[k] && !without[(k + 1) % 3] && !without[(k + 2) % 3])
      normal = edge_[t][(k + 1) % 3];
  }
  const double out = dot(normal, difference(x, nearest.x));
  return out > 0 ? 1 : out < 0 ? -1 : 0;
}

}  // namespace pnpbs
