// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/node_link.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace pnpbs {

namespace {

// A face of a tetrahedron at one of its nodes, given by its two other nodes in ascending order.
struct LinkEdge {
  std::array<std::int64_t, 2> ids;
  bool along;

  auto operator<=>(const LinkEdge&) const = default;
};

// Returns the faces of a tetrahedron at one of its nodes.
std::array<LinkEdge, 3> link_edges(const LabelledTetrahedron& tetrahedron, std::int64_t around) {
  const std::array<std::int64_t, 4>& ids = tetrahedron.ids;
  std::array<LinkEdge, 3> edges;
  std::size_t count = 0;
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    if (ids[left_out] == around) continue;
    LinkEdge edge{{}, tetrahedron.along[left_out]};
    std::size_t n = 0;
    for (std::size_t k = 0; k < 4; ++k)
      if (k != left_out && ids[k] != around) edge.ids[n++] = ids[k];
    edges[count++] = edge;
  }
  return edges;
}

template <class Value>
void sort_once(std::vector<Value>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

template <class Value>
std::int64_t place_of(const std::vector<Value>& sorted, const Value& value) {
  const auto found = std::ranges::lower_bound(sorted, value);
  return found != sorted.end() && *found == value ? found - sorted.begin() : -1;
}

}  // namespace

NodeLink::NodeLink(const LabelledNode& node, const std::vector<LabelledTetrahedron>& tetrahedra,
                   const std::vector<std::size_t>& around)
    : disks_(node.disks) {
  std::vector<LinkEdge> all;
  std::vector<std::int64_t> ids;
  for (const std::size_t t : around)
    for (const LinkEdge& edge : link_edges(tetrahedra[t], node.id)) {
      all.push_back(edge);
      ids.insert(ids.end(), edge.ids.begin(), edge.ids.end());
    }
  sort_once(all);
  sort_once(ids);
  const auto end = [&](std::int64_t id) { return static_cast<std::size_t>(place_of(ids, id)); };
  for (const LinkEdge& edge : all)
    edges_.push_back({{end(edge.ids[0]), end(edge.ids[1])}, edge.along, 0});
  for (const std::int64_t id : node.joined) joined_.push_back(place_of(ids, id));
  for (const std::size_t t : around) {
    is_element_.push_back(tetrahedra[t].is_element);
    std::array<std::size_t, 3>& mine = edges_of_.emplace_back();
    const std::array<LinkEdge, 3> given = link_edges(tetrahedra[t], node.id);
    for (std::size_t k = 0; k < 3; ++k) {
      mine[k] = static_cast<std::size_t>(place_of(all, given[k]));
      edges_[mine[k]].used += tetrahedra[t].is_element;
    }
  }
  open_at_.resize(ids.size());
  pieces_ = UnionFind<std::size_t>(ids.size());
  defects_ = counted_defects();
  gains_of_disks_.assign(around.size(), kNotCached);
  ids_ = std::move(ids);
}

void NodeLink::flip(std::size_t place) {
  is_element_[place] = is_element_[place] == 0;
  for (const std::size_t edge : edges_of_[place])
    edges_[edge].used += is_element_[place] != 0 ? 1 : -1;
}

void NodeLink::change(std::size_t place) {
  flip(place);
  defects_ = counted_defects();
  std::ranges::fill(gains_of_disks_, kNotCached);
}

int NodeLink::gain(std::initializer_list<std::size_t> places) {
  for (const std::size_t place : places) flip(place);
  const int fewer = defects() - weighed(counted_defects());
  for (const std::size_t place : places) flip(place);
  return fewer;
}

int NodeLink::gain_of_disks(std::size_t place) {
  int& gain = gains_of_disks_[place];
  if (gain != kNotCached) return gain;
  flip(place);
  gain = defects_of_disks() - disks_first(counted_defects());
  flip(place);
  return gain;
}

int NodeLink::euler_times_six(std::size_t place) const {
  const auto is_open = [](const Edge& edge) { return edge.used == 1; };
  if (std::ranges::none_of(edges_, is_open)) return 0;
  int faces = 0, edges = 0;
  std::array<std::size_t, 6> ends;
  for (std::size_t k = 0; k < 3; ++k) {
    const Edge& edge = edges_[edges_of_[place][k]];
    faces += is_open(edge);
    ends[2 * k] = edge.ends[0];
    ends[2 * k + 1] = edge.ends[1];
  }
  std::ranges::sort(ends);
  for (std::size_t k = 0; k < ends.size(); k += 2)  // Each end belongs to two edges.
    edges += std::ranges::any_of(edges_, [&](const Edge& edge) {
      return is_open(edge) && (edge.ends[0] == ends[k] || edge.ends[1] == ends[k]);
    });
  return 6 - 3 * edges + 2 * faces;
}

// Counts the defects of the open edges: pieces too many or too few, nodes where they branch,
// feature edges that are not among them, and edges along no surface. A node in no element, or
// surrounded by elements, has no open edge.
NodeLink::Defects NodeLink::counted_defects() {
  constexpr Defects kNoFace{4, 0, 0};
  std::ranges::fill(open_at_, 0);
  pieces_.separate_all();
  int open = 0, strays = 0, pieces = 0;
  for (const Edge& edge : edges_) {
    if (edge.used != 1) continue;
    ++open;
    strays += !edge.along;
    const auto [a, b] = edge.ends;
    for (const std::size_t end : edge.ends) pieces += open_at_[end]++ == 0;
    pieces -= pieces_.root(a) != pieces_.root(b);
    pieces_.join(a, b);
  }
  if (open == 0) return kNoFace;
  Defects found{std::abs(pieces - static_cast<int>(disks_)), 0, strays};
  for (const std::int32_t ends : open_at_)
    if (ends > 0) found.disks += ends / 2 - 1;
  for (const std::int64_t other : joined_)
    found.edges += other < 0 || open_at_[static_cast<std::size_t>(other)] == 0;
  return found;
}

}  // namespace pnpbs
