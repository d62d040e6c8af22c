// SPDX-License-Identifier: BSD-3-Clause
// Undersampled points: nodes at which d is far finer than the samples that the tree was grown with.
// Samples may miss a fine region until a node gets there. A leaf made for a few dozen nodes would
// then be filled with thousands.
#pragma once

#include <vector>

#include "comm/communicator.hpp"
#include "level/level.hpp"

namespace pnpbs {

// The error that nodes have met undersampled points. It is the same on all ranks.
class UndersampledSpacing : public AgreedError {
 public:
  struct Place {
    double d, sampled;  // d at the point, and the smallest sample in its leaf
    double leaf_side;
    Point<3> x;
  };
  explicit UndersampledSpacing(std::vector<Place> places);

  // Returns the finest point of each leaf, the finest of all first. Their number is limited, and
  // the finest ones are returned.
  const std::vector<Place>& places() const { return places_; }

 private:
  std::vector<Place> places_;
};

// Throws UndersampledSpacing on all ranks if a node that moves is an undersampled point.
// Collective.
void require_sampled_spacing(const Level<3>& level);
// Does nothing in the plane.
inline void require_sampled_spacing(const Level<2>&) {}

}  // namespace pnpbs
