// SPDX-License-Identifier: BSD-3-Clause
// Output of arrays that the caller may omit.
#pragma once

#include <algorithm>
#include <vector>

namespace pnpbs::api {

// Copies the vector to the array `to`, unless it is NULL.
template <class Value>
void copy_out(const std::vector<Value>& from, Value* to) {
  if (to) std::copy(from.begin(), from.end(), to);
}

}  // namespace pnpbs::api
