// SPDX-License-Identifier: BSD-3-Clause
// Places far finer than the tree of a level was made for. It is grown by samples of d, which may
// miss what is fine between them until a node gets there. A leaf made for a few dozen nodes would
// then be filled up with thousands.
#pragma once

#include <vector>

#include "comm/communicator.hpp"
#include "level/level.hpp"

namespace pnpbs {

// That nodes have come upon such places. The same on all ranks.
class UndersampledSpacing : public AgreedError {
 public:
  struct Place {
    double d, sampled;  // there, and the least of the samples in its leaf
    double leaf_side;
    Point<3> x;
  };
  explicit UndersampledSpacing(std::vector<Place> places);

  // The finest of each leaf; of very many, the finest. The finest of all comes first.
  const std::vector<Place>& places() const { return places_; }

 private:
  std::vector<Place> places_;
};

// Throws UndersampledSpacing if there are any at nodes that move. Collective.
void require_sampled_spacing(const Level<3>& level);
// Checks nothing in the plane.
inline void require_sampled_spacing(const Level<2>&) {}

}  // namespace pnpbs
