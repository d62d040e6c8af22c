// SPDX-License-Identifier: BSD-3-Clause
// What is fine around places that nodes have come upon: a layer, say, of which they met a few.
#pragma once

#include <functional>
#include <vector>

#include "domain/spacing_evaluator.hpp"
#include "level/undersampled_points.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// The places, with d as the spacing has it, and those inside the domain that are reached from them
// by steps of about d in all directions for as long as it stays far finer than what was sampled
// around. Where these are very many, those nearest to the places.
SpacingHints<3> finer_region(const std::vector<UndersampledSpacing::Place>& places,
                             const SpacingEvaluator<3>& spacing,
                             const std::function<bool(const Point<3>&)>& inside);

}  // namespace pnpbs
