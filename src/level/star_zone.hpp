// SPDX-License-Identifier: BSD-3-Clause
// The ghosts whose stars are found besides those of the owned nodes.
#pragma once

namespace pnpbs {

struct StarZone {
  // So many neighbours away from the owned nodes, by the stars.
  int rings = 0;
  // In space, besides: those within the sum of both nodes' reaches from an owned one, however many
  // neighbours lie between (across a gap of the domain none do), and the neighbours of these. In
  // units of d.
  double reach = 0;
};

}  // namespace pnpbs
