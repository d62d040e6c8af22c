// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/element_labels.hpp"

#include <algorithm>
#include <cstdlib>
#include <tuple>

#include "base/union_find.hpp"

namespace pnpbs {

namespace {

constexpr int kTorn = 3;  // where a face that strays counts 1

// A face of a tetrahedron at one of its nodes, by its other two.
struct LinkEdge {
  std::array<std::int64_t, 2> ids;  // ascending
  bool along;                       // does the face lie along one surface?

  auto operator<=>(const LinkEdge&) const = default;
};

// Those of a tetrahedron around one of its nodes.
void append_link(const LabelledTetrahedron& tetrahedron, std::int64_t around,
                 std::vector<LinkEdge>& link) {
  const std::array<std::int64_t, 4>& ids = tetrahedron.ids;
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    if (ids[left_out] == around) continue;
    LinkEdge edge{{}, tetrahedron.along[left_out]};
    std::size_t n = 0;
    for (std::size_t k = 0; k < 4; ++k)
      if (k != left_out && ids[k] != around) edge.ids[n++] = ids[k];
    link.push_back(edge);
  }
}

// Those that come once.
std::vector<LinkEdge> open_edges(std::vector<LinkEdge>& link) {
  std::ranges::sort(link);
  std::vector<LinkEdge> open;
  for (std::size_t k = 0; k < link.size(); ++k) {
    const bool as_before = k > 0 && link[k - 1] == link[k];
    const bool as_next = k + 1 < link.size() && link[k + 1] == link[k];
    if (!as_before && !as_next) open.push_back(link[k]);
  }
  return open;
}

// The nodes of these edges, each as often as it is an end.
std::vector<std::int64_t> ends_of(const std::vector<LinkEdge>& edges) {
  std::vector<std::int64_t> ends;
  for (const LinkEdge& edge : edges) ends.insert(ends.end(), edge.ids.begin(), edge.ids.end());
  std::ranges::sort(ends);
  return ends;
}

int pieces_of(const std::vector<LinkEdge>& edges, const std::vector<std::int64_t>& ends) {
  std::vector<std::int64_t> nodes = ends;
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const auto place = [&](std::int64_t id) {
    return static_cast<std::size_t>(std::ranges::lower_bound(nodes, id) - nodes.begin());
  };
  UnionFind<std::size_t> joined(nodes.size());
  auto pieces = static_cast<int>(nodes.size());
  for (const LinkEdge& edge : edges) {
    const std::size_t a = place(edge.ids[0]), b = place(edge.ids[1]);
    if (joined.root(a) != joined.root(b)) --pieces;
    joined.join(a, b);
  }
  return pieces;
}

}  // namespace

ElementLabels::ElementLabels(std::vector<LabelledTetrahedron> tetrahedra,
                             const std::vector<LabelledNode>& nodes)
    : tetrahedra_(std::move(tetrahedra)) {
  std::ranges::sort(tetrahedra_);
  tetrahedra_.erase(std::unique(tetrahedra_.begin(), tetrahedra_.end()), tetrahedra_.end());
  changed_.assign(tetrahedra_.size(), 0);
  for (const LabelledNode& node : nodes) nodes_.push_back({node, {}});
  std::ranges::sort(nodes_, {}, [](const Node& node) { return node.is.id; });
  for (std::size_t n = 0; n < nodes_.size(); ++n) node_at_[nodes_[n].is.id] = n;
  for (std::size_t t = 0; t < tetrahedra_.size(); ++t)
    for (const std::int64_t id : tetrahedra_[t].ids)
      if (const auto found = node_at_.find(id); found != node_at_.end())
        nodes_[found->second].tetrahedra.push_back(t);
}

