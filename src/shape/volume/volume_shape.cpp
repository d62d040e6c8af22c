// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/space_vectors.hpp"
#include "shape/shape.hpp"

namespace pnpbs {

namespace {

using SymmetricMatrix = std::array<double, 6>;  // xx, yy, zz, xy, yz, zx

// Returns the largest absolute eigenvalue, by Smith's closed form (Communications of the ACM 4
// (1961) 168).
double largest_eigenvalue(const SymmetricMatrix& m) {
  const auto [xx, yy, zz, xy, yz, zx] = m;
  const double off = xy * xy + yz * yz + zx * zx, mean = (xx + yy + zz) / 3;
  const double a = xx - mean, b = yy - mean, c = zz - mean;
  const double p = std::sqrt((a * a + b * b + c * c + 2 * off) / 6);
  if (p == 0) return std::fabs(mean);
  const double determinant =
      a * (b * c - yz * yz) - xy * (xy * c - yz * zx) + zx * (xy * yz - b * zx);
  const double angle = std::acos(std::clamp(determinant / (2 * p * p * p), -1.0, 1.0)) / 3;
  const double high = mean + 2 * p * std::cos(angle),
               low = mean + 2 * p * std::cos(angle + 2 * std::numbers::pi / 3);
  return std::max(std::fabs(high), std::fabs(low));
}

// The curvature tensor of an area: the sum over its edges of the angle between normals times the
// length, in the direction of the edge (Cohen-Steiner and Morvan, Symposium on Computational
// Geometry 2003). Each facet has half of its edges' contributions.
struct Bending {
  SymmetricMatrix turn{};
  double area = 0;

  void add_edge(double turned, const Point<3>& edge) {
    const auto [x, y, z] = edge;
    const double whole = length(edge);
    if (whole == 0) return;
    const SymmetricMatrix part{x * x, y * y, z * z, x * y, y * z, z * x};
    for (std::size_t k = 0; k < 6; ++k) turn[k] += 0.5 * turned * part[k] / whole;
  }
  void add(const Bending& other) {
    for (std::size_t k = 0; k < 6; ++k) turn[k] += other.turn[k];
    area += other.area;
  }
  double radius() const {
    const double whole = largest_eigenvalue(turn);
    return whole > 0 ? area / whole : ShapePiece<3>::kNone;
  }
};

class VolumeShape {
 public:
  explicit VolumeShape(const VolumeDomain& domain) : domain_(domain), mesh_(domain.mesh()) {}

  Shape<3> run() {
    for (const BoundaryTriangle& facet : mesh_.facets)
      shape_.push_back({corners_of(mesh_, facet), facet.nodes, facet.tag, facet.front_inside,
                        facet.back_inside});
    find_edges();
    bend_surfaces();
    bend_curves();
    return std::move(shape_);
  }

 private:
  const Point<3>& position(std::int32_t node) const {
    return mesh_.nodes[static_cast<std::size_t>(node)].position;
  }

  void find_edges() {
    for (std::size_t f = 0; f < shape_.size(); ++f) {
      ShapePiece<3>& piece = shape_[f];
      const auto& [a, b, c] = piece.corners;
      const double around = distance<3>(a, b) + distance<3>(b, c) + distance<3>(c, a);
      if (piece.is_facet()) {
        if (!domain_.approximates(f)) piece.edge = around / 3;
      } else if (around > 0) {
        piece.edge = around / 2;
      }
    }
  }

  Bending bending_of(std::size_t f) const {
    const BoundaryTriangle& facet = mesh_.facets[f];
    const auto& [a, b, c] = shape_[f].corners;
    const Point<3> normal = facet_normal(mesh_, facet);
    Bending bending;
    bending.area = 0.5 * length(cross(difference(b, a), difference(c, a)));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t other = domain_.features().across[f][k];
      if (other < 0) continue;
      const Point<3> edge = difference(shape_[f].corners[(k + 1) % 3], shape_[f].corners[k]);
      const Point<3> beyond = facet_normal(mesh_, mesh_.facets[static_cast<std::size_t>(other)]);
      if (beyond == Point<3>{}) continue;
      const Point<3> turn = cross(normal, beyond);
      const double angle = std::atan2(length(turn), dot(normal, beyond));
      bending.add_edge(dot(turn, edge) < 0 ? -angle : angle, edge);
    }
    return bending;
  }

  void bend_surfaces() {
    std::vector<Bending> bending(shape_.size());
    for (std::size_t f = 0; f < shape_.size(); ++f)
      if (shape_[f].is_facet()) bending[f] = bending_of(f);
    for (std::size_t f = 0; f < shape_.size(); ++f) {
      if (!shape_[f].is_facet()) continue;
      Bending around = bending[f];
      for (const std::int32_t other : domain_.features().across[f])
        if (other >= 0) around.add(bending[static_cast<std::size_t>(other)]);
      shape_[f].radius = around.radius();
    }
  }

  // Sets the radii of curve pieces from the circle through neighbouring nodes, as in the plane.
  void bend_curves() {
    std::map<std::int32_t, std::vector<std::size_t>> at;  // curve pieces at each node
    for (std::size_t f = 0; f < shape_.size(); ++f)
      if (!shape_[f].is_facet() && shape_[f].ends[0] != shape_[f].ends[1])
        for (const std::size_t end : {0, 1}) at[shape_[f].ends[end]].push_back(f);
    for (const auto& [node, pieces] : at) {
      if (pieces.size() != 2) continue;
      std::array<Point<3>, 2> way;
      for (const std::size_t k : {0, 1}) {
        const ShapePiece<3>& piece = shape_[pieces[k]];
        way[k] = difference(position(piece.ends[piece.ends[0] == node ? 1 : 0]), position(node));
      }
      const double turn = std::atan2(length(cross(way[0], way[1])), -dot(way[0], way[1]));
      if (turn == 0 || turn >= kFeatureAngle * std::numbers::pi / 180) continue;
      const double radius = length(difference(way[0], way[1])) / (2 * std::sin(turn));
      for (const std::size_t f : pieces) shape_[f].radius = std::min(shape_[f].radius, radius);
    }
  }

  const VolumeDomain& domain_;
  const BoundaryMesh<3>& mesh_;
  Shape<3> shape_;
};

}  // namespace

Shape<3> shape_of(const VolumeDomain& domain) { return VolumeShape(domain).run(); }

}  // namespace pnpbs
