// SPDX-License-Identifier: BSD-3-Clause
// The region of fine d around undersampled points that nodes have met, such as a layer of which
// they met a few points.
#pragma once

#include <functional>
#include <vector>

#include "domain/spacing_evaluator.hpp"
#include "level/undersampled_points.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// Returns these points with their d, and the points of the domain that are reached from them by
// steps of about d, as long as d stays far below the samples around. If there are too many, the
// nearest ones are returned.
SpacingHints<3> finer_region(const std::vector<UndersampledSpacing::Place>& places,
                             const SpacingEvaluator<3>& spacing,
                             const std::function<bool(const Point<3>&)>& inside);

}  // namespace pnpbs
