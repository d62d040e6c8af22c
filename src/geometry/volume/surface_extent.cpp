// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/volume/surface_extent.hpp"

#include "base/limits.hpp"
#include "base/space_vectors.hpp"
#include "predicates/expansion.hpp"

namespace pnpbs {

namespace {

class Sum {
 public:
  void add(double term) {
    const TwoTerms next = two_sum(sum_.high, term);
    sum_ = {next.high, sum_.low + next.low};
  }
  double value() const { return sum_.high + sum_.low; }

 private:
  TwoTerms sum_{0, 0};
};

}  // namespace

VolumeExtent extent_of(const BoundaryMesh<3>& mesh) {
  Box<3> box = empty_box<3>();
  for (const BoundaryNode<3>& node : mesh.nodes) include(box, node.position);
  const Point<3>& origin = box.low;
  Sum volume, area;
  for (const BoundaryTriangle& facet : mesh.facets) {
    if (facet.front_inside && facet.back_inside) continue;
    const auto& [a, b, c] = corners_of(mesh, facet);
    const Point<3> normal = cross(difference(b, a), difference(c, a));
    const double sign = int{facet.back_inside} - int{facet.front_inside};
    volume.add(sign * dot(difference(a, origin), normal));
    area.add(length(normal));
  }
  return {box, volume.value() / 6, area.value() / 2};
}

}  // namespace pnpbs
