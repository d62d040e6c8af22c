// SPDX-License-Identifier: BSD-3-Clause
// The level of x86-64 processors for which this library's kernels are compiled
// (cmake/PnpbsLevels.cmake).
#pragma once

namespace pnpbs {

/// ", x86-64-v3" and the like; empty in the library for all processors.
const char* build_level();

}  // namespace pnpbs
