// SPDX-License-Identifier: BSD-3-Clause
// Name of the x86-64 level that the kernels of this library are compiled for
// (cmake/PnpbsLevels.cmake).
#pragma once

namespace pnpbs {

// Returns a suffix for the version text, such as ", x86-64-v3". It is empty in the library for all
// processors.
const char* build_level();

}  // namespace pnpbs
