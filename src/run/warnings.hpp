// SPDX-License-Identifier: BSD-3-Clause
// The warnings of a level and of a finished run. No warning is returned if there is no reason for
// one.
#pragma once

#include <optional>
#include <vector>

#include "base/warning.hpp"
#include "level/finish.hpp"
#include "level/level.hpp"
#include "level/volume/surface_fit.hpp"
#include "settings/options.hpp"
#include "spacing/steepest_growth.hpp"

namespace pnpbs {

// Returns the warnings of a new level. `given` is the user's spacing, `steepest` its largest
// growth. Throws Error if the spacing is given nowhere near the nodes of a sphere. All ranks must
// call it, and if one rank throws, all ranks throw.
template <int Dim>
std::vector<Warning> warnings_of_level(const Level<Dim>& level, const Domain<Dim>& domain,
                                       const Spacing<Dim>& given,
                                       const SteepestGrowth<Dim>& steepest, const Options& options);

// Returns a warning if the edges at the end of a run do not follow d.
std::optional<Warning> warning_of_missed_spacing(const std::vector<EdgeBand>& bands);
// Returns a warning if the tetrahedra of a run do not follow the surfaces.
std::optional<Warning> warning_of_surface_fit(const SurfaceFit& fit, const Options& options);
// Returns a warning if elements lack corners or feature edges of the body. Collective.
std::optional<Warning> warning_of_features_left_out(const Level<2>& level);
std::optional<Warning> warning_of_features_left_out(const Level<3>& level);

}  // namespace pnpbs
