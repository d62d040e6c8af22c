// SPDX-License-Identifier: BSD-3-Clause
// What the floating-point filters of the predicates share.
#pragma once

namespace pnpbs::predicates {

constexpr double kHalfUlp = 0x1p-53;
// Far above what products lose that fall below the normal range: below it, nothing is decided
// without the exact arithmetic. (Overflow gives inf or NaN, which decide nothing either.)
constexpr double kUnderflowGuard = 0x1p-960;

}  // namespace pnpbs::predicates
