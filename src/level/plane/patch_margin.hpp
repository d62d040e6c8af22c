// SPDX-License-Identifier: BSD-3-Clause
// The margin of the patch that closes a whole sphere, whose nodes may move.
#pragma once

namespace pnpbs {

// The state of the nodes in the margin (see closed_sphere.hpp).
enum class PatchMargin {
  laid,  // fixed at their positions in the patch
  free,  // they move in the finish
  held   // fixed at their positions after the last finish
};

}  // namespace pnpbs
