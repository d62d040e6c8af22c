// SPDX-License-Identifier: BSD-3-Clause
// The outcomes of the calls of a placement.
#pragma once

namespace pnpbs {

// The outcome of a call that moves nodes. The values are those of pnpbs_status.
//   spacing_missed: the nodes do not follow d somewhere, whether or not the bubbles rest.
//   not_conforming: the elements do not fill the domain; this outcome has precedence.
enum class [[nodiscard]] Outcome{converged, not_converged, stopped, spacing_missed, not_conforming};

}  // namespace pnpbs
