// SPDX-License-Identifier: BSD-3-Clause
// Constants for nodes that serve as particles. Each node lies at the centre of the matter that it
// represents, an area d^2 or a volume d^3. The outermost nodes lie about d/2 inside the matter,
// which is the domain or layers of a wall around it.
#pragma once

#include <limits>

namespace pnpbs::tool {

// The region between two signed distances from the boundary of the domain, over d, negative inside.
struct Band {
  double from, to;
};

struct CentredNodes {
  double depth;    // of the outermost nodes below the boundary of the matter, over d
  double bubbles;  // spacing of the bubbles over d that gives the required number of nodes

  // Band of the nodes: inside the domain, or in a wall with this number of layers.
  Band inside() const { return {-std::numeric_limits<double>::infinity(), -depth}; }
  Band in_wall(int layers) const { return {depth, depth + layers - 1}; }
  // Band of the wall. The first layer is as far from the inner side of the wall as the last layer
  // is from the outer side.
  Band wall(int layers) const { return {0, layers - 1 + 2 * depth}; }
};

// Returns the measured constants. A triangular lattice with an area d^2 per node has a spacing of
// 1.075 d. Hexagonal and cubic close packing with a volume d^3 per node have a spacing of 1.12 d.
// The values bring the number of nodes within 1 percent in the plane and some 5 percent in space
// (docs/guide/particles.md).
inline CentredNodes centred_nodes(int dimension) {
  return dimension == 2 ? CentredNodes{0.42, 1.076} : CentredNodes{0.46, 1.147};
}

}  // namespace pnpbs::tool
