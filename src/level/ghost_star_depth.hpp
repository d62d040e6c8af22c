// SPDX-License-Identifier: BSD-3-Clause
// What is known and found around the owned nodes besides their own stars.
#pragma once

namespace pnpbs {

struct GhostStarDepth {
  // The stars of ghosts so many neighbours away, by the stars.
  int rings = 0;
  // In space: all nodes that are nearer to an owned one than the sum of both nodes' reaches, in
  // units of d, are known, however many neighbours lie between (across a gap of the domain none
  // do).
  double reach = 0;
};

}  // namespace pnpbs
