// SPDX-License-Identifier: BSD-3-Clause
// Constants of the floating-point filters in the predicates.
#pragma once

namespace pnpbs::predicates {

constexpr double kHalfUlp = 0x1p-53;
// Bound of the magnitudes below which a filter does not decide. It is far above the loss of
// products that fall below the normal range. Overflow results in inf or NaN, for which a filter
// does not decide either.
constexpr double kUnderflowGuard = 0x1p-960;

}  // namespace pnpbs::predicates
