// SPDX-License-Identifier: BSD-3-Clause
#include "cgrid/star_rings.hpp"

#include <algorithm>
#include <utility>

#include "base/execution.hpp"

namespace pnpbs {

namespace {

// Returns the two other corners of a triangle, in counter-clockwise order after the node.
std::pair<std::int32_t, std::int32_t> others(const StarRings::Triangle& triangle,
                                             std::int32_t node) {
  const std::size_t k = node == triangle[0] ? 0 : node == triangle[1] ? 1 : 2;
  return {triangle[(k + 1) % 3], triangle[(k + 2) % 3]};
}

}  // namespace

StarRings::StarRings(const std::vector<Triangle>& triangles, const std::vector<std::int64_t>& ids)
    : offsets_(ids.size() + 1, 0), closed_(ids.size(), 0) {
  for (const Triangle& triangle : triangles)
    for (const std::int32_t node : triangle) ++offsets_[static_cast<std::size_t>(node) + 1];
  for (std::size_t i = 1; i < offsets_.size(); ++i) offsets_[i] += offsets_[i - 1];
  neighbours_.resize(static_cast<std::size_t>(places()));
  triangles_.resize(static_cast<std::size_t>(places()));
  std::vector<std::int64_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::int32_t node : triangles[t])
      triangles_[static_cast<std::size_t>(next[static_cast<std::size_t>(node)]++)] =
          static_cast<std::int32_t>(t);
  for_each("pnpbs::StarRings", std::ssize(ids),
           [&](std::int64_t i) { put_in_order(static_cast<std::int32_t>(i), triangles, ids); });
}

// Orders the ring of a node: each triangle follows the one whose last neighbour is its first.
void StarRings::put_in_order(std::int32_t node, const std::vector<Triangle>& triangles,
                             const std::vector<std::int64_t>& ids) {
  if (size(node) == 0) return;
  std::int32_t* const ring = &triangles_[static_cast<std::size_t>(begin(node))];
  const std::int32_t n = size(node);
  const auto others_of = [&](std::int32_t k) {
    return others(triangles[static_cast<std::size_t>(ring[k])], node);
  };
  const auto id_of = [&](std::int32_t k) {
    return ids[static_cast<std::size_t>(others_of(k).first)];
  };
  const auto ends_none = [&](std::int32_t k) {
    for (std::int32_t m = 0; m < n; ++m)
      if (others_of(m).second == others_of(k).first) return false;
    return true;
  };
  std::int32_t first = 0;
  bool open = false;
  for (std::int32_t k = 0; k < n && !open; ++k) {
    open = ends_none(k);  // an open ring begins with this triangle
    if (open || id_of(k) < id_of(first)) first = k;
  }
  std::swap(ring[0], ring[first]);
  bool joined = true;
  for (std::int32_t k = 1; k < n; ++k) {
    std::int32_t follows = k;
    while (follows < n && others_of(follows).first != others_of(k - 1).second) ++follows;
    if (follows == n)
      joined = false;
    else
      std::swap(ring[k], ring[follows]);
  }
  for (std::int32_t k = 0; k < n; ++k)
    neighbours_[static_cast<std::size_t>(begin(node) + k)] = others_of(k).first;
  closed_[static_cast<std::size_t>(node)] = joined && !open;
}

}  // namespace pnpbs
