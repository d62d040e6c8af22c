// SPDX-License-Identifier: BSD-3-Clause
// Obtuse triangles: their circumcentres, corners of Voronoi cells, lie beyond their longest edges,
// where finite volumes cannot use them.
#pragma once

#include "quality/plane/bad_triangles.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

// Measures triangles for their repair: on a sphere by the angles in space.
TriangleMeasure measure_of_obtuse_triangles(const Embedding<2>& embedding);

}  // namespace pnpbs
