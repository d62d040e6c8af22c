// SPDX-License-Identifier: BSD-3-Clause
// The creases of level sets on their way from the surfaces as given to the mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/volume/volume_domain.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Those of all surfaces, whose vertices come one after the other; `joined`: of each vertex the one
// that it is welded to.
std::vector<SurfaceCrease> join_creases(const std::vector<SurfaceSource>& surfaces,
                                        const std::vector<std::int32_t>& joined);

// In the order of their nodes; `node`: of each vertex, or -1.
std::vector<LevelSetCrease> creases_between(const std::vector<SurfaceCrease>& creases,
                                            const std::vector<std::int32_t>& node);

}  // namespace pnpbs
