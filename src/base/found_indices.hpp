// SPDX-License-Identifier: BSD-3-Clause
// Parallel search for the few indices that have a property.
#pragma once

#include <cstdint>
#include <vector>

#include "base/execution.hpp"

namespace pnpbs {

// Returns all i in 0 <= i < n for which holds(i) is true, in ascending order. `holds` is called on
// all threads.
template <class Holds>
std::vector<std::int64_t> indices_where(const char* label, std::int64_t n, const Holds& holds) {
  const View<char> marked = make_view<char>(label, n);
  for_each(label, n, [&](std::int64_t i) { marked(i) = holds(i) ? 1 : 0; });
  std::vector<std::int64_t> found;
  for (std::int64_t i = 0; i < n; ++i)
    if (marked(i) != 0) found.push_back(i);
  return found;
}

}  // namespace pnpbs
