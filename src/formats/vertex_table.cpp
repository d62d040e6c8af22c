// SPDX-License-Identifier: BSD-3-Clause
#include "formats/vertex_table.hpp"

#include "base/mixed_hash.hpp"

namespace pnpbs {

namespace {

constexpr std::int32_t kFree = -1;

std::uint64_t hash_of(const Point<3>& x) {
  std::uint64_t hash = 0;
  for (const double coordinate : x) hash = mixed_with(hash, coordinate);
  return hash;
}

}  // namespace

// The slot that has the point, or the free one where it belongs.
std::size_t VertexTable::slot_of(const Point<3>& x) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(x) & mask;
  while (slots_[slot] != kFree && points_[static_cast<std::size_t>(slots_[slot])] != x)
    slot = (slot + 1) & mask;
  return slot;
}

void VertexTable::grow() {
  slots_.assign(slots_.empty() ? 64 : 4 * slots_.size(), kFree);
  for (std::size_t i = 0; i < points_.size(); ++i)
    slots_[slot_of(points_[i])] = static_cast<std::int32_t>(i);
}

std::int32_t VertexTable::index_of(Point<3> x) {
  for (double& coordinate : x) coordinate += 0.0;  // -0 is 0
  if (2 * points_.size() >= slots_.size()) grow();
  std::int32_t& slot = slots_[slot_of(x)];
  if (slot == kFree) {
    slot = static_cast<std::int32_t>(points_.size());
    points_.push_back(x);
  }
  return slot;
}

}  // namespace pnpbs
