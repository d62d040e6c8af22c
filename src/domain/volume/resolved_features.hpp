// SPDX-License-Identifier: BSD-3-Clause
// The features of a domain whose surfaces have been resolved, and what is told of them.
#pragma once

#include <vector>

#include "domain/volume/volume_resolver.hpp"

namespace pnpbs {

// The smallest feature angle of the surfaces holds for all of them.
void find_features_of(const std::vector<SurfaceSource>& surfaces, ResolvedVolume& resolved);

}  // namespace pnpbs