// Of the open edges around it, the faces of the boundary as the node sees them: nodes where they
// branch, circles too many, and feature edges that are not among them, and
// those that lie along no surface; a node in no element, or with elements all around, has none.
int ElementLabels::defects(const Node& node) const {
  constexpr int kNoFace = 4 * kTorn;
  std::vector<LinkEdge> link;
  for (const std::size_t t : node.tetrahedra)
    if (tetrahedra_[t].is_element) append_link(tetrahedra_[t], node.is.id, link);
  const std::vector<LinkEdge> open = open_edges(link);
  if (open.empty()) return kNoFace;
  const std::vector<std::int64_t> ends = ends_of(open);
  int torn = std::abs(pieces_of(open, ends) - static_cast<int>(node.is.disks));
  for (std::size_t k = 0; k < ends.size();) {
    const auto next =
        static_cast<std::size_t>(std::ranges::upper_bound(ends, ends[k]) - ends.begin());
    torn += static_cast<int>(next - k) / 2 - 1;
    k = next;
  }
  for (const std::int64_t other : node.is.joined) torn += !std::ranges::binary_search(ends, other);
  const auto strays = std::ranges::count(open, false, &LinkEdge::along);
  return kTorn * torn + static_cast<int>(strays);
}

int ElementLabels::defects_around(const LabelledTetrahedron& tetrahedron) const {
  int sum = 0;
  for (const std::int64_t id : tetrahedron.ids)
    if (const auto found = node_at_.find(id); found != node_at_.end())
      sum += defects(nodes_[found->second]);
  return sum;
}

void ElementLabels::change(std::size_t t) {
  tetrahedra_[t].is_element = !tetrahedra_[t].is_element;
  changed_[t] = changed_[t] == 0;
}

// By how many there are fewer defects after these changes. Each node counts once.
int ElementLabels::gain(const std::vector<std::size_t>& changes) {
  std::set<std::size_t> around;
  for (const std::size_t t : changes)
    for (const std::int64_t id : tetrahedra_[t].ids)
      if (const auto found = node_at_.find(id); found != node_at_.end())
        around.insert(found->second);
  const auto sum = [&] {
    int all = 0;
    for (const std::size_t n : around) all += defects(nodes_[n]);
    return all;
  };
  const int before = sum();
  for (const std::size_t t : changes) change(t);
  const int after = sum();
  for (const std::size_t t : changes) change(t);
  return before - after;
}

// What is surely inside or outside stays; so does what has a node around which not all is known.
bool ElementLabels::may_change(std::size_t t) const {
  constexpr double kMaxDepth = 0.2;
  const LabelledTetrahedron& tetrahedron = tetrahedra_[t];
  return tetrahedron.may_change && tetrahedron.depth < kMaxDepth &&
         std::ranges::all_of(tetrahedron.ids,
                             [&](std::int64_t id) { return node_at_.contains(id); });
}

// The change that helps most, of one tetrahedron or, if the node has no disk, of two around it; of
// equals the one that is nearest to the surface.
bool ElementLabels::improve(const Node& node) {
  std::vector<std::size_t> free;
  for (const std::size_t t : node.tetrahedra)
    if (may_change(t)) free.push_back(t);
  std::tuple<int, double> best{0, 0};
  std::vector<std::size_t> changes;
  const auto consider = [&](const std::vector<std::size_t>& those) {
    double depth = 0;
    for (const std::size_t t : those) depth += tetrahedra_[t].depth;
    const std::tuple<int, double> here{gain(those), -depth};
    if (std::get<0>(here) <= 0 || (!changes.empty() && here <= best)) return;
    best = here;
    changes = those;
  };
  for (const std::size_t t : free) consider({t});
  if (changes.empty() && defects(node) >= kTorn)
    for (std::size_t k = 0; k < free.size(); ++k)
      for (std::size_t l = 0; l < k; ++l) consider({free[k], free[l]});
  for (const std::size_t t : changes) change(t);
  return !changes.empty();
}

std::vector<LabelledTetrahedron> ElementLabels::settle() {
  bool any = true;
  while (any) {
    any = false;
    for (const Node& node : nodes_)
      while (defects(node) > 0 && improve(node)) any = true;
  }
  std::vector<LabelledTetrahedron> result;
  for (std::size_t t = 0; t < tetrahedra_.size(); ++t)
    if (changed_[t] != 0) result.push_back(tetrahedra_[t]);
  return result;
}

}  // namespace pnpbs
