// SPDX-License-Identifier: BSD-3-Clause
// What is to be told of a level and of a finished run. No warning is returned if there is nothing.
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

// Of a level as it begins: `given` is the user's spacing, `steepest` how it grows. Collective.
// Throws Error where that is given nowhere near the nodes of a sphere.
template <int Dim>
std::vector<Warning> warnings_of_level(const Level<Dim>& level, const Domain<Dim>& domain,
                                       const Spacing<Dim>& given,
                                       const SteepestGrowth<Dim>& steepest, const Options& options);

// Where the nodes do not follow d, by the edges at the end of a run.
std::optional<Warning> warning_of_missed_spacing(const std::vector<EdgeBand>& bands);
// Where a run's tetrahedra do not follow the surfaces.
std::optional<Warning> warning_of_surface_fit(const SurfaceFit& fit, const Options& options);
// Corners and feature edges that the elements do not have. Collective.
std::optional<Warning> warning_of_features_left_out(const Level<2>& level);
std::optional<Warning> warning_of_features_left_out(const Level<3>& level);

}  // namespace pnpbs
