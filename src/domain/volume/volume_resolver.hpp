// SPDX-License-Identifier: BSD-3-Clause
// Turns what the user gave for a domain in space into the mesh and features on which nodes are
// placed.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "domain/volume/volume_domain.hpp"
#include "surfaces/solids.hpp"

namespace pnpbs {

// References to what the user gave.
struct GivenVolume {
  const std::vector<SurfaceSource>& surfaces;
  const std::map<std::int32_t, SurfaceRole>& roles;  // see VolumeDomain::set_role
  const std::vector<InnerPolyline>& polylines;
  const std::vector<RegionPoint<3>>& region_points;
  const std::vector<FixedNode<3>>& fixed_nodes;
  bool filled;  // see VolumeDomain::set_filled
  // How surfaces may meet other than in common vertices and edges. They are split there, and what
  // they enclose becomes regions.
  enum class Contacts {
    none,
    touching,  // solids may not overlap, and surfaces may not end elsewhere than on others
    any
  } contacts = Contacts::none;
  OverlapRule overlap = OverlapRule::last;
  double gap = 0;  // surfaces this close to each other become one where they are split
};

// Welds the surfaces, checks and orients them, and finds the inside and the features. Throws
// Error(ErrorKind::domain).
std::unique_ptr<ResolvedVolume> resolve_volume(const GivenVolume& given);

}  // namespace pnpbs
