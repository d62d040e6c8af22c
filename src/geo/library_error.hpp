// SPDX-License-Identifier: BSD-3-Clause
// Error messages of libpnpbs with the points that they name.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "pnpbs/pnpbs.h"

namespace pnpbs::geo {

// Returns the last error message of the context, or of this thread if `context` is null.
inline MessageText last_message(pnpbs_context context) {
  std::int32_t count = 0;
  pnpbs_last_error_data(context, nullptr, &count);
  std::vector<NamedPoint> points(static_cast<std::size_t>(count));
  for (std::int32_t k = 0; k < count; ++k) {
    NamedPoint& point = points[static_cast<std::size_t>(k)];
    std::int64_t begin = 0, end = 0;
    pnpbs_last_error_point(context, k, point.x.data(), &begin, &end);
    point.dimension = std::isnan(point.x[2]) ? 2 : 3;
    point.begin = static_cast<std::size_t>(begin);
    point.end = static_cast<std::size_t>(end);
  }
  return {pnpbs_last_error(context), std::move(points)};
}

// Returns whether the last error of libpnpbs on this thread is that curves cross or overlap.
inline bool last_error_is_crossing() {
  std::int32_t reason = PNPBS_REASON_OTHER;
  return pnpbs_last_error_data(nullptr, &reason, nullptr) >= 0 && reason == PNPBS_REASON_CROSSING;
}

}  // namespace pnpbs::geo
