// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pnpbs {

// The nodes in the margin of the patch that closes a whole sphere (closed_sphere.hpp).
enum class PatchMargin {
  laid,  // fixed where the patch has them
  free,  // they move in the finish, as others do
  held   // fixed where the last finish left them
};

}  // namespace pnpbs
