// SPDX-License-Identifier: BSD-3-Clause
// Allocation of the buffers of an exchange of node values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "comm/communicator.hpp"

namespace pnpbs {

// Returns a buffer for each row of an exchange pattern, with `bytes_of_node` bytes for each node of
// the row.
inline std::vector<Bytes> exchange_buffers(const std::vector<std::int64_t>& offsets,
                                           std::size_t bytes_of_node) {
  std::vector<Bytes> all;
  for (std::size_t k = 0; k + 1 < offsets.size(); ++k)
    all.emplace_back(static_cast<std::size_t>(offsets[k + 1] - offsets[k]) * bytes_of_node);
  return all;
}

}  // namespace pnpbs
