// SPDX-License-Identifier: BSD-3-Clause
// Quality of the tetrahedra of a node set in space, from any mesher.
#pragma once

#include "edges_over_d.hpp"
#include "evaluate_volume.hpp"

namespace pnpbs_bench {

struct ShapeOfTetrahedron {
  double quality = 0;  // 3 r_in / R
  double angle = 0;    // the smallest dihedral angle, in degrees
};
ShapeOfTetrahedron shape_of(const std::array<Place, 4>& corners);

struct TetrahedronMeasures {
  std::int64_t tetrahedra = 0;
  double quality_mean = 0;
  double quality_one_percent = 0;  // 99 % of the tetrahedra are above
  double quality_min = 0;
  double angle_min = 180;  // dihedral, degrees
  Place angle_min_at{};    // centre of that tetrahedron
  std::int64_t below_20 = 0, below_10 = 0;
};

// Measures of the triangles of the boundary: quality is 2 r_in / R, angles are in degrees.
struct SurfaceMeasures {
  std::int64_t triangles = 0;
  double quality_mean = 0;
  double angle_mean = 0;  // of the smallest angles of triangles
  double angle_min = 180;
};

struct VolumeVerdict {
  TetrahedronMeasures all;
  TetrahedronMeasures inside;       // those without a corner on the boundary
  TetrahedronMeasures at_boundary;  // the others
  EdgeBand edges;                   // all edges; then by the number of ends on the boundary:
  EdgeBand inner_edges, edges_at_boundary, boundary_edges;  // none, one, two
  std::vector<EdgeBand> octaves;                            // of those with an end inside
  // Smallest and largest mean of these around a node and its neighbours.
  double min_place = 0, max_place = 0;
  Place min_at{}, max_at{};
  SurfaceMeasures surface;
  double volume = 0;
};

VolumeVerdict evaluate(const std::vector<Place>& x, const std::vector<double>& d,
                       const std::vector<char>& on_boundary, const BodyMesh& mesh);

}  // namespace pnpbs_bench
