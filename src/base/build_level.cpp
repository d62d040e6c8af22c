// SPDX-License-Identifier: BSD-3-Clause
#include "base/build_level.hpp"

// The build defines this macro for libraries whose kernels need a higher level.
#ifndef PNPBS_BUILD_LEVEL
#define PNPBS_BUILD_LEVEL ""
#endif

namespace pnpbs {

const char* build_level() { return PNPBS_BUILD_LEVEL; }

}  // namespace pnpbs
