// SPDX-License-Identifier: BSD-3-Clause
#include "base/build_level.hpp"

// Kernels for a higher level are compiled with a text of their own.
#ifndef PNPBS_BUILD_LEVEL
#define PNPBS_BUILD_LEVEL ""
#endif

namespace pnpbs {

const char* build_level() { return PNPBS_BUILD_LEVEL; }

}  // namespace pnpbs
