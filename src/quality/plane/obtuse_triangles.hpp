// SPDX-License-Identifier: BSD-3-Clause
// Obtuse triangles: their circumcentres, corners of Voronoi cells, lie beyond their longest edges,
// where finite volumes cannot use them.
#pragma once

#include "quality/plane/bad_triangles.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

// By which they are repaired. In the chart of a sphere by the angles in space.
TriangleMeasure measure_of_obtuse_triangles(const StereographicChart* chart);

}  // namespace pnpbs
