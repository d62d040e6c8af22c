// SPDX-License-Identifier: BSD-3-Clause
// The depth to which ghosts have stars or must be known.
#pragma once

namespace pnpbs {

struct GhostStarDepth {
  // Number of rings of ghosts around the owned nodes whose stars are found.
  int rings = 0;
  // In space: every node is known whose distance from an owned node is less than the sum of both
  // reaches, in units of d. That includes nodes across a gap of the domain, which no chain of
  // neighbours connects.
  double reach = 0;
};

}  // namespace pnpbs
