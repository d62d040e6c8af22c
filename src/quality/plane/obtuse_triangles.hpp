// SPDX-License-Identifier: BSD-3-Clause
// The criterion for obtuse triangles. Their circumcentres, which are vertices of Voronoi cells, lie
// beyond their longest edges, where finite volumes cannot use them.
#pragma once

#include "quality/plane/bad_triangles.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

// Returns the criterion by which BadTriangleRepair finds and improves obtuse triangles. On a sphere
// it uses the angles in space.
TriangleMeasure measure_of_obtuse_triangles(const Embedding<2>& embedding);

}  // namespace pnpbs
