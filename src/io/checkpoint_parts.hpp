// SPDX-License-Identifier: BSD-3-Clause
// What writing and reading checkpoints have in common.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/records.hpp"
#include "io/checkpoint_layout.hpp"
#include "placement/placement_of.hpp"

namespace pnpbs::io {

template <int Dim>
void write_checkpoint_of(PlacementOf<Dim>& placement, const std::string& path);
template <int Dim>
void read_checkpoint_of(PlacementOf<Dim>& placement, const std::string& path);

// For messages.
inline std::string quoted_checkpoint(const std::string& path) {
  return "checkpoint '" + path + "'";
}

// Makes rank 0's numbers everyone's. Collective.
template <class Number>
void share(const Communicator& comm, std::vector<Number>& numbers) {
  Bytes bytes;
  for (const Number number : numbers) pack(bytes, number);
  comm.broadcast(bytes, 0);
  numbers.clear();
  for_records<Number>({bytes}, [&](Number number) { numbers.push_back(number); });
}

// Rows of a file in pieces: visit(first row, rows) of `rows`, of that many bytes each.
template <class Visit>
void in_pieces(std::int64_t rows, std::int64_t row_size, const Visit& visit) {
  constexpr std::int64_t kPiece = 1 << 20;  // bytes written or read at a time
  const std::int64_t most = std::max<std::int64_t>(1, kPiece / row_size);
  for (std::int64_t first = 0; first < rows; first += most)
    visit(first, std::min(most, rows - first));
}

}  // namespace pnpbs::io
