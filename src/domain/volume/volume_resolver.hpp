// SPDX-License-Identifier: BSD-3-Clause
// From what the user gave to what the nodes are laid on, in space.
#pragma once

#include <vector>

#include "domain/volume/volume_domain.hpp"

namespace pnpbs {

// Welds the surfaces, mends and checks them, finds the inside and the features; `filled`: see
// VolumeDomain::set_filled. Throws Error(ErrorKind::domain).
ResolvedVolume resolve_volume(const std::vector<SurfaceSource>& surfaces,
                              const std::vector<double>& feature_angles,
                              const std::vector<InnerPolyline>& polylines,
                              const std::vector<VolumeHole>& holes,
                              const std::vector<FixedNode3>& fixed_nodes, bool filled);

}  // namespace pnpbs
