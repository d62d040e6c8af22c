// SPDX-License-Identifier: BSD-3-Clause
#include "shape/sharp_edges.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "base/space_vectors.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

class SharpEdgeFinder {
 public:
  explicit SharpEdgeFinder(const BoundaryMesh<3>& mesh) : mesh_(mesh) {}

  std::vector<FacetCorners<3>> find(const Features& features) const {
    std::vector<FacetCorners<3>> sharp;
    for (const FeatureCurve& curve : features.curves)
      for (std::size_t e = 0; e < curve.edge_count(); ++e) {
        const std::int32_t p = curve.nodes[e], q = curve.nodes[e + 1];
        if (is_sharp(p, q, curve.facets[e])) sharp.push_back({at(p), at(q), at(q)});
      }
    return sharp;
  }

 private:
  const Point<3>& at(std::int32_t node) const {
    return mesh_.nodes[static_cast<std::size_t>(node)].position;
  }
  const BoundaryTriangle& facet(std::int32_t f) const {
    return mesh_.facets[static_cast<std::size_t>(f)];
  }

  bool is_sharp(std::int32_t p, std::int32_t q, const std::vector<std::int32_t>& facets) const {
    for (std::size_t f = 0; f < facets.size(); ++f)
      for (std::size_t g = f + 1; g < facets.size(); ++g)
        if (encloses_sharply(p, q, facet(facets[f]), facet(facets[g]))) return true;
    return false;
  }

  // Returns true if the two triangles enclose less than kSharpEdge degrees of the body at their
  // edge.
  bool encloses_sharply(std::int32_t p, std::int32_t q, const BoundaryTriangle& f,
                        const BoundaryTriangle& g) const {
    static const double kCosine = std::cos(method::kSharpEdge * std::numbers::pi / 180);
    const Point<3> along = unit_vector(difference(at(q), at(p)));
    const Point<3> to_f = across(f, p, q, along), to_g = across(g, p, q, along);
    return dot(to_f, to_g) > kCosine && inside_towards(f, to_g) && inside_towards(g, to_f);
  }

  // Returns the unit vector perpendicular to edge pq that points into the triangle.
  Point<3> across(const BoundaryTriangle& f, std::int32_t p, std::int32_t q,
                  const Point<3>& along) const {
    for (const std::int32_t node : f.nodes)
      if (node != p && node != q)
        return unit_vector(part_across(difference(at(node), at(p)), along));
    return {};
  }

  bool inside_towards(const BoundaryTriangle& f, const Point<3>& way) const {
    return dot(facet_normal(mesh_, f), way) > 0 ? f.front_inside : f.back_inside;
  }

  const BoundaryMesh<3>& mesh_;
};

}  // namespace

SharpEdges::SharpEdges(const BoundaryMesh<3>& mesh, const Features& features)
    : edges_(SharpEdgeFinder(mesh).find(features)) {}

}  // namespace pnpbs
