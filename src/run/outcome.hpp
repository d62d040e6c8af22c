// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pnpbs {

// How a call that moves nodes has ended, with the numbers of pnpbs_status.
// spacing_missed: somewhere the nodes do not follow d, whether the bubbles rest or not.
// not_conforming: the elements do not fill the domain, whatever else is true.
enum class [[nodiscard]] Outcome{converged, not_converged, stopped, spacing_missed, not_conforming};

}  // namespace pnpbs
