// SPDX-License-Identifier: BSD-3-Clause
#include "check/node_check.hpp"

#include <algorithm>
#include <cmath>

#include "base/limits.hpp"
#include "base/mixed_hash.hpp"
#include "comm/records.hpp"

namespace pnpbs {

void fail_check(const MessageText& what) {
  throw Error(ErrorKind::internal, "the check of the results failed: " + what);
}

// ------------------------------------------------------------------ nodes ----------------------

template <int Dim>
std::int64_t NodeCheck<Dim>::owned_node(std::int64_t id) const {
  std::int64_t low = 0, high = owned_;
  while (low < high) {
    const std::int64_t middle = low + (high - low) / 2;
    if (nodes_.id(p_.node_at(middle)) < id)
      low = middle + 1;
    else
      high = middle;
  }
  if (low == owned_) return -1;
  const std::int64_t i = p_.node_at(low);
  return nodes_.id(i) == id ? i : -1;
}

// Distributes the nodes of all ranks by their keys, so that nodes with the same key are on the same
// rank. Collective.
template <int Dim>
std::vector<typename NodeCheck<Dim>::PlacedId> NodeCheck<Dim>::gathered_by(
    std::uint64_t (*key)(const PlacedId&)) const {
  std::vector<PlacedId> mine;
  mine.reserve(static_cast<std::size_t>(owned_));
  for_owned([&](std::int64_t i) { mine.push_back({nodes_.id(i), position(i)}); });
  if (comm_.size() == 1) return mine;
  const auto ranks = static_cast<std::uint64_t>(comm_.size());
  return redistribute(comm_, mine,
                      [&](const PlacedId& node) { return static_cast<int>(key(node) % ranks); });
}

template <int Dim>
void NodeCheck<Dim>::check_ids() const {
  std::vector<PlacedId> nodes =
      gathered_by([](const PlacedId& node) { return mixed(static_cast<std::uint64_t>(node.id)); });
  std::ranges::sort(nodes, {}, &PlacedId::id);
  const auto twice = std::ranges::adjacent_find(nodes, {}, &PlacedId::id);
  if (twice != nodes.end())
    fail_check("two nodes have the id " + text_of(*twice) + " and " + point_text(twice[1].x));
  if (!nodes.empty() && nodes.front().id < 0)
    fail_check("node " + text_of(nodes.front()) + " has a negative id");
}

template <int Dim>
void NodeCheck<Dim>::check_places() const {
  for_owned([&](std::int64_t i) {
    if (!is_usable(position(i)))
      fail_check("node " + name(i) + " has coordinates that are not usable");
  });
  std::vector<PlacedId> nodes = gathered_by([](const PlacedId& node) {
    std::uint64_t hash = 0;
    for (const double x : node.x) hash = mixed_with(hash, x + 0.0);  // -0 and 0 are the same point
    return hash;
  });
  std::ranges::sort(nodes, {}, &PlacedId::x);
  const auto twice = std::ranges::adjacent_find(nodes, {}, &PlacedId::x);
  if (twice != nodes.end())
    fail_check("nodes " + text_of(twice[0]) + " and " + text_of(twice[1]) +
               " lie at the same point");
}

template <int Dim>
void NodeCheck<Dim>::check_inside(std::int64_t i, const FacetIndex<Dim>& boundary) const {
  if (!boundary.inside(position(i))) fail_check("node " + name(i) + " does not lie inside");
}

template <int Dim>
void NodeCheck<Dim>::check_placed(std::int64_t i, const Point<Dim>& laid) const {
  if (position(i) != laid)
    fail_check("node " + name(i) +
               " is on the boundary, but not where it was placed: " + point_text(laid));
}

// ------------------------------------------------------------------ lists ----------------------

template <int Dim>
bool NodeCheck<Dim>::lists(std::int64_t i, std::int64_t id) const {
  bool found = false;
  level_.lists().for_neighbours(i, [&](std::int64_t j) { found = found || nodes_.id(j) == id; });
  return found;
}

// Returns the pair of an owned node i and a ghost j as the owner of j knows it.
template <int Dim>
typename NodeCheck<Dim>::ListedPair NodeCheck<Dim>::pair_at_owner(std::int64_t i,
                                                                  std::int64_t j) const {
  const std::int64_t of = nodes_.id(j), shift = nodes_.cell.home_id(of) - of;
  return {of + shift, nodes_.id(i) + shift, owner_of(j)};
}

template <int Dim>
void NodeCheck<Dim>::check_lists() const {
  std::vector<ListedPair> elsewhere;
  const auto require_listed = [&](std::int64_t i, std::int64_t id) {
    if (!lists(i, id))
      fail_check("node " + name(i) + " is in the adjacency list of node " + std::to_string(id) +
                 ", which is not in its own");
  };
  for_owned([&](std::int64_t i) {
    std::int64_t before = -1;
    level_.lists().for_neighbours(i, [&](std::int64_t j) {
      if (j == i || nodes_.id(j) <= before)
        fail_check("the adjacency list of node " + name(i) + " has node " + name(j) +
                   " out of the order of ids");
      before = nodes_.id(j);
      if (nodes_.owned(j))
        require_listed(j, nodes_.id(i));
      else
        elsewhere.push_back(pair_at_owner(i, j));
    });
  });
  if (!level_.distributed()) return;
  for (const ListedPair& pair :
       redistribute(comm_, elsewhere, [](const ListedPair& listed) { return listed.owner; })) {
    const std::int64_t i = owned_node(pair.of);
    if (i < 0)
      fail_check(
          "node " + std::to_string(pair.listed) + " has node " + std::to_string(pair.of) +
          " in its adjacency list, which the rank that was taken for its owner does not own");
    require_listed(i, pair.listed);
  }
}

template <int Dim>
double NodeCheck<Dim>::sum_over_ranks(double mine, double unit) const {
  constexpr double kFine = 0x1p40, kMax = 1e6;
  const double share = mine / unit;  // may be NaN or huge if nodes have invalid positions
  const double parts = (std::isnan(share) ? kMax : std::clamp(share, -kMax, kMax)) * kFine;
  const std::uint64_t sum =
      comm_.allreduce_sum(static_cast<std::uint64_t>(static_cast<std::int64_t>(parts)));
  return static_cast<double>(static_cast<std::int64_t>(sum)) / kFine * unit;
}

template class NodeCheck<2>;
template class NodeCheck<3>;

}  // namespace pnpbs
