// SPDX-License-Identifier: BSD-3-Clause
// Where the elements of a run do not fill the domain, two sheets of its surface are mostly nearer
// to each other than d, or it goes around a bar or through a hole that is narrower than d.
#pragma once

#include <vector>

#include "level/level.hpp"
#include "spacing/growth_source.hpp"

namespace pnpbs {

// Where that is so within d of the places given, whose d that is, or anywhere if there are none:
// with d as it would have to be. Empty in the plane, where boundary nodes keep to their curves.
// Throws Error(ErrorKind::spacing) if there were more of them than nodes are allowed. The same on
// all ranks. Collective.
std::vector<GrowthSource<2>> narrow_places(const Level<2>& level,
                                           const std::vector<GrowthSource<2>>& near);
std::vector<GrowthSource<3>> narrow_places(const Level<3>& level,
                                           const std::vector<GrowthSource<3>>& near);

}  // namespace pnpbs
