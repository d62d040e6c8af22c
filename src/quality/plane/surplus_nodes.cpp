// SPDX-License-Identifier: BSD-3-Clause
#include "quality/plane/surplus_nodes.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "method/constants.hpp"
#include "quality/triangle_quality.hpp"

namespace pnpbs {

namespace {

// The neighbours of a node, counter-clockwise from the one with the smallest id. This order makes
// every rank compute the same bits.
struct Ring {
  std::array<std::int64_t, method::kFewNeighbours> node{};
  std::int32_t size = 0;
};

Ring ring_around(const Nodes<2>& nodes, const DelaunayStars& stars, std::int64_t i) {
  Ring ring;
  stars.for_neighbours_in_order(i, [&](std::int64_t j, bool) { ring.node[ring.size++] = j; });
  const auto begin = ring.node.begin(), end = begin + ring.size;
  std::rotate(
      begin,
      std::min_element(begin, end,
                       [&](std::int64_t j, std::int64_t k) { return nodes.id(j) < nodes.id(k); }),
      end);
  return ring;
}

bool has_few_neighbours(const Nodes<2>& nodes, const DelaunayStars& stars, std::int64_t i) {
  return nodes.moves(i) && stars.closed(i) && stars.size(i) <= method::kFewNeighbours;
}

double quality_of(const Nodes<2>& nodes, std::int64_t i, std::int64_t j, std::int64_t k) {
  return triangle_quality(nodes.position(i), nodes.position(j), nodes.position(k));
}

double min_quality_around(const Nodes<2>& nodes, std::int64_t i, const Ring& ring) {
  double min = 1;
  for (std::int32_t k = 0; k < ring.size; ++k)
    min = std::min(min, quality_of(nodes, i, ring.node[k], ring.node[(k + 1) % ring.size]));
  return min;
}

// The triangulation of the hole that a removed node leaves: one triangle, or two with a diagonal
// from ring.node[edge] to the opposite node.
struct Filling {
  double min_quality;
  std::int32_t edge;  // -1: no diagonal
};

Filling best_filling(const Nodes<2>& nodes, const Ring& ring) {
  const auto& n = ring.node;
  if (ring.size == 3) return {quality_of(nodes, n[0], n[1], n[2]), -1};
  const Filling even{
      std::min(quality_of(nodes, n[0], n[1], n[2]), quality_of(nodes, n[0], n[2], n[3])), 0},
      odd{std::min(quality_of(nodes, n[1], n[2], n[3]), quality_of(nodes, n[1], n[3], n[0])), 1};
  return odd.min_quality > even.min_quality ? odd : even;
}

// Returns the best triangulation of the hole without node i, or nothing if the node should stay.
std::optional<Filling> better_without(const Nodes<2>& nodes, const DelaunayStars& stars,
                                      std::int64_t i) {
  const Ring ring = ring_around(nodes, stars, i);
  for (std::int32_t k = 0; k < ring.size; ++k)
    if (has_few_neighbours(nodes, stars, ring.node[k])) return std::nullopt;
  const Filling filling = best_filling(nodes, ring);
  if (filling.min_quality < min_quality_around(nodes, i, ring) + method::kSurplusPays)
    return std::nullopt;
  return filling;
}

// Removes node i from the stars of its neighbours and adds the diagonal of the filling.
void take_out(const Nodes<2>& nodes, DelaunayStars& stars, std::int64_t i, const Filling& filling) {
  const Ring ring = ring_around(nodes, stars, i);
  for (std::int32_t k = 0; k < ring.size; ++k) {
    if (filling.edge >= 0 && k % 2 == filling.edge)
      stars.replace(ring.node[k], i, ring.node[(k + 2) % method::kFewNeighbours]);
    else
      stars.remove(ring.node[k], i);
  }
  stars.clear(i);
}

}  // namespace

std::vector<std::int32_t> remove_surplus_nodes(const Nodes<2>& nodes, DelaunayStars& stars) {
  std::vector<std::int32_t> surplus;
  std::vector<Filling> fillings;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!has_few_neighbours(nodes, stars, i)) continue;
    const std::optional<Filling> filling = better_without(nodes, stars, i);
    if (!filling) continue;
    surplus.push_back(static_cast<std::int32_t>(i));
    fillings.push_back(*filling);
  }
  for (std::size_t s = 0; s < surplus.size(); ++s) take_out(nodes, stars, surplus[s], fillings[s]);
  return surplus;
}

}  // namespace pnpbs
