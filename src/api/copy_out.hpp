// SPDX-License-Identifier: BSD-3-Clause
// Arrays that the caller may not want.
#pragma once

#include <algorithm>
#include <vector>

namespace pnpbs::api {

// to may be NULL.
template <class Value>
void copy_out(const std::vector<Value>& from, Value* to) {
  if (to) std::copy(from.begin(), from.end(), to);
}

}  // namespace pnpbs::api
